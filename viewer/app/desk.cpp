// Pictures are drawn by the App, in the frame after they were asked for, and written here with their view beside them.
// Commands that write files end in the background; follow() tells how, once a frame. A notice goes by itself after some
// seconds, an error by a click.
#include "viewer/app/desk.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "base/core/error.h"
#include "files/io/output_file.h"
#include "files/io/text_file.h"
#include "viewer/model/file_kind.h"

namespace kerf::view {

namespace {

// The beginning of to_json() of a view with its origin.
constexpr OutputKind view_kind = {
    "view", [](std::string_view text) {
        return text.starts_with("{\n  \"size\": [") ||
               (text.starts_with("{\n  \"input\": \"") &&
                (text.find("\n  \"run\": {") != text.npos || text.find("\n  \"size\": [") != text.npos));
    }};

// The file with the view of a picture.
std::string view_of(const std::string& picture) {
    return std::filesystem::path(picture).replace_extension(".json").string();
}

std::string unused_picture(const std::string& folder) {
    for (int i = 1;; ++i) {
        const std::string path = fmt::format("{}/kerf-{:03}.png", folder, i);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored) && !std::filesystem::exists(view_of(path), ignored)) return path;
    }
}

}  // namespace

void Desk::quit() {
    if (!unsaved_.asks_before([this] { quit(); })) quit_ = true;
}

void Desk::take_screenshot() { picture_ = unused_picture(view_.options.screenshot_folder); }

void Desk::follow() {
    if (const auto result = view_.session.writer().take_result()) {
        if (result->error.empty())
            view_.notify("saved as " + result->file);
        else
            complain(result->error);
    }
    for (const Document* document : {&view_.session.document(), view_.session.other_document()})
        if (document && !document->saved_as.empty() && told_.insert({document->folder, document->saved_as}).second)
            view_.notify("saved as " + document->saved_as);
    unsaved_.follow();
}

void Desk::copy(const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    view_.notify("copied");
}

std::string Desk::clipboard() {
    const char* text = ImGui::GetClipboardText();
    return text ? text : "";
}

void Desk::complain(const std::string& text) {
    view_.facts.notice = text;
    view_.facts.notice_is_error = true;
}

ViewOrigin Desk::origin_of_picture() const {
    const Document& document = view_.session.document();
    ViewOrigin origin;
    const bool is_temporary = view_.session.pair().can_save() || document.kind == Document::Kind::surface;
    const std::string& input = !document.saved_as.empty() ? document.saved_as
                               : is_temporary             ? document.options.input
                                                          : document.path;
    if (!input.empty()) origin.input = absolute_path(input);
    const std::vector<OptionText> usual = option_texts({}, true);
    for (const OptionText& option : option_texts(document.options, true))
        if (is_temporary && document.saved_as.empty() &&
            std::none_of(usual.begin(), usual.end(),
                         [&](const OptionText& u) { return u.name == option.name && u.text == option.text; }))
            origin.run.push_back(option);
    origin.width = view_.size.width;
    origin.height = view_.size.height;
    origin.scale = view_.size.scale;
    origin.body = document.box;
    return origin;
}

void Desk::write_picture(const Image& picture) {
    const std::string path = std::exchange(picture_, "");
    try {
        require_writable("Its name", path, output_kind::picture);
        require_writable("The file of its view", view_of(path), view_kind);
        write_png(path, picture);
        ViewState state = view_.state;
        state.camera = view_.camera;
        write_text_file(view_of(path), to_json(state, origin_of_picture()));
        view_.notify("saved as " + std::filesystem::path(path).lexically_normal().string() +
                     ", its view as .json beside it");
    } catch (const Error& error) {
        complain(fmt::format(
            "The picture was not saved: {} Start the viewer in a folder that can be written, or choose another place.",
            error.what()));
    }
}

void Desk::clear_notice() {
    SceneFacts& facts = view_.facts;
    if (facts.notice_is_error ? ImGui::IsMouseClicked(0) : ImGui::GetTime() > view_.notice_until) facts.notice.clear();
}

}  // namespace kerf::view
