#include "run/work/inside/mesh_in_two.h"

#include <algorithm>

#include "base/core/error.h"
#include "cut/cut/bisect.h"
#include "fill/volume/meshers.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

constexpr NodeId cut_node = 1;

// Returns the surface with its vertices and facets named by their numbers, so that those of the cut are told from them.
SurfaceArrays renamed(SurfaceArrays arrays) {
    for (std::size_t v = 0; v < arrays.vertices.size(); ++v)
        arrays.vertex_key[v] = make_key(0, static_cast<std::int32_t>(v));
    for (std::size_t f = 0; f < arrays.facets.size(); ++f)
        arrays.facet_key[f] = make_key(0, static_cast<std::int32_t>(f));
    return arrays;
}

std::array<SurfaceArrays, 2> halves_of(const SurfaceArrays& arrays, const MesherOptions& options) {
    const Surface surface = separated_surface(renamed(arrays));
    const MassProperties mass = mass_properties(surface);
    CutOptions cut;
    cut.size = cut.load.size = options.size;
    cut.load.volume_weight = find_mesher(options.name).forecast.volume_weight;
    cut = cut.of(surface);
    const Bisection bisection = bisect(surface, mass, cut_node, choose_place(surface, mass, 2, cut), cut, false);
    if (!bisection.cut.made())
        throw Error(ErrorCode::subdomain, "The part has no contour of edges that would cut it in two.");
    return {joined_by_key(bisection.halves[0].arrays()), joined_by_key(bisection.halves[1].arrays())};
}

}  // namespace

Filling mesh_in_two(const SurfaceArrays& surface, const MesherOptions& options) {
    Filling filling;
    TetMesh& joined = filling.mesh;
    joined.vertices = surface.vertices;
    joined.boundary_vertex_count = static_cast<std::int32_t>(surface.vertices.size());
    for (const SurfaceArrays& half : halves_of(surface, options)) {
        const Filling of_half = mesh_volume(half, options);
        filling.recovery.add(of_half.recovery);
        filling.improvement.add(of_half.improvement);
        filling.improve_seconds += of_half.improve_seconds;
        const TetMesh& mesh = of_half.mesh;
        if (filling.strategy.find(of_half.strategy) == std::string::npos)
            filling.strategy += (filling.strategy.empty() ? "" : ", ") + of_half.strategy;
        if (filling.reason.empty()) filling.reason = of_half.reason;
        std::vector<std::int32_t> number(mesh.vertices.size());
        const auto place = [&](std::size_t vertex, std::int32_t at) {
            if (static_cast<std::size_t>(at) >= joined.vertices.size()) joined.vertices.resize(at + 1);
            joined.vertices[at] = mesh.vertices[vertex];
            number[vertex] = at;
        };
        for (std::size_t v = 0; v < half.vertices.size(); ++v) {
            const Key key = half.vertex_key[v];
            place(v, key_index(key) + (key_node(key) == cut_node ? joined.boundary_vertex_count : 0));
        }
        for (std::size_t v = half.vertices.size(); v < mesh.vertices.size(); ++v)
            place(v, static_cast<std::int32_t>(joined.vertices.size()));
        const std::size_t before = joined.tets.size();
        for (const Tetrahedron& t : mesh.tets)
            joined.tets.push_back({number[t[0]], number[t[1]], number[t[2]], number[t[3]]});
        const auto first = joined.tets.begin() + static_cast<std::ptrdiff_t>(before);
        std::rotate(joined.tets.begin() + filling.core_tets, first, first + of_half.core_tets);  // the cores come first
        filling.core_tets += of_half.core_tets;
    }
    return filling;
}

}  // namespace kerf
