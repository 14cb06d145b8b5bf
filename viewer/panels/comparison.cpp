// What a repetition with other options has changed: of one cut, or of the whole run.
#include <fmt/format.h>

#include "core/words.h"
#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

enum class Better { more, less, neither };

class Table {
 public:
    Table(const char* title, const Palette& colors) : colors_(colors) {
        ImGui::Spacing();
        show(title, colors.accent);
        open_ = ImGui::BeginTable("##comparison", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings);
        if (!open_) return;
        ImGui::TableSetupColumn("##what", ImGuiTableColumnFlags_WidthStretch, 1.5f);
        ImGui::TableSetupColumn("##before");
        ImGui::TableSetupColumn("##now");
        row("", "before", "now", colors.dim);
    }
    ~Table() {
        if (open_) ImGui::EndTable();
    }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    void add(const char* what, const std::string& before, const std::string& now) {
        row(what, before, now, colors_.text);
    }
    // The new value is green or red if one of them is better.
    void add(const char* what, double before, double now, Better better = Better::neither) {
        const bool same = before == now || better == Better::neither;
        const bool gain = better == Better::more ? now > before : now < before;
        row(what, number(before), number(now), same ? colors_.text : gain ? colors_.good : colors_.bad);
    }

 private:
    static std::string number(double value) { return fmt::format("{:.5g}", value); }

    void row(const char* what, const std::string& before, const std::string& now, const ImVec4& color) {
        if (!open_) return;
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        show(what, colors_.dim);
        ImGui::TableSetColumnIndex(1);
        show_right(before, colors_.dim);
        ImGui::TableSetColumnIndex(2);
        show_right(now, color);
    }

    const Palette& colors_;
    bool open_ = false;
};

void compare_cuts(const Cut& before, const Cut& now, const Palette& colors) {
    Table table(fmt::format("Cut of node {}", now.node).c_str(), colors);
    table.add("cut by", in_words(name(before.rung)), in_words(name(now.rung)));
    table.add("tries", static_cast<double>(before.tries.size()), static_cast<double>(now.tries.size()), Better::less);
    table.add("contour length", before.contour_length, now.contour_length, Better::less);
    table.add("contour edges", static_cast<double>(before.contour_edges), static_cast<double>(now.contour_edges));
    table.add("loops", static_cast<double>(before.loops.size()), static_cast<double>(now.loops.size()));
    table.add("interface area", before.interface_area, now.interface_area, Better::less);
    table.add("smallest angle", before.quality.angle_deg, now.quality.angle_deg, Better::more);
    table.add("dihedral angle", before.quality.dihedral_deg, now.quality.dihedral_deg, Better::more);
    table.add("off the plane", before.max_deviation, now.max_deviation);
}

struct Sums {
    double parts = 0, tets = 0, area = 0, failed = 0;
};

Sums sums_of(const Tree& tree) {
    Sums sums;
    for (const TreeRow& row : tree.rows) {
        sums.parts += row.leaf();
        sums.failed += row.state == NodeState::failed;
        if (row.leaf() && row.tets > 0) sums.tets += static_cast<double>(row.tets);
        if (row.plane()) sums.area += row.cut->interface_area;
    }
    return sums;
}

void compare_runs(const Tree& before, const Tree& now, const Palette& colors) {
    const Sums old_sums = sums_of(before), new_sums = sums_of(now);
    Table table("Run", colors);
    table.add("parts", old_sums.parts, new_sums.parts);
    table.add("tetrahedra", compact(old_sums.tets), compact(new_sums.tets));
    table.add("interface area", old_sums.area, new_sums.area, Better::less);
    if (old_sums.failed > 0 || new_sums.failed > 0)
        table.add("failed parts", old_sums.failed, new_sums.failed, Better::less);
}

}  // namespace

void draw_comparison(UiContext& context) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    const Cut* before = context.session.cut_before(context.state.node);
    const Cut* now = document.trace ? document.trace->find(context.state.node) : nullptr;
    if (before && now) compare_cuts(*before, *now, colors);
    const Tree& tree_before = context.session.tree_before();
    if (!tree_before.rows.empty() && !document.progress.running) compare_runs(tree_before, document.tree, colors);
}

}  // namespace kerf::view
