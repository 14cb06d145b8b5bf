// A mesh of arrays is taken apart into the parts of which it was joined, by MeshArrays::part. Neighbours of all
// tetrahedra are found once; a face whose neighbour is of another part, or that has none, is on the boundary of its
// part, and a search among the sorted triangles of the arrays tells its patch. Vertices get numbers in the part as they
// are met, those of the boundary first. Global numbers are rows of the arrays, so that parts have no keys to match by.
#include "kerf/inside/parts_from_arrays.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "base/core/ids.h"
#include "fill/mesh/adjacency.h"
#include "kerf/inside/array_edge_nodes.h"
#include "kerf/inside/array_points.h"

namespace kerf {

namespace {

using Corners = std::array<std::int32_t, 3>;

Corners sorted(Corners face) {
    std::sort(face.begin(), face.end());
    return face;
}

// The triangles of the arrays by their corners.
class TriangleRows {
 public:
    explicit TriangleRows(const MeshArrays& mesh) {
        rows_.reserve(mesh.triangles.size());
        for (const auto& triangle : mesh.triangles) rows_.emplace_back(sorted(narrowed(triangle)), count_of(rows_));
        std::sort(rows_.begin(), rows_.end());
    }
    /// Returns the row of a triangle with these corners, in any order; -1 if there is none.
    std::int32_t find(const Corners& face) const {
        const std::pair<Corners, std::int32_t> wanted = {sorted(face), 0};
        const auto found = std::lower_bound(rows_.begin(), rows_.end(), wanted);
        return found != rows_.end() && found->first == wanted.first ? found->second : -1;
    }

 private:
    std::vector<std::pair<Corners, std::int32_t>> rows_;
};

TetMesh joined_mesh(const MeshArrays& mesh) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    if (mesh.vertices.size() > most || mesh.tets.size() > most)
        throw Error(ErrorCode::usage,
                    "The mesh is too large to be taken apart: it has more than 2^31 vertices or "
                    "tetrahedra. Mesh into a folder.");
    TetMesh whole;
    whole.vertices = to_points(mesh.vertices);
    whole.tets.reserve(mesh.tets.size());
    for (const auto& tet : mesh.tets) whole.tets.push_back(narrowed(tet));
    connect_tets(whole);
    return whole;
}

// Takes one part after the other out of the whole.
class PartTaker {
 public:
    explicit PartTaker(const MeshArrays& mesh)
        : mesh_(mesh), whole_(joined_mesh(mesh)), rows_(mesh), local_(whole_.vertices.size(), -1) {}

    Part take(NodeId id, const std::vector<std::int32_t>& tets) {
        Part part;
        part.id = id;
        for (std::size_t i = 0; i < tets.size(); ++i) add_boundary(tets[i], i, part);
        part.mesh.boundary_vertex_count = count_of(part.mesh.vertices);
        for (const std::int32_t tet : tets) {
            const Tetrahedron& t = whole_.tets[tet];
            part.mesh.tets.push_back({number(t[0], part), number(t[1], part), number(t[2], part), number(t[3], part)});
        }
        take_edge_nodes(mesh_, tets, part);
        part.patch_names = NameTable::of_part(mesh_.patch_names, part.patch);
        if (!mesh_.region_names.empty()) {
            part.regions = {{0, RegionIndex(mesh_.region[tets.front()])}};
            part.region_names = NameTable::of_part(mesh_.region_names, {mesh_.region[tets.front()]});
        }
        for (const std::int64_t vertex : part.global_id) local_[vertex] = -1;
        return part;
    }

 private:
    void add_boundary(std::int32_t tet, std::int32_t place, Part& part) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::int32_t beyond = whole_.neighbours[tet][i].value();
            const NodeId neighbour = beyond < 0 ? NodeId::none() : NodeId(mesh_.part[beyond]);
            if (neighbour == part.id) continue;
            Corners corners;
            for (std::size_t c = 0; c < 3; ++c) corners[c] = whole_.tets[tet][tet_faces[i][c]];
            const std::int32_t row = rows_.find(corners);
            part.facets.push_back({number(corners[0], part), number(corners[1], part), number(corners[2], part)});
            part.patch.push_back(row < 0 ? -1 : mesh_.patch[row]);
            part.facet.push_back(row);
            part.neighbour.push_back(neighbour);
            part.tet_at_facet.push_back(place);
        }
    }
    // Returns the number of a vertex in the part; a vertex that is met first gets one.
    std::int32_t number(std::int32_t vertex, Part& part) {
        if (local_[vertex] < 0) {
            local_[vertex] = count_of(part.mesh.vertices);
            part.mesh.vertices.push_back(whole_.vertices[vertex]);
            part.global_id.push_back(vertex);
        }
        return local_[vertex];
    }

    const MeshArrays& mesh_;
    TetMesh whole_;
    TriangleRows rows_;
    std::vector<std::int32_t> local_;  // of each vertex, in the part that is being taken; else -1
};

}  // namespace

void for_each_part_of(const MeshArrays& mesh, const std::function<void(const Part&)>& take) {
    PartTaker taker(mesh);
    std::map<NodeId, std::vector<std::int32_t>> tets_of;
    for (std::size_t tet = 0; tet < mesh.part.size(); ++tet) tets_of[NodeId(mesh.part[tet])].push_back(tet);
    for (const auto& [id, tets] : tets_of) take(taker.take(id, tets));
}

}  // namespace kerf
