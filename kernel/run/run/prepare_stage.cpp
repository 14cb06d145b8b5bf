// A part becomes a job that needs nothing of the others. All that only the parts together know is found by keys, never
// by coordinates: the part behind each interface triangle (run/prepare/interface_match.h), the global number of each
// vertex, which is arithmetic on its key and the tree (run/prepare/numbering.h), and the set of parts that have a
// vertex or an edge (run/prepare/shared_incidences.h). An incidence is one vertex or edge with one part that has it; it
// goes to one rank, which its number chooses, and comes back as the set, so that the memory of a rank follows its own
// parts. Only vertices of facets between parts, and those of contacts, are told. Of several regions, a part that
// touches itself gets one vertex at each place first: a mesher must not get two. The surface of a leaf is moved into
// its job; nothing is kept twice.
#include "run/run/prepare_stage.h"

#include <algorithm>
#include <utility>

#include "base/core/ids.h"
#include "base/core/mixed_bits.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "files/part/shared_edges.h"
#include "files/part/shared_vertices.h"
#include "fill/volume/tet_forecast.h"
#include "run/prepare/input_cover.h"
#include "run/prepare/interface_match.h"
#include "run/prepare/leaf_owners.h"
#include "run/prepare/numbering.h"
#include "run/prepare/shared_incidences.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

// The report of a part before it is meshed.
PartReport describe_part(const PartJob& job, double volume, int rank, double half_thickness, const RunPlan& plan) {
    const CutOptions cut = plan.decompose_options().cut_in(job.region);
    const SizeField size = plan.size_in(job.region);
    const MesherOptions mesher = plan.mesher();
    PartReport part;
    part.id = job.part;
    part.rank = rank;
    part.region = job.region;
    part.surface_volume = volume;
    part.surface_volume_error = bounded_volume(job.surface.vertices, job.surface.facets).error;
    part.box = box_around(job.surface.vertices);
    part.surface_vertices = std::ssize(job.surface.vertices);
    part.surface_facets = std::ssize(job.surface.facets);
    for (std::size_t f = 0; f < job.neighbour.size(); ++f) {
        const Triangle& t = job.surface.facets[f];
        const std::vector<Vec3>& p = job.surface.vertices;
        const double area = triangle_area(p, t);
        const Vec3 centroid = (p[t[0]] + p[t[1]] + p[t[2]]) / 3;
        if (job.neighbour[f].is_valid()) part.neighbours.push_back(job.neighbour[f]);
        if (is_of_input(job.surface.facet_key[f])) {
            part.walls_of_others += !is_listed_triangle(job.surface.patch[f], job.part, job.neighbour[f]);
            part.tets_at_facets +=
                tets_at_facet(shape_of_facet(p[t[0]], p[t[1]], p[t[2]]), size.at(centroid), half_thickness, mesher);
            continue;
        }
        ++part.interface_facets;
        const double edge = cut.max_interface_edge(centroid);
        part.interface_area += area;
        part.interface_in_squared_edges += area / (edge * edge);
    }
    part.sized_volume = sized_volume(cut.size, job.surface.vertices, job.surface.facets, volume);
    if (!size.is_empty() && !plan.size.is_empty())
        part.sized_volume *= plan.size.reference_volume() / size.reference_volume();
    const LoadModel load = cut.load();
    part.load =
        load.load(part.surface_vertices, part.surface_facets, load.depends_on_place() ? part.sized_volume : volume);
    std::sort(part.neighbours.begin(), part.neighbours.end());
    part.neighbours.erase(std::unique(part.neighbours.begin(), part.neighbours.end()), part.neighbours.end());
    return part;
}

// Finds the vertices that the parts of this rank share with others, on any rank.
SharedVertices find_shared_vertices(Communicator& ranks, const LeafOwners& leaves, const VertexNumbering& numbering,
                                    const Decomposition& own, std::span<const FacetSides> sides) {
    std::vector<SharedVertices::Incidence> held;
    std::vector<char> is_held;
    for (const Leaf& leaf : own.leaves) {
        const SurfaceArrays& surface = leaf.surface;
        is_held.assign(surface.vertices.size(), 0);
        for (std::size_t f = 0; f < surface.facets.size(); ++f)
            if (is_between_leaves(surface.facet_key[f], sides))
                for (const std::int32_t v : surface.facets[f]) is_held[v] = 1;
        for (std::size_t v = 0; v < is_held.size(); ++v)
            if (const Key key = surface.vertex_key[v]; is_held[v] || own.contacts.has(key))
                held.push_back({numbering.global_id(key), leaves.index_of(leaf.id)});
    }
    using Incidence = SharedVertices::Incidence;
    return {incidences_of_rank(
                ranks, leaves, std::move(held), [](const Incidence& i) { return i.vertex; },
                [](const Incidence& a, const Incidence& b) { return a.vertex == b.vertex; }),
            leaves.ids()};
}

void find_shared_edges(Communicator& ranks, const LeafOwners& leaves, std::vector<OwnPart>& own) {
    using Incidence = SharedEdges::Incidence;
    std::vector<Incidence> told;
    for (const OwnPart& part : own) {
        const std::vector<Incidence> by_part = SharedEdges::incidences_of(part_of_job(part.job));
        told.insert(told.end(), by_part.begin(), by_part.end());
    }
    const auto number = [](const Incidence& i) { return mixed_bits(i.edge[0]) + i.edge[1]; };
    const SharedEdges shared(
        incidences_of_rank(ranks, leaves, std::move(told), number,
                           [](const Incidence& a, const Incidence& b) { return a.edge == b.edge; }),
        leaves.ids());
    for (OwnPart& part : own) part.job.shared_edges = shared.groups_of(part_of_job(part.job));
}

// The vertices and edges of one surface that lie at contacts.
struct SurfaceContacts {
    std::vector<std::int32_t> vertices;
    std::vector<UndirectedEdge> edges;
};

SurfaceContacts contacts_of(const SurfaceArrays& surface, const Contacts& contacts) {
    SurfaceContacts own;
    if (contacts.empty()) return own;
    std::vector<char> is_contact(surface.vertices.size(), 0);
    for (std::int32_t v = 0; v < count_of(is_contact); ++v)
        if (contacts.has(surface.vertex_key[v])) {
            is_contact[v] = 1;
            own.vertices.push_back(v);
        }
    for (const Triangle& t : surface.facets)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            if (is_contact[a] && is_contact[b] && contacts.has(surface.vertex_key[a], surface.vertex_key[b]))
                own.edges.push_back(undirected(a, b));
        }
    std::sort(own.edges.begin(), own.edges.end());
    own.edges.erase(std::unique(own.edges.begin(), own.edges.end()), own.edges.end());
    return own;
}

}  // namespace

PreparedParts prepare_parts(Communicator& ranks, const Input& input, const std::vector<TreeNode>& nodes,
                            Decomposition own, const RunPlan& plan) {
    PreparedParts prepared;
    const std::span<const FacetSides> sides = input.complex.all_sides();
    const InterfaceMatch match(ranks, own.leaves, sides);
    prepared.unmatched_interface_facets = match.unmatched();
    prepared.missing_input_facets = count_missing_input_facets(ranks, input.facets, own, sides);
    const VertexNumbering numbering(input.vertices, nodes);
    prepared.surface_vertices = numbering.surface_vertices();
    const LeafOwners leaves(ranks, own.leaves);
    // A part that touches itself has one vertex at a place from here on.
    if (!sides.empty())
        for (Leaf& leaf : own.leaves) leaf.surface = joined_by_key(std::move(leaf.surface));
    const SharedVertices shared = find_shared_vertices(ranks, leaves, numbering, own, sides);
    for (std::size_t i = 0; i < own.leaves.size(); ++i) {
        Leaf& leaf = own.leaves[i];
        PartJob job;
        job.part = leaf.id;
        job.boundary_id = numbering.global_ids(leaf.surface.vertex_key);
        job.neighbour = match.neighbours(i);
        SurfaceContacts contacts = contacts_of(leaf.surface, own.contacts);
        job.contact_vertices = std::move(contacts.vertices);
        job.contact_edges = std::move(contacts.edges);
        job.shared = shared.groups_of(leaves.index_of(leaf.id), job.boundary_id);
        job.patch_names = NameTable::of_part(input.patch_names, leaf.surface.patch);
        job.region_names = NameTable::of_part(input.complex.region_names(), {leaf.region.value()});
        job.region = leaf.region;
        job.length_scale = input.diagonal;
        job.surface = std::exchange(leaf.surface, {});
        PartReport report = describe_part(job, leaf.volume, ranks.rank(), input.volume / input.area, plan);
        prepared.own.push_back({std::move(report), std::move(job)});
    }
    find_shared_edges(ranks, leaves, prepared.own);
    return prepared;
}

std::vector<PartReport> gather_reports(Communicator& ranks, const std::vector<OwnPart>& own) {
    std::vector<PartReport> reports;
    for (const OwnPart& part : own) reports.push_back(part.report);
    return gather_items(ranks, reports);
}

}  // namespace kerf
