// Places in the arrays follow from the outline: it has the number of each part's tetrahedra and triangles, and vertices
// have global numbers. So the arrays have their size before the first part is loaded, and parts are put into them in
// any order, by threads, without copies. Vertices on the boundary belong to several parts, which write the same
// coordinates; they are written under a lock, those inside without one. The region in front of a wall is known when all
// parts are there: until then its place holds the number of the part there. The outline is not trusted: rows outside of
// a part's range throw.
#include "kerf/inside/arrays_from_parts.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "files/export/whole_mesh.h"

namespace kerf {

namespace {

class ArrayFiller {
 public:
    explicit ArrayFiller(const MeshOutline& outline) : outline_(outline) {
        const std::size_t tets = outline.tets(), triangles = outline.patch_facets();
        mesh_.patch_names = outline.patch_names;
        mesh_.region_names = outline.region_names;
        mesh_.vertices.resize(outline.nodes());
        mesh_.edge_nodes = outline.edge_nodes;
        mesh_.tets.resize(tets);
        mesh_.part.resize(tets);
        mesh_.region.resize(tets);
        mesh_.triangles.resize(triangles);
        mesh_.patch.resize(triangles);
        mesh_.sides.resize(triangles);
        if (outline.order == 1) return;
        mesh_.quadratic_tets.resize(tets);
        mesh_.quadratic_triangles.resize(triangles);
    }

    // Puts corners, patches and sides of the listed triangles of a part. The place of the region in front holds the
    // number of the part there, or -1, until all parts are known.
    void put_boundary(PartIndex index, const Part& part) {
        const std::int32_t region = part.region_of(0).value();
        std::int64_t next = outline_.first_patch_facet(index);
        const std::int64_t end = next + outline_.parts[index].patch_facets;
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (!part.is_listed(f)) continue;
            require(next < end, part);
            const std::int64_t row = next++;
            mesh_.triangles[row] = global_corners(part, part.facets[f]);
            if (part.order() == 2) mesh_.quadratic_triangles[row] = global_nodes(part, part.nodes_of_facet(f));
            mesh_.patch[row] = part.patch[f];
            mesh_.sides[row] = {region, part.is_wall(f) ? part.neighbour[f].value() : -1};
        }
        require(next == end, part);
        const std::lock_guard lock(mutex_);
        region_of_part_[part.id] = region;
    }

    // Puts points. Several parts have the vertices of their boundaries, with the same coordinates.
    void put_points(const Part& part, std::size_t first, std::span<const Vec3> points) {
        std::unique_lock lock(mutex_, std::defer_lock);
        if (std::cmp_less(first, part.mesh.boundary_vertex_count)) lock.lock();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::int64_t id = part.global_id[first + i];
            require(id >= 0 && id < outline_.vertices, part);
            mesh_.vertices[id] = {points[i].x(), points[i].y(), points[i].z()};
        }
    }

    void put_cells(PartIndex index, const Part& part, std::size_t first, std::span<const Tetrahedron> tets) {
        require(std::cmp_less_equal(first + tets.size(), outline_.parts[index].tets), part);
        const std::size_t begin = outline_.first_tet(index) + first;
        const auto count = std::ssize(tets);
        std::transform(tets.begin(), tets.end(), mesh_.tets.begin() + begin,
                       [&](const Tetrahedron& tet) { return global_corners(part, tet); });
        std::fill_n(mesh_.part.begin() + begin, count, part.id.value());
        std::fill_n(mesh_.region.begin() + begin, count, part.region_of(0).value());
    }

    // Puts the nodes on edges, of a part that was loaded as a whole.
    void put_edge_nodes(PartIndex index, const Part& part) {
        const EdgeNodes& nodes = part.edge_nodes;
        for (std::size_t e = 0; e < nodes.points.size(); ++e) {
            const std::int64_t id = nodes.global_id[e];
            require(id >= outline_.vertices && id < outline_.nodes(), part);
            mesh_.vertices[id] = {nodes.points[e].x(), nodes.points[e].y(), nodes.points[e].z()};
        }
        const std::int64_t first = outline_.first_tet(index);
        for (std::int64_t t = 0; t < part.tet_count(); ++t)
            mesh_.quadratic_tets[first + t] = global_nodes(part, part.nodes_of_tet(t));
    }

    // Returns the mesh, when all parts are there.
    MeshArrays take() {
        for (auto& [behind, in_front] : mesh_.sides)
            if (in_front >= 0) in_front = region_of_part_.at(NodeId(in_front));
        return std::move(mesh_);
    }

 private:
    template <std::size_t n>
    static std::array<std::int64_t, n> global_nodes(const Part& part, const std::array<std::int32_t, n>& nodes) {
        std::array<std::int64_t, n> ids;
        std::transform(nodes.begin(), nodes.end(), ids.begin(), [&](std::int32_t node) { return part.node_id(node); });
        return ids;
    }
    static void require(bool holds, const Part& part) {
        if (!holds)
            throw Error(ErrorCode::io,
                        fmt::format("The files of part {} do not belong together. Mesh again.", part.id.value()));
    }

    const MeshOutline& outline_;
    MeshArrays mesh_;
    std::mutex mutex_;  // for region_of_part_ and the vertices of boundaries
    std::map<NodeId, std::int32_t> region_of_part_;
};

// Calls work(i) for i below `count`, by threads, until one throws.
template <class Work>
void by_threads(int threads, std::size_t count, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr error;
    const auto work_off = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) work(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!error) error = std::current_exception();
        }
    };
    {
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < std::min<std::size_t>(count, threads); ++i) others.emplace_back(work_off);
        work_off();
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace

MeshArrays arrays_from_parts(const StoredParts& parts, int threads) {
    ArrayFiller filler(parts.outline());
    by_threads(threads, parts.outline().parts.size(), [&](std::size_t i) {
        const PartIndex index(i);
        parts.load_in_pieces(index, {[&](const Part& part) { filler.put_boundary(index, part); },
                                     [&](const Part& part, std::size_t first, std::span<const Vec3> points) {
                                         filler.put_points(part, first, points);
                                     },
                                     [&](const Part& part, std::size_t first, std::span<const Tetrahedron> tets) {
                                         filler.put_cells(index, part, first, tets);
                                     }});
    });
    return filler.take();
}

MeshArrays arrays_from_parts(const PartSource& parts) {
    ArrayFiller filler(parts.outline());
    if (parts.outline().order == 2) {
        for_each_part(parts, PartContent::all, [&](PartIndex index, const Part& part) {
            filler.put_points(part, 0, part.mesh.vertices);
            filler.put_boundary(index, part);
            filler.put_cells(index, part, 0, part.mesh.tets);
            filler.put_edge_nodes(index, part);
        });
        return filler.take();
    }
    for_each_part(parts, PartContent::vertices,
                  [&](PartIndex, const Part& part) { filler.put_points(part, 0, part.mesh.vertices); });
    for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
        filler.put_boundary(index, part);
        filler.put_cells(index, part, 0, part.mesh.tets);
    });
    return filler.take();
}

}  // namespace kerf
