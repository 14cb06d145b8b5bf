// FEBio's input, after version 4.0 of its specification: the mesh, with a part of elements for each material
// (files/export/inside/materials.h) and a surface for each patch, and of the rest what a file must have: a placeholder
// material for each, which says so, and its domain. There are no steps, loads or constraints. Ids count from 1; the
// nodes of edges follow the corners in VTK's order. Surfaces are seen from outside.
#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/cell_groups.h"
#include "files/export/inside/text_rows.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace feb {

constexpr const char* begin =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<febio_spec version=\"4.0\">\n"
    "<Module type=\"solid\"/>\n";

void write_materials(const CellGroups& groups, ExportFile& file) {
    file.write("<Material>\n<!-- Placeholders of Kerf: choose types and parameters. -->\n");
    std::int64_t id = 0;
    for (const CellGroup& material : groups.materials)
        file.write(
            fmt::format("<material id=\"{}\" name=\"{}\" type=\"neo-Hookean\"><density>1</density><E>1</E>"
                        "<v>0.3</v></material>\n",
                        ++id, material.name));
    file.write("</Material>\n");
}

void write_nodes(const PartSource& parts, ExportFile& file) {
    file.write("<Nodes name=\"nodes\">\n");
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& p : points)
            file.write(fmt::format("<node id=\"{}\">{},{},{}</node>\n", ++first, p.x(), p.y(), p.z()));
    });
    file.write("</Nodes>\n");
}

void write_cell(const char* element, std::int64_t id, const CellNodes& nodes, ExportFile& file) {
    file.write(fmt::format("<{} id=\"{}\">", element, id));
    TextRow(file, ",").add(nodes, 1);
    file.write(fmt::format("</{}>\n", element));
}

// The elements of the XML that hold groups of cells of a kind.
struct GroupElement {
    const char* name;
    std::string type;  // an attribute
    const char* cell;
    std::int64_t before = 0;  // cells of the other kind, which have ids of their own
};

// Writes some cells of a group, the first of which has this number, within the element of the group.
void write_cells(const GroupElement& element, const CellGroup& group, std::span<const GroupCell> cells,
                 std::int64_t number, ExportFile& file) {
    if (number == group.first) file.write(fmt::format("<{}{} name=\"{}\">\n", element.name, element.type, group.name));
    for (const GroupCell& cell : cells) write_cell(element.cell, ++number - element.before, cell.nodes, file);
    if (number == group.first + group.count) file.write(fmt::format("</{}>\n", element.name));
}

void write_mesh(const PartSource& parts, const CellGroups& groups, ExportFile& file) {
    const int order = parts.outline().order;
    const GroupElement elements{"Elements", order == 1 ? " type=\"tet4\"" : " type=\"tet10\"", "elem"};
    const GroupElement surfaces{"Surface", "", order == 1 ? "tri3" : "tri6", parts.outline().tets()};
    file.write("<Mesh>\n");
    write_nodes(parts, file);
    for_each_tet_by_material(parts, groups, [&](const CellGroup& material, std::int64_t first, auto cells) {
        write_cells(elements, material, cells, first, file);
    });
    for_each_triangle_by_patch(parts, groups, [&](const CellGroup& patch, std::int64_t first, auto cells) {
        write_cells(surfaces, patch, cells, first, file);
    });
    file.write("</Mesh>\n");
}

void write_domains(const CellGroups& groups, ExportFile& file) {
    file.write("<MeshDomains>\n");
    for (const CellGroup& material : groups.materials)
        if (material.count > 0) file.write(fmt::format("<SolidDomain name=\"{0}\" mat=\"{0}\"/>\n", material.name));
    file.write("</MeshDomains>\n");
}

std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names); }

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "feb", most_of_32_bits);
    const CellGroups groups = cell_groups(parts);
    ExportFile file = files.create(stem + ".feb");
    file.write(begin);
    write_materials(groups, file);
    write_mesh(parts, groups, file);
    write_domains(groups, file);
    file.write("</febio_spec>\n");
    file.close();
}

}  // namespace feb

extern const Format feb_format = {
    .name = "feb",
    .help = "FEBio's input: FEBio, FEBio Studio",
    .ending = ".feb",
    .kind = {"FEBio input", [](std::string_view text) { return text.starts_with(feb::begin); }},
    .patch_words = feb::patch_words,
    .write_merged = feb::write_merged};

}  // namespace kerf
