// The corners of faces are global vertex numbers.
#include "support/run_laws.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/geometry/predicates.h"
#include "support/face.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/facet_cover.h"

namespace kerf::test {

namespace {

// A face of the boundary of a part.
struct BoundaryFace {
    Face corners;
    NodeId part, neighbour;
    std::int32_t patch;
    auto key() const { return std::tie(corners, part, neighbour, patch); }
    bool operator<(const BoundaryFace& o) const { return key() < o.key(); }
};

class RunLaws {
 public:
    RunLaws(const std::vector<Part>& parts, const SurfaceArrays& input) : parts_(parts), input_(input) {
        volumes_ = {enclosed_volume(input.vertices, input.facets)};
    }
    RunLaws(const std::vector<Part>& parts, const SurfaceArrays& input, const Complex& complex)
        : parts_(parts), input_(input), sides_(complex.all_sides()) {
        for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
            const SurfaceArrays arrays = complex.arrays_of(region);
            volumes_.push_back(enclosed_volume(arrays.vertices, arrays.facets));
        }
    }

    std::string broken() {
        check_numbers();
        if (!text_.empty()) return text_;  // what follows is told by global numbers
        for (const Part& part : parts_) check_tetrahedra(part);
        check_volume();
        check_boundary();
        return text_;
    }

 private:
    void add(std::int64_t count, const char* law) {
        if (count) text_ += std::to_string(count) + " " + law + "; ";
    }
    void check_numbers();
    void check_tetrahedra(const Part& part);
    void check_volume();
    void check_facets();
    void check_boundary();
    std::vector<BoundaryFace> boundary(bool interface) const;

    const std::vector<Part>& parts_;
    const SurfaceArrays& input_;
    std::span<const FacetSides> sides_;
    std::vector<double> volumes_;  // of the regions
    std::string text_;
    std::vector<Vec3> points_;  // by global number
};

void RunLaws::check_numbers() {
    struct Numbered {
        std::int64_t id;
        Vec3 point;
    };
    std::vector<Numbered> all;
    for (const Part& part : parts_)
        for (std::size_t v = 0; v < part.global_id.size(); ++v)
            all.push_back({part.global_id[v], part.mesh.vertices[v]});
    std::sort(all.begin(), all.end(), [](const Numbered& a, const Numbered& b) { return a.id < b.id; });
    std::int64_t gaps = 0, moved = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0 && all[i].id == all[i - 1].id) {
            moved += !same_bits(all[i].point, all[i - 1].point);
            continue;
        }
        gaps += all[i].id != static_cast<std::int64_t>(points_.size());
        points_.push_back(all[i].point);
    }
    add(gaps, "gaps in the vertex numbers");
    add(moved, "vertices with the same number at different places");
    if (points_.size() < input_.vertices.size()) {
        add(1, "mesh with fewer vertices than the input");
        return;
    }
    std::int64_t changed = 0;
    for (std::size_t v = 0; v < input_.vertices.size(); ++v) changed += !same_bits(points_[v], input_.vertices[v]);
    add(changed, "vertices of the input without their number and place");
    const auto less = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::vector<Vec3> sorted = points_;
    std::sort(sorted.begin(), sorted.end(), less);
    std::int64_t doubled = 0;
    for (std::size_t i = 1; i < sorted.size(); ++i) doubled += sorted[i] == sorted[i - 1];
    add(doubled, "vertices with different numbers at the same place");
}

void RunLaws::check_tetrahedra(const Part& part) {
    std::int64_t inverted = 0;
    std::vector<Face> faces, facets;
    for (const Tetrahedron& t : part.mesh.tets) {
        const std::vector<Vec3>& p = part.mesh.vertices;
        inverted += orientation(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) <= 0;
        for (const auto& [i, j, k] : tet_faces) faces.push_back(rotated({t[i], t[j], t[k]}));
    }
    for (const Triangle& t : part.facets) facets.push_back(rotated({t[0], t[1], t[2]}));
    std::sort(faces.begin(), faces.end());
    std::sort(facets.begin(), facets.end());
    std::vector<Face> outer;
    for (const Face& face : faces)
        if (!std::binary_search(faces.begin(), faces.end(), turned(face))) outer.push_back(face);
    std::int64_t doubled = 0;
    for (std::size_t i = 1; i < faces.size(); ++i) doubled += faces[i] == faces[i - 1];
    add(part.mesh.tets.empty(), "part without tetrahedra");
    add(inverted, "tetrahedra that are not positive");
    add(doubled, "faces with two tetrahedra on one side");
    add(outer != facets, "part whose boundary triangles are not the boundary of its tetrahedra");
}

void RunLaws::check_volume() {
    std::vector<double> sums(volumes_.size(), 0);
    std::int64_t wrong = 0;
    for (const Part& part : parts_)
        for (const Tetrahedron& t : part.mesh.tets) {
            const std::vector<Vec3>& p = part.mesh.vertices;
            const auto region = static_cast<std::size_t>(part.region_of(0).value());
            if (region >= sums.size()) return add(1, "part in a region that there is not");
            sums[region] += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) / 6;
        }
    for (std::size_t r = 0; r < sums.size(); ++r) wrong += !(std::abs(sums[r] - volumes_[r]) <= 1e-10 * volumes_[r]);
    add(wrong, "volume that is not the enclosed one");
    std::int64_t mixed = 0;
    for (const Part& part : parts_) mixed += part.regions.size() != (sides_.empty() ? 0 : 1);
    add(mixed, "parts that do not lie in one region");
}

std::vector<BoundaryFace> RunLaws::boundary(bool interface) const {
    std::vector<BoundaryFace> faces;
    for (const Part& part : parts_)
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (part.neighbour[f].is_valid() != interface) continue;
            const Triangle& t = part.facets[f];
            faces.push_back({rotated({part.global_id[t[0]], part.global_id[t[1]], part.global_id[t[2]]}), part.id,
                             part.neighbour[f], part.patch[f]});
        }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// The pieces of a facet are the facet itself, or new vertices lie on its edges and inside of it.
void RunLaws::check_facets() {
    // Behind facet f, then in front of it.
    std::vector<std::vector<std::pair<Face, NodeId>>> pieces(2 * input_.facets.size());
    std::int64_t foreign = 0, changed = 0;
    const auto region_at = [&](std::size_t side) {
        const FacetSides sides = sides_.empty() ? FacetSides{} : sides_[side / 2];
        return side % 2 == 0 ? sides.back : sides.front;
    };
    for (const Part& part : parts_)
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            const auto facet = static_cast<std::size_t>(part.facet[f]);
            const bool is_wall = facet < sides_.size() && sides_[facet].is_wall();
            if (part.neighbour[f].is_valid() && !is_wall) continue;
            const Triangle& t = part.facets[f];
            const RegionIndex region = part.region_of(0);
            if (facet >= input_.facets.size() || part.patch[f] != input_.patch[facet] ||
                (region_at(2 * facet) != region && region_at(2 * facet + 1) != region))
                ++foreign;
            else
                pieces[2 * facet + (region_at(2 * facet) == region ? 0 : 1)].push_back(
                    {rotated({part.global_id[t[0]], part.global_id[t[1]], part.global_id[t[2]]}), part.id});
        }
    for (std::size_t f = 0; f < pieces.size(); ++f) {
        Triangle t = input_.facets[f / 2];
        if (f % 2 == 1) std::swap(t[1], t[2]);
        if (!region_at(f).is_valid()) {
            changed += !pieces[f].empty();
            continue;
        }
        if (pieces[f].size() == 1) {
            changed += pieces[f][0].first != rotated({t[0], t[1], t[2]});
            continue;
        }
        std::vector<std::array<Vec3, 3>> corners;
        for (const auto& [face, part] : pieces[f])
            corners.push_back({points_[face[0]], points_[face[1]], points_[face[2]]});
        changed += !covers({input_.vertices[t[0]], input_.vertices[t[1]], input_.vertices[t[2]]}, corners);
    }
    add(foreign, "boundary triangles without a facet of the input");
    add(changed, "facets that are not once in the input and once in the parts");
}

void RunLaws::check_boundary() {
    check_facets();
    const std::vector<BoundaryFace> sides = boundary(true);
    std::int64_t unmatched = 0, doubled = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const BoundaryFace& side = sides[i];
        unmatched += !std::binary_search(sides.begin(), sides.end(),
                                         BoundaryFace{turned(side.corners), side.neighbour, side.part, side.patch});
        doubled += i > 0 && side.corners == sides[i - 1].corners;
    }
    add(unmatched, "interface faces without their other side");
    add(doubled, "interface faces that are there twice");
}

std::vector<Part> read_files(const std::string& folder, bool surfaces) {
    std::vector<Part> parts;
    for (const auto& entry : std::filesystem::directory_iterator(folder + "/parts")) {
        const bool is_surface = entry.path().string().ends_with(".surface.vtu");
        if (is_surface == surfaces) parts.push_back(read_part(entry.path()));
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.id < b.id; });
    return parts;
}

// Global numbers, the smaller one first.
std::array<std::int64_t, 2> edge_of(const Part& part, std::int32_t a, std::int32_t b) {
    return {std::min(part.global_id[a], part.global_id[b]), std::max(part.global_id[a], part.global_id[b])};
}

}  // namespace

std::vector<Part> read_parts(const std::string& folder) { return read_files(folder, false); }

std::vector<Part> read_part_surfaces(const std::string& folder) { return read_files(folder, true); }

std::string broken_laws(const std::vector<Part>& parts, const SurfaceArrays& input) {
    return RunLaws(parts, input).broken();
}

std::string broken_laws(const std::vector<Part>& parts, const Complex& input) {
    const SurfaceArrays facets = input.arrays();
    return input.region_count() == 1 ? broken_laws(parts, facets) : RunLaws(parts, facets, input).broken();
}

std::string broken_sharing(const PartSource& source) {
    using Holders = std::set<NodeId>;
    std::map<std::int64_t, Holders> of_vertex, told_of_vertex;
    std::map<std::array<std::int64_t, 2>, Holders> of_edge, told_of_edge;
    std::int64_t wrong = 0;
    for (const PartIndex index : source.outline().parts.ids()) {
        const Part part = source.load(index);
        for (const std::int64_t id : part.global_id) of_vertex[id].insert(part.id);
        for (const Tetrahedron& t : part.mesh.tets)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < i; ++j) of_edge[edge_of(part, t[i], t[j])].insert(part.id);
        for (const SharedGroup& group : part.shared)
            for (const std::int32_t v : group.vertices) {
                const auto [told, is_new] =
                    told_of_vertex.emplace(part.global_id[v], Holders(group.parts.begin(), group.parts.end()));
                wrong += told->second != Holders(group.parts.begin(), group.parts.end());
            }
        for (const SharedEdgeGroup& group : part.shared_edges)
            for (const auto& [a, b] : group.edges) {
                const auto [told, is_new] =
                    told_of_edge.emplace(edge_of(part, a, b), Holders(group.parts.begin(), group.parts.end()));
                wrong += told->second != Holders(group.parts.begin(), group.parts.end());
            }
    }
    std::erase_if(of_vertex, [](const auto& held) { return held.second.size() < 2; });
    std::erase_if(of_edge, [](const auto& held) { return held.second.size() < 2; });
    std::string text;
    if (wrong > 0) text += fmt::format("{} that parts tell of differently; ", wrong);
    if (of_vertex != told_of_vertex)
        text += fmt::format("{} vertices shared, {} told; ", of_vertex.size(), told_of_vertex.size());
    if (of_edge != told_of_edge) text += fmt::format("{} edges shared, {} told; ", of_edge.size(), told_of_edge.size());
    return text;
}

std::string broken_edge_nodes(const PartSource& parts, bool curved) {
    struct Seen {
        std::array<std::int64_t, 2> edge;
        Vec3 point;
    };
    std::map<std::int64_t, Seen> of_number;
    std::map<std::array<std::int64_t, 2>, std::int64_t> of_edge;
    std::int64_t wrong = 0, off_middle = 0;
    for (const PartIndex index : parts.outline().parts.ids()) {
        const Part part = parts.load(index);
        std::set<std::int64_t> reached;
        for (std::int64_t t = 0; t < part.tet_count(); ++t) {
            const auto nodes = part.nodes_of_tet(t);
            for (std::size_t e = 0; e < tet_edges.size(); ++e) {
                const std::int32_t a = nodes[tet_edges[e][0]], b = nodes[tet_edges[e][1]], n = nodes[4 + e];
                const Vec3& point = part.node_point(n);
                const Seen now = {edge_of(part, a, b), point};
                const Seen& seen = of_number.emplace(part.node_id(n), now).first->second;
                wrong += seen.edge != now.edge || seen.point != point;
                wrong += of_edge.emplace(now.edge, part.node_id(n)).first->second != part.node_id(n);
                off_middle += point != 0.5 * (part.node_point(a) + part.node_point(b));
                reached.insert(n);
            }
        }
        wrong += std::ssize(reached) != std::ssize(part.edge_nodes.points);
        wrong += std::ssize(reached) != parts.outline().parts[index].edge_nodes;
    }
    std::string text;
    if (wrong > 0) text += fmt::format("{} nodes of which parts tell differently; ", wrong);
    if (off_middle > 0 && !curved) text += fmt::format("{} off the middle of their edges; ", off_middle);
    const std::int64_t vertices = parts.outline().vertices;
    if (of_number.empty() || of_number.begin()->first != vertices ||
        of_number.rbegin()->first != parts.outline().nodes() - 1 ||
        std::ssize(of_number) != parts.outline().edge_nodes || of_number.size() != of_edge.size())
        text += fmt::format("{} edges with {} numbers, not {} from {} on; ", of_edge.size(), of_number.size(),
                            parts.outline().edge_nodes, vertices);
    return text;
}

}  // namespace kerf::test
