// The list of cuts whose interfaces have the smallest angles: dihedral angles between interface and surface along the
// contour, or angles of the interface's triangles. The numbers are those of the tree's rows, and the sorting is that of
// the tree's columns, so that both agree. A click shows the cut and flies to the place of the smallest angle. The
// dihedral needs the surface of the node, which may have to be made in the background first: the flight waits
// (WorstInterfacesMemory::awaited) and is given up when another node is shown.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "viewer/model/interface_places.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

class WorstInterfaces {
 public:
    WorstInterfaces(UiContext& context, WorstInterfacesMemory& memory)
        : context_(context),
          memory_(memory),
          colors_(palette(context.state.theme)),
          by_{memory.by_angle ? angle_column : dihedral_column, false},
          rows_(context.session.document().tree.in_order()) {
        std::erase_if(rows_, [&](const TreeRow* row) { return !number_in(*row, *by_.by); });
        sort_rows(rows_, by_);
    }

    void draw() {
        if (rows_.empty()) return show_wrapped("No angles of interfaces are known: nothing has been cut.", colors_.dim);
        if (context_.widgets.radio("By dihedral", !memory_.by_angle)) memory_.by_angle = false;
        explain("The smallest angle between interface and surface along the contour");
        ImGui::SameLine(0, em());
        if (context_.widgets.radio("By angle", memory_.by_angle)) memory_.by_angle = true;
        explain("The smallest angle of a triangle of the interface");
        constexpr ImGuiTableFlags flags =
            ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoSavedSettings;
        const float rows = std::min(10.f, rows_.size() + 1.3f);
        if (!ImGui::BeginTable("##worst interfaces", 4, flags, {0, rows * (ImGui::GetTextLineHeight() + 0.4f * em())}))
            return;
        draw_heads();
        ImGuiListClipper clipper;
        clipper.Begin(count_of(rows_));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_row(i);
        ImGui::EndTable();
    }

 private:
    void draw_heads() const {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("##number", ImGuiTableColumnFlags_WidthFixed, 2 * em());
        for (const char* column : {"##node", "##dihedral", "##angle"}) ImGui::TableSetupColumn(column);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        int index = 0;
        for (const char* head : {"", "node", "dihedral", "angle"}) {
            ImGui::TableSetColumnIndex(index++);
            show_right(head, colors_.dim);
        }
    }

    void draw_row(int i) {
        const TreeRow& row = *rows_[i];
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        const std::string label = fmt::format("worst interface {}", i + 1);
        if (ImGui::Selectable(fmt::format("{}##{}", i + 1, label).c_str(), memory_.chosen == row.id,
                              ImGuiSelectableFlags_SpanAllColumns))
            choose(row.id);
        const ImVec2 from = ImGui::GetItemRectMin();  // the row spans columns, which are clipped one by one
        context_.widgets.record(label, from, {from.x + 2 * em(), ImGui::GetItemRectMax().y});
        ImGui::TableSetColumnIndex(1);
        show_right(fmt::format("{}", row.id.value()), colors_.text);
        for (const auto& [index, column] : {std::pair(2, dihedral_column), {3, angle_column}}) {
            ImGui::TableSetColumnIndex(index);
            const std::optional<double> degrees = number_in(row, column);
            show_right(degrees ? fmt::format("{:.1f}", *degrees) : "", colors_.text);
        }
    }

    void choose(NodeId node) {
        memory_.chosen = memory_.awaited = node;
        context_.state.step = {Stage::interface, -1};
        reveal(context_, node);
        go_to_node(context_, node);
    }

    UiContext& context_;
    WorstInterfacesMemory& memory_;
    const Palette& colors_;
    TreeOrder by_;
    std::vector<const TreeRow*> rows_;
};

// Flies to the awaited interface once its node's surface is there, which may have to be made first.
void fly_when_there(UiContext& context, WorstInterfacesMemory& memory) {
    if (memory.awaited == no_node) return;
    const NodeId node = memory.awaited;
    const Document& document = context.session.document();
    const Cut* cut = document.trace ? document.trace->find(node) : nullptr;
    const std::shared_ptr<const NodeSurface> surface = cut ? context.session.fetched().surface(node) : nullptr;
    if (cut && !surface && context.state.node == node) return;
    memory.awaited = no_node;
    if (!surface || context.state.node != node) return;
    const std::optional<InterfacePlace> place =
        memory.by_angle ? smallest_angle(cut->interface) : smallest_dihedral(cut->interface, *surface);
    if (place) context.actions.camera.fly_to(place->where, 2 * place->radius, Vec3::Zero());
}

}  // namespace

void draw_worst_interfaces(UiContext& context, WorstInterfacesMemory& memory) {
    fly_when_there(context, memory);
    if (context.widgets.header("Worst interfaces", false)) WorstInterfaces(context, memory).draw();
}

}  // namespace kerf::view
