// I-DEAS universal file, after the descriptions of datasets by SDRC: nodes (2411), elements (2412) and permanent groups
// (2477), which Salome, Code_Aster and gmsh read. Labels count from 1. Elements are solid linear or parabolic
// tetrahedra (111, 118), whose physical property is the number of their material (files/export/inside/materials.h),
// then thin shell triangles (91, 92), with the number of their patch. A group has the elements of a patch or of a
// material. Units are those of the surface: no dataset of units is written.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/cell_groups.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace unv {

// Fields of labels have ten columns. Nodes, tetrahedra and triangles stay below half of what fits, so that elements
// together fit, too.
constexpr std::int64_t most_labels = 499'999'999;
constexpr std::size_t longest_name = 40;
constexpr std::size_t fields_in_a_line = 8;

// Nodes of parabolic elements go round the edges of a face; the nodes on the other edges and the last corner follow.
constexpr std::array<std::int8_t, 10> order_in_tets = {0, 4, 1, 5, 2, 6, 7, 8, 9, 3};
constexpr std::array<std::int8_t, 10> order_in_triangles = {0, 3, 1, 4, 2, 5};

// A kind of elements of the whole mesh: its descriptor and the order of its nodes.
struct ElementKind {
    int descriptor;
    const std::array<std::int8_t, 10>* order;  // null: VTK's
};

ElementKind tet_kind(int order) { return order == 1 ? ElementKind{111, nullptr} : ElementKind{118, &order_in_tets}; }
ElementKind triangle_kind(int order) {
    return order == 1 ? ElementKind{91, nullptr} : ElementKind{92, &order_in_triangles};
}

void begin_dataset(int number, ExportFile& file) { file.write(fmt::format("{:6}\n{:6}\n", -1, number)); }
void end_dataset(ExportFile& file) { file.write(fmt::format("{:6}\n", -1)); }

// Writes fields of ten columns, eight in a line.
template <class Numbers>
void write_labels(const Numbers& numbers, ExportFile& file) {
    std::size_t in_line = 0;
    for (const std::int64_t number : numbers) {
        if (in_line == fields_in_a_line) file.write("\n");
        in_line = in_line % fields_in_a_line + 1;
        file.write(fmt::format("{:10}", number));
    }
    file.write("\n");
}

// Returns the number as Fortran's 1PD25.16 has it: 17 digits, which give it back exactly.
std::string fortran_double(double x) {
    std::string text = fmt::format("{:25.16E}", x);
    text[text.rfind('E')] = 'D';
    return text;
}

void write_nodes(const PartSource& parts, ExportFile& file) {
    constexpr int color = 11;
    begin_dataset(2411, file);
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& p : points) {
            write_labels(std::array<std::int64_t, 4>{++first, 1, 1, color}, file);
            for (const double x : {p.x(), p.y(), p.z()}) file.write(fortran_double(x));
            file.write("\n");
        }
    });
    end_dataset(file);
}

void write_cells(const ElementKind& kind, std::int64_t label, std::span<const GroupCell> cells, ExportFile& file) {
    constexpr std::int64_t color = 7, no_material = 0;
    for (const auto& [group, nodes] : cells) {
        const std::int64_t property = group + 1, size = nodes.size();
        write_labels(std::array<std::int64_t, 6>{++label, kind.descriptor, property, no_material, color, size}, file);
        std::vector<std::int64_t> labels;
        for (const std::int64_t node : kind.order ? nodes.in_order(*kind.order) : nodes) labels.push_back(node + 1);
        write_labels(labels, file);
    }
}

void write_elements(const PartSource& parts, const CellGroups& groups, ExportFile& file) {
    const int order = parts.outline().order;
    begin_dataset(2412, file);
    for_each_tet_by_material(parts, groups, [&](const CellGroup&, std::int64_t first, auto cells) {
        write_cells(tet_kind(order), first, cells, file);
    });
    for_each_triangle_by_patch(parts, groups, [&](const CellGroup&, std::int64_t first, auto cells) {
        write_cells(triangle_kind(order), first, cells, file);
    });
    end_dataset(file);
}

void write_group(std::int64_t number, const CellGroup& group, ExportFile& file) {
    constexpr std::int64_t finite_elements = 8;  // the kind of what is in the group
    write_labels(std::array<std::int64_t, fields_in_a_line>{number, 0, 0, 0, 0, 0, 0, group.count}, file);
    file.write(group.name + "\n");
    for (std::int64_t i = 0; i < group.count; i += 2) {
        std::vector<std::int64_t> members;
        for (std::int64_t cell = i; cell < std::min(i + 2, group.count); ++cell)
            members.insert(members.end(), {finite_elements, group.first + cell + 1, 0, 0});
        write_labels(members, file);
    }
}

void write_groups(const CellGroups& groups, ExportFile& file) {
    std::int64_t number = 0;
    begin_dataset(2477, file);
    for (const auto* of_kind : {&groups.patches, &groups.materials})
        for (const CellGroup& group : *of_kind)
            if (group.count > 0) write_group(++number, group, file);
    end_dataset(file);
}

WordRules rules() { return {.most_characters = longest_name, .ignores_case = true}; }
std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names, rules()); }

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "unv", most_labels);
    const CellGroups groups = cell_groups(parts, rules());
    ExportFile file = files.create(stem + ".unv");
    write_nodes(parts, file);
    write_elements(parts, groups, file);
    write_groups(groups, file);
    file.close();
}

}  // namespace unv

extern const Format unv_format = {
    .name = "unv",
    .help = "I-DEAS universal file: Salome, Code_Aster, gmsh",
    .ending = ".unv",
    .kind = {"universal file", [](std::string_view text) { return text.starts_with("    -1\n  2411\n"); }},
    .patch_words = unv::patch_words,
    .write_merged = unv::write_merged};

}  // namespace kerf
