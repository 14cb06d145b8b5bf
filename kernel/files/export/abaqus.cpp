// Abaqus input (.inp) as CalculiX reads it, too: nodes, linear tetrahedra (C3D4) or of order 2 quadratic ones (C3D10),
// and sets; no materials, no steps. Nodes and elements are numbered from 1. A node set has the nodes on edges, too.
//
// NALL and EALL hold all nodes and elements; BODY_1, BODY_2, ... the elements of the materials
// (files/export/inside/materials.h), or sets named by the regions where there are several; SUBDOMAIN_1, SUBDOMAIN_2,
// ... those of the parts in the order of the tree. The surface of a wall between regions is of elements in the first of
// the two. For a patch INLET there are the node set INLET, the element-based surface INLET, and the element sets
// INLET_S1 to INLET_S4 of which it consists: those with the patch at this face. Names are words
// (files/export/inside/word_names.h) that differ by more than case. A line is shorter than the 132 characters that old
// readers see, and a coordinate has no more than the 20 that a reader may look at, so that few of them lose their last
// digits.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/by_patch.h"
#include "files/export/inside/materials.h"
#include "files/export/inside/text_rows.h"
#include "files/export/inside/word_names.h"
#include "files/export/whole_mesh.h"
#include "files/part/region_walls.h"

namespace kerf {

namespace abaqus {

constexpr std::int64_t most_labels = 999'999'999;
constexpr int most_digits = 20;  // of a number, with its sign, point and exponent
constexpr std::size_t longest_name = 80, longest_ending = 3;

// A triangle on a patch as a face of an element.
struct ElementFace {
    std::int32_t patch;
    std::int32_t face;  // 1 to 4
    std::int64_t element;
};

// Names of patches in the file; that of a patch without triangles is not used.
struct Names {
    std::vector<std::string> words;
    std::vector<std::int64_t> sizes;
};

// The faces are numbered 1-2-3, 1-4-2, 2-4-3, 3-4-1 in the manual of CalculiX; here by the corner that they lack.
constexpr std::array<std::int32_t, 4> face_opposite_to = {3, 4, 2, 1};

// Returns the face of the tetrahedron that the triangle is.
std::int32_t face_of(const Tetrahedron& tet, const Triangle& triangle) {
    const auto is_of_triangle = [&](std::int32_t v) {
        return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
    };
    const auto opposite = std::find_if_not(tet.begin(), tet.end(), is_of_triangle) - tet.begin();
    return face_opposite_to[opposite];
}

// Writes the coordinate as exactly as a field can hold it.
void write_coordinate(ExportFile& file, double x) {
    std::array<char, 32> text;
    char* const begin = text.data();
    char* end = std::to_chars(begin, begin + text.size(), x).ptr;
    for (int precision = 15; end - begin > most_digits; --precision)
        end = std::to_chars(begin, begin + text.size(), x, std::chars_format::scientific, precision).ptr;
    file.write(std::string_view(begin, end));
}

void write_nodes(const PartSource& parts, ExportFile& file) {
    file.write("*NODE, NSET=NALL\n");
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& p : points) {
            file.number(++first);
            for (const double x : {p.x(), p.y(), p.z()}) {
                file.write(",");
                write_coordinate(file, x);
            }
            file.write("\n");
        }
    });
}

void write_elements(const PartSource& parts, ExportFile& file) {
    const char* const type = parts.outline().order == 1 ? "C3D4" : "C3D10";
    std::int64_t element = 0;
    for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
        file.write(fmt::format("** part {}\n*ELEMENT, TYPE={}, ELSET=SUBDOMAIN_{}\n", part.id.value(), type,
                               index.value() + 1));
        for (std::int64_t t = 0; t < part.tet_count(); ++t)
            TextRow(file, ",").add(++element).add(nodes_of_tet(part, t), 1).end();
    });
    file.write(fmt::format("*ELSET, ELSET=EALL, GENERATE\n1,{},1\n", element));
}

// An element of a material, in the form that for_each_by_patch() takes.
struct MaterialElement {
    std::int32_t patch;
    std::int64_t element;
};

void write_list(ExportFile& file, std::span<const std::int64_t> labels) {
    constexpr std::size_t in_a_line = 12;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (i > 0) file.write(i % in_a_line ? "," : "\n");
        file.number(labels[i]);
    }
    file.write("\n");
}

void write_material_sets(const PartSource& parts, const std::vector<std::string>& names, ExportFile& file) {
    const Materials materials(parts);
    if (materials.count() == 1)
        return file.write(fmt::format("*ELSET, ELSET={}, GENERATE\n1,{},1\n", names[0], parts.outline().tets()));
    const auto visit = [&](const auto& add) {
        for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
            std::int64_t element = parts.outline().first_tet(index);
            for (const std::int32_t material : materials.of_tets(index, part)) add({material, ++element});
        });
    };
    std::int32_t current = -1;
    std::vector<std::int64_t> elements;
    const auto take = [&](std::int32_t material, std::span<const MaterialElement> of_material) {
        if (material != current && materials.are_regions())
            file.write(fmt::format("** region {}: {}\n", material + 1, comment_text(materials.names()[material])));
        if (material != current) file.write(fmt::format("*ELSET, ELSET={}\n", names[material]));
        current = material;
        elements.clear();
        for (const MaterialElement& each : of_material) elements.push_back(each.element);
        write_list(file, elements);
    };
    for_each_by_patch<MaterialElement>(materials.sizes(), visit, take);
}

// Writes the nodes of each patch, each once, ascending in each piece of a large patch. n: nodes of a triangle.
template <std::size_t n>
void write_node_sets(const PartSource& parts, const Names& names, ExportFile& file) {
    std::vector<bool> is_written;  // in an earlier piece of the patch
    std::vector<std::int64_t> nodes;
    std::int32_t current = -1;
    const auto take = [&](std::int32_t patch, std::span<const PatchTriangle<n>> triangles) {
        nodes.clear();
        for (const PatchTriangle<n>& triangle : triangles)
            for (const std::int64_t node : triangle.nodes) nodes.push_back(node + 1);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        if (patch != current) {
            file.write(fmt::format("** patch {}: {}\n*NSET, NSET={}\n", patch + 1,
                                   comment_text(parts.outline().patch_names[patch]), names.words[patch]));
            is_written.clear();
        } else {
            std::erase_if(nodes, [&](std::int64_t node) { return is_written[node]; });
        }
        if (names.sizes[patch] > std::ssize(triangles)) {
            is_written.resize(parts.outline().nodes() + 1);
            for (const std::int64_t node : nodes) is_written[node] = true;
        }
        current = patch;
        if (!nodes.empty()) write_list(file, nodes);
    };
    for_each_patch_triangle<n>(parts, names.sizes, take);
}

// Writes the element sets of the faces of patches, piece after piece. Sets that are named again are continued.
void write_face_sets(const PartSource& parts, const Names& names, ExportFile& file, std::vector<unsigned>& faces_of) {
    const RegionWalls& sides = parts.walls();
    const auto visit = [&](const auto& add) {
        for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
            const std::int64_t first = parts.outline().first_tet(index) + 1;
            for (std::size_t f = 0; f < part.facets.size(); ++f) {
                if (part.is_wall(f) ? !sides.is_first(part, f) : !part.is_listed(f)) continue;
                const std::int32_t t = part.tet_at_facet[f];
                const Tetrahedron& tet = part.mesh.tets.at(t);
                add({part.patch[f], face_of(tet, part.facets[f]), first + t});
            }
        });
    };
    std::vector<std::int64_t> elements;
    for_each_by_patch<ElementFace>(names.sizes, visit, [&](std::int32_t patch, std::span<const ElementFace> faces) {
        for (std::int32_t face = 1; face <= 4; ++face) {
            elements.clear();
            for (const ElementFace& each : faces)
                if (each.face == face) elements.push_back(each.element);
            if (elements.empty()) continue;
            std::sort(elements.begin(), elements.end());
            faces_of[patch] |= 1U << face;
            file.write(fmt::format("*ELSET, ELSET={}_S{}\n", names.words[patch], face));
            write_list(file, elements);
        }
    });
}

void write_surfaces(const PartSource& parts, const Names& names, ExportFile& file) {
    std::vector<unsigned> faces_of(names.words.size(), 0);  // bits 1 to 4
    write_face_sets(parts, names, file, faces_of);
    for (std::size_t patch = 0; patch < names.words.size(); ++patch) {
        if (faces_of[patch] == 0) continue;
        const std::string& word = names.words[patch];
        file.write(fmt::format("*SURFACE, NAME={}, TYPE=ELEMENT\n", word));
        for (unsigned face = 1; face <= 4; ++face)
            if (faces_of[patch] >> face & 1U) file.write(fmt::format("{}_S{},S{}\n", word, face, face));
    }
}

std::vector<std::string> patch_words(const std::vector<std::string>& names) {
    return word_names(names,
                      {.most_characters = longest_name - longest_ending, .ignores_case = true, .taken = {"NALL"}});
}

// No set has two meanings: regions are called unlike the sets of parts and of the faces of patches.
std::vector<std::string> material_words(const PartSource& parts, const std::vector<std::string>& patch_words) {
    const Materials materials(parts);
    std::vector<std::string> words;
    if (!materials.are_regions()) {
        for (std::int32_t body = 0; body < materials.count(); ++body) words.push_back(fmt::format("BODY_{}", body + 1));
        return words;
    }
    WordRules rules{.most_characters = longest_name, .ignores_case = true, .taken = {"EALL"}, .kind = "region"};
    for (const PartIndex index : parts.outline().parts.ids())
        rules.taken.push_back(fmt::format("SUBDOMAIN_{}", index.value() + 1));
    for (const std::string& patch : patch_words)
        for (int face = 1; face <= 4; ++face) rules.taken.push_back(fmt::format("{}_S{}", patch, face));
    return word_names(materials.names(), rules);
}

void write_merged(const PartSource& parts, const MergeOptions&, ExportFiles& files, const std::string& stem) {
    require_numbers_fit(parts.outline(), "abaqus", most_labels);
    const Names names{patch_words(parts.outline().patch_names), patch_sizes(parts)};
    ExportFile file = files.create(stem + ".inp");
    write_nodes(parts, file);
    write_elements(parts, file);
    write_material_sets(parts, material_words(parts, names.words), file);
    parts.outline().order == 1 ? write_node_sets<3>(parts, names, file) : write_node_sets<6>(parts, names, file);
    write_surfaces(parts, names, file);
    file.close();
}

}  // namespace abaqus

extern const Format abaqus_format = {
    .name = "abaqus",
    .help = "Abaqus input with sets: CalculiX, Abaqus",
    .ending = ".inp",
    .kind = {"Abaqus input", [](std::string_view text) { return text.starts_with("*NODE, NSET=NALL"); }},
    .patch_words = abaqus::patch_words,
    .write_merged = abaqus::write_merged};

}  // namespace kerf
