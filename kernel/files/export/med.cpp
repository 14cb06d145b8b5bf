// MED (Salome, Code_Aster), by the layout that libmed gives to HDF5 in version 3.0, which all later ones read: one mesh
// without time steps, its nodes, elements, and families of elements. Arrays have the first number of all items, then
// the second of all (MED_NO_INTERLACE). A family is a group: one for each patch, with negative numbers from -1 on, then
// one for each material (files/export/inside/materials.h). Cells of MED are seen from the other side: the second and
// third corner of a tetrahedron change places, and the nodes of edges go with them. Triangles are seen from outside.
#include <array>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/cell_groups.h"
#include "files/export/inside/hdf5_file.h"
#include "files/export/inside/hdf5_rows.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace med {

constexpr std::size_t longest_name = 80;
constexpr std::array<std::int8_t, 10> order_in_tets = {0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<std::int8_t, 10> order_in_triangles = {0, 1, 2, 3, 4, 5};

const std::string mesh = "ENS_MAA/mesh";
const std::string step = mesh + "/-0000000000000000001-0000000000000000001";  // neither time nor iteration
const std::string families = "FAS/mesh";

// The elements of a type: where they are, and the nodes of each.
struct Elements {
    std::string group;
    std::int64_t count;
    int nodes;
    const std::array<std::int8_t, 10>& order;
};

Elements tets_of(const MeshOutline& outline) {
    return {step + (outline.order == 1 ? "/MAI/TE4" : "/MAI/T10"), outline.tets(), nodes_of_tets(outline.order),
            order_in_tets};
}

Elements triangles_of(const MeshOutline& outline) {
    return {step + (outline.order == 1 ? "/MAI/TR3" : "/MAI/TR6"), outline.patch_facets(),
            nodes_of_triangles(outline.order), order_in_triangles};
}

std::int32_t family_of_patch(std::size_t patch) { return -1 - static_cast<std::int32_t>(patch); }
std::int32_t family_of_material(const CellGroups& groups, std::size_t material) {
    return family_of_patch(groups.patches.size() + material);
}

// Adds a group of items of the mesh with the attributes that each has.
void add_items(Hdf5Content& content, const std::string& group) {
    content.groups.push_back(group);
    content.attributes.push_back({group, "CGT", 1});
    content.attributes.push_back({group, "CGS", 1});
    content.attributes.push_back({group, "PFL", "MED_NO_PROFILE_INTERNAL"});
}

// Adds an array of `columns` numbers for each of `count` items.
void add_array(Hdf5Content& content, const std::string& name, Hdf5Type type, std::int64_t count, int columns) {
    content.arrays.push_back({name, type, count * columns});
    content.attributes.push_back({name, "CGT", 1});
    content.attributes.push_back({name, "NBR", static_cast<std::int32_t>(count)});
}

void add_elements(Hdf5Content& content, const Elements& elements) {
    add_items(content, elements.group);
    add_array(content, elements.group + "/NOD", Hdf5Type::int32, elements.count, elements.nodes);
    add_array(content, elements.group + "/FAM", Hdf5Type::int32, elements.count, 1);
}

void add_family(Hdf5Content& content, std::int32_t number, const CellGroup& group) {
    if (group.count == 0) return;
    const std::string family = fmt::format("{}/ELEME/FAM_{}", families, number);
    content.groups.insert(content.groups.end(), {family, family + "/GRO"});
    content.attributes.push_back({family, "NUM", number});
    content.attributes.push_back({family + "/GRO", "NBR", 1});
    content.names.push_back({family + "/GRO/NOM", {group.name}, longest_name});
}

void add_families(Hdf5Content& content, const CellGroups& groups) {
    const std::string no_family = families + "/FAMILLE_ZERO";
    content.groups.insert(content.groups.end(), {"FAS", families, no_family, families + "/ELEME"});
    content.attributes.push_back({no_family, "NUM", 0});
    for (std::size_t patch = 0; patch < groups.patches.size(); ++patch)
        add_family(content, family_of_patch(patch), groups.patches[patch]);
    for (std::size_t material = 0; material < groups.materials.size(); ++material)
        add_family(content, family_of_material(groups, material), groups.materials[material]);
}

void add_mesh(Hdf5Content& content) {
    constexpr int dimension = 3, no_step = -1, unstructured = 0, cartesian = 0, sorted_by_time = 1;
    content.groups.insert(content.groups.end(), {"INFOS_GENERALES", "ENS_MAA", mesh, step});
    content.attributes = {{"INFOS_GENERALES", "MAJ", 3},
                          {"INFOS_GENERALES", "MIN", 0},
                          {"INFOS_GENERALES", "REL", 0},
                          {mesh, "DIM", dimension},
                          {mesh, "ESP", dimension},
                          {mesh, "REP", cartesian},
                          {mesh, "TYP", unstructured},
                          {mesh, "SRT", sorted_by_time},
                          {mesh, "DES", "Mesh of Kerf"},
                          {mesh, "NOM", fmt::format("{:16}{:16}{:16}", "X", "Y", "Z")},
                          {mesh, "UNI", std::string(48, ' ')},
                          {mesh, "UNT", std::string(16, ' ')},
                          {step, "CGT", 1},
                          {step, "NDT", no_step},
                          {step, "NOR", no_step},
                          {step, "PDT", -1.0}};
}

Hdf5Content content_of(const MeshOutline& outline, const CellGroups& groups) {
    Hdf5Content content;
    content.format = "med";
    content.tracks_order = true;
    add_mesh(content);
    add_items(content, step + "/NOE");
    add_array(content, step + "/NOE/COO", Hdf5Type::real, outline.nodes(), 3);
    content.groups.push_back(step + "/MAI");
    content.attributes.push_back({step + "/MAI", "CGT", 1});
    add_elements(content, tets_of(outline));
    add_elements(content, triangles_of(outline));
    add_families(content, groups);
    return content;
}

// Writes an array of several numbers for each item.
template <class T>
class Columns {
 public:
    Columns(const Hdf5Bytes& file, const std::string& name, std::int64_t count, int columns) {
        for (int column = 0; column < columns; ++column) rows_.emplace_back(file, name, column * count);
    }
    template <class Item>
    void put(const Item& item) {
        for (std::size_t column = 0; column < rows_.size(); ++column) rows_[column].put(item[column]);
    }
    void flush() {
        for (Hdf5Rows<T>& rows : rows_) rows.flush();
    }

 private:
    std::vector<Hdf5Rows<T>> rows_;
};

void write_nodes(const PartSource& parts, const Hdf5Bytes& file) {
    Columns<double> coordinates(file, step + "/NOE/COO", parts.outline().nodes(), 3);
    for_each_node(parts, [&](std::int64_t, std::span<const Vec3> points) {
        for (const Vec3& point : points) coordinates.put(point);
    });
    coordinates.flush();
}

// Writes elements as they come.
class ElementRows {
 public:
    ElementRows(const Hdf5Bytes& file, const Elements& elements)
        : order_(elements.order),
          nodes_(file, elements.group + "/NOD", elements.count, elements.nodes),
          families_(file, elements.group + "/FAM", 0) {}

    void put(const CellNodes& nodes, std::int32_t family) {
        std::array<std::int32_t, 10> labels;
        for (std::size_t i = 0; i < nodes.size(); ++i) labels[i] = nodes[order_[i]] + 1;
        nodes_.put(labels);
        families_.put(family);
    }
    void flush() {
        nodes_.flush();
        families_.flush();
    }

 private:
    const std::array<std::int8_t, 10>& order_;
    Columns<std::int32_t> nodes_;
    Hdf5Rows<std::int32_t> families_;
};

void write_elements(const PartSource& parts, const CellGroups& groups, const Hdf5Bytes& file) {
    ElementRows tets(file, tets_of(parts.outline()));
    for_each_tet_by_material(parts, groups, [&](const CellGroup&, std::int64_t, auto cells) {
        for (const auto& [material, nodes] : cells) tets.put(nodes, family_of_material(groups, material));
    });
    tets.flush();
    ElementRows triangles(file, triangles_of(parts.outline()));
    for_each_triangle_by_patch(parts, groups, [&](const CellGroup&, std::int64_t, auto cells) {
        for (const auto& [patch, nodes] : cells) triangles.put(nodes, family_of_patch(patch));
    });
    triangles.flush();
}

WordRules rules() { return {.most_characters = longest_name}; }
std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names, rules()); }

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "med", most_of_32_bits);
    const CellGroups groups = cell_groups(parts, rules());
    const Hdf5Content content = content_of(parts.outline(), groups);
    const std::string path = files.path_of(stem + ".med");
    make_hdf5_file(path, content);
    Hdf5Bytes file(path, content.arrays);
    write_nodes(parts, file);
    write_elements(parts, groups, file);
    file.close();
    files.add(stem + ".med");
}

}  // namespace med

extern const Format med_format = {.name = "med",
                                  .help = "MED: Salome, Code_Aster",
                                  .ending = ".med",
                                  .kind = {"MED file", [](std::string_view text) { return is_hdf5_of("med", text); }},
                                  .patch_words = med::patch_words,
                                  .write_merged = med::write_merged};

}  // namespace kerf
