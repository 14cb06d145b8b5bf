// Words and numbers as people read them, and short calls to show them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <imgui.h>

namespace kerf::view {

/// Returns "999", "12.3 k", "4.56 M"; empty for an unknown count (negative).
std::string compact(std::int64_t count);
std::string compact(double value);
/// Returns three significant digits: "0.00123", "12.3", "1.23e+07"; whole numbers below a million in full.
std::string rounded(double value);
/// Returns "3.2 s", "4 min 5 s", "2 h 3 min"; empty if negative.
std::string duration(double seconds);
/// Returns "3 parts", "1 part".
std::string number_of(std::int64_t n, const std::string& noun);
/// Returns "12.3 kB", of 1000 bytes each.
std::string file_size(std::uintmax_t bytes);
/// Returns about `wanted` round values in [low, high], ascending: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double low, double high, int wanted);
/// Returns the width of the text in pixels, on one line.
float width_of(const std::string& text);
/// Returns the start of the text that is no wider than `width`, with "..." if anything was left out.
std::string shortened(const std::string& text, float width);
/// Returns the text in lines no wider than `width`, broken between words alone: ImGui breaks numbers at their commas
/// and points.
std::string broken(const std::string& text, float width);
/// Returns the end of the path that is no wider than `width`, with "..." before it if anything was left out.
std::string shortened_path(const std::string& path, float width);

void show(const std::string& text);
void show(const std::string& text, const ImVec4& color);
void show_wrapped(const std::string& text, const ImVec4& color);
/// Shows the text at the right of the column or panel.
void show_right(const std::string& text, const ImVec4& color);

}  // namespace kerf::view
