#include "viewer/model/inside/node_surface.h"

#include <numeric>

namespace kerf::view {

NodeSurface node_surface_of(const SurfaceArrays& surface) {
    NodeSurface result;
    result.vertices = surface.vertices;
    result.facets = surface.facets;
    result.patch = surface.patch;
    result.vertex_number.reserve(surface.vertices.size());
    for (const Key key : surface.vertex_key) result.vertex_number.push_back(is_of_input(key) ? key_index(key) : -1);
    result.interface_of.reserve(surface.facets.size());
    result.facet_number.reserve(surface.facets.size());
    for (const Key key : surface.facet_key) {
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
    result.interface_of.assign(soup.facets.size(), no_node);
    result.facet_number.resize(soup.facets.size());
    std::iota(result.facet_number.begin(), result.facet_number.end(), 0);
    result.vertex_number.resize(soup.vertices.size());
    std::iota(result.vertex_number.begin(), result.vertex_number.end(), 0);
    return result;
}

static std::size_t bytes_of(const EdgePoints& edges) {
    return bytes_of(edges.places) + bytes_of(edges.ends) + bytes_of(edges.node);
}

std::size_t bytes_of(const NodeSurface& surface) {
    return sizeof surface + bytes_of(surface.vertices) + bytes_of(surface.facets) + bytes_of(surface.patch) +
           bytes_of(surface.interface_of) + bytes_of(surface.neighbour) + bytes_of(surface.facet_number) +
           bytes_of(surface.vertex_number) + bytes_of(surface.edges) + bytes_of(surface.edges_of_facet);
}

std::size_t bytes_of(const PartCells& cells) {
    return sizeof cells + bytes_of(cells.vertices) + bytes_of(cells.tets) + bytes_of(cells.neighbours) +
           bytes_of(cells.tet_at_facet) + bytes_of(cells.vertex_number) + bytes_of(cells.at_interface) +
           bytes_of(cells.edges) + bytes_of(cells.edges_of_tet);
}

}  // namespace kerf::view
