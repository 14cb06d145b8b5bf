// The dialog that opens a file or folder. Kinds are told by names alone, as opening every file of a folder would take
// long; a folder is a run by its report.json or its ending .kerf-partial, and any other file can be tried by "All
// files". The folder is read once, when it is entered, into FileBrowser; a Dialog lives for one frame and collects the
// entries that the filter lists. Opening an entry replaces the list, so it waits until the list has been drawn. ImGui
// gives the keyboard to a new dialog itself, hence the two frames before the path gets it.
#include <algorithm>
#include <cctype>

#include <imgui_internal.h>  // the veil behind the dialog
#include <imgui_stdlib.h>

#include "base/core/ids.h"
#include "files/io/surface_formats.h"
#include "viewer/model/saving.h"
#include "viewer/panels/imgui_input.h"
#include "viewer/panels/inside/icons.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

using Kind = FileBrowser::Entry::Kind;
constexpr const char* popup_title = "Open a surface, a trace or a run";

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

Kind kind_of_file(const fs::path& path) {
    const fs::path name = lower(path.filename().string());
    if (has_surface_ending(name.string())) return Kind::surface;
    const std::string extension = name.extension().string();
    if (extension.ends_with("trace")) return Kind::trace;
    return extension == ".jsonl" ? Kind::events : Kind::other;
}

Kind kind_of_folder(const fs::path& path) {
    std::error_code ignored;  // a folder that cannot be read is a folder
    const bool run = path.extension() == ".kerf-partial" || fs::is_regular_file(path / "report.json", ignored) ||
                     fs::is_regular_file(path / "solution/report.json", ignored);
    return run ? Kind::run : Kind::folder;
}

FileBrowser::Entry entry_of(const fs::directory_entry& file) {
    std::error_code ignored;  // broken links are files of no size
    FileBrowser::Entry entry{.name = file.path().filename().string()};
    if (file.is_directory(ignored)) {
        entry.kind = kind_of_folder(file.path());
    } else {
        entry.kind = kind_of_file(file.path());
        const std::uintmax_t bytes = file.file_size(ignored);
        entry.bytes = ignored ? 0 : bytes;
    }
    return entry;
}

bool is_folder(Kind kind) { return kind == Kind::folder || kind == Kind::run; }

// Folders first, then by name whatever the case.
bool comes_before(const FileBrowser::Entry& a, const FileBrowser::Entry& b) {
    if (is_folder(a.kind) != is_folder(b.kind)) return is_folder(a.kind);
    return std::pair(lower(a.name), a.name) < std::pair(lower(b.name), b.name);
}

class Dialog {
 public:
    Dialog(UiContext& context, FileBrowser& browser)
        : context_(context), browser_(browser), colors_(palette(context.state.theme)) {}

    void draw() {
        const float below = 2 * ImGui::GetFrameHeightWithSpacing();
        draw_path();
        if (!browser_.error.empty()) show_wrapped(browser_.error, colors_.bad);
        ImGui::BeginChild("##entries", {0, -below}, true);
        draw_entries();
        ImGui::EndChild();
        draw_filter();
        draw_buttons();
        take_keys();
    }

 private:
    void draw_path() {
        const fs::path folder = browser_.folder;
        if (icon_button(context_.widgets, "parent folder", Icon::up, ImGui::GetFrameHeight(), packed(colors_.accent),
                        "Parent folder"))
            browser_.go_to(folder.parent_path());
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1);
        if (browser_.frames_to_focus > 0 && --browser_.frames_to_focus == 0) ImGui::SetKeyboardFocusHere();
        const bool entered = ImGui::InputText("##path", &browser_.typed,
                                              ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
        context_.widgets.record("folder path");
        typing_ |= ImGui::IsItemActive() || entered;
        if (entered) try_typed();
    }

    void try_typed() {
        if (browser_.typed == browser_.folder && browser_.chosen >= 0) return activate(browser_.chosen);
        std::error_code ignored;  // a path that is neither: go_to() says so
        if (fs::is_regular_file(browser_.typed, ignored)) return open(browser_.typed);
        browser_.go_to(browser_.typed);
    }

    bool is_listed(const FileBrowser::Entry& entry) const {
        if (!browser_.filter.empty()) return lower(entry.name).find(lower(browser_.filter)) != std::string::npos;
        return (entry.kind != Kind::other || browser_.all_files) && !entry.name.starts_with('.');
    }

    void draw_entries() {
        for (int i = 0; i < count_of(browser_.entries); ++i)
            if (is_listed(browser_.entries[i])) listed_.push_back(i);
        if (listed_.empty()) show("Nothing here that Kerf can open.", colors_.dim);
        ImGuiListClipper clipper;
        clipper.Begin(count_of(listed_));
        int activated = -1;  // opening replaces the list
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                if (draw_entry(listed_[i])) activated = listed_[i];
        if (activated >= 0) activate(activated);
    }

    bool draw_entry(int index) {
        const FileBrowser::Entry& entry = browser_.entries[index];
        const float left = ImGui::GetCursorPosX();
        if (ImGui::Selectable(("##" + entry.name).c_str(), browser_.chosen == index,
                              ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups))
            choose(index);
        context_.widgets.record("entry " + entry.name);
        const bool activated = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0);
        ImGui::SameLine(left, 0);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float size = ImGui::GetTextLineHeight();
        draw_icon(*ImGui::GetWindowDrawList(), icon_of(entry.kind), {at.x + 0.6f * size, at.y + size / 2}, size,
                  packed(color_of(entry.kind)));
        ImGui::SetCursorPosX(left + 1.6f * size);
        const float room = ImGui::GetContentRegionAvail().x - 9 * em();
        show(shortened(entry.name, room), entry.kind == Kind::other ? colors_.dim : colors_.text);
        ImGui::SameLine();
        show_right(is_folder(entry.kind) ? word_of(entry.kind) : file_size(entry.bytes), colors_.dim);
        return activated;
    }

    static Icon icon_of(Kind kind) {
        switch (kind) {
            case Kind::folder:
                return Icon::folder;
            case Kind::run:
                return Icon::run;
            case Kind::surface:
                return Icon::surface;
            case Kind::trace:
            case Kind::events:
                return Icon::trace;
            case Kind::other:
                return Icon::file;
        }
        return Icon::file;
    }
    const ImVec4& color_of(Kind kind) const {
        return kind == Kind::folder || kind == Kind::other ? colors_.dim
               : kind == Kind::run                         ? colors_.good
                                                           : colors_.accent;
    }
    static const char* word_of(Kind kind) { return kind == Kind::run ? "run" : ""; }

    void draw_filter() {
        ImGui::SetNextItemWidth(16 * em());
        ImGui::InputTextWithHint("##filter", "Filter names", &browser_.filter);
        context_.widgets.record("filter");
        typing_ |= ImGui::IsItemActive();
        ImGui::SameLine();
        context_.widgets.checkbox("All files", &browser_.all_files,
                                  "Also files whose names say nothing, such as traces");
    }

    void draw_buttons() {
        std::error_code ignored;  // a path that cannot be looked at cannot be opened
        const bool is_typed = browser_.typed != browser_.folder && fs::exists(browser_.typed, ignored);
        ImGui::BeginDisabled(!is_typed && browser_.chosen < 0);
        if (context_.widgets.button("Open")) is_typed ? try_typed() : activate(browser_.chosen);
        ImGui::EndDisabled();
        ImGui::SameLine();
        draw_button_of_folder();
        ImGui::SameLine();
        const bool cancelled = ImGui::Button("Cancel");
        context_.widgets.record("Cancel opening");
        if (cancelled) close();
    }

    void draw_button_of_folder() {
        const std::string name = fs::path(browser_.folder).filename().string();
        ImGui::BeginDisabled(!browser_.is_run);
        const bool pressed = ImGui::Button(("Open " + shortened(name, 10 * em()) + "/###this folder").c_str());
        context_.widgets.record("Open this folder");
        explain(browser_.is_run ? "The folder whose content is listed, as a run: " + browser_.folder
                                : "The folder whose content is listed is not that of a run.");
        ImGui::EndDisabled();
        if (pressed) open(browser_.folder);
    }

    void take_keys() {
        if (is_imgui_key_pressed(ImGuiKey_Escape) && !typing_) return close();
        if (is_imgui_key_pressed(ImGuiKey_UpArrow)) move(-1);
        if (is_imgui_key_pressed(ImGuiKey_DownArrow)) move(1);
        if (is_imgui_key_pressed(ImGuiKey_Enter) && !typing_ && browser_.chosen >= 0) activate(browser_.chosen);
    }

    void move(int direction) {
        if (listed_.empty()) return;
        const auto at = std::find(listed_.begin(), listed_.end(), browser_.chosen);
        const std::int64_t next = at == listed_.end() ? 0 : at - listed_.begin() + direction;
        choose(listed_[std::clamp<std::int64_t>(next, 0, std::ssize(listed_) - 1)]);
    }

    // An entry that is chosen after something was typed takes its place.
    void choose(int index) {
        browser_.chosen = index;
        browser_.typed = browser_.folder;
    }

    void activate(int index) {
        const FileBrowser::Entry entry = browser_.entries[index];
        const fs::path path = fs::path(browser_.folder) / entry.name;
        entry.kind == Kind::folder ? browser_.go_to(path) : open(path.string());
    }

    void open(const std::string& path) {
        const bool compares = browser_.compares;
        close();
        if (compares)
            context_.actions.files.open_files({folder_of(context_.session.document()), path});
        else
            context_.actions.files.open_files({path});
    }

    void close() {
        context_.settings.browser_folder = browser_.folder;
        ImGui::CloseCurrentPopup();
        browser_.open = browser_.compares = false;
    }

    UiContext& context_;
    FileBrowser& browser_;
    const Palette& colors_;
    std::vector<int> listed_;  // indices of entries
    bool typing_ = false;      // Enter and Escape belong to a text field
};

void begin_browsing(const Settings& settings, FileBrowser& browser) {
    std::error_code failed;
    fs::path folder = settings.browser_folder;
    if (folder.empty() || !fs::is_directory(folder, failed)) folder = fs::current_path(failed);
    browser.filter.clear();
    browser.go_to(folder);
    browser.open = true;
    browser.frames_to_focus = 2;  // a dialog takes the keyboard when it appears
    ImGui::OpenPopup(popup_title);
}

}  // namespace

void FileBrowser::go_to(const fs::path& new_folder) {
    std::error_code failed;
    fs::directory_iterator file(new_folder, failed);
    if (failed) {
        error = new_folder.string() + " cannot be read: " + failed.message() + ".";
        return;
    }
    error.clear();
    entries.clear();
    chosen = -1;
    for (; !failed && file != fs::directory_iterator(); file.increment(failed)) entries.push_back(entry_of(*file));
    std::sort(entries.begin(), entries.end(), comes_before);
    std::error_code unresolved;  // then the path is shown as it was given
    const fs::path clean = fs::canonical(new_folder, unresolved);
    folder = typed = (unresolved ? new_folder : clean).string();
    is_run = kind_of_folder(folder) == Kind::run;
}

void draw_browser(UiContext& context, FileBrowser& browser) {
    if (browser.requested) {
        browser.requested = false;
        begin_browsing(context.settings, browser);
    }
    if (!browser.open) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({screen.x / 2, screen.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(44 * em(), screen.x), std::min(34 * em(), screen.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.3f * em());
    const bool shown = ImGui::BeginPopupModal(popup_title, nullptr,
                                              ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                  ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    if (!shown) {
        browser.open = browser.compares = false;
        return;
    }
    // The veil would fade in slowly, and stop on the way where frames are drawn on demand.
    ImGui::GetCurrentContext()->DimBgRatio = 1;
    Dialog(context, browser).draw();
    ImGui::EndPopup();
}

}  // namespace kerf::view
