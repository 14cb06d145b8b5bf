#include "run/mesh_in_two.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "cut/bisect.h"
#include "mesh/adjacency.h"

namespace kerf {

namespace {

constexpr NodeId own_node = std::numeric_limits<NodeId>::max();  // no node of the tree has it

// Finds the vertices of a surface by their keys.
class VertexOfKey {
 public:
    explicit VertexOfKey(const std::vector<Key>& keys) : keys_(keys), order_(keys.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) { return keys[a] < keys[b]; });
    }
    std::int32_t operator()(Key key) const {
        return *std::lower_bound(order_.begin(), order_.end(), key,
                                 [&](std::int32_t vertex, Key wanted) { return keys_[vertex] < wanted; });
    }

 private:
    const std::vector<Key>& keys_;
    std::vector<std::int32_t> order_;
};

std::array<SurfaceArrays, 2> halves_of(const SurfaceArrays& arrays, const MesherOptions& options) {
    const Surface surface(arrays);
    const MassProperties mass = mass_properties(surface);
    CutOptions cut;
    cut.max_volume = cut.load.max_volume = options.max_volume;
    const Bisection bisection = bisect(surface, mass, own_node, choose_place(surface, mass, 2, cut), cut, false);
    if (!bisection.cut.made())
        throw Error(ErrorCode::subdomain, "The part has no contour of edges that would cut it in two.");
    return {bisection.halves[0].arrays(), bisection.halves[1].arrays()};
}

}  // namespace

TetMesh mesh_in_two(const SurfaceArrays& surface, const MesherOptions& options) {
    TetMesh joined;
    joined.vertices = surface.vertices;
    joined.boundary_vertex_count = static_cast<std::int32_t>(surface.vertices.size());
    const VertexOfKey vertex_of(surface.vertex_key);
    for (const SurfaceArrays& half : halves_of(surface, options)) {
        const TetMesh mesh = mesh_volume(half, options);
        std::vector<std::int32_t> number(mesh.vertices.size());
        const auto place = [&](std::size_t vertex, std::int32_t at) {
            if (static_cast<std::size_t>(at) >= joined.vertices.size()) joined.vertices.resize(at + 1);
            joined.vertices[at] = mesh.vertices[vertex];
            number[vertex] = at;
        };
        for (std::size_t v = 0; v < half.vertices.size(); ++v) {
            const Key key = half.vertex_key[v];
            place(v, key_node(key) == own_node ? joined.boundary_vertex_count + key_index(key) : vertex_of(key));
        }
        for (std::size_t v = half.vertices.size(); v < mesh.vertices.size(); ++v)
            place(v, static_cast<std::int32_t>(joined.vertices.size()));
        for (const Tetrahedron& t : mesh.tets)
            joined.tets.push_back({number[t[0]], number[t[1]], number[t[2]], number[t[3]]});
    }
    connect_tets(joined);
    return joined;
}

}  // namespace kerf
