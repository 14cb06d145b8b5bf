// The comparison of two runs, A before and B after a repetition with other options: of these options, of the cut of the
// node shown, where it differs, and of the whole run. A value of B is green or red where more or less of it is better;
// a value that is not known is negative and shown as "-". Whichever of the two is shown, A is the earlier one; the
// switch is drawn first, because it may exchange the two documents that the tables refer to.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/words.h"
#include "viewer/model/saving.h"
#include "viewer/panels/inside/parts.h"

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
        row("", "A", "B", colors.dim);
    }
    ~Table() {
        if (open_) ImGui::EndTable();
    }
    Table(const Table&) = delete;
    Table& operator=(const Table&) = delete;

    void add(const std::string& what, const std::string& before, const std::string& now) {
        row(what, before, now, colors_.text);
    }
    // Adds a row of numbers, the new one green or red if one of the two is better and that can be read. Negative: not
    // known.
    void add(const char* what, double before, double now, Better better = Better::neither) {
        const bool same = number(before) == number(now) || better == Better::neither || before < 0 || now < 0;
        const bool gain = better == Better::more ? now > before : now < before;
        row(what, number(before), number(now), same ? colors_.text : gain ? colors_.good : colors_.bad);
    }

 private:
    static std::string number(double value) { return value < 0 ? "-" : fmt::format("{:.5g}", value); }

    void row(const std::string& what, const std::string& before, const std::string& now, const ImVec4& color) {
        if (!open_) return;
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        show(what, colors_.dim);
        ImGui::TableSetColumnIndex(1);
        show_right(shortened(before, ImGui::GetContentRegionAvail().x), colors_.dim);
        ImGui::TableSetColumnIndex(2);
        show_right(shortened(now, ImGui::GetContentRegionAvail().x), color);
    }

    const Palette& colors_;
    bool open_ = false;
};

bool is_same(const CutSummary& a, const CutSummary& b) {
    return a.strategy == b.strategy && a.tries == b.tries && a.contour_edges == b.contour_edges &&
           a.plane.origin == b.plane.origin && a.plane.normal == b.plane.normal && a.interface_area == b.interface_area;
}

void compare_cuts(NodeId node, const CutSummary& before, const CutSummary& now, const Palette& colors) {
    Table table(fmt::format("Cut of node {}", node.value()).c_str(), colors);
    table.add("cut by", in_words(name(before.strategy)), in_words(name(now.strategy)));
    table.add("tries", before.tries, now.tries, Better::less);
    table.add("contour length", before.contour_length, now.contour_length, Better::less);
    table.add("contour edges", before.contour_edges, now.contour_edges);
    table.add("loops", before.loops, now.loops);
    table.add("interface area", before.interface_area, now.interface_area, Better::less);
    table.add("smallest angle", before.quality.angle_deg, now.quality.angle_deg, Better::more);
    table.add("dihedral angle", before.quality.dihedral_deg, now.quality.dihedral_deg, Better::more);
    table.add("off the plane", before.max_deviation, now.max_deviation);
}

// The numbers of a run; negative: not known.
struct RunNumbers {
    double parts = 0, failed = 0, tries = 0, tets = 0, area = 0, imbalance = -1, angle = -1;
    double smallest = -1, percentile = -1, median = -1;  // dihedral angles
};

RunNumbers numbers_of(const Document& document) {
    RunNumbers n;
    double load = 0, largest_load = 0;
    bool has_loads = true;
    for (const TreeRow& row : document.tree.rows) {
        if (row.cut) n.tries += row.cut->tries;
        if (row.plane()) n.area += row.cut->interface_area;
        if (row.plane() && row.cut->quality.angle_deg >= 0)
            n.angle = n.angle < 0 ? row.cut->quality.angle_deg : std::min(n.angle, row.cut->quality.angle_deg);
        if (!row.leaf()) continue;
        ++n.parts;
        n.failed += row.state == NodeState::failed;
        if (row.tets > 0) n.tets += row.tets;
        has_loads &= row.load > 0;
        load += row.load;
        largest_load = std::max(largest_load, row.load);
    }
    if (has_loads && load > 0) n.imbalance = largest_load * n.parts / load;
    if (const auto& angles = document.histograms[0]) {
        n.smallest = angles->min;
        n.percentile = angles->p1;
        n.median = angles->median;
    }
    return n;
}

std::string count_text(double count) { return count > 0 ? compact(count) : "-"; }

void compare_runs(const Document& before, const Document& now, const Palette& colors) {
    const RunNumbers a = numbers_of(before), b = numbers_of(now);
    Table table("Run", colors);
    table.add("parts", a.parts, b.parts);
    table.add("tries", a.tries, b.tries, Better::less);
    table.add("cutting, s", before.cut_seconds, now.cut_seconds, Better::less);
    table.add("meshing, s", before.mesh_seconds, now.mesh_seconds, Better::less);
    table.add("load imbalance", a.imbalance, b.imbalance, Better::less);
    table.add("tetrahedra", count_text(a.tets), count_text(b.tets));
    table.add("smallest dihedral", a.smallest, b.smallest, Better::more);
    table.add("1 % are below", a.percentile, b.percentile, Better::more);
    table.add("median dihedral", a.median, b.median, Better::more);
    table.add("interface angle", a.angle, b.angle, Better::more);
    table.add("interface area", a.area, b.area, Better::less);
    if (a.failed > 0 || b.failed > 0) table.add("failed parts", a.failed, b.failed, Better::less);
}

// The options by which the runs differ explain the differences of all that follows.
void compare_options(const Document& before, const Document& now, const Palette& colors) {
    const std::vector<OptionText> old_texts = option_texts(before.options, true),
                                  new_texts = option_texts(now.options, true);
    if (std::equal(old_texts.begin(), old_texts.end(), new_texts.begin(), new_texts.end(),
                   [](const OptionText& a, const OptionText& b) { return a.text == b.text; }))
        return;
    Table table("Options", colors);
    for (std::size_t i = 0; i < old_texts.size(); ++i)
        if (old_texts[i].text != new_texts[i].text) table.add(old_texts[i].name, old_texts[i].text, new_texts[i].text);
}

// Draws the switch between the two runs.
void draw_switch(UiContext& context) {
    const bool shows_before = context.session.shows_before();
    ImGui::BeginDisabled(!context.session.pair().can_swap());
    const bool wants_a = context.widgets.radio("A##run", shows_before);
    explain("What was there before the last run or cut was made, under the same camera (key B)");
    ImGui::SameLine();
    const bool wants_b = context.widgets.radio("B##run", !shows_before);
    explain("What the last run or cut has made (key B)");
    ImGui::EndDisabled();
    if (has_mesh(context.session.document()) && has_mesh(*context.session.other_document())) {
        ImGui::SameLine();
        context.widgets.checkbox("Side by side", &context.state.look.beside, "Both under one camera (Shift+B)");
    }
    if ((wants_a && !shows_before) || (wants_b && shows_before)) context.actions.runs.swap_runs();
}

void draw_saving(UiContext& context, SaveDialog& dialog) {
    const std::string& saved_as = context.session.document().saved_as;
    if (!saved_as.empty()) show_wrapped("Saved as " + saved_as, palette(context.state.theme).dim);
    if (!context.session.pair().can_save()) return;
    if (context.widgets.button("Save run...", "Keeps this run, which is removed else when the viewer ends (Ctrl+S)"))
        dialog.request(SaveDialog::Kind::run);
}

}  // namespace

void draw_comparison(UiContext& context, SaveDialog& dialog) {
    const Session& session = context.session;
    const Palette& colors = palette(context.state.theme);
    const Document *other = session.other_document(), *shown = &session.document();
    if (other && !shown->progress.running) {
        draw_switch(context);  // first: it may exchange the two
        const Document &before = session.shows_before() ? *shown : *other,
                       &now = session.shows_before() ? *other : *shown;
        compare_options(before, now, colors);
        const NodeId node = context.state.node;
        const TreeRow *old_row = before.tree.find(node), *new_row = now.tree.find(node);
        if (old_row && new_row && old_row->cut && new_row->cut && !is_same(*old_row->cut, *new_row->cut))
            compare_cuts(node, *old_row->cut, *new_row->cut, colors);
        compare_runs(before, now, colors);
    }
    draw_saving(context, dialog);
}

}  // namespace kerf::view
