// A rank joins whole parts, one after the other: vertices that several parts share, known from Part::shared by their
// global numbers, are taken from the first of its parts that has them. Parts are divided among ranks as leaves of the
// tree (divide_leaves()), in its order; groups of sharing parts are in that order, too, so that the first rank that
// holds a vertex, its owner, is the same for all without a message. What two ranks share is in the same order on both,
// because it is sorted by global numbers: vertices by theirs, triangles by those of their corners. A wall between two
// regions is listed by one of its parts; where that part is on another rank, both ranks have the triangle, and
// `triangle_owner` says which counts it.
#include "kerf/rank_mesh.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "files/part/joined_parts.h"
#include "files/part/region_walls.h"
#include "files/part/solution_parts.h"

namespace kerf {

namespace {

class RankMeshMaker {
 public:
    RankMeshMaker(const PartSource& parts, int rank, int ranks);
    RankMesh make();

 private:
    void add_vertices(const Part& part);
    void add_shared(const Part& part);
    void add_tets(const Part& part);
    void add_triangles(const Part& part);
    void add_interfaces(const Part& part);
    void sort_interface(RankNeighbour& neighbour) const;
    std::int32_t region_in_front(const Part& part, std::size_t f) const;
    bool is_own(NodeId part) const { return rank_of_.at(part) == rank_; }

    const PartSource& parts_;
    int rank_;
    PartIndex first_, end_;                                         // range of the own parts
    std::unordered_map<NodeId, std::int32_t> rank_of_;              // of every part
    std::unordered_map<std::int64_t, std::int64_t> row_of_shared_;  // of vertices of several parts, by global numbers
    std::map<std::int32_t, RankNeighbour> neighbours_;              // by rank
    std::vector<std::int64_t> row_;                                 // of each vertex of the part at hand
    RankMesh mesh_;
};

RankMeshMaker::RankMeshMaker(const PartSource& parts, int rank, int ranks) : parts_(parts), rank_(rank) {
    const MeshOutline& outline = parts.outline();
    std::vector<NodeId> leaves;
    for (const PartExtent& part : outline.parts) leaves.push_back(part.id);
    const std::int32_t count = std::ssize(leaves);
    first_ = end_ = PartIndex(count);
    std::int32_t r = 0;
    for (const PieceOfTree& piece : divide_leaves(leaves, std::min(ranks, count))) {
        for (std::int32_t i = piece.first; i < piece.last; ++i) rank_of_[leaves[i]] = r;
        if (r++ != rank) continue;
        first_ = PartIndex(piece.first);
        end_ = PartIndex(piece.last);
    }
    mesh_.first_tet = outline.first_tet(first_);
    mesh_.all_vertices = outline.vertices;
    mesh_.all_tets = outline.tets();
    mesh_.patch_names = outline.patch_names;
    mesh_.region_names = outline.region_names;
}

RankMesh RankMeshMaker::make() {
    for (const PartIndex index : IdRange(first_, end_)) {
        const Part part = parts_.load(index);
        add_vertices(part);
        add_shared(part);
        add_triangles(part);
        add_interfaces(part);
        add_tets(part);
    }
    const std::vector<std::int64_t>& ids = mesh_.global_vertices;
    for (auto& [rank, neighbour] : neighbours_) {
        neighbour.rank = rank;
        std::sort(neighbour.vertices.begin(), neighbour.vertices.end(),
                  [&](std::int64_t a, std::int64_t b) { return ids[a] < ids[b]; });
        sort_interface(neighbour);
        mesh_.neighbours.push_back(std::move(neighbour));
    }
    return std::move(mesh_);
}

void RankMeshMaker::sort_interface(RankNeighbour& neighbour) const {
    struct Face {
        std::array<std::int64_t, 3> ids, corners;
        std::int64_t tet;
    };
    std::vector<Face> faces;
    for (std::size_t f = 0; f < neighbour.triangles.size(); ++f) {
        const auto& [a, b, c] = neighbour.triangles[f];
        const std::vector<std::int64_t>& ids = mesh_.global_vertices;
        faces.push_back({{ids[a], ids[b], ids[c]}, neighbour.triangles[f], neighbour.tet_behind[f]});
        std::sort(faces.back().ids.begin(), faces.back().ids.end());
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.ids < b.ids; });
    for (std::size_t f = 0; f < faces.size(); ++f) {
        neighbour.triangles[f] = faces[f].corners;
        neighbour.tet_behind[f] = faces[f].tet;
    }
}

// Adds the vertices of a part. One that an earlier part has brought stays in its row.
void RankMeshMaker::add_vertices(const Part& part) {
    row_.assign(part.mesh.vertices.size(), -1);
    for (const SharedGroup& group : part.shared)
        for (const std::int32_t v : group.vertices)
            if (const auto known = row_of_shared_.find(part.global_id[v]); known != row_of_shared_.end())
                row_[v] = known->second;
    for (std::size_t v = 0; v < row_.size(); ++v) {
        if (row_[v] >= 0) continue;
        row_[v] = std::ssize(mesh_.vertices);
        const Vec3& p = part.mesh.vertices[v];
        mesh_.vertices.push_back({p.x(), p.y(), p.z()});
        mesh_.global_vertices.push_back(part.global_id[v]);
        mesh_.owner.push_back(rank_);
    }
}

// Adds the vertices that a part shares with other ranks. Ranks have their parts in the order of the tree, in which
// groups name them: the first one owns.
void RankMeshMaker::add_shared(const Part& part) {
    for (const SharedGroup& group : part.shared) {
        std::vector<std::int32_t> ranks;
        for (const NodeId holder : group.parts) ranks.push_back(rank_of_.at(holder));
        ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
        for (const std::int32_t v : group.vertices) {
            if (!row_of_shared_.emplace(part.global_id[v], row_[v]).second) continue;
            mesh_.owner[row_[v]] = ranks.front();
            for (const std::int32_t rank : ranks)
                if (rank != rank_) neighbours_[rank].vertices.push_back(row_[v]);
        }
    }
}

void RankMeshMaker::add_tets(const Part& part) {
    for (const Tetrahedron& tet : part.mesh.tets)
        mesh_.tets.push_back({row_[tet[0]], row_[tet[1]], row_[tet[2]], row_[tet[3]]});
    mesh_.part.insert(mesh_.part.end(), part.mesh.tets.size(), part.id.value());
    mesh_.region.insert(mesh_.region.end(), part.mesh.tets.size(), part.region_of(0).value());
}

std::int32_t RankMeshMaker::region_in_front(const Part& part, std::size_t f) const {
    if (!part.is_wall(f)) return -1;
    return part.region_names.empty() ? 0 : parts_.walls().beyond(part, f).value();
}

// Adds the triangles on patches. Of a wall between two parts of this rank that of the part is taken which files list.
void RankMeshMaker::add_triangles(const Part& part) {
    const std::int64_t first_tet = std::ssize(mesh_.tets);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        const bool is_listed = part.is_listed(f);
        if (part.patch[f] < 0 || (!is_listed && is_own(part.neighbour[f]))) continue;
        const Triangle& facet = part.facets[f];
        mesh_.triangles.push_back({row_[facet[0]], row_[facet[1]], row_[facet[2]]});
        mesh_.tet_behind.push_back(first_tet + part.tet_at_facet[f]);
        mesh_.patch.push_back(part.patch[f]);
        mesh_.sides.push_back({part.region_of(0).value(), region_in_front(part, f)});
        mesh_.triangle_owner.push_back(is_listed ? rank_ : rank_of_.at(part.neighbour[f]));
    }
}

void RankMeshMaker::add_interfaces(const Part& part) {
    const std::int64_t first_tet = std::ssize(mesh_.tets);
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        if (!part.is_interface(f) || is_own(part.neighbour[f])) continue;
        const Triangle& facet = part.facets[f];
        RankNeighbour& neighbour = neighbours_[rank_of_.at(part.neighbour[f])];
        neighbour.triangles.push_back({row_[facet[0]], row_[facet[1]], row_[facet[2]]});
        neighbour.tet_behind.push_back(first_tet + part.tet_at_facet[f]);
    }
}

}  // namespace

RankMesh mesh_of_rank(const std::string& folder, int rank, int ranks) {
    return RankMeshMaker(*open_parts(folder), rank, ranks).make();
}

}  // namespace kerf
