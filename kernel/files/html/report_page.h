// A run as one page of HTML that can be sent by mail.
#pragma once

#include <cstdint>
#include <string>

namespace kerf {

/// The most boundary triangles of a page, of all parts together; larger runs are made coarser. A page with so many
/// takes less than 5 MB.
inline constexpr std::int64_t most_page_triangles = 600'000;

struct ReportPage {
    std::string html;
    std::int64_t parts = 0;
    std::int64_t triangles = 0, triangles_of_run = 0;  ///< boundary triangles of all parts, in the page and in the run
};

/// Returns the page of a run of kerf mesh or kerf decompose that has ended, even if parts of it could not be meshed:
/// the figures of its report, and the surfaces of its parts, with 16 bits a coordinate and at most `limit` > 0
/// triangles (files/html/inside/page_surface.h). Of a solution of kerf solve it has loads, reactions and largest
/// values, too, and its values on the surface. It needs no other file and no network. The bytes depend on the folder
/// alone.
///
/// Throws Error(io), with the way out, for a folder that is no such run or solution, and Error(verification) where a
/// report or another file is not as Kerf has written it. Memory: the page, and a part at a time.
ReportPage report_page(const std::string& folder, std::int64_t limit = most_page_triangles);

}  // namespace kerf
