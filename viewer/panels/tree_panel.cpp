// The tree of nodes as a table, a row for each node in depth-first order, or sorted by a column, which makes it a plain
// list without indents and folds. Rows have one height and only those in sight are drawn (ImGuiListClipper), so that
// trees of many thousand nodes cost no more. A node comes into sight when it is chosen elsewhere, by keys or in the
// scene, and then only once, so that the wheel stays free. The table's id holds the shown columns: ImGui keeps widths
// that a user has changed by it, for as long as the columns are the same.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/model/shown_parts.h"
#include "viewer/panels/inside/icons.h"
#include "viewer/panels/inside/parts.h"
#include "viewer/panels/inside/tree_columns.h"
#include "viewer/panels/inside/tree_words.h"

namespace kerf::view {

namespace {

bool is_shown(const ViewState& state, const Document& document, NodeId node) {
    if (state.visibility.is_hidden(node)) return false;
    return shows_node(state, document, node) ||
           (state.visibility.isolated && lies_below(*state.visibility.isolated, node));
}

// Seconds with two digits behind the point, or fewer where they would be more than three in all.
std::string short_seconds(double seconds) {
    return seconds < 0 ? "" : fmt::format("{:.{}f}", seconds, seconds < 9.995 ? 2 : seconds < 99.95 ? 1 : 0);
}

template <class T>
void set_in(std::set<T>& set, const T& item, bool is_in) {
    if (is_in)
        set.insert(item);
    else
        set.erase(item);
}

constexpr float fold_size = 0.85f;  // size of the button before a node, in ems

class TreeTable {
 public:
    TreeTable(UiContext& context, TreeMemory& memory)
        : context_(context), memory_(memory), colors_(palette(context.state.theme)) {}

    void draw() {
        const Tree& tree = context_.session.document().tree;
        rows_ = tree.in_order();
        const TreeColumns columns(rows_, context_.state.look.times, memory_.columns, room());
        total_load_ = columns.total_load;
        const bool is_sortable = memory_.order.by && columns.shown[*memory_.order.by];
        if (!is_sortable) memory_.order = {};
        is_sortable ? sort_rows(rows_, memory_.order) : leave_out_folded();
        // Widths that a user has changed stay as long as the columns are the same.
        std::string id = fmt::format("##tree {}", tree.levels());
        for (const bool shown : columns.shown) id += shown ? '1' : '0';
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable |
                                          ImGuiTableFlags_NoSavedSettings | ImGuiTableFlags_NoBordersInBody;
        if (!ImGui::BeginTable(id.c_str(), column_count, flags, {0, 0})) return;
        columns.set_up();
        draw_heads();
        scroll_to_node();
        ImGuiListClipper clipper;
        clipper.Begin(count_of(rows_), row_height());
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_row(*rows_[i]);
        ImGui::EndTable();
    }

 private:
    bool is_tree() const { return !memory_.order.by; }

    void leave_out_folded() {
        // The node that is shown comes into sight when it is chosen.
        if (memory_.scrolled_to != context_.state.node)
            for (NodeId node = parent_of(context_.state.node); node > no_node; node = parent_of(node))
                memory_.folded.erase(node);
        if (memory_.folded.empty()) return;
        std::erase_if(rows_, [&](const TreeRow* row) {
            for (NodeId node = parent_of(row->id); node > no_node; node = parent_of(node))
                if (memory_.folded.contains(node)) return true;
            return false;
        });
    }

    // Draws the heads of the columns; a click sorts.
    void draw_heads() {
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (int i = 0; i < column_count; ++i) {
            const auto column = static_cast<TreeColumn>(i);
            if (!ImGui::TableSetColumnIndex(i) || column == eye_column) continue;
            draw_head(column);
        }
    }

    void draw_head(TreeColumn column) {
        const bool chosen = memory_.order.by == column, sorts = column == node_column || column >= facets_column;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (sorts) {
            const std::string label = fmt::format("sort by {}", title(column));
            if (ImGui::InvisibleButton(label.c_str(), {ImGui::GetContentRegionAvail().x, line_height()}))
                memory_.order = memory_.order.after_click(column);
            context_.widgets.record(label);
            explain(column == node_column ? meaning(column) : fmt::format("{}. A click sorts by it.", meaning(column)));
            if (ImGui::IsItemHovered())
                ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                                          packed(faded(colors_.accent, 0.2f)));
            ImGui::SetCursorScreenPos(at);
        }
        const ImVec4& color = chosen ? colors_.accent : colors_.dim;
        column >= facets_column ? show_right(title(column), color) : show(title(column), color);
        // An arrow down: the rows that deserve a look are at the top.
        if (chosen)
            draw_icon(*ImGui::GetWindowDrawList(), memory_.order.reversed ? Icon::up : Icon::down,
                      {at.x - 0.1f * em(), at.y + line_height() / 2}, 0.5f * em(), packed(colors_.accent));
    }

    static float line_height() { return ImGui::GetTextLineHeight() + 0.15f * em(); }
    static float row_height() { return line_height() + 2 * ImGui::GetStyle().CellPadding.y; }

    float room() const {
        const ImVec2 all = ImGui::GetContentRegionAvail();
        const bool scrolls = (rows_.size() + 1) * row_height() > all.y;
        return all.x - (scrolls ? ImGui::GetStyle().ScrollbarSize : 0);
    }

    // Brings the node into sight once when it changes, as it does by keys, too; the wheel stays free.
    void scroll_to_node() {
        if (memory_.scrolled_to == context_.state.node) return;
        memory_.scrolled_to = context_.state.node;
        const auto row =
            std::find_if(rows_.begin(), rows_.end(), [&](const TreeRow* r) { return r->id == context_.state.node; });
        if (row == rows_.end()) return;
        const float top = (row - rows_.begin()) * row_height();
        scroll_to_row(top, 2 * row_height());
    }

    void draw_row(const TreeRow& row) {
        const float alpha = is_shown(context_.state, context_.session.document(), row.id) ? 1 : 0.45f;
        text_ = faded(colors_.text, alpha);
        ImGui::PushID(row.id.value());
        ImGui::TableNextRow(0, row_height());
        draw_node(row, alpha);
        draw_switches(row);
        draw_state(row, alpha);
        draw_number(facets_column, compact(row.facets));
        draw_number(tets_column, compact(row.tets));
        draw_number(load_column, share(row.load));
        draw_number(seconds_column, short_seconds(row.seconds));
        draw_number(rank_column, row.rank < 0 ? "" : fmt::format("{}", row.rank));
        draw_number(tries_column, formatted(number_in(row, tries_column), 0));
        draw_number(angle_column, formatted(number_in(row, angle_column), 1));
        draw_number(dihedral_column, formatted(number_in(row, dihedral_column), 1));
        draw_number(ratio_column, formatted(number_in(row, ratio_column), 2));
        ImGui::PopID();
    }

    void draw_node(const TreeRow& row, float alpha) {
        ImGui::TableSetColumnIndex(node_column);
        const int level = is_tree() ? level_of(row.id) : 0;
        const float left = ImGui::GetCursorPosX() + tree_indent * em() * level;
        const ImVec2 cell = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const bool is_picked = context_.state.selection.kind != Selection::Kind::none &&
                               context_.state.selection.kind != Selection::Kind::place &&
                               context_.state.selection.owner == row.id;
        if (is_picked && context_.state.node != row.id)
            ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, packed(faded(colors_.accent, 0.18f)));
        if (ImGui::Selectable("##node", context_.state.node == row.id,
                              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap,
                              {0, line_height()}))
            choose(row.id);
        const ImVec2 from = ImGui::GetItemRectMin();  // the row spans columns, which are clipped one by one
        const float number = cell.x + tree_indent * em() * level + em();  // right of the button that folds it
        context_.widgets.record(fmt::format("node {}", row.id.value()), {number, from.y},
                                {from.x + width, ImGui::GetItemRectMax().y});
        if (ImGui::IsItemHovered()) explain(details(row, region_of(context_.session.document(), row.id)));
        draw_guides(cell, level);
        ImGui::SameLine(left, 0);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float size = 0.7f * em();
        if (row.leaf()) draw_swatch(row, {at.x, at.y + (line_height() - size) / 2}, size, alpha);
        if (!row.leaf() && is_tree()) draw_fold(row.id);
        ImGui::SetCursorScreenPos({at.x + em(), at.y});
        show(fmt::format("{}", row.id.value()), text_);
    }

    // Draws a line for each level above, from row to row.
    void draw_guides(const ImVec2& cell, int level) const {
        const float padding = ImGui::GetStyle().CellPadding.y;
        const ImU32 color = packed(faded(colors_.dim, 0.4f));
        for (int i = 0; i < level; ++i) {
            const float x = std::round(cell.x + (tree_indent * i + 0.35f) * em());
            ImGui::GetWindowDrawList()->AddLine({x, cell.y - padding}, {x, cell.y - padding + row_height()}, color);
        }
    }

    void draw_fold(NodeId node) {
        const bool folded = memory_.folded.contains(node);
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + (line_height() - fold_size * em()) / 2);
        if (icon_button(context_.widgets, fmt::format("fold {}", node.value()), folded ? Icon::right : Icon::down,
                        fold_size * em(), packed(folded ? colors_.accent : colors_.dim),
                        folded ? "Lists what lies below" : "Leaves what lies below out of this list"))
            set_in(memory_.folded, node, !folded);
    }

    void draw_swatch(const TreeRow& row, const ImVec2& from, float size, float alpha) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 to = {from.x + size, from.y + size};
        const Color* color = part_color(context_.facts, context_.state, row.id);
        if (color)
            list.AddRectFilled(from, to, packed(Color{color->r, color->g, color->b, alpha}), 0.2f * size);
        else
            list.AddRect(from, to, packed(faded(colors_.dim, 0.6f * alpha)), 0.2f * size);
    }

    void draw_switches(const TreeRow& row) {
        ImGui::TableSetColumnIndex(eye_column);
        ViewState& state = context_.state;
        const bool hidden = state.visibility.is_hidden(row.id), isolated = state.visibility.isolated == row.id;
        const ImU32 quiet = packed(faded(colors_.dim, 0.55f));
        if (icon_button(context_.widgets, fmt::format("show {}", row.id.value()), hidden ? Icon::eye_closed : Icon::eye,
                        line_height(), hidden ? packed(colors_.warning) : quiet,
                        hidden ? "Hidden: show it again" : "Hide it and what lies below"))
            hidden ? reveal(context_, row.id) : state.visibility.set_hidden(row.id, true);
        ImGui::SameLine(0, 0.1f * em());
        if (icon_button(context_.widgets, fmt::format("isolate {}", row.id.value()), Icon::isolate, line_height(),
                        isolated ? packed(colors_.accent) : quiet,
                        isolated ? "Show the others again" : "Show only this and what lies below"))
            state.visibility.isolated = isolated ? std::nullopt : std::optional(row.id);
    }

    void draw_state(const TreeRow& row, float alpha) {
        if (!ImGui::TableSetColumnIndex(state_column)) return;
        const ImVec4 color = faded(color_of(row, colors_), alpha);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float r = 0.22f * em();
        if (row.leaf())
            ImGui::GetWindowDrawList()->AddCircleFilled({at.x + r, at.y + line_height() / 2}, r, packed(color));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 3 * r);
        show(shortened(word_of(row, context_.session.document().progress.running), ImGui::GetContentRegionAvail().x),
             color);
    }

    void draw_number(int column, const std::string& text) {
        if (ImGui::TableSetColumnIndex(column)) show_right(text, text_);
    }

    static std::string formatted(const std::optional<double>& number, int digits) {
        return number ? fmt::format("{:.{}f}", *number, digits) : "";
    }

    std::string share(double load) const {
        if (load < 0 || total_load_ <= 0) return "";
        const double percent = 100 * load / total_load_;
        return fmt::format("{:.{}f} %", percent, percent < 9.95 ? 1 : 0);
    }

    void choose(NodeId node) {
        go_to_node(context_, node);
        memory_.scrolled_to = node;  // it is in sight
    }

    UiContext& context_;
    TreeMemory& memory_;
    const Palette& colors_;
    std::vector<const TreeRow*> rows_;
    double total_load_ = 0;
    ImVec4 text_;
};

std::string summary(const Document& document) {
    std::int64_t parts = 0, tets = 0;
    for (const TreeRow& row : document.tree.rows) {
        parts += row.leaf();
        tets += row.leaf() ? std::max<std::int64_t>(row.tets, 0) : 0;
    }
    std::string text = number_of(parts, "part") + ", " + number_of(document.tree.levels(), "level");
    if (tets > 0) text += ", " + compact(tets) + " tetrahedra";
    return text;
}

float width_of_button(const char* label) { return width_of(label) + 2 * ImGui::GetStyle().FramePadding.x; }

void draw_column_menu(UiContext& context, TreeMemory& memory) {
    if (context.widgets.button("Columns", "What the tree says about cuts: tries, angles, areas"))
        ImGui::OpenPopup("##columns");
    if (!ImGui::BeginPopup("##columns")) return;
    for (int i = tries_column; i < column_count; ++i) {
        const auto column = static_cast<TreeColumn>(i);
        bool chosen = memory.columns.contains(i);
        if (context.widgets.checkbox(fmt::format("column {}", title(column)).c_str(), &chosen, meaning(column)))
            set_in(memory.columns, i, chosen);
    }
    ImGui::EndPopup();
}

void draw_tree_head(UiContext& context, TreeMemory& memory) {
    ViewState& state = context.state;
    const float gap = 0.4f * em(), right = ImGui::GetContentRegionMax().x;
    const bool some_hidden = !state.visibility.hidden.empty() || state.visibility.isolated ||
                             !state.visibility.hidden_regions.empty() || state.visibility.isolated_region ||
                             !state.visibility.hidden_patches.empty();
    const float all = some_hidden ? width_of_button("Show all") + gap : 0, columns = width_of_button("Columns");
    ImGui::AlignTextToFramePadding();
    const std::string text = summary(context.session.document());
    show(shortened(text, right - ImGui::GetCursorPosX() - columns - all - gap), palette(state.theme).dim);
    explain(text);
    ImGui::SameLine(right - columns - all);
    draw_column_menu(context, memory);
    if (!some_hidden) return;
    ImGui::SameLine(0, gap);
    if (context.widgets.button("Show all", "Hides nothing and isolates nothing any more")) {
        state.visibility.hidden.clear();
        state.visibility.isolated.reset();
        state.visibility.hidden_regions.clear();
        state.visibility.hidden_patches.clear();
        state.visibility.isolated_region.reset();
    }
}

void draw_without_tree(UiContext& context) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    show(document.title, colors.text);
    if (document.input_facets > 0)
        show_wrapped(
            fmt::format("{}, {}", number_of(document.input_facets, "facet"),
                        document.input_vertices == 1 ? "1 vertex" : compact(document.input_vertices) + " vertices"),
            colors.dim);
    ImGui::Spacing();
    show_wrapped(
        "This surface has not been cut yet. Cut it under Parameters at the right: the tree of cuts and the "
        "parts appear here.",
        colors.dim);
    ImGui::Spacing();
    if (context.widgets.button("Open the parameters")) context.state.panels.parameters = true;
}

}  // namespace

void draw_tree(UiContext& context, TreeMemory& memory) {
    const Document& document = context.session.document();
    if (!has_tree(document)) return draw_without_tree(context);
    draw_tree_head(context, memory);
    TreeTable(context, memory).draw();
}

}  // namespace kerf::view
