#include "viewer/panels/tree_words.h"

#include <fmt/format.h>

#include "core/words.h"
#include "viewer/panels/text.h"

namespace kerf::view {

namespace {

// Numbers of any kind, a line each.
class Lines {
 public:
    void add(const char* what, const std::string& value) {
        if (!value.empty()) text_ += fmt::format("{}{}: {}", text_.empty() ? "" : "\n", what, value);
    }
    void add(const char* what, std::int64_t value) { add(what, value < 0 ? "" : fmt::format("{}", value)); }
    void add(const char* what, double value, const char* unit = "") {
        add(what, value < 0 ? "" : fmt::format("{:.6g}{}", value, unit));
    }
    const std::string& text() const { return text_; }

 private:
    std::string text_;
};

}  // namespace

ImVec4 color_of(const TreeRow& row, const Palette& colors) {
    switch (row.state) {
        case NodeState::divided:
            return row.rung == "soft" || row.rung == "straight" ? colors.warning : colors.dim;
        case NodeState::waiting:
            return row.rung == "whole" ? colors.warning : colors.waiting;
        case NodeState::meshing:
            return colors.busy;
        case NodeState::done:
            return colors.good;
        case NodeState::failed:
            return colors.bad;
    }
    return colors.text;
}

std::string word_of(const TreeRow& row, bool running) {
    if (row.state == NodeState::waiting && !running) return "not meshed";
    if (row.leaf()) return name(row.state);
    return row.rung.empty() ? "cut" : in_words(row.rung);
}

std::string details(const TreeRow& row) {
    Lines lines;
    lines.add("node", static_cast<std::int64_t>(row.id));
    lines.add("state", std::string(name(row.state)));
    if (row.leaves > 1) lines.add("parts below", static_cast<std::int64_t>(row.leaves));
    lines.add("facets", row.facets);
    lines.add("vertices", row.vertices);
    lines.add("tetrahedra", row.tets);
    lines.add("volume", row.volume);
    lines.add("load", row.load);
    lines.add(row.leaf() ? "meshed in" : "cut in", duration(row.seconds));
    lines.add("rank", static_cast<std::int64_t>(row.rank));
    lines.add("cut by", in_words(row.rung));
    if (row.tries > 0) lines.add("tries", static_cast<std::int64_t>(row.tries));
    lines.add("contour length", row.contour_length);
    lines.add("contour loops", static_cast<std::int64_t>(row.loops));
    lines.add("interface triangles", static_cast<std::int64_t>(row.interface_faces));
    lines.add("interface area", row.interface_area);
    if (row.section_area > 0 && row.interface_area >= 0)
        lines.add("interface over section area", row.interface_area / row.section_area);
    lines.add("smallest angle", row.min_angle_deg, " deg");
    lines.add("smallest dihedral angle", row.min_dihedral_deg, " deg");
    lines.add("message", row.message);
    return lines.text();
}

}  // namespace kerf::view
