// 3MF files as bytes: ZIP archives with a model in them. The program kerf-3mf reads the model.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// Tells whether the content is a ZIP archive with the model of a 3MF file and the relations by which it is found.
/// O(size).
bool is_threemf(std::string_view content);

/// Checks a ZIP archive before anything is unpacked. Throws Error(input) naming the file for an archive without a table
/// of contents, which is truncated, or one whose table claims more content than most_content() of its size
/// (files/io/compressed.h).
void check_growth_of_zip(std::string_view content, const std::string& path);

}  // namespace kerf
