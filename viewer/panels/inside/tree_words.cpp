#include "viewer/panels/inside/tree_words.h"

#include <concepts>

#include <fmt/format.h>

#include "base/core/words.h"
#include "viewer/panels/text.h"

namespace kerf::view {

namespace {

// Text of numbers of any kind, a line each.
class Lines {
 public:
    void add(const char* what, const std::string& value) {
        if (!value.empty()) text_ += fmt::format("{}{}: {}", text_.empty() ? "" : "\n", what, value);
    }
    template <std::integral Number>
    void add(const char* what, Number value) {
        add(what, value < 0 ? "" : fmt::format("{}", value));
    }
    void add(const char* what, double value, const char* unit = "") {
        add(what, value < 0 ? "" : fmt::format("{:.6g}{}", value, unit));
    }
    const std::string& text() const { return text_; }

 private:
    std::string text_;
};

void add_cut(const CutSummary& cut, Lines& lines) {
    lines.add("cut by", in_words(name(cut.strategy)));
    if (cut.tries > 0) lines.add("tries", cut.tries);
    if (!cut.made()) return;
    lines.add("contour length", cut.contour_length);
    lines.add("contour loops", cut.loops);
    lines.add("interface triangles", cut.interface_faces);
    lines.add("interface area", cut.interface_area);
    if (cut.section_area > 0 && cut.interface_area >= 0)
        lines.add("interface over section area", cut.interface_area / cut.section_area);
    lines.add("smallest angle", cut.quality.angle_deg, " deg");
    lines.add("smallest dihedral angle", cut.quality.dihedral_deg, " deg");
}

bool is_cut_by(const TreeRow& row, CutStrategy strategy) { return row.cut && row.cut->strategy == strategy; }

}  // namespace

ImVec4 color_of(const TreeRow& row, const Palette& colors) {
    switch (row.state) {
        case NodeState::divided:
            return is_cut_by(row, CutStrategy::soft) || is_cut_by(row, CutStrategy::straight) ? colors.warning
                                                                                              : colors.dim;
        case NodeState::waiting:
            return is_cut_by(row, CutStrategy::whole) ? colors.warning : colors.waiting;
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
    if (row.regions > 1) return fmt::format("{} regions", row.regions);
    return row.cut ? in_words(name(row.cut->strategy)) : "cut";
}

std::string details(const TreeRow& row, const std::string* region) {
    Lines lines;
    lines.add("node", row.id.value());
    lines.add("state", std::string(name(row.state)));
    if (row.regions > 1) lines.add("regions", row.regions);
    if (region) lines.add("region", *region);
    if (row.leaves > 1) lines.add("parts below", row.leaves);
    lines.add("facets", row.facets);
    lines.add("vertices", row.vertices);
    lines.add("tetrahedra", row.tets);
    lines.add("volume", row.volume);
    lines.add("load", row.load);
    lines.add(row.leaf() ? "meshed in" : "cut in", duration(row.seconds));
    lines.add("rank", row.rank);
    if (row.cut) add_cut(*row.cut, lines);
    lines.add("message", row.message);
    return lines.text();
}

}  // namespace kerf::view
