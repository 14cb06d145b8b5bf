// 3MF files as bytes: ZIP archives with a model in them. What the model says is read by the program kerf-3mf.
#pragma once

#include <string>
#include <string_view>

namespace kerf {

/// A ZIP archive that names the model of a 3MF file, and the relations by which it is found. O(size).
bool is_threemf(std::string_view content);

/// Throws Error(input) naming the file for a ZIP archive without a table of contents, which is truncated, or one whose
/// table claims more content than most_content() of its size (io/compressed.h): nothing is unpacked before.
void check_growth_of_zip(std::string_view content, const std::string& path);

}  // namespace kerf
