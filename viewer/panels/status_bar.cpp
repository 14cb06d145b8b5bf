// The status bar: the most urgent message at the left, the progress of a run at the right. Messages are taken in order
// of urgency: a notice of the app, an error of the document, the end of a run, a failed background job, and last the
// sizes of the open document. The time left is that of the load left (1 - Progress::load_done) at the rate so far, and
// is told from 3 per cent on.
#include <algorithm>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// The number of tetrahedra; empty if there are none.
std::string cells_of(const Document& document) {
    std::int64_t tets = 0;
    for (const TreeRow& row : document.tree.rows) tets += row.leaf() ? std::max<std::int64_t>(0, row.tets) : 0;
    return tets > 0 ? compact(tets) + " tetrahedra" : "";
}

std::string facts_of(UiContext& context) {
    const Document& document = context.session.document();
    const std::string outcome = document.progress.running ? "" : outcome_of(document, context.state.look.times);
    std::string text = outcome.empty() || document.input_facets == 0
                           ? sizes_of(document)
                           : number_of(document.input_facets, "facet") + ", " + outcome;
    if (context.facts.triangles > 0)
        text += (text.empty() ? "" : ", ") + number_of(context.facts.triangles, "triangle") + " drawn";
    return text;
}

struct Message {
    std::string text;
    ImVec4 color;
};

// The most urgent message.
Message left_message(UiContext& context) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    if (!context.facts.notice.empty())
        return {context.facts.notice, context.facts.notice_is_error ? colors.bad : colors.accent};
    if (!document.error.empty()) return {document.error, colors.bad};
    if (!document.progress.running && !document.progress.message.empty())
        return {document.progress.message, colors.bad};
    if (document.kind == Document::Kind::none) return {"Nothing is open", colors.dim};
    if (!context.session.failures().empty()) return {context.session.failures().back(), colors.bad};
    const std::string facts = facts_of(context);
    return {facts.empty() ? document.title : document.title + ": " + facts, colors.text};
}

// The time that the rest of the work takes at the rate so far; empty before 3 per cent are done.
std::string time_left(const Progress& progress) {
    if (progress.load_done < 0.03 || progress.load_done >= 1) return "";
    return ", about " + duration(progress.seconds * (1 - progress.load_done) / progress.load_done) + " left";
}

std::string stage_text(const Progress& progress) {
    const std::string& stage = progress.stage;
    if (stage == "repair") return "Repairing";
    if (stage == "read") return "Reading";
    if (stage == "remesh") return "Remeshing";
    if (stage == "decompose") return "Cutting";
    if (stage == "prepare") return "Preparing parts";
    if (stage == "volume") return "Meshing";
    if (stage == "reference") return "Meshing in one piece";
    if (stage == "write") return "Writing";
    if (stage == "hash") return "Checking files";
    return stage.empty() ? "Running" : stage;
}

std::string progress_text(const Progress& progress) {
    std::string text = stage_text(progress);
    if (progress.parts > 0) text += fmt::format(", {} of {} parts", progress.parts_done, progress.parts);
    return text + ", " + duration(progress.seconds) + time_left(progress);
}

void draw_bar(double fraction, const Palette& colors) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = 9 * em(), height = 0.55f * em(), drop = (ImGui::GetTextLineHeight() - height) / 2;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto fill = static_cast<float>(std::clamp(fraction, 0., 1.));
    const ImVec2 from = {at.x, at.y + drop}, to = {at.x + width, at.y + drop + height};
    list.AddRectFilled(from, to, packed(faded(colors.dim, 0.3f)), height / 2);
    if (fill > 0)
        list.AddRectFilled(from, {from.x + std::max(height, fill * width), to.y}, packed(colors.busy), height / 2);
    ImGui::Dummy({width, ImGui::GetTextLineHeight()});
}

void draw_progress(UiContext& context) {
    const Progress& progress = context.session.document().progress;
    const Palette& colors = palette(context.state.theme);
    const std::string text = progress_text(progress);
    const float spacing = 0.7f * em();
    const float button =
        progress.ours ? ImGui::CalcTextSize("Cancel").x + 2 * ImGui::GetStyle().FramePadding.x + spacing : 0;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(text.c_str()).x - 9 * em() - spacing - button);
    show(text, colors.text);
    ImGui::SameLine(0, spacing);
    draw_bar(progress.load_done, colors);
    if (!progress.ours) return;
    ImGui::SameLine(0, spacing);
    if (context.widgets.small_button("Cancel", "Ends the run within five seconds")) context.session.cancel_run();
}

}  // namespace

std::string sizes_of(const Document& document) {
    std::string text;
    if (document.input_facets > 0) text = number_of(document.input_facets, "facet");
    const std::string cells = cells_of(document);
    return text + (text.empty() || cells.empty() ? "" : ", ") + cells;
}

std::string outcome_of(const Document& document, bool with_seconds) {
    std::string text = cells_of(document);
    if (text.empty()) return "";
    if (const auto& angles = document.histograms[0])
        text += fmt::format(", least dihedral angle {:.1f} deg", angles->min);
    if (document.verified) text += *document.verified ? ", verified" : ", NOT verified";
    if (with_seconds && document.progress.seconds > 0) text += ", " + duration(document.progress.seconds);
    return text;
}

void draw_status(UiContext& context) {
    const Palette& colors = palette(context.state.theme);
    ImGui::SetCursorPosY((ImGui::GetWindowHeight() - ImGui::GetTextLineHeight()) / 2);
    const bool running = context.session.document().progress.running;
    const Message message = left_message(context);
    show(shortened(message.text, (running ? 0.45f : 0.85f) * ImGui::GetWindowWidth()), message.color);
    explain(message.text);
    if (running) return draw_progress(context);
    const bool writes = context.session.writer().is_writing();
    if (!context.facts.pending && !writes) return;
    ImGui::SameLine();
    show_right(writes ? "writing..." : "reading...", colors.busy);
}

}  // namespace kerf::view
