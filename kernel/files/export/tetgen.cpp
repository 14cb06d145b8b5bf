// The files of TetGen (.node, .ele, .face), numbered from 0. The attribute of a tetrahedron is its
// material (files/export/inside/materials.h), from 1; the boundary marker of a face its patch, from 1. Faces between
// parts are not among them, but walls between regions are, once each, as TetGen has them. Of order 2 the tetrahedra
// have ten nodes, as those of its switch -o2, and the faces three.
#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/materials.h"
#include "files/export/inside/text_rows.h"
#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace tetgen {

// Corners, then the nodes of the edges 23 03 01 12 13 02.
constexpr std::array<std::int8_t, 10> order_of_nodes = {0, 1, 2, 3, 9, 7, 4, 5, 8, 6};

void write_nodes(const PartSource& parts, ExportFile file) {
    file.write(fmt::format("{} 3 0 0\n", parts.outline().nodes()));
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& p : points) {
            file.number(first++);
            file.write(" ");
            file.point(p);
            file.write("\n");
        }
    });
    file.close();
}

void write_elements(const PartSource& parts, ExportFile file) {
    const MeshOutline& outline = parts.outline();
    const Materials materials(parts);
    for (std::size_t region = 0; region < outline.region_names.size(); ++region)
        file.write(fmt::format("# attribute {}: {}\n", region + 1, comment_text(outline.region_names[region])));
    file.write(fmt::format("{} {} 1\n", outline.tets(), nodes_of_tets(outline.order)));
    std::int64_t number = 0;
    for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
        const std::vector<std::int32_t> of_tets = materials.of_tets(index, part);
        for (std::size_t t = 0; t < of_tets.size(); ++t)
            TextRow(file)
                .add(number++)
                .add(nodes_of_tet(part, t).in_order(order_of_nodes), 0)
                .add(of_tets[t] + 1)
                .end();
    });
    file.close();
}

void write_faces(const PartSource& parts, ExportFile file) {
    const MeshOutline& outline = parts.outline();
    for (std::size_t patch = 0; patch < outline.patch_names.size(); ++patch)
        file.write(fmt::format("# marker {}: {}\n", patch + 1, comment_text(outline.patch_names[patch])));
    file.write(fmt::format("{} 1\n", outline.patch_facets()));
    std::int64_t number = 0;
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (!part.is_listed(f)) continue;
            const auto [a, b, c] = global_corners(part, part.facets[f]);
            write_row(file, {number++, a, b, c, part.patch[f] + 1});
        }
    });
    file.close();
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "tetgen", most_of_32_bits);
    write_nodes(parts, files.create(stem + ".node"));
    write_elements(parts, files.create(stem + ".ele"));
    write_faces(parts, files.create(stem + ".face"));
}

}  // namespace tetgen

extern const Format tetgen_format = {.name = "tetgen",
                                     .help = "TetGen's .node, .ele and .face",
                                     .ending = ".node",
                                     .kind = {"TetGen file",
                                              [](std::string_view text) {
                                                  return text.starts_with("# marker ") ||
                                                         text.starts_with("# attribute ") ||
                                                         (text[0] >= '0' && text[0] <= '9');
                                              }},
                                     .write_merged = tetgen::write_merged};

}  // namespace kerf
