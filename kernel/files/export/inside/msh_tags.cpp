#include "files/export/inside/msh_tags.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/inside/materials.h"

namespace kerf::msh {

Tags::Tags(const PartSource& source)
    : parts_(source.outline().parts.size()),
      patches_(source.outline().patch_names.size()),
      materials_(Materials(source).count()) {
    const std::int64_t volumes = (std::int64_t{parts_} + 1) * materials_ + parts_;
    const std::int64_t surfaces = (std::int64_t{parts_} + 1) * patches_;
    if (std::max(volumes, surfaces) >= most_int32)
        throw Error(ErrorCode::usage,
                    fmt::format("{} patches in {} parts of {} materials are more than Gmsh's 32-bit tags can tell "
                                "apart. Use fewer parts, or another format.",
                                patches_, parts_, materials_));
}

std::int64_t first_triangle(const MeshOutline& outline, PartIndex index) {
    return outline.tets() + outline.first_patch_facet(index);
}

std::int64_t element_count(const MeshOutline& outline) {
    return first_triangle(outline, PartIndex(outline.parts.size()));
}

std::string readable(std::string name, std::size_t most) {
    for (char& c : name) {
        if (c == '"') c = '\'';
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    if (name.size() <= most) return name;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    while (most > 0 && continues(name[most])) --most;
    return name.substr(0, most);
}

std::vector<std::string> readable_names(const std::vector<std::string>& given_names) {
    std::vector<std::string> names;
    std::set<std::string> used;
    for (const std::string& given : given_names) {
        std::string name = readable(given, longest_name);
        for (std::size_t number = names.size() + 1; !used.insert(name).second; number += given_names.size()) {
            const std::string suffix = fmt::format(" ({})", number);
            name = readable(given, longest_name - suffix.size()) + suffix;
        }
        names.push_back(name);
    }
    return names;
}

std::vector<MaterialPiece> material_pieces(const PartSource& parts, PartIndex index, const Part& part,
                                           const std::vector<std::int32_t>& inside) {
    const std::vector<std::int32_t> of_tets = Materials(parts).of_tets(index, part);
    std::map<std::int32_t, MaterialPiece> pieces;
    std::vector<std::int32_t> of_nodes(part.node_count(), -1);
    for (std::size_t t = 0; t < of_tets.size(); ++t) {
        pieces[of_tets[t]].tets.push_back(t);
        const auto set_nodes = [&](const auto& nodes) {
            for (const std::int32_t n : nodes) of_nodes[n] = of_tets[t];
        };
        part.order() == 1 ? set_nodes(part.mesh.tets[t]) : set_nodes(part.nodes_of_tet(t));
    }
    for (std::size_t n = 0; n < of_nodes.size(); ++n)
        if (of_nodes[n] >= 0) pieces[of_nodes[n]].box.extend(part.node_point(n));
    for (const std::int32_t n : inside) pieces[of_nodes[n]].inside.push_back(n);
    std::vector<MaterialPiece> ordered;
    for (auto& [material, piece] : pieces) {
        piece.material = material;
        ordered.push_back(std::move(piece));
    }
    return ordered;
}

}  // namespace kerf::msh
