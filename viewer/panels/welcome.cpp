// The start page: files opened before, kinds of files that can be opened, and surfaces to try. It is drawn in the place
// of the scene while there is no body, which includes the time that a file takes to open and the case that it cannot be
// opened. Opening a file changes the list of recent files, and with it the document, so that lists are copied before
// buttons are drawn. Pictures of examples show only a part of a screenshot (seen_from, seen_to).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "files/io/surface_formats.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

constexpr std::size_t most_recent = 8;
constexpr float share_of_tiles = 0.66f;  // of the width

// The kinds of surfaces are those of the reader's table.
std::vector<std::string> what_can_be_opened() {
    std::string read, imported;
    for (const SurfaceFormat& format : surface_formats()) {
        std::string& list = format.is_imported ? imported : read;
        list += (list.empty() ? "" : ", ") + std::string(format.words);
    }
    return {"Surfaces: " + read + ", also .gz or .zst", "Bodies: " + imported,
            "Traces: what kerf mesh --trace FILE has written",
            "Runs: the folder of kerf mesh -o DIR, finished or under way",
            "Solutions: the folder of kerf solve -o DIR"};
}

// The example whose cut the tour shows.
constexpr const char* example_of_tour = "Bearing cap 14k";

// The part of an example's picture that is shown, as fractions of its size: that which caption and legend leave to the
// body.
const ImVec2 seen_from = {0, 0.15f}, seen_to = {0.66f, 1};
constexpr float picture_shape = 0.966f;  // height over width of that part

void show_centered(const std::string& text, const ImVec4& color) {
    const float room = ImGui::GetContentRegionAvail().x, width = ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, (room - width) / 2));
    show(text, color);
}

// Draws a ground that lights up under the mouse, and returns whether it was clicked.
bool draw_tile_ground(UiContext& context, const std::string& label, const ImVec2& size) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton(("##" + label).c_str(), size);
    context.widgets.record(label);
    const Palette& colors = palette(context.state.theme);
    const ImVec4 ground = ImGui::IsItemHovered() ? faded(colors.accent, 0.3f) : colors.frame;
    ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + size.x, from.y + size.y}, packed(ground), 0.3f * em());
    return clicked;
}

void add_text(const ImVec2& at, const std::string& text, float width, const ImVec4& color) {
    ImGui::GetWindowDrawList()->AddText(at, packed(color), shortened(text, width).c_str());
}

// The name of the last file or folder of a path, which may end with a slash.
std::string name_of_path(const std::string& path) {
    const std::filesystem::path file(path);
    return (file.has_filename() ? file : file.parent_path()).filename().string();
}

void draw_recent(UiContext& context, const Palette& colors) {
    const std::vector<RecentFile> recent = context.settings.recent;  // opening changes it
    if (recent.empty()) return;
    show("Opened before", colors.text);
    const float pad = 0.4f * em(), line = ImGui::GetTextLineHeight();
    for (std::size_t i = 0; i < std::min(recent.size(), most_recent); ++i) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        if (draw_tile_ground(context, fmt::format("open recent {}", i + 1), {width, 2 * line + pad}))
            context.actions.files.open_files({recent[i].path});
        explain(recent[i].path);
        const std::string& day = recent[i].day;
        const std::string more = day + (day.empty() || recent[i].sizes.empty() ? "" : ", ") + recent[i].sizes;
        add_text({at.x + pad, at.y + pad / 2}, name_of_path(recent[i].path), width - 2 * pad, colors.accent);
        add_text({at.x + pad, at.y + pad / 2 + line}, more, width - 2 * pad, colors.dim);
    }
    ImGui::Dummy({0, 0.5f * em()});
}

void draw_left(UiContext& context, const Palette& colors) {
    draw_recent(context, colors);
    show("What can be opened", colors.text);
    for (const std::string& kind : what_can_be_opened()) show_wrapped(kind, colors.dim);
}

// The columns of the tiles of all examples, and the size of each.
struct Tiles {
    int columns = 1;
    ImVec2 size = {0, 0};
    float height = 0;  // of all rows
};

float tile_gap() { return 0.5f * em(); }

// The largest tiles that fit into the room, as few in a row as can be; small ones, which scroll, if none fit.
Tiles arranged(int count, const ImVec2& room) {
    Tiles tiles;
    for (int columns = std::min(count, 3);; ++columns) {
        const float width = std::floor((room.x + tile_gap()) / static_cast<float>(columns) - tile_gap());
        const int rows = (count + columns - 1) / columns;
        tiles.columns = columns;
        tiles.size = {width, std::floor(picture_shape * width + 2.4f * ImGui::GetTextLineHeight())};
        tiles.height = static_cast<float>(rows) * (tiles.size.y + tile_gap());
        if (tiles.height <= room.y || columns >= count || width < 8.5f * em()) return tiles;
    }
}

void draw_example(UiContext& context, const Example& example, const ImVec2& size) {
    const Palette& colors = palette(context.state.theme);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (draw_tile_ground(context, "example " + example.name, size)) context.actions.files.open_files({example.path});
    explain(example.path);
    const float pad = 0.3f * em(), line = ImGui::GetTextLineHeight(), below = size.y - 2 * line - pad;
    if (example.picture)
        ImGui::GetWindowDrawList()->AddImage(example.picture, {at.x + pad, at.y + pad},
                                             {at.x + size.x - pad, at.y + below - pad}, seen_from, seen_to);
    add_text({at.x + pad, at.y + below}, example.name, size.x - 2 * pad, colors.text);
    add_text({at.x + pad, at.y + below + line}, number_of(example.facets, "facet"), size.x - 2 * pad, colors.dim);
}

void draw_examples(UiContext& context, const Tiles& tiles, const Palette& colors) {
    show("Surfaces to try: one click opens and cuts them", colors.text);
    const std::vector<Example> examples = context.examples;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {tile_gap(), tile_gap()});
    for (int i = 0; i < count_of(examples); ++i) {
        if (i % tiles.columns != 0) ImGui::SameLine();
        draw_example(context, examples[i], tiles.size);
    }
    ImGui::PopStyleVar();
}

void draw_buttons(UiContext& context, Dialogs& dialogs) {
    const auto tour = std::find_if(context.examples.begin(), context.examples.end(),
                                   [](const Example& example) { return example.name == example_of_tour; });
    const char *choose = "Choose a file...", *show_cut = "Show me how a cut is made";
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = width_of(choose) + 2 * style.FramePadding.x;
    if (tour != context.examples.end()) width += width_of(show_cut) + 2 * style.FramePadding.x + style.ItemSpacing.x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.f, (ImGui::GetContentRegionAvail().x - width) / 2));
    if (context.widgets.button(choose, "Ctrl+O")) dialogs.browser.requested = true;
    if (tour == context.examples.end()) return;
    ImGui::SameLine();
    if (!context.widgets.button(show_cut, "Opens a bearing cap, cuts it, and explains each stage")) return;
    const std::string path = tour->path;
    context.actions.files.open_files({path});
    begin_tour(context, dialogs);
}

void draw_titles(const Document& document, const Palette& colors) {
    ImGui::PushFont(large_font());
    if (!document.error.empty()) show_centered("This file could not be opened", colors.bad);
    show_centered(document.error.empty() ? "Drop a surface, a trace or a run folder here" : "Drop another one here",
                  colors.text);
    ImGui::PopFont();
}

void draw_columns(UiContext& context, const Tiles& tiles, const Palette& colors) {
    const bool has_examples = !context.examples.empty();
    ImGui::BeginChild("##start", {0, 0});  // scrolls
    if (ImGui::BeginTable("##start page", has_examples ? 2 : 1, ImGuiTableFlags_NoSavedSettings)) {
        ImGui::TableSetupColumn("##left", ImGuiTableColumnFlags_WidthStretch, 1 - share_of_tiles);
        if (has_examples) ImGui::TableSetupColumn("##right", ImGuiTableColumnFlags_WidthStretch, share_of_tiles);
        ImGui::TableNextColumn();
        draw_left(context, colors);
        if (has_examples && ImGui::TableNextColumn()) draw_examples(context, tiles, colors);
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

}  // namespace

void draw_welcome(UiContext& context, Dialogs& dialogs, const Rectangle& scene) {
    const Document& document = context.session.document();
    const Palette& colors = palette(context.state.theme);
    const bool is_opening = !document.path.empty() && document.error.empty();
    const float e = em(), width = std::min((context.examples.empty() ? 40 : 84) * e, scene.width - 2 * e);
    const float head = 8.7f * e, most = scene.height - 2 * e;
    Tiles tiles;
    if (!context.examples.empty())
        tiles = arranged(count_of(context.examples), {share_of_tiles * width - 2 * e, most - head - 2 * e});
    const float least = std::max(26 * e, head + tiles.height + 2 * e);
    const float height = std::min(is_opening ? 5 * e : least, most);
    begin_place("##welcome",
                {scene.x + (scene.width - width) / 2, scene.y + (scene.height - height) / 2, width, height},
                ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    const ImVec2 from = ImGui::GetWindowPos();
    draw_backdrop(*ImGui::GetWindowDrawList(), context.state.theme, {from.x + 0.5f * e, from.y + 0.5f * e},
                  {from.x + width - 0.5f * e, from.y + height - 0.5f * e});
    ImGui::Dummy({0, 0.4f * e});
    if (is_opening) {
        show_centered("Opening " + document.title, colors.text);
    } else {
        draw_titles(document, colors);
        ImGui::Dummy({0, 0.2f * e});
        draw_buttons(context, dialogs);
        ImGui::Dummy({0, 0.6f * e});
        draw_columns(context, tiles, colors);
    }
    ImGui::End();
}

}  // namespace kerf::view
