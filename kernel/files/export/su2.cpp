// SU2's native text format: a marker for every patch that has triangles, named by a word
// (files/export/inside/word_names.h), because SU2's lists of markers separate them by commas and blanks. A marker
// bounds the zone: walls between regions lie inside of it and are no markers. Which part and which region a tetrahedron
// is of is not said: a zone of SU2 is a mesh for itself, which would have vertices of its own. SU2 counts with 64 bits,
// and has no cells of second order.
#include <algorithm>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/text_rows.h"
#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"
#include "files/io/vtk_cell_types.h"
#include "files/part/bodies.h"

namespace kerf {

namespace su2 {

void write_elements(const PartSource& parts, ExportFile& file) {
    file.write(fmt::format("NDIME= 3\nNELEM= {}\n", parts.outline().tets()));
    std::int64_t number = 0;
    for_each_part(parts, PartContent::cells, [&](PartIndex, const Part& part) {
        for (const Tetrahedron& tet : part.mesh.tets) {
            const auto [a, b, c, d] = global_corners(part, tet);
            write_row(file, {vtk_tetra, a, b, c, d, number++});
        }
    });
}

void write_points(const PartSource& parts, ExportFile& file) {
    file.write(fmt::format("NPOIN= {}\n", parts.outline().vertices));
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& p : points) {
            file.point(p);
            file.write(" ");
            file.number(first++);
            file.write("\n");
        }
    });
}

// Keywords are looked for anywhere in a line, and each ends with '='.
std::string marker_comment(const std::string& name) {
    std::string text = comment_text(name);
    std::replace(text.begin(), text.end(), '=', ' ');
    return text;
}

std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names); }

void write_markers(const PartSource& parts, ExportFile& file) {
    const std::vector<std::string>& names = parts.outline().patch_names;
    const std::vector<std::string> words = patch_words(names);
    const std::vector<std::int64_t>& sizes = parts.bodies().boundary_sizes();
    file.write(
        fmt::format("NMARK= {}\n", std::count_if(sizes.begin(), sizes.end(), [](std::int64_t n) { return n > 0; })));
    std::int32_t current = -1;
    const auto take = [&](std::int32_t patch, std::span<const PatchTriangle<3>> triangles) {
        if (patch != current)
            file.write(fmt::format("% {}\nMARKER_TAG= {}\nMARKER_ELEMS= {}\n", marker_comment(names[patch]),
                                   words[patch], sizes[patch]));
        current = patch;
        for (const auto& [of, corners] : triangles) write_row(file, {vtk_triangle, corners[0], corners[1], corners[2]});
    };
    for_each_patch_triangle<3>(parts, sizes, take, OnPatches::outer);
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    ExportFile file = files.create(stem + ".su2");
    write_elements(parts, file);
    write_points(parts, file);
    write_markers(parts, file);
    file.close();
}

}  // namespace su2

extern const Format su2_format = {
    .name = "su2",
    .help = "SU2's native mesh",
    .ending = ".su2",
    .kind = {"SU2 mesh", [](std::string_view text) { return text.starts_with("NDIME= 3\nNELEM= "); }},
    .highest_order = 1,
    .patch_words = su2::patch_words,
    .write_merged = su2::write_merged};

}  // namespace kerf
