// The dialogs that save what is open: a run, its mesh in a format of others, a picture, a page, a repaired surface.
// Each shows the command line that does the same, and what it does is that command, except for a run, which is copied,
// and a picture. A mesh that lies in a temporary folder has no command of its own: its run is made first there. Before
// a mesh that nobody has saved is lost, a question comes (app/unsaved.h); its answer is asked for here.
#include <algorithm>

#include <fmt/format.h>
#include <imgui_internal.h>  // the veil behind the dialog

#include "viewer/model/file_kind.h"
#include "viewer/model/saving.h"
#include "viewer/panels/imgui_input.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

using SaveKind = SaveDialog::Kind;

constexpr const char* save_title = "Save###save dialog";
constexpr const char* question_title = "This mesh is not saved###unsaved";

const char* title_of(SaveKind kind) {
    switch (kind) {
        case SaveKind::run:
            return "Save the run as a folder";
        case SaveKind::mesh:
            return "Export the mesh";
        case SaveKind::picture:
            return "Save the picture";
        case SaveKind::page:
            return "Save the report as a page";
        case SaveKind::surface:
            return "Save the surface";
    }
    return "";
}

std::vector<const Format*> offered_formats() {
    const std::span<const Format* const> all = formats();
    return {all.begin(), all.end()};
}

// The name of a new file, in the folder where the viewer was started.
std::string first_path(const Document& document, const SaveDialog& dialog) {
    const std::string& input = document.options.input.empty() ? document.path : document.options.input;
    const std::string stem = fs::path(input).stem().string();
    std::error_code ignored;
    const std::string path = (fs::current_path(ignored) / stem).string();
    switch (dialog.kind) {
        case SaveKind::run:
            return unused_run_folder(document);
        case SaveKind::mesh:
            return with_ending(path + ".x", *offered_formats()[dialog.format]);
        case SaveKind::picture:
            return path + ".png";
        case SaveKind::page:
            return path + ".html";
        case SaveKind::surface:
            return path + "_repaired.obj";
    }
    return path;
}

bool begin_dialog(const char* name, float width) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(width, screen.x), 0});
    const bool is_shown = ImGui::BeginPopupModal(name, nullptr,
                                                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings);
    if (is_shown) ImGui::GetCurrentContext()->DimBgRatio = 1;  // which fades in slowly else
    return is_shown;
}

class Saving {
 public:
    Saving(UiContext& context, SaveDialog& dialog)
        : context_(context),
          dialog_(dialog),
          document_(context.session.document()),
          colors_(palette(context.state.theme)) {}

    void draw() {
        show(title_of(dialog_.kind), colors_.accent);
        ImGui::Spacing();
        if (dialog_.kind == SaveKind::mesh) draw_format();
        const char* label = dialog_.kind == SaveKind::run ? "Folder" : "Name";
        context_.widgets.input_text(label, &dialog_.path);
        draw_remark();
        ImGui::Spacing();
        show("The same on the command line", colors_.dim);
        show_wrapped(command(), colors_.text);
        if (context_.widgets.small_button("Copy command")) context_.actions.window.copy(command());
        ImGui::Spacing();
        draw_buttons();
    }

 private:
    void draw_format() {
        const std::vector<const Format*> offered = offered_formats();
        std::vector<std::string> names;
        for (const Format* format : offered) names.push_back(fmt::format("{}: {}", format->name, format->help));
        const int before = dialog_.format;
        context_.widgets.combo("Format", &dialog_.format, names);
        const Format& format = *offered[dialog_.format];
        if (dialog_.format != before) dialog_.path = with_ending(dialog_.path, format);
        std::vector<std::string> orders = {"as the run has them", "1: four vertices", "2: a node on each edge, too"};
        orders.resize(format.highest_order + 1);
        dialog_.order = std::min(dialog_.order, format.highest_order);
        context_.widgets.combo("Cells", &dialog_.order, orders);
    }

    // Says what the name would replace: one line in any case, so that nothing moves while one types.
    void draw_remark() {
        const char* taken = "There is one of this name, which is replaced if it is of the same kind.";
        show(!has_ending()          ? "Pictures are PNG files: the name ends with .png."
             : exists(dialog_.path) ? taken
                                    : " ",
             colors_.warning);
    }

    bool has_ending() const { return dialog_.kind != SaveKind::picture || dialog_.path.ends_with(".png"); }

    void draw_buttons() {
        ImGui::BeginDisabled(dialog_.path.empty() || !has_ending() || context_.session.writer().is_writing());
        const bool saves = context_.widgets.button("Save");
        ImGui::EndDisabled();
        ImGui::SameLine();
        const bool cancels = context_.widgets.button("Cancel saving") || is_imgui_key_pressed(ImGuiKey_Escape);
        if (saves) save();
        if (cancels && !saves) context_.actions.window.answer(UnsavedMesh::stay);
        if (saves || cancels) ImGui::CloseCurrentPopup();
    }

    MeshFile mesh_file() const { return {offered_formats()[dialog_.format], dialog_.path, dialog_.order}; }

    // Arguments for a run in this folder.
    std::vector<std::string> arguments(const std::string& folder) const {
        switch (dialog_.kind) {
            case SaveKind::run:
                return arguments_of_run(document_, dialog_.path);
            case SaveKind::mesh:
                return arguments_of_mesh(folder, mesh_file());
            case SaveKind::picture:
                return {"screenshot", "--state", fs::path(dialog_.path).replace_extension(".json").string(), "-o",
                        dialog_.path};
            case SaveKind::page:
                return arguments_of_page(folder, dialog_.path);
            case SaveKind::surface:
                return arguments_of_surface(document_, dialog_.path);
        }
        return {};
    }

    // A run in a temporary folder is made first, in one that stays.
    std::string command() const {
        const bool needs_run = dialog_.kind == SaveKind::mesh || dialog_.kind == SaveKind::page;
        if (!needs_run || !context_.session.pair().can_save()) return command_text(arguments(folder_of(document_)));
        const std::string run = fs::path(dialog_.path).replace_extension("").string() + "_run";
        return command_text(arguments_of_run(document_, run)) + " && " + command_text(arguments(run));
    }

    void save() {
        switch (dialog_.kind) {
            case SaveKind::run:
                return context_.session.pair().save(dialog_.path);
            case SaveKind::mesh:
            case SaveKind::page:
                return context_.session.write(arguments(folder_of(document_)), dialog_.path);
            case SaveKind::picture:
                return context_.actions.window.save_picture(dialog_.path);
            case SaveKind::surface:
                return context_.session.repairs().save(dialog_.path);
        }
    }

    UiContext& context_;
    SaveDialog& dialog_;
    const Document& document_;
    const Palette& colors_;
};

}  // namespace

void draw_save_dialog(UiContext& context, SaveDialog& dialog) {
    if (std::exchange(dialog.is_requested, false)) {
        dialog.path = first_path(context.session.document(), dialog);
        ImGui::OpenPopup(save_title);
    }
    if (!begin_dialog(save_title, 40 * em())) return;
    Saving(context, dialog).draw();
    ImGui::EndPopup();
}

void draw_unsaved(UiContext& context, SaveDialog& dialog) {
    if (context.facts.asks_to_save && !ImGui::IsPopupOpen(question_title)) ImGui::OpenPopup(question_title);
    if (!begin_dialog(question_title, 30 * em())) return;
    const Palette& colors = palette(context.state.theme);
    show("This mesh is not saved", colors.accent);
    show_wrapped("It lies in a temporary folder, which goes when it is closed: " +
                     outcome_of(context.session.document(), true) + ".",
                 colors.text);
    ImGui::Spacing();
    std::optional<UnsavedMesh> answer;
    if (context.widgets.button("Save it...")) answer = UnsavedMesh::save;
    ImGui::SameLine();
    if (context.widgets.button("Let it go")) answer = UnsavedMesh::lose;
    ImGui::SameLine();
    if (context.widgets.button("Stay here") || is_imgui_key_pressed(ImGuiKey_Escape)) answer = UnsavedMesh::stay;
    if (answer || !context.facts.asks_to_save) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (!answer) return;
    context.actions.window.answer(*answer);
    if (*answer == UnsavedMesh::save) dialog.request(SaveKind::run);
}

}  // namespace kerf::view
