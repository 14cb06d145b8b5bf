// The dialogs that save what is open: a run, its mesh in a format of others, a picture, a page, a repaired surface.
// Each shows the command line that does the same, and what it does is that command, except for a run, which is copied,
// and a picture. A mesh that lies in a temporary folder has no command of its own: its run is made first there. Before
// work that nobody has saved is lost, a question comes (app/unsaved.h); its answer is asked for here.
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
constexpr const char* question_title = "Not saved###unsaved";

const char* title_of(SaveKind kind) {
    switch (kind) {
        case SaveKind::run:
            return "Save the run as a folder";
        case SaveKind::other_run:
            return "Save the other run as a folder";
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

bool is_of_run(SaveKind kind) { return kind == SaveKind::run || kind == SaveKind::other_run; }

// The document that is saved.
const Document& document_of(const Session& session, SaveKind kind) {
    const Document* other = session.other_document();
    return kind == SaveKind::other_run && other ? *other : session.document();
}

// The name of a new file, in the folder where the viewer was started.
std::string first_path(const Document& document, const SaveDialog& dialog) {
    const std::string& input = document.options.input.empty() ? document.path : document.options.input;
    const std::string stem = fs::path(input).stem().string();
    std::error_code ignored;
    const std::string path = (fs::current_path(ignored) / stem).string();
    switch (dialog.kind) {
        case SaveKind::run:
        case SaveKind::other_run:
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
          document_(document_of(context.session, dialog.kind)),
          colors_(palette(context.state.theme)) {}

    void draw() {
        show(title_of(dialog_.kind), colors_.accent);
        ImGui::Spacing();
        if (dialog_.kind == SaveKind::mesh) draw_format();
        const char* label = is_of_run(dialog_.kind) ? "Folder" : "Name";
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

    // Runs are not saved while anything is read, or another one is under way.
    bool can_save() const {
        const RunPair& runs = context_.session.pair();
        if (dialog_.kind == SaveKind::run) return runs.can_save();
        if (dialog_.kind == SaveKind::other_run) return runs.can_save_other();
        if (dialog_.kind == SaveKind::surface) return context_.session.repairs().can_repair();
        return !context_.session.writer().is_writing();
    }

    bool has_ending() const { return dialog_.kind != SaveKind::picture || dialog_.path.ends_with(".png"); }

    void draw_buttons() {
        ImGui::BeginDisabled(dialog_.path.empty() || !has_ending() || !can_save());
        const bool saves = context_.widgets.button("Save");
        ImGui::EndDisabled();
        ImGui::SameLine();
        const bool cancels = context_.widgets.button("Cancel saving") || is_imgui_key_pressed(ImGuiKey_Escape);
        if (saves) save();
        if (cancels && !saves) context_.actions.window.answer(UnsavedFate::stay);
        if (saves || cancels) ImGui::CloseCurrentPopup();
    }

    MeshFile mesh_file() const { return {offered_formats()[dialog_.format], dialog_.path, dialog_.order}; }

    // Arguments for a run in this folder.
    std::vector<std::string> arguments(const std::string& folder) const {
        switch (dialog_.kind) {
            case SaveKind::run:
            case SaveKind::other_run:
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
            case SaveKind::other_run:
                return context_.session.pair().save_other(dialog_.path);
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

// Its facts are not known of a run without cells.
std::string with_facts(const std::string& words, const std::string& facts) {
    return facts.empty() ? words : words + ": " + facts;
}

// One piece of work in words.
std::string words_of(const Session& session, UnsavedWork work) {
    const Document &document = session.document(), *other = session.other_document();
    switch (work) {
        case UnsavedWork::run:
            return with_facts("The run that is shown", outcome_of(document, true));
        case UnsavedWork::other_run:
            return with_facts("The other run, which is not shown", other ? outcome_of(*other, true) : "");
        case UnsavedWork::surface:
            return "The repaired surface: " + number_of(document.input_facets, "facet");
    }
    return "";
}

SaveKind kind_of(UnsavedWork work) {
    switch (work) {
        case UnsavedWork::run:
            return SaveKind::run;
        case UnsavedWork::other_run:
            return SaveKind::other_run;
        case UnsavedWork::surface:
            return SaveKind::surface;
    }
    return SaveKind::run;
}

}  // namespace

void draw_save_dialog(UiContext& context, SaveDialog& dialog) {
    if (std::exchange(dialog.is_requested, false)) {
        dialog.path = first_path(document_of(context.session, dialog.kind), dialog);
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
    const std::vector<UnsavedWork>& at_stake = context.facts.at_stake;
    const bool is_one = at_stake.size() == 1;
    show(is_one ? "This is not saved, and would be lost" : "These are not saved, and would be lost", colors.accent);
    for (const UnsavedWork work : at_stake) show_wrapped(words_of(context.session, work) + ".", colors.text);
    ImGui::Spacing();
    std::optional<UnsavedFate> answer;
    if (context.widgets.button(is_one ? "Save it..." : "Save them...")) answer = UnsavedFate::save;
    ImGui::SameLine();
    if (context.widgets.button(is_one ? "Let it go" : "Let them go")) answer = UnsavedFate::lose;
    ImGui::SameLine();
    if (context.widgets.button("Stay here") || is_imgui_key_pressed(ImGuiKey_Escape)) answer = UnsavedFate::stay;
    if (answer || !context.facts.asks_to_save) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (!answer) return;
    const SaveKind kind = kind_of(at_stake.front());
    context.actions.window.answer(*answer);
    if (*answer == UnsavedFate::save) dialog.request(kind);
}

}  // namespace kerf::view
