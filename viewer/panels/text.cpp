// Numbers and texts as panels show them. Large numbers have three significant digits and the largest unit that leaves a
// digit before the point; limits like 999.5 and 9.995 are where rounding to three digits would carry into a fourth.
// Texts are cut at the characters of UTF-8, never within one, and are measured in the current font, so that these
// functions need an ImGui frame. Ticks are i * step for whole i, not sums, so that they carry no rounding errors along.
#include "viewer/panels/text.h"

#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace kerf::view {

namespace {

// Three digits with the largest unit that leaves at least one of them before the point.
std::string with_unit(double value, double step, const std::array<const char*, 5>& units) {
    std::size_t unit = 0;
    while (value >= 999.5 && unit + 1 < units.size()) {
        value /= step;
        ++unit;
    }
    const int decimals = unit == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
    return fmt::format("{:.{}f}{}{}", value, decimals, *units[unit] ? " " : "", units[unit]);
}

constexpr std::array<const char*, 5> thousands = {"", "k", "M", "G", "T"};
constexpr std::array<const char*, 5> bytes_units = {"B", "kB", "MB", "GB", "TB"};

// Whether a byte continues a character of UTF-8.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

}  // namespace

float width_of(const std::string& text) { return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x; }

std::string compact(std::int64_t count) { return count < 0 ? "" : with_unit(count, 1000, thousands); }

std::string compact(double value) {
    if (!(value >= 0)) return "";
    return value < 999.5 ? fmt::format("{:.3g}", value) : with_unit(value, 1000, thousands);
}

std::string rounded(double value) {
    if (std::isfinite(value) && value == std::round(value) && std::abs(value) < 1e6)
        return fmt::format("{:.0f}", value);
    return fmt::format("{:.3g}", value);
}

std::string duration(double seconds) {
    if (seconds < 0) return "";
    if (seconds < 0.95) return fmt::format("{:.2g} s", seconds);
    if (seconds < 99.5) return fmt::format("{:.{}f} s", seconds, seconds < 9.95 ? 1 : 0);
    const std::int64_t whole = std::llround(seconds);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string number_of(std::int64_t n, const std::string& noun) {
    return fmt::format("{} {}{}", compact(n), noun, n == 1 ? "" : "s");
}

std::string file_size(std::uintmax_t bytes) { return with_unit(bytes, 1000, bytes_units); }

std::vector<double> round_ticks(double low, double high, int wanted) {
    if (!(high > low) || !std::isfinite(high - low)) return {low};
    const double rough = (high - low) / wanted;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double digit = rough / power;
    const double step = power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
    std::vector<double> ticks;
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push_back(i * step + 0.0);
    return ticks;
}

std::string shortened(const std::string& text, float width) {
    if (width_of(text) <= width) return text;
    std::size_t end = text.size();
    while (end > 0) {
        --end;
        while (end > 0 && continues(text[end])) --end;
        if (width_of(text.substr(0, end) + "...") <= width) break;
    }
    return text.substr(0, end) + "...";
}

std::string shortened_path(const std::string& path, float width) {
    if (width_of(path) <= width) return path;
    std::size_t begin = 0;
    while (begin < path.size()) {
        ++begin;
        while (begin < path.size() && continues(path[begin])) ++begin;
        if (width_of("..." + path.substr(begin)) <= width) break;
    }
    return "..." + path.substr(begin);
}

std::string broken(const std::string& text, float width) {
    std::string all, line, word;
    std::istringstream words(text);
    while (words >> word) {
        const std::string longer = line.empty() ? word : fmt::format("{} {}", line, word);
        if (line.empty() || width_of(longer) <= width) {
            line = longer;
            continue;
        }
        all += line + "\n";
        line = word;
    }
    return all + line;
}

void show(const std::string& text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

void show(const std::string& text, const ImVec4& color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    show(text);
    ImGui::PopStyleColor();
}

void show_wrapped(const std::string& text, const ImVec4& color) {
    ImGui::PushTextWrapPos(0);
    show(text, color);
    ImGui::PopTextWrapPos();
}

void show_right(const std::string& text, const ImVec4& color) {
    const float room = ImGui::GetContentRegionAvail().x - width_of(text);
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    show(text, color);
}

}  // namespace kerf::view
