// A part whose arrays have the right sizes and random content: who stores it has no opinion about geometry.
#pragma once

#include <random>
#include <string>

#include "files/part/part.h"

namespace kerf::test {

inline Part random_part(unsigned seed) {
    std::mt19937 engine(seed);
    const auto number = [&](std::int32_t below) { return static_cast<std::int32_t>(engine() % below); };
    const auto coordinate = [&] { return std::uniform_real_distribution<double>(-1e3, 1e3)(engine); };
    Part part;
    const std::int32_t boundary = 4 + number(50), interior = number(40), tets = 1 + number(300),
                       facets = 1 + number(90);
    for (std::int32_t v = 0; v < boundary + interior; ++v)
        part.mesh.vertices.emplace_back(coordinate(), coordinate(), coordinate());
    part.mesh.boundary_vertex_count = boundary;
    for (std::int32_t t = 0; t < tets; ++t) {
        Tetrahedron& tet = part.mesh.tets.emplace_back();
        for (std::int32_t& corner : tet) corner = number(boundary + interior);
    }
    for (std::int32_t f = 0; f < facets; ++f) {
        part.facets.push_back({number(boundary), number(boundary), number(boundary)});
        part.patch.push_back(number(4) - 1);
        part.facet.push_back(number(1000) - 1);
        part.neighbour.emplace_back(number(20) - 1);
        part.tet_at_facet.push_back(number(tets + 1) - 1);
    }
    for (std::int32_t v = 0; v < boundary; ++v) part.global_id.push_back((std::int64_t{v} << 33) + number(9));
    for (std::int32_t v = 0; v < interior; ++v) part.global_id.push_back(7'000'000'000 + v);
    part.id = NodeId(1 + number(1000));
    const std::vector<std::string> names = {"body", "",
                                            "l\xc3\xaf"
                                            "d <&\">",
                                            std::string(seed * 100, 'x')};
    part.patch_names = seed % 2 ? NameTable({0, 1, 2, 1000 + number(1000)}, names) : NameTable(names);
    for (std::int32_t g = 0; g < number(4); ++g)
        part.shared.push_back({{root_node, NodeId(2 + g)}, {number(boundary)}});
    for (std::int32_t g = 0; g < number(4); ++g)
        part.shared_edges.push_back({{root_node, NodeId(2 + g)}, {{number(boundary), number(boundary)}}});
    return part;
}

}  // namespace kerf::test
