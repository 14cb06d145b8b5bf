// The steps of a node follow from the data that the document has. With a trace these are the refused tries and all
// stages of the contour that have edges; with a report alone the plane and, if there is a folder, the halves. A try
// counts as refused unless the cut was made from it: where nothing better was found, the best try that was refused
// softly is used after all, and known by its contour (is_used()). Sentences take counts from the trace, but facets,
// volumes and the quality of the interface from the tree, because a run improves interfaces after its last cut.
#include "viewer/model/timeline.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/core/words.h"

namespace kerf::view {

namespace {

bool has_edges(const Cut& cut, Stage stage) {
    switch (stage) {
        case Stage::crossed_edges:
            return !cut.stages.crossed_edges.empty();
        case Stage::hanging_removed:
            return !cut.stages.hanging_edges_removed.empty();
        case Stage::closed_loops:
            return !cut.stages.closed_loops.empty();
        case Stage::paths_removed:
            return !cut.stages.multiple_paths_removed.empty();
        default:
            return true;
    }
}

// The best soft try is used where nothing better was found.
bool is_used(const Cut& cut, const CutTry& attempt) {
    if (attempt.refusal == Refusal::none) return true;
    return cut.strategy == CutStrategy::soft && attempt.refusal == Refusal::soft &&
           attempt.contour == cut.stages.smoothed;
}

void add_cut(const Cut& cut, std::vector<Step>& steps) {
    for (std::int32_t i = 0; i < count_of(cut.tries); ++i)
        if (!is_used(cut, cut.tries[i])) steps.push_back({Stage::plane, i});
    if (!cut.made()) return;
    for (int i = static_cast<int>(Stage::plane); i <= static_cast<int>(Stage::split); ++i) {
        const auto stage = static_cast<Stage>(i);
        if (has_edges(cut, stage)) steps.push_back({stage, -1});
    }
}

std::string counted(std::int64_t n, const char* noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

// Says how a plane was found. Planes are moved along their normal, which points into the half above.
std::string describe_plane_of(const CutTry& attempt, NodeId node) {
    if (attempt.method == ContourMethod::straight)
        return fmt::format("straight across {}, choice {} of the planes", "xyz"[std::clamp(attempt.axis, 0, 2)],
                           attempt.step + 1);
    constexpr std::array<const char*, 3> ordinals = {"first", "second", "third"};
    std::string text = fmt::format("{} axis, ", ordinals[std::clamp(attempt.axis, 0, 2)]);
    text += attempt.step == 0
                ? "the plane in its first place"
                : fmt::format("the plane moved {} into the half of node {}", counted(std::abs(attempt.step), "step"),
                              child_of(node, attempt.step > 0 ? 1 : 0).value());
    return text + (attempt.repair == 0 ? ", no repairs yet" : ", after " + counted(attempt.repair, "repair"));
}

std::string describe_try(const CutTry& attempt, std::int32_t number, std::int32_t count, NodeId node) {
    std::string text = fmt::format("Refused: {}", in_words(name(attempt.refusal)));
    if (!attempt.places.empty()) text += " at " + counted(std::ssize(attempt.places), "place");
    if (!attempt.collisions.empty())
        text += fmt::format(", {}{} of triangles", attempt.collisions.size() < max_collisions ? "" : "at least ",
                            counted(std::ssize(attempt.collisions), "pair"));
    if (attempt.refusal == Refusal::soft)
        text += fmt::format(" (dihedral {:.1f} deg, angle {:.1f} deg, gap {:.2f})", attempt.quality.dihedral_deg,
                            attempt.quality.angle_deg, attempt.quality.gap_rel);
    return text + fmt::format(". Try {} of {}: {}.", number + 1, count, describe_plane_of(attempt, node));
}

std::string describe_input(const Document& document, const TreeRow* row) {
    if (!row || row->facets < 0)
        return fmt::format("{} facets, {} vertices.", grouped(document.input_facets), grouped(document.input_vertices));
    std::string text = fmt::format("{} facets", grouped(row->facets));
    if (row->volume > 0) text += fmt::format(", volume {:.5g}", row->volume);
    text += row->leaf() ? "; a part." : fmt::format("; {} parts below.", row->leaves);
    return text;
}

std::string describe_plane(const TreeRow& row) {
    const Vec3& n = row.plane()->normal;
    return fmt::format("Normal ({:.3f}, {:.3f}, {:.3f}) through ({:.4g}, {:.4g}, {:.4g}); {}.", n.x(), n.y(), n.z(),
                       row.plane()->origin.x(), row.plane()->origin.y(), row.plane()->origin.z(),
                       in_words(name(row.cut->strategy)));
}

std::string describe_edges(const Cut& cut, Stage stage) {
    const auto count = [](const auto& edges) { return fmt::format("{} edges", grouped(edges.size())); };
    switch (stage) {
        case Stage::crossed_edges:
            return count(cut.stages.crossed_edges) + " with ends on both sides of the plane.";
        case Stage::hanging_removed:
            return count(cut.stages.hanging_edges_removed) + ": closed, nothing hangs.";
        case Stage::closed_loops:
            return count(cut.stages.closed_loops) + ": ears and islands removed.";
        case Stage::paths_removed:
            return count(cut.stages.multiple_paths_removed) + ": no vertex has more than two of them.";
        default:
            if (cut.method == ContourMethod::straight)
                return fmt::format("Straight contour: {} edges in {}, length {:.5g}, in the plane; facets were split.",
                                   grouped(cut.contour_edges), counted(std::ssize(cut.loops), "loop"),
                                   cut.contour_length);
            return fmt::format("{} edges in {}, length {:.5g}; at most {:.3g} off the plane.",
                               grouped(cut.contour_edges), counted(std::ssize(cut.loops), "loop"), cut.contour_length,
                               cut.max_deviation);
    }
}

std::string describe_interface(const Cut& cut, const TreeRow* row) {
    const InterfaceQuality quality = row && row->cut ? row->cut->quality : cut.quality;
    if (quality.angle_deg < 0)
        return fmt::format("{} triangles, area {:.5g}. The run makes better ones after its last cut.",
                           grouped(cut.interface.triangles.size()), cut.interface_area);
    return fmt::format(
        "{} triangles, area {:.5g} ({:.3f} of the plane section); smallest angle {:.1f} deg, to the "
        "surface {:.1f} deg.",
        grouped(cut.interface.triangles.size()), cut.interface_area,
        cut.section_area > 0 ? cut.interface_area / cut.section_area : 0, quality.angle_deg, quality.dihedral_deg);
}

std::string describe_halves(const Document& document, NodeId node) {
    const TreeRow* below = document.tree.find(child_of(node, 0));
    const TreeRow* above = document.tree.find(child_of(node, 1));
    if (!below || !above) return "Both halves.";
    return fmt::format("Node {}: {} facets; node {}: {} facets.", child_of(node, 0).value(), grouped(below->facets),
                       child_of(node, 1).value(), grouped(above->facets));
}

std::string describe_parts(const Document& document, NodeId node) {
    const std::vector<NodeId> parts = document.tree.parts_below(node);
    std::int64_t facets = 0;
    for (const NodeId part : parts) facets += document.tree.find(part)->facets;
    return fmt::format("{} facets of {}, each with a closed surface.", grouped(facets),
                       counted(std::ssize(parts), "part"));
}

std::string describe_tetrahedra(const Document& document, NodeId node) {
    std::int64_t tets = 0;
    std::size_t meshed = 0;
    const std::vector<NodeId> parts = document.tree.parts_below(node);
    for (const NodeId part : parts)
        if (const TreeRow& row = *document.tree.find(part); row.tets > 0) {
            tets += row.tets;
            ++meshed;
        }
    return fmt::format("{} tetrahedra in {}{} part{}.", grouped(tets),
                       meshed < parts.size() ? fmt::format("{} of ", meshed) : "", parts.size(),
                       parts.size() == 1 ? "" : "s");
}

}  // namespace

bool has_cells(const Document& document, NodeId node) {
    if (document.folder.empty()) return false;
    for (const NodeId part : document.tree.parts_below(node)) {
        const TreeRow* row = document.tree.find(part);
        if (row && row->state == NodeState::done && row->tets > 0) return true;
    }
    return false;
}

std::vector<Step> steps_of(const Document& document, NodeId node) {
    std::vector<Step> steps;
    if (node == root_node && document.unrepaired) steps.push_back({Stage::before_repair, -1});
    if (node == root_node && document.remeshed) steps.push_back({Stage::before_remeshing, -1});
    steps.push_back({Stage::input, -1});
    const Cut* cut = document.trace ? document.trace->find(node) : nullptr;
    const TreeRow* row = document.tree.find(node);
    if (cut) {
        add_cut(*cut, steps);
    } else if (row && row->plane()) {
        steps.push_back({Stage::plane, -1});
        if (!document.folder.empty()) steps.push_back({Stage::split, -1});
    }
    if (has_cells(document, node)) steps.push_back({Stage::tetrahedra, -1});
    if (document.has_surfaces_alone() && row) steps.push_back({Stage::parts, -1});
    return steps;
}

std::size_t nearest_step(const std::vector<Step>& steps, const Step& step) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i] == step) return i;
        const bool is_before = steps[i].stage < step.stage || (steps[i].stage == step.stage && step.refused_try >= 0);
        if (steps[i].refused_try < 0 && is_before) nearest = i;
    }
    return nearest;
}

std::string describe_step(const Document& document, NodeId node, const Step& step) {
    const Cut* cut = document.trace ? document.trace->find(node) : nullptr;
    const TreeRow* row = document.tree.find(node);
    if (step.refused_try >= 0) {
        const std::int32_t number = step.refused_try;
        if (!cut || number >= count_of(cut->tries)) return "";
        return describe_try(cut->tries[number], number, count_of(cut->tries), node);
    }
    switch (step.stage) {
        case Stage::before_repair:
            return "The surface as the file has it.";
        case Stage::before_remeshing:
            return document.unrepaired ? "The surface of the file, repaired." : "The surface as the file has it.";
        case Stage::input:
            return describe_input(document, row);
        case Stage::plane:
            return row && row->plane() ? describe_plane(*row) : "";
        case Stage::triangulation:
        case Stage::interface:
            return cut ? describe_interface(*cut, document.tree.find(node)) : "";
        case Stage::split:
            return describe_halves(document, node);
        case Stage::parts:
            return describe_parts(document, node);
        case Stage::tetrahedra:
            return describe_tetrahedra(document, node);
        default:
            return cut ? describe_edges(*cut, step.stage) : "";
    }
}

bool has_no_stages(const Document& document, NodeId node) {
    const TreeRow* row = document.tree.find(node);
    return !document.progress.running && !document.trace && row && row->state == NodeState::divided &&
           row->regions == 1;
}

std::vector<FailurePlace> failure_places(const Document& document, NodeId node, const Step& step) {
    const Cut* cut = document.trace ? document.trace->find(node) : nullptr;
    std::vector<FailurePlace> places;
    if (!cut || step.refused_try < 0 || step.refused_try >= count_of(cut->tries)) return places;
    const CutTry& attempt = cut->tries[step.refused_try];
    for (const Collision& pair : attempt.collisions) {
        FailurePlace& place = places.emplace_back();
        for (const Vec3& p : pair.first) place.where += p / 6;
        for (const Vec3& p : pair.second) place.where += p / 6;
        for (const auto& triangle : {pair.first, pair.second})
            for (const Vec3& p : triangle) place.radius = std::max(place.radius, (p - place.where).norm());
    }
    if (attempt.collisions.empty())
        for (const Vec3& p : attempt.places) places.push_back({p, 0});
    return places;
}

NodeId next_node(const Tree& tree, NodeId node, int direction) {
    const std::vector<const TreeRow*> order = tree.in_order();
    const auto here = std::find_if(order.begin(), order.end(), [&](const TreeRow* row) { return row->id == node; });
    if (here == order.end()) return order.empty() ? node : order.front()->id;
    if (direction < 0) return here == order.begin() ? node : (*(here - 1))->id;
    return here + 1 == order.end() ? node : (*(here + 1))->id;
}

}  // namespace kerf::view
