// The files of assets/report, which the build makes a part of the program (embed.cmake).
#pragma once

#include <string_view>

namespace kerf::page_files {

extern const std::string_view page_html, page_css, page_js, figures_js, view_js, three_min_js;

}  // namespace kerf::page_files
