// Sentences are a table in the order in which they are told; each has a stage, a text and perhaps a condition on the
// cut. {names} in a text stand for figures, which are looked up in the document; a sentence with a figure that is not
// known is left out, so that a document that knows less tells less, but nothing wrong. Figures come from the tree where
// it has them, since it knows more than the trace of all that happened after the cut. Views are made from three
// directions: the normal of the plane (`normal`), a direction in the plane (`aside`), and one across both (`up`),
// upright where that can be. Stages of the border show the interface obliquely and closely, others the body; the
// tetrahedra are cut open by a clip plane across `aside`, beside faces that lie there.
#include "viewer/model/tour.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "base/geometry/box.h"
#include "viewer/model/off_faces.h"
#include "viewer/model/timeline.h"

namespace kerf::view {

namespace {

constexpr double tour_explosion = 0.35;  // of halves and parts

using Figures = std::map<std::string, std::string>;

struct Sentence {
    Stage stage;
    const char* text;
    bool (*holds)(const Cut& cut) = nullptr;  // null: always
    bool cut_open = false;                    // as of the stop
};

bool is_straight_cut(const Cut& cut) { return cut.method == ContourMethod::straight; }
bool is_minimum_cut(const Cut& cut) { return cut.method == ContourMethod::min_cut; }
bool is_on_edges(const Cut& cut) { return !is_straight_cut(cut); }
template <CutStrategy Strategy>
bool is_made_by(const Cut& cut) {
    return cut.strategy == Strategy;
}

constexpr Sentence sentences[] = {
    {Stage::before_repair, "This is the surface as the file has it, before it was repaired."},
    {Stage::before_remeshing, "This is the surface as the file has it, before its triangles were made anew."},
    {Stage::input, "This is what is to be cut: {body}, a closed surface of {facets} triangles."},
    {Stage::input, "The arrows at its centre show in which directions it is long and short."},
    {Stage::plane, "The plane says about where to cut: across {direction}, so that the wall is small."},
    {Stage::plane, "It leaves {below} of the work to come on one side, and {above} on the other."},
    {Stage::plane, "It was the first plane, and it worked at once.", is_made_by<CutStrategy::first_try>},
    {Stage::plane, "At first the cut failed at some places, which were avoided then.",
     is_made_by<CutStrategy::local_repair>},
    {Stage::plane, "Before it, {refused} failed; a place beside the first one worked.",
     is_made_by<CutStrategy::plane_step>},
    {Stage::plane, "Across the first direction {refused} failed, so that another one was taken.",
     is_made_by<CutStrategy::other_axis>},
    {Stage::plane, "All {tried} gave a wall with narrow angles; this is the best of them.",
     is_made_by<CutStrategy::soft>},
    {Stage::plane, "Nothing else worked, so the triangles themselves are cut here.", is_made_by<CutStrategy::straight>},
    {Stage::crossed_edges, "{crossed} edges of the surface have their ends on different sides of the plane."},
    {Stage::crossed_edges, "The border between the halves has to be made of edges, and is looked for near these."},
    {Stage::hanging_removed, "Each triangle goes to the side where most of its corners are."},
    {Stage::hanging_removed, "Where the sides meet there are {hanging} edges, and no loose ends."},
    {Stage::closed_loops, "Triangles that stick out, and small islands, change sides: {closed} edges are left."},
    {Stage::paths_removed, "Where the border touched itself it is opened: {paths} edges, two at every corner."},
    {Stage::contour, "This is the border that is used: the shortest and smoothest one near the plane.", is_minimum_cut},
    {Stage::contour,
     "This is the border that is used, where the plane meets the surface; triangles were divided there.",
     is_straight_cut},
    {Stage::contour, "It has {contour} edges in {loops} and is {length} long."},
    {Stage::contour, "It is at most {deviation} away from the plane.", is_on_edges},
    {Stage::projected, "The border is laid flat into the plane, where one sees what is inside of it and what outside."},
    {Stage::triangulation, "The inside is filled with {triangles} triangles."},
    {Stage::triangulation, "The edges of the border stay as they are, because the surface has them, too."},
    {Stage::interface, "Back on the surface, the {triangles} triangles are a wall through the body, of area {area}."},
    {Stage::interface, "It meets the surface at {dihedral} or more, and no angle in it is below {angle}."},
    {Stage::split,
     "Now there are two closed surfaces, of {facets_below} and {facets_above} triangles, with the same wall."},
    {Stage::split, "Their volumes are {volume_below} and {volume_above}."},
    {Stage::split, "From here on neither needs to know of the other."},
    {Stage::parts, "The halves were cut again, and so on: there are {parts} now, each with a closed surface."},
    {Stage::tetrahedra, "At last {parts} were filled with {cells} tetrahedra, each on its own."},
    {Stage::tetrahedra, "Cut open, one sees the tetrahedra inside.", nullptr, true},
    {Stage::tetrahedra, "Meshes of parts fit together because both sides of a wall have the same triangles.", nullptr,
     true},
};

std::string number_of_things(std::int64_t n, const char* noun) {
    return fmt::format("{} {}{}", grouped(n), noun, n == 1 ? "" : "s");
}

std::string short_value(double value) { return fmt::format("{:.4g}", value); }

// The try that the cut came from; nullptr: it is not known.
const CutTry* used_try(const Cut& cut) {
    for (auto attempt = cut.tries.rbegin(); attempt != cut.tries.rend(); ++attempt)
        if (attempt->refusal == Refusal::none) return &*attempt;
    return nullptr;
}

void add_plane(const Document& document, const Cut& cut, Figures& figures) {
    const CutChoices& options = document.options.cut;
    constexpr const char* ranks[] = {"its longest direction", "the second of its directions",
                                     "the shortest of its directions"};
    const CutTry* attempt = used_try(cut);
    const std::int32_t axis = attempt ? attempt->axis : cut.place.axis;
    if (cut.method == ContourMethod::straight || options.axis >= 0 || options.criterion != Criterion::inertia) {
        Eigen::Index along = 0;
        cut.plane.normal.cwiseAbs().maxCoeff(&along);
        figures["direction"] = fmt::format("the axis {}", "xyz"[along]);
    } else if (axis >= 0 && axis < 3) {
        figures["direction"] = ranks[axis];
    }
    const bool is_in_first_place = cut.strategy == CutStrategy::first_try || cut.strategy == CutStrategy::local_repair;
    if (is_in_first_place && cut.place.fraction > 0 && cut.place.fraction < 1) {
        figures["below"] = fmt::format("{:.0f} %", 100 * cut.place.fraction);
        figures["above"] = fmt::format("{:.0f} %", 100 - std::round(100 * cut.place.fraction));
    }
    const std::int64_t refused = std::ssize(cut.tries) - (attempt ? 1 : 0);
    if (refused > 0) figures["refused"] = refused == 1 ? "one try" : grouped(refused) + " tries";
    figures["tried"] = fmt::format("{} tries", grouped(std::ssize(cut.tries)));
}

void add_contour(const Cut& cut, Figures& figures) {
    const ContourStages& stages = cut.stages;
    figures["crossed"] = grouped(std::ssize(stages.crossed_edges));
    figures["hanging"] = grouped(std::ssize(stages.hanging_edges_removed));
    figures["closed"] = grouped(std::ssize(stages.closed_loops));
    figures["paths"] = grouped(std::ssize(stages.multiple_paths_removed));
    figures["contour"] = grouped(cut.contour_edges);
    figures["loops"] = number_of_things(std::ssize(cut.loops), "loop");
    figures["length"] = short_value(cut.contour_length);
    figures["deviation"] = fmt::format("{:.2g}", cut.max_deviation);
    figures["triangles"] = grouped(std::ssize(cut.interface.triangles));
    figures["area"] = short_value(cut.interface_area);
}

// Adds figures of the tree, which knows more than the trace of all that came after the cut.
void add_tree(const Document& document, NodeId node, Figures& figures) {
    figures["body"] = node == root_node ? "the whole body" : fmt::format("piece {}", node.value());
    const Tree& tree = document.tree;
    if (const TreeRow* row = tree.find(node)) {
        if (row->facets > 0) figures["facets"] = grouped(row->facets);
        if (row->cut && row->cut->quality.angle_deg > 0 && row->cut->quality.dihedral_deg > 0) {
            figures["angle"] = fmt::format("{:.0f} degrees", row->cut->quality.angle_deg);
            figures["dihedral"] = fmt::format("{:.0f} degrees", row->cut->quality.dihedral_deg);
        }
    }
    for (const auto& [child, side] : {std::pair(child_of(node, 0), "below"), std::pair(child_of(node, 1), "above")}) {
        const TreeRow* row = tree.find(child);
        if (row && row->facets > 0) figures[std::string("facets_") + side] = grouped(row->facets);
        if (row && row->volume > 0) figures[std::string("volume_") + side] = short_value(row->volume);
    }
    const std::vector<NodeId> parts = tree.parts_below(node);
    std::int64_t cells = 0;
    for (const NodeId part : parts) cells += std::max<std::int64_t>(0, tree.find(part)->tets);
    figures["parts"] = number_of_things(std::ssize(parts), "part");
    if (cells > 0) figures["cells"] = grouped(cells);
}

// Returns the text with its figures; empty if one is not known.
std::string filled(const std::string& text, const Figures& figures) {
    std::string result;
    std::size_t at = 0;
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', at)) {
        const std::size_t end = text.find('}', open);
        const auto figure = figures.find(text.substr(open + 1, end - open - 1));
        if (figure == figures.end()) return "";
        result += text.substr(at, open - at) + figure->second;
        at = end + 1;
    }
    return result + text.substr(at);
}

const Cut* recorded_cut(const Document& document, NodeId node) {
    const Cut* cut = document.trace ? document.trace->find(node) : nullptr;
    return cut && cut->made() ? cut : nullptr;
}

// A direction across the normal, level where that can be.
Vec3 across(const Vec3& normal) {
    const Vec3 up = std::abs(normal.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
    return normal.cross(up).normalized();
}

// The box of a border with some room around it, by which one sees where it lies in the body.
Eigen::AlignedBox3d around_contour(const Cut& cut, const Eigen::AlignedBox3d& body) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : cut.interface.points) box.extend(p);
    if (box.isEmpty()) return body;
    const Vec3 more = Vec3::Constant(0.15 * box.diagonal().norm());
    return {box.min() - more, box.max() + more};
}

}  // namespace

std::optional<NodeId> node_of_tour(const Document& document, NodeId wanted) {
    if (!document.trace) return {};
    if (recorded_cut(document, wanted)) return wanted;
    for (const Cut& cut : document.trace->cuts)
        if (cut.made()) return cut.node;
    return {};
}

std::vector<TourStop> stops_of_tour(const Document& document, NodeId node) {
    std::vector<TourStop> stops;
    for (const Step& step : steps_of(document, node)) {
        if (step.refused_try >= 0 || step.stage < Stage::input) continue;
        stops.push_back({step.stage});
        if (step.stage == Stage::tetrahedra) stops.push_back({step.stage, true});
    }
    return stops;
}

std::size_t nearest_stop(const std::vector<TourStop>& stops, const ViewState& state) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < stops.size(); ++i)
        if (stops[i].stage <= state.step.stage && (!stops[i].cut_open || state.clip.on)) nearest = i;
    return nearest;
}

std::string tell(const Document& document, NodeId node, const TourStop& stop) {
    const Cut none, *recorded = recorded_cut(document, node), &cut = recorded ? *recorded : none;
    Figures figures;
    add_tree(document, node, figures);
    if (recorded) add_plane(document, cut, figures);
    if (recorded) add_contour(cut, figures);
    std::string text;
    for (const Sentence& sentence : sentences) {
        if (TourStop{sentence.stage, sentence.cut_open} != stop || (sentence.holds && !sentence.holds(cut))) continue;
        const std::string told = filled(sentence.text, figures);
        if (!told.empty()) text += (text.empty() ? "" : " ") + told;
    }
    return text;
}

TourView view_of_stop(const Document& document, NodeId node, const TourStop& stop, const NodeSurface* surface,
                      const ViewState& before) {
    const Cut& cut = *recorded_cut(document, node);
    const Stage stage = stop.stage;
    const Eigen::AlignedBox3d body = surface ? box_around_finite(surface->vertices) : document.box;
    TourView view;
    ViewState& state = view.state;
    state.theme = before.theme;
    state.panels = before.panels;
    state.look.times = before.look.times;
    state.node = node;
    state.step = {stage, -1};
    const Vec3 &normal = cut.plane.normal, aside = across(normal), up = aside.cross(normal);
    const bool shows_border = stage > Stage::plane && stage < Stage::split;
    view.box = shows_border ? around_contour(cut, body) : body;
    view.back = (0.6 * normal + 0.7 * aside + 0.4 * up).normalized();
    if (stage == Stage::triangulation || stage == Stage::interface)
        view.back = (0.85 * normal + 0.45 * aside + 0.3 * up).normalized();
    if (stage == Stage::input) state.look.axes = true;  // of which it tells
    if (stage >= Stage::split && !stop.cut_open) state.explosion.amount = tour_explosion;
    if (stop.cut_open) {
        snap_to(state.clip, Plane(body.center(), aside), document.box);
        if (surface) keep_off_faces(state.clip, *surface, document.box);
        view.back = (0.25 * normal + 0.9 * aside + 0.35 * up).normalized();
    }
    return view;
}

}  // namespace kerf::view
