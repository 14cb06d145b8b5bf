// CGNS, after its Standard Interface Data Structures and the mapping of those to HDF5: a node is a group with its name,
// label and type as attributes, and its data in an array " data". One base with one zone, unstructured: sections of
// tetrahedra, one for each material (files/export/inside/materials.h), then sections of triangles, one for each patch,
// seen from outside. A boundary condition of the patch's name has all elements of its section, and belongs to the
// family of that name, whose kind users choose. Nodes of edges follow the corners in VTK's order, which is that of
// TETRA_10 and TRI_6. A range of numbers has two rows of one, as CGNS counts dimensions from the last.
#include <cstring>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/cell_groups.h"
#include "files/export/inside/hdf5_file.h"
#include "files/export/inside/hdf5_rows.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace cgns {

constexpr std::size_t longest_name = 32;
constexpr std::int64_t most_cells = most_of_32_bits / 2;  // of each kind, so that elements together fit, too
const std::string base = "/Base", zone = base + "/Zone";

// Returns the text with zero bytes behind it.
std::string padded(std::string_view text, std::size_t size) {
    std::string bytes(text);
    bytes.resize(size, '\0');
    return bytes;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

// The tree of nodes, as the content of a file.
class Tree {
 public:
    Tree() {
        content_.format = "cgns";
        content_.tracks_order = true;
        set_attributes("/", "HDF5 MotherNode", "Root Node of HDF5 File", "MT");
        const std::string_view format = "IEEE_LITTLE_32", library = "HDF5 Version 1.10";
        content_.arrays.push_back({"/ format", Hdf5Type::character, std::ssize(format) + 1, 0, padded(format, 15)});
        content_.arrays.push_back({"/ hdf5version", Hdf5Type::character, 33, 0, padded(library, 33)});
    }

    /// Add a node at a path: without data, with text, with integers (of `columns` in a row), with other data that are
    /// written later.
    void add(const std::string& path, const char* label) { add_node(path, label, "MT"); }
    void add_text(const std::string& path, const char* label, const std::string& text) {
        add_node(path, label, "C1");
        content_.arrays.push_back({path + "/ data", Hdf5Type::character, std::ssize(text), 0, text});
    }
    void add_numbers(const std::string& path, const char* label, const std::vector<std::int32_t>& numbers,
                     std::int64_t columns = 0) {
        add_node(path, label, "I4");
        const std::int64_t count = std::ssize(numbers);
        content_.arrays.push_back(
            {path + "/ data", Hdf5Type::int32, columns ? count / columns : count, columns, bytes_of(numbers)});
    }
    void add_version(float version) {
        add_node("/CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4");
        content_.arrays.push_back(
            {"/CGNSLibraryVersion/ data", Hdf5Type::real32, 1, 0, bytes_of(std::vector<float>{version})});
    }
    void add_array(const std::string& path, Hdf5Type type, std::int64_t size) {
        add_node(path, "DataArray_t", type == Hdf5Type::real ? "R8" : "I4");
        content_.arrays.push_back({path + "/ data", type, size});
    }

    const Hdf5Content& content() const { return content_; }

 private:
    void add_node(const std::string& path, const char* label, const char* type) {
        content_.groups.push_back(path);
        set_attributes(path, path.substr(path.rfind('/') + 1), label, type);
        content_.attributes.push_back({path, "flags", std::vector<std::int32_t>{1}});
    }
    void set_attributes(const std::string& path, std::string_view name, std::string_view label, std::string_view type) {
        content_.attributes.push_back({path, "name", padded(name, longest_name + 1)});
        content_.attributes.push_back({path, "label", padded(label, longest_name + 1)});
        content_.attributes.push_back({path, "type", padded(type, 3)});
    }

    Hdf5Content content_;
};

std::vector<std::int32_t> range_of(const CellGroup& group) {
    return {static_cast<std::int32_t>(group.first + 1), static_cast<std::int32_t>(group.first + group.count)};
}

std::string section_of(const CellGroup& group) { return zone + "/" + group.name; }
std::string nodes_of(const CellGroup& group) { return section_of(group) + "/ElementConnectivity"; }

void add_section(Tree& tree, const CellGroup& group, std::int32_t type, std::int64_t nodes) {
    tree.add_numbers(section_of(group), "Elements_t", {type, 0});
    tree.add_numbers(section_of(group) + "/ElementRange", "IndexRange_t", range_of(group));
    tree.add_array(nodes_of(group), Hdf5Type::int32, nodes * group.count);
}

void add_zone(Tree& tree, const MeshOutline& outline) {
    const auto nodes = static_cast<std::int32_t>(outline.nodes()), tets = static_cast<std::int32_t>(outline.tets());
    tree.add_numbers(zone, "Zone_t", {nodes, tets, 0}, 1);
    tree.add_text(zone + "/ZoneType", "ZoneType_t", "Unstructured");
    tree.add(zone + "/GridCoordinates", "GridCoordinates_t");
    for (const char* axis : {"X", "Y", "Z"})
        tree.add_array(fmt::format("{}/GridCoordinates/Coordinate{}", zone, axis), Hdf5Type::real, nodes);
}

// Calls take(group) with the groups that have elements.
template <class Take>
void for_each_used(const std::vector<CellGroup>& groups, const Take& take) {
    for (const CellGroup& group : groups)
        if (group.count > 0) take(group);
}

void add_sections(Tree& tree, const MeshOutline& outline, const CellGroups& groups) {
    const std::int32_t tetra = outline.order == 1 ? 10 : 11, triangle = outline.order == 1 ? 5 : 6;
    for_each_used(groups.materials,
                  [&](const CellGroup& material) { add_section(tree, material, tetra, nodes_of_tets(outline.order)); });
    for_each_used(groups.patches, [&](const CellGroup& patch) {
        add_section(tree, patch, triangle, nodes_of_triangles(outline.order));
    });
    tree.add(zone + "/ZoneBC", "ZoneBC_t");
    for_each_used(groups.patches, [&](const CellGroup& patch) {
        const std::string condition = zone + "/ZoneBC/" + patch.name;
        tree.add_text(condition, "BC_t", "FamilySpecified");
        tree.add_numbers(condition + "/PointRange", "IndexRange_t", range_of(patch), 1);
        tree.add_text(condition + "/GridLocation", "GridLocation_t", "FaceCenter");
        tree.add_text(condition + "/FamilyName", "FamilyName_t", patch.name);
    });
}

void add_families(Tree& tree, const CellGroups& groups) {
    for_each_used(groups.patches, [&](const CellGroup& patch) {
        tree.add(base + "/" + patch.name, "Family_t");
        tree.add_text(base + "/" + patch.name + "/FamilyBC", "FamilyBC_t", "UserDefined");
    });
}

Tree tree_of(const MeshOutline& outline, const CellGroups& groups) {
    Tree tree;
    tree.add_version(3.1F);
    tree.add_numbers(base, "CGNSBase_t", {3, 3});
    add_zone(tree, outline);
    add_sections(tree, outline, groups);
    add_families(tree, groups);
    return tree;
}

void write_nodes(const PartSource& parts, const Hdf5Bytes& file) {
    Hdf5Rows<double> x(file, zone + "/GridCoordinates/CoordinateX/ data", 0),
        y(file, zone + "/GridCoordinates/CoordinateY/ data", 0),
        z(file, zone + "/GridCoordinates/CoordinateZ/ data", 0);
    for_each_node(parts, [&](std::int64_t, std::span<const Vec3> points) {
        for (const Vec3& point : points) {
            x.put(point.x());
            y.put(point.y());
            z.put(point.z());
        }
    });
    for (Hdf5Rows<double>* axis : {&x, &y, &z}) axis->flush();
}

void write_elements(const PartSource& parts, const CellGroups& groups, const Hdf5Bytes& file) {
    const auto write = [&](const CellGroup& group, std::int64_t first, std::span<const GroupCell> cells) {
        const std::int64_t nodes = cells.front().nodes.size();
        Hdf5Rows<std::int32_t> rows(file, nodes_of(group) + "/ data", (first - group.first) * nodes);
        for (const GroupCell& cell : cells)
            for (const std::int64_t node : cell.nodes) rows.put(node + 1);
        rows.flush();
    };
    for_each_tet_by_material(parts, groups, write);
    for_each_triangle_by_patch(parts, groups, write);
}

// Words are names of nodes below the base and the zone, beside those that are there anyway.
WordRules rules() {
    return {.most_characters = longest_name, .taken = {"Zone", "ZoneType", "ZoneBC", "GridCoordinates"}};
}
std::vector<std::string> patch_words(const std::vector<std::string>& names) { return word_names(names, rules()); }

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "cgns", most_cells);
    const CellGroups groups = cell_groups(parts, rules());
    const Tree tree = tree_of(parts.outline(), groups);
    const std::string path = files.path_of(stem + ".cgns");
    make_hdf5_file(path, tree.content());
    Hdf5Bytes file(path, tree.content().arrays);
    write_nodes(parts, file);
    write_elements(parts, groups, file);
    file.close();
    files.add(stem + ".cgns");
}

}  // namespace cgns

extern const Format cgns_format = {
    .name = "cgns",
    .help = "CGNS on HDF5: ParaView, VisIt, codes for flow",
    .ending = ".cgns",
    .kind = {"CGNS file", [](std::string_view text) { return is_hdf5_of("cgns", text); }},
    .patch_words = cgns::patch_words,
    .write_merged = cgns::write_merged};

}  // namespace kerf
