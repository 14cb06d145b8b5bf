// Words and numbers as people read them, and short calls to show them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <imgui.h>

namespace kerf::view {

/// "999", "12.3 k", "4.56 M"; empty for what is not known (negative).
std::string compact(std::int64_t count);
std::string compact(double value);
/// Three significant digits: "0.00123", "12.3", "1.23e+07"; whole numbers below a million in full.
std::string rounded(double value);
/// "3.2 s", "4 min 5 s", "2 h 3 min".
std::string duration(double seconds);
/// "3 parts", "1 part".
std::string number_of(std::int64_t n, const std::string& noun);
/// "12.3 kB".
std::string file_size(std::uintmax_t bytes);
/// About `wanted` round values in [low, high], ascending: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double low, double high, int wanted);
/// In pixels, on one line.
float width_of(const std::string& text);
/// The start of the text that is no wider than `width`, with "..." if anything was left out.
std::string shortened(const std::string& text, float width);
/// In lines that are no wider, broken between words alone: ImGui breaks numbers at their commas and points.
std::string broken(const std::string& text, float width);
/// Of a path: its end rather than its start.
std::string shortened_path(const std::string& path, float width);

void show(const std::string& text);
void show(const std::string& text, const ImVec4& color);
void show_wrapped(const std::string& text, const ImVec4& color);
/// At the right of the column or panel.
void show_right(const std::string& text, const ImVec4& color);

}  // namespace kerf::view
