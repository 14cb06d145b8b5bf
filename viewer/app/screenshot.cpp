// Pictures without a display: the App of the window in a loop that ends when it has settled. The document is awaited
// first, because the picture may depend on all of it; a surface is run, cut or meshed, only as far as the wanted stage
// and colours need it (needs_run()), and with no window nobody else starts that run. A wish that cannot be met is an
// error here, and only a wish in the window (check_wishes()); the cause is told rather than the symptom: if a run has
// ended with an error, that error. Every frame takes the same time (frame_seconds), so that pictures do not depend on
// the speed of the computer. Antialiasing draws so many times as large and averages.
#include "viewer/app/screenshot.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "base/core/error.h"
#include "base/core/name_pattern.h"
#include "files/io/output_file.h"
#include "viewer/app/interruption.h"
#include "viewer/model/surface_values.h"
#include "viewer/render/offscreen.h"

namespace kerf::view {

namespace {

constexpr float frame_seconds = 1.f / 60;

class Deadline {
 public:
    explicit Deadline(double seconds)
        : end_(std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds)) {}
    void check() const {
        if (was_interrupted()) throw Error(ErrorCode::cancelled, "Interrupted.");
        if (std::chrono::steady_clock::now() > end_)
            throw Error(ErrorCode::cancelled, "The picture was not ready in time. Raise --timeout.");
    }

 private:
    std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>> end_;
};

// Whether the wanted stage and colours need more than the surface, as it was read and repaired.
bool needs_run(const Document& document, const ViewState& state) {
    const bool is_repaired = document.unrepaired != nullptr;
    const bool is_there = state.step == Step{} || (is_repaired && state.step == Step{Stage::before_repair, -1});
    const bool needs_values =
        is_of_surface(state.coloring.by) && !(is_repaired && state.coloring.by == ColorBy::deviation);
    return state.node != root_node || !is_there || needs_values;
}

void wait_for_document(App& app, const ViewCommand& command, const Deadline& deadline) {
    Session& session = app.session();
    const auto is_ready = [&] {
        const Document& document = session.document();
        if (!document.error.empty()) return true;
        if (document.kind == Document::Kind::surface) {
            if (!document.checked && (session.busy() || session.failures().empty())) return false;
            if (document.has_problems()) return true;
        }
        return !session.busy() && !session.pending();
    };
    while (!is_ready()) {
        app.wait(0.05);
        deadline.check();
    }
    if (session.document().kind != Document::Kind::surface || session.document().has_problems()) return;
    // A repaired surface is shown as it is then, unless somebody has asked for more.
    const bool is_told = !session.document().unrepaired || command.run.remeshing != RunRequest().remeshing;
    const bool is_remeshed = command.run.remeshing != Remeshing::never && is_told;
    if (!needs_run(session.document(), command.state) && !is_remeshed && !command.clip.starts_with("node=")) return;
    RunRequest run = command.run;
    run.input = session.document().path;
    session.start_run(run, command.state.step.stage == Stage::tetrahedra);
    while (session.busy()) {
        app.wait(0.05);
        deadline.check();
    }
}

// Throws the error that ended the run if one did, as it is the reason why something is missing, else this message.
[[noreturn]] void refuse(const Document& document, const std::string& message) {
    const Progress& progress = document.progress;
    if (!progress.message.empty() && progress.exit_code > 0)
        throw Error(static_cast<ErrorCode>(progress.exit_code), progress.message);
    throw Error(ErrorCode::usage, message);
}

void check_regions(const Document& document, const ViewState& state) {
    std::vector<std::string> wanted = state.visibility.hidden_regions;
    wanted.insert(wanted.end(), state.visibility.glass_regions.begin(), state.visibility.glass_regions.end());
    if (state.visibility.isolated_region) wanted.push_back(*state.visibility.isolated_region);
    const std::vector<std::string>& names = document.region_names;
    if (names.empty() && (!wanted.empty() || state.visibility.walls || state.explosion.regions))
        refuse(document, fmt::format("{} has one region, not several.", document.path));
    constexpr std::size_t most = 20;
    const auto end = names.begin() + std::min(most, names.size());
    for (const std::string& region : wanted)
        if (std::find(names.begin(), names.end(), region) == names.end())
            refuse(document, fmt::format("{} has no region '{}', but '{}'{}.", document.path, region,
                                         fmt::join(names.begin(), end, "', '"),
                                         names.size() > most ? fmt::format(" and {} more", names.size() - most) : ""));
}

// A wish that cannot be met is an error here; in the window it is only a wish.
void check_wishes(const Document& document, const ViewState& state, bool with_panels) {
    if (!document.error.empty() && !with_panels) throw Error(document.error_code, document.error);
    for (const std::string& pattern : state.visibility.hidden_patches)
        matching_names("--hide-patch", "patch", pattern, document.patch_names);
    if (!needs_run(document, state)) return;
    if (document.has_problems())
        throw Error(ErrorCode::input,
                    fmt::format("{} cannot be meshed as it is, so that there is only its stage 'input'. "
                                "Run kerf check on it.",
                                document.path));
    std::vector<NodeId> nodes = state.visibility.hidden;
    nodes.push_back(state.node);
    if (state.visibility.isolated) nodes.push_back(*state.visibility.isolated);
    for (const NodeId node : nodes)
        if (!document.tree.find(node))
            refuse(document, fmt::format("The tree of {} has no node {}.", document.path, node.value()));
    check_regions(document, state);
    if (const char* why = why_without_values(document, state.coloring.by)) refuse(document, why);
    if (document.has_surfaces_alone() && is_of_cells(state.coloring.by))
        refuse(document,
               fmt::format("{} is a folder of kerf decompose, whose parts have no cells to colour by {}. kerf "
                           "mesh makes them.",
                           document.path, name(state.coloring.by)));
    const std::vector<Step> steps = steps_of(document, state.node);
    if (steps[nearest_step(steps, state.step)] == state.step) return;
    std::vector<std::string> names;
    for (const Step& step : steps) names.push_back(name(step));
    refuse(document, fmt::format("Node {} of {} has no stage '{}', but {}.", state.node.value(), document.path,
                                 name(state.step), fmt::join(names, ", ")));
}

}  // namespace

void take_screenshot(const ViewCommand& command, const AppOptions& options) {
    const PictureOptions& picture = command.picture;
    const std::vector<std::string> files = picture.files();
    const Deadline deadline(picture.timeout_seconds);
    for (const std::string& file : command.files())
        for (const std::string& drawn : files) refuse_to_overwrite(file, "--output", drawn);
    if (std::error_code ignored;
        std::filesystem::is_directory(command.input, ignored) && lies_inside(picture.output, command.input))
        throw Error(ErrorCode::io, fmt::format("--output is {}, which lies in the run {}. Choose another place.",
                                               picture.output, command.input));
    if (!picture.output.ends_with(".png"))
        throw Error(ErrorCode::usage,
                    fmt::format("--output is {}, but pictures are PNG files: name it {}.", picture.output,
                                std::filesystem::path(picture.output).replace_extension(".png").string()));
    for (const std::string& drawn : files) require_writable("--output", drawn, output_kind::picture);
    const auto context = make_offscreen_context(picture.context);
    const ImGuiOwner imgui;
    ImGui::GetIO().DeltaTime = frame_seconds;
    AppOptions own = options;
    own.auto_run = false;
    App app(context->gl(), own);
    app.open_files(command.files());
    wait_for_document(app, command, deadline);
    const Document& document = app.session().document();
    app.show(command.state, command.chosen);
    apply_document(command, document, static_cast<double>(picture.width) / picture.height, app.state());
    check_wishes(document, app.state(), picture.panels);
    const FrameSize size = {.width = picture.width * picture.antialias,
                            .height = picture.height * picture.antialias,
                            .scale = picture.scale * picture.antialias};
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (picture.frames > 0) app.state().deformation.phase = static_cast<double>(i) / picture.frames;
        app.wake();
        do {
            deadline.check();
            app.frame(size, picture.panels);
        } while (!app.settled());
        if (!app.session().failures().empty())
            throw Error(app.session().failure_code(), app.session().failures().front());
        write_png(files[i], averaged(app.picture(), picture.antialias));
    }
}

}  // namespace kerf::view
