// The guided tour of one cut, in the place of the timeline: the text of a stage (model/tour.h) and buttons to go on. A
// tour waits until there is a cut with recorded stages; if none comes by itself, it starts one run, and gives up if
// that leaves none either. A stop takes over the whole view, and the view of before comes back at the end, except for
// theme and panels. Buttons and keys only ask for a stop (Tour::go_to); follow_tour() shows it at the start of the next
// frame, when the layout of the scene, into which the camera fits the stop, is known. A tour ends by itself when
// another node is shown or the cut is gone.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "viewer/model/tour.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// Begins the tour as soon as there is a cut, and starts a run that makes one if none is on the way.
void await_cut(UiContext& context, Tour& tour) {
    const Session& session = context.session;
    const Document& document = session.document();
    if (const std::optional<NodeId> node = node_of_tour(document, context.state.node)) {
        tour = {.node = *node, .go_to = TourStop(), .before = context.state};
        return;
    }
    if (session.busy() || session.pending() || document.progress.running) return;
    const bool is_over = tour.has_run || document.has_problems() || !document.error.empty() || document.trace;
    if (is_over) {
        tour = {};
        context.actions.window.complain("There is no cut to be shown.");
    } else if (document.kind != Document::Kind::none) {
        tour.has_run = true;
        record_stages(context);
    }
}

void show_stop(UiContext& context, const Tour& tour, const TourStop& stop, const Rectangle& scene) {
    const auto surface = context.session.fetched().surface(tour.node);
    const TourView view = view_of_stop(context.session.document(), tour.node, stop, surface.get(), context.state);
    const Rectangle body = body_area(view.state, scene);
    const float height = std::max(body.height, 1.f);
    Camera camera;
    look_from(camera, view.back, context.facts.up);
    fit(camera, view.box, body.width / height);
    camera.height *= scene.height / height;
    context.state = view.state;
    context.actions.camera.take_camera(camera);
}

}  // namespace

void begin_tour(UiContext& context, Dialogs& dialogs) {
    dialogs.tour = {.awaited = true};
    context.state.panels.timeline = true;
}

void end_tour(UiContext& context, Dialogs& dialogs) {
    const ViewState now = std::exchange(context.state, *dialogs.tour.before);
    context.state.theme = now.theme;
    context.state.panels = now.panels;
    dialogs.tour = {};
}

void go_on_tour(UiContext& context, Dialogs& dialogs, int count) {
    const std::vector<TourStop> stops = stops_of_tour(context.session.document(), dialogs.tour.node);
    const std::int64_t current = nearest_stop(stops, context.state), wanted = current + count;
    if (wanted >= 0 && wanted < std::ssize(stops)) dialogs.tour.go_to = stops[wanted];
}

void follow_tour(UiContext& context, Dialogs& dialogs, const Rectangle& scene) {
    Tour& tour = dialogs.tour;
    if (tour.awaited) await_cut(context, tour);
    if (tour.node == no_node) return;
    const bool is_left = !tour.go_to && context.state.node != tour.node;
    if (is_left || node_of_tour(context.session.document(), tour.node) != tour.node)
        tour = {};
    else if (tour.go_to)
        show_stop(context, tour, *std::exchange(tour.go_to, std::nullopt), scene);
}

void draw_tour(UiContext& context, Dialogs& dialogs) {
    const NodeId node = dialogs.tour.node;
    const Palette& colors = palette(context.state.theme);
    const std::vector<TourStop> stops = stops_of_tour(context.session.document(), node);
    const std::size_t current = nearest_stop(stops, context.state);
    Widgets& widgets = context.widgets;
    ImGui::BeginDisabled(current == 0);
    if (widgets.button("Back")) go_on_tour(context, dialogs, -1);
    ImGui::EndDisabled();
    ImGui::SameLine(0, 0.4f * em());
    ImGui::BeginDisabled(current + 1 >= stops.size());
    if (widgets.button("Next")) go_on_tour(context, dialogs, 1);
    ImGui::EndDisabled();
    ImGui::SameLine(0, 0.4f * em());
    const bool is_over = widgets.button("End");
    ImGui::SameLine(0, em());
    ImGui::AlignTextToFramePadding();
    show(fmt::format("{} of {}: {}", current + 1, stops.size(), title(stops[current].stage)), colors.accent);
    show_wrapped(tell(context.session.document(), node, stops[current]), colors.text);
    if (is_over) end_tour(context, dialogs);
}

}  // namespace kerf::view
