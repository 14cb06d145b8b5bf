// The text format of Medit (.mesh, version 2: numbers of 32 bits, coordinates as doubles), which MMG, ParMmg, FreeFEM
// and gmsh read. References count from 1: that of a tetrahedron is its material (files/export/inside/materials.h), that
// of a triangle its patch; names are comments. Walls between regions are triangles, once each. Which part a tetrahedron
// is of is not said. Of order 2 there are TetrahedraP2 and TrianglesP2 in their place, with the nodes of edges 12 23 13
// 14 24 34 behind the corners, as gmsh has them, and Vizir where a file does not say another order.
#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/materials.h"
#include "files/export/inside/text_rows.h"
#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace medit {

void write_head(const MeshOutline& outline, ExportFile& file) {
    file.write("MeshVersionFormatted 2\nDimension 3\n");
    for (std::size_t patch = 0; patch < outline.patch_names.size(); ++patch)
        file.write(
            fmt::format("# reference {} of triangles: {}\n", patch + 1, comment_text(outline.patch_names[patch])));
    for (std::size_t region = 0; region < outline.region_names.size(); ++region)
        file.write(
            fmt::format("# reference {} of tetrahedra: {}\n", region + 1, comment_text(outline.region_names[region])));
}

void write_vertices(const PartSource& parts, ExportFile& file) {
    file.write(fmt::format("Vertices\n{}\n", parts.outline().nodes()));
    for_each_node(parts, [&](std::int64_t, std::span<const Vec3> points) {
        for (const Vec3& p : points) {
            file.point(p);
            file.write(" 0\n");
        }
    });
}

void write_head_of(const char* cells, const MeshOutline& outline, std::int64_t count, ExportFile& file) {
    file.write(fmt::format("{}{}\n{}\n", cells, outline.order == 1 ? "" : "P2", count));
}

void write_tetrahedra(const PartSource& parts, ExportFile& file) {
    write_head_of("Tetrahedra", parts.outline(), parts.outline().tets(), file);
    const Materials materials(parts);
    for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
        const std::vector<std::int32_t> of_tets = materials.of_tets(index, part);
        for (std::size_t t = 0; t < of_tets.size(); ++t)
            TextRow(file).add(nodes_of_tet(part, t), 1).add(of_tets[t] + 1).end();
    });
}

void write_triangles(const PartSource& parts, ExportFile& file) {
    write_head_of("Triangles", parts.outline(), parts.outline().patch_facets(), file);
    for_each_part(parts, patch_content(parts.outline()), [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_listed(f)) TextRow(file).add(nodes_of_facet(part, f), 1).add(part.patch[f] + 1).end();
    });
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "medit", most_of_32_bits);
    ExportFile file = files.create(stem + ".mesh");
    write_head(parts.outline(), file);
    write_vertices(parts, file);
    write_tetrahedra(parts, file);
    write_triangles(parts, file);
    file.write("End\n");
    file.close();
}

}  // namespace medit

extern const Format medit_format = {
    .name = "medit",
    .help = "Medit's .mesh: MMG, FreeFEM, gmsh",
    .ending = ".mesh",
    .kind = {"MEDIT file", [](std::string_view text) { return text.starts_with("MeshVersionFormatted "); }},
    .write_merged = medit::write_merged};

}  // namespace kerf
