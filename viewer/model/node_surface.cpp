#include "viewer/model/node_surface.h"

#include <numeric>

namespace kerf::view {

NodeSurface node_surface_of(const Surface& surface) {
    NodeSurface result;
    const auto vertices = static_cast<std::size_t>(surface.vertex_count());
    const auto facets = static_cast<std::size_t>(surface.facet_count());
    result.vertices.reserve(vertices);
    result.vertex_number.reserve(vertices);
    for (std::int32_t v = 0; v < surface.vertex_count(); ++v) {
        const Key key = surface.vertex_key(v);
        result.vertices.push_back(surface.point(v));
        result.vertex_number.push_back(is_of_input(key) ? key_index(key) : -1);
    }
    result.facets.reserve(facets);
    result.patch.reserve(facets);
    result.interface_of.reserve(facets);
    result.facet_number.reserve(facets);
    for (std::int32_t f = 0; f < surface.facet_count(); ++f) {
        const Key key = surface.facet_key(f);
        result.facets.push_back(surface.vertices(f));
        result.patch.push_back(surface.patch(f));
        result.interface_of.push_back(key_node(key));
        result.facet_number.push_back(is_of_input(key) ? key_index(key) : -1);
    }
    return result;
}

NodeSurface node_surface_of(const Soup& soup) {
    NodeSurface result;
    result.vertices = soup.vertices;
    result.facets = soup.facets;
    result.patch = soup.patch;
    result.interface_of.assign(soup.facets.size(), 0);
    result.facet_number.resize(soup.facets.size());
    std::iota(result.facet_number.begin(), result.facet_number.end(), 0);
    result.vertex_number.resize(soup.vertices.size());
    std::iota(result.vertex_number.begin(), result.vertex_number.end(), 0);
    return result;
}

std::size_t bytes_of(const NodeSurface& surface) {
    return sizeof surface + bytes_of(surface.vertices) + bytes_of(surface.facets) + bytes_of(surface.patch) +
           bytes_of(surface.interface_of) + bytes_of(surface.neighbour) + bytes_of(surface.facet_number) +
           bytes_of(surface.vertex_number);
}

std::size_t bytes_of(const PartCells& cells) {
    return sizeof cells + bytes_of(cells.vertices) + bytes_of(cells.tets) + bytes_of(cells.neighbours) +
           bytes_of(cells.tet_at_facet) + bytes_of(cells.vertex_number) + bytes_of(cells.at_interface);
}

}  // namespace kerf::view
