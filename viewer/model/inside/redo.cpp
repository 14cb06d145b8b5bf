// A cut is made again on the surface of its node as it was before the cut: by bisect(), and by a straight cut where no
// contour of edges is found, or is asked for, and facets may be split. A run makes straight cuts in a complex of many
// parts (FaceComplex), whose faces they divide together; here the complex holds the surface of this node alone, with
// keys of its own for all vertices and facets, and the interface is triangulated as if no other cut crossed it.
// Therefore numbers are mapped twice: those of the complex to vertices of the node's surface (`parent_vertex`), and
// these to points of the interface, contour first. The keys of the surface are put back at the end, with those of
// split() for new vertices. The new trace is the old one with this cut in its place and without the cuts below it.
#include "viewer/model/inside/redo.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/core/ids.h"
#include "cut/cut/bisect.h"
#include "cut/cut/place.h"
#include "cut/decompose/cap_quality.h"
#include "cut/decompose/cap_triangulation.h"
#include "run/prepare/size_reader.h"
#include "run/request/run_choices.h"
#include "surface/complex/touching.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

namespace {

struct MadeCut {
    Cut cut;
    std::vector<TreeRow> halves;
};

TreeRow row_of(NodeId id, const Surface& surface) {
    TreeRow row;
    row.id = id;
    describe_surface(surface.vertex_count(), surface.facet_count(), mass_properties(surface), row);
    return row;
}

// A surface with keys of its own, which tell all its vertices and facets apart, also pieces of a facet that was split.
Leaf with_own_keys(const Surface& surface, NodeId node) {
    Leaf leaf;
    leaf.id = node;
    leaf.surface = surface.arrays();
    std::iota(leaf.surface.vertex_key.begin(), leaf.surface.vertex_key.end(), make_key(input_node, 0));
    std::iota(leaf.surface.facet_key.begin(), leaf.surface.facet_key.end(), make_key(input_node, 0));
    return leaf;
}

// Returns the faces of the cap as the interface of the cut. `parent_vertex` has the vertex of the parent for each
// vertex of the complex that is one of the parent's.
Interface interface_of(const FaceComplex& complex, const Cut& cut, const std::vector<Vertex>& parent_vertex) {
    Interface interface;
    interface.contour = cut.interface.contour;
    const std::int32_t corners = count_of(interface.contour);
    interface.points.assign(cut.interface.points.begin(), cut.interface.points.begin() + corners);
    std::map<Vertex, std::int32_t> number_of_parent;
    std::map<std::int32_t, std::int32_t> number_of_new;
    for (std::int32_t i = 0; i < corners; ++i) number_of_parent[interface.contour[i]] = i;
    const auto number = [&](std::int32_t vertex) {
        if (vertex < count_of(parent_vertex)) return number_of_parent.at(parent_vertex[vertex]);
        const auto [place, is_new] = number_of_new.try_emplace(vertex, count_of(interface.points));
        if (is_new) interface.points.push_back(complex.point(vertex));
        return place->second;
    };
    for (const ComplexFace& face : complex.faces())
        if (face.cap == cut.node)
            interface.triangles.push_back({number(face.corners[0]), number(face.corners[1]), number(face.corners[2])});
    for (const Vec3& p : interface.points) interface.planar.push_back(cut.plane.project(p));
    return interface;
}

// Divides a surface by a straight cut, as a run does where no contour of edges is found; false if none is accepted.
bool cut_straight(const Surface& surface, NodeId node, const CutPlace& place, const CutOptions& options,
                  MadeCut& made) {
    FaceComplex complex({with_own_keys(surface, node)});
    const FaceComplex::Part part = complex.part(node);
    std::vector<CutTry>& tries = made.cut.tries;
    std::optional<StraightCut> straight =
        kerf::cut_straight(separated_surface(part.arrays), node, place.fraction, options, tries, part.untested);
    if (!straight) return false;
    complex.divide(node, part, *straight);
    std::vector<Vertex> parent_vertex(part.vertex.size());  // of a vertex of the surface, and then of the complex
    for (const Vertex v : part.vertex.ids()) parent_vertex[part.vertex[v]] = v;
    for (CutTry& one : tries)
        for (SurfaceEdge& edge : one.contour)
            for (Vertex& v : edge) v = parent_vertex[v.value()];
    for (std::int32_t i = count_of(parent_vertex); i < count_of(straight->split.arrays.vertices); ++i)
        parent_vertex.emplace_back(i);
    triangulate_caps(complex, [&](NodeId, const Vec3& point) { return options.max_interface_edge(point); });
    straight->cut.tries = std::move(tries);
    made.cut = std::move(straight->cut);
    made.cut.place = place;
    made.cut.interface = interface_of(complex, made.cut, parent_vertex);
    made.cut.quality = measure_caps(complex).at(node).quality;
    made.cut.side = straight->split.side;
    SurfaceArrays& arrays = made.cut.split_parent = std::move(straight->split.arrays);
    // Interior points of the interface have the first keys of the node (split()).
    const std::int32_t interior = count_of(made.cut.interface.points) - count_of(made.cut.interface.contour);
    const std::int32_t old_vertices = count_of(part.vertex);
    for (std::int32_t i = 0; i < count_of(arrays.vertices); ++i)
        arrays.vertex_key[i] =
            i < old_vertices ? surface.vertex_key(Vertex(part.vertex[i])) : make_key(node, interior + i - old_vertices);
    for (std::size_t f = 0; f < arrays.facets.size(); ++f)
        arrays.facet_key[f] = surface.facet_key(straight->split.parent[f]);
    return true;
}

MadeCut make_cut(const Surface& surface, NodeId node, const CutPlace& place, const DecomposeOptions& options) {
    MadeCut made;
    made.cut.node = node;
    made.cut.place = place;
    if (options.cut.contour != ContourMethod::straight) {
        Bisection bisection = bisect(surface, mass_properties(surface), node, place, options.cut, true);
        made.cut = std::move(bisection.cut);
        if (made.cut.made()) {
            for (const int i : {0, 1}) made.halves.push_back(row_of(child_of(node, i), bisection.halves[i]));
            return made;
        }
    }
    if (options.facets == FacetPolicy::split) cut_straight(surface, node, place, options.cut, made);
    return made;
}

}  // namespace

RedoneCut redo_cut(Replayer& replayer, NodeId node, RunRequest options, const std::optional<Plane>& plane) {
    RunChoices choices = choices_of(std::move(options));
    const Trace& old = *replayer.trace();
    Eigen::AlignedBox3d box;
    for (const Vec3& p : old.surface.vertices) box.extend(p);
    SizeOptions& sizes = choices.request.sizes;
    sizes.resolve_lengths(box.diagonal().norm());
    DecomposeOptions cuts = choices.decompose_options(read_size_field(sizes, old.surface, old.patch_names));
    const Cut* before = old.find(node);
    RedoneCut redone;
    const std::shared_ptr<const Surface> surface = replayer.uncut_surface(node);
    cuts.cut = cuts.cut.of(*surface);
    const MassProperties mass = mass_properties(*surface);
    const CutPlace place = plane    ? place_of(*plane, *surface, mass, cuts.cut)
                           : before ? before->place
                                    : choose_place(*surface, mass, 2, cuts.cut);
    MadeCut made = make_cut(*surface, node, place, cuts);
    redone.rows.push_back(row_of(node, *surface));
    describe_cut(made.cut, redone.rows.front());
    redone.rows.front().leaves = made.cut.made() ? 2 : 1;
    made.cut.seconds = 0;  // as in every trace

    const auto trace = std::make_shared<Trace>(old);
    std::erase_if(trace->cuts, [&](const Cut& cut) { return lies_below(cut.node, node); });
    const auto position =
        std::partition_point(trace->cuts.begin(), trace->cuts.end(), [&](const Cut& cut) { return cut.node < node; });
    const bool is_made = trace->cuts.insert(position, std::move(made.cut))->made();
    redone.replayer = std::make_shared<Replayer>(replayer, trace, node);

    if (is_made && made.halves.empty())  // of a straight cut the kernel gives no halves
        for (const NodeId half : halves_of(node)) made.halves.push_back(row_of(half, *redone.replayer->surface(half)));
    redone.rows.insert(redone.rows.end(), made.halves.begin(), made.halves.end());
    return redone;
}

}  // namespace kerf::view
