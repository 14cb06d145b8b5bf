// Gmsh's MSH 2 and 4.1: sections between $Name and $EndName. Keywords, names of physical groups and, in MSH 2, counts
// are text; the numbers of the other sections are text or, in a binary file, their bytes, in the order of bytes that a
// 1 behind the version tells.
//
// Nodes carry tags, any different numbers; elements name nodes by tag. An element belongs to a geometric entity, and
// that to physical groups: MSH 2 writes one group and the entity with every element, and an element of several groups
// once for each; MSH 4 lists the groups of each entity in $Entities and the elements entity by entity. The patch of a
// triangle is its first group, else its entity; so is the region of a tetrahedron. Partitions are no volumes: where MSH
// 4 has them, there is only one. Without tetrahedra, $Entities of MSH 4 may say which surfaces bound which volumes.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/core/error.h"
#include "files/io/inside/gmsh_elements.h"
#include "files/io/inside/gmsh_model.h"
#include "files/io/inside/gmsh_source.h"
#include "files/io/inside/mesh_scanners.h"
#include "files/io/soup_builder.h"
#include "files/io/surface_reader.h"

namespace kerf {

namespace gmsh {

namespace {

enum class Version { msh2, msh41 };

[[noreturn]] void refuse_version(const TextScanner& text, const std::string& version) {
    text.fail("MSH version " + version.substr(0, 40) +
              " cannot be read. Save the mesh as MSH 2.2 or 4.1, for example with gmsh FILE -save -format msh41 -o "
              "NEW.msh.");
}

std::endian read_byte_order(Source& source) {
    source.set_byte_order(std::endian::little);
    const std::int32_t one = source.next_int();
    if (one != 1 && one != 0x01000000)
        source.fail("the number that tells the order of the bytes is not 1. Save the mesh again.");
    return one == 1 ? std::endian::little : std::endian::big;
}

Version read_format(Source& source) {
    TextScanner& text = source.text();
    const std::string version(text.next_word());
    const bool is_msh2 = version == "2" || version.starts_with("2.");
    if (!is_msh2 && version != "4.1") refuse_version(text, version);
    const bool is_binary = text.next_integer() != 0;
    if (text.next_integer() != 8) text.fail("the size of a real number is not 8. Save the mesh again.");
    if (is_binary) source.set_byte_order(read_byte_order(source));
    return is_msh2 ? Version::msh2 : Version::msh41;
}

void read_physical_names(Source& source, Model& model) {
    TextScanner& text = source.text();
    const std::int64_t count = text.next_count();
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t dimension = text.next_integer(), tag = text.next_integer();
        std::string_view name = text.rest_of_line();
        if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
        if (EntityKind* kind = model.of_dimension(dimension)) kind->groups.emplace_back(tag, name);
    }
    for (EntityKind* kind : {&model.surfaces, &model.volumes})
        std::stable_sort(kind->groups.begin(), kind->groups.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
}

// The first of a list of physical tags, 0 if it is empty. A negative tag turns the entity around, which no surface
// needs whose orientation follows from its closedness.
std::int64_t read_group(Source& source) {
    const std::int64_t count = source.next_count();
    if (count == 0) return 0;
    const std::int64_t first = source.next_int();
    source.skip_ints(count - 1);
    return first < 0 ? -first : first;
}

// Returns the entities around one; their signs, which say how they are turned, are dropped.
std::vector<std::int64_t> read_boundary(Source& source) {
    std::vector<std::int64_t> tags;
    const std::int64_t count = source.next_count();
    for (std::int64_t i = 0; i < count; ++i) tags.push_back(std::abs(std::int64_t{source.next_int()}));
    return tags;
}

void read_entities(Source& source, Model& model) {
    std::array<std::int64_t, 4> counts;  // by dimension
    for (std::int64_t& count : counts) count = source.next_count();
    for (int dimension = 0; dimension < 4; ++dimension)
        for (std::int64_t i = 0; i < counts[dimension]; ++i) {
            const std::int64_t tag = source.next_int();
            source.skip_reals(dimension == 0 ? 3 : 6);  // a point or a bounding box
            const std::int64_t group = read_group(source);
            if (dimension == 3)
                model.surfaces_of_volume.emplace_back(tag, read_boundary(source));
            else if (dimension > 0)
                source.skip_ints(source.next_count());  // its boundary
            EntityKind* kind = model.of_dimension(dimension);
            if (kind && group != 0) kind->group_of_entity.emplace_back(tag, group);
        }
    for (EntityKind* kind : {&model.surfaces, &model.volumes})
        std::stable_sort(kind->group_of_entity.begin(), kind->group_of_entity.end());
}

void add_node(Source& source, std::int64_t tag, SoupBuilder& builder, Model& model) {
    const double x = source.next_real(), y = source.next_real(), z = source.next_real();
    model.vertex_of_node.emplace_back(tag, builder.vertex_count());
    builder.add_vertex({x, y, z});
}

void sort_nodes(const Source& source, Model& model) {
    auto& nodes = model.vertex_of_node;
    if (!std::is_sorted(nodes.begin(), nodes.end())) std::sort(nodes.begin(), nodes.end());
    const auto equal =
        std::adjacent_find(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
    if (equal != nodes.end())
        source.fail("there are two nodes " + std::to_string(equal->first) + ". Save the mesh again.");
}

void read_nodes_2(Source& source, SoupBuilder& builder, Model& model) {
    const std::int64_t count = source.text().next_count();
    for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t tag = source.next_int();
        add_node(source, tag, builder, model);
    }
    sort_nodes(source, model);
}

void read_nodes_4(Source& source, SoupBuilder& builder, Model& model) {
    const std::int64_t blocks = source.next_count();
    for (int i = 0; i < 3; ++i) source.next_long();  // numbers of all blocks together
    std::vector<std::int64_t> tags;
    for (std::int64_t block = 0; block < blocks; ++block) {
        const std::int64_t dimension = source.next_int();
        source.next_int();  // the entity
        const bool is_parametric = source.next_int() != 0;
        const std::int64_t count = source.next_count();
        tags.clear();
        for (std::int64_t i = 0; i < count; ++i) tags.push_back(source.next_long());
        for (const std::int64_t tag : tags) {
            add_node(source, tag, builder, model);
            if (is_parametric) source.skip_reals(dimension);
        }
    }
    sort_nodes(source, model);
}

// The tags of an element of MSH 2: its physical group, its entity, perhaps partitions.
void read_tags_2(Source& source, std::int64_t count, Elements& elements) {
    const std::int64_t group = count > 0 ? source.next_int() : 0, entity = count > 1 ? source.next_int() : 0;
    source.skip_ints(count - 2);
    elements.set_patch(group, entity);
}

void read_elements_2(Source& source, Elements& elements) {
    const std::int64_t count = source.text().next_count();
    for (std::int64_t i = 0; i < count;) {
        // In a binary file a header of type, number and tags serves several elements; in text it is part of each.
        const std::int64_t first = source.is_binary() ? 0 : source.next_int();
        elements.set_type(source.next_int());
        const std::int64_t block = source.is_binary() ? source.next_int() : 1, tags = source.next_int();
        if (block < 1) source.fail("a block of elements is empty. Save the mesh again.");
        elements.announce(block);
        for (std::int64_t j = 0; j < block; ++j, ++i) {
            const std::int64_t tag = source.is_binary() ? source.next_int() : first;
            read_tags_2(source, tags, elements);
            elements.read(tag, [&] { return source.next_int(); });
        }
    }
}

void read_elements_4(Source& source, const Model& model, Elements& elements) {
    const std::int64_t blocks = source.next_count();
    for (int i = 0; i < 3; ++i) source.next_long();  // numbers of all blocks together
    for (std::int64_t block = 0; block < blocks; ++block) {
        const std::int64_t dimension = source.next_int(), entity = source.next_int();
        elements.set_type(source.next_int());
        const EntityKind& kind = dimension == 3 ? model.volumes : model.surfaces;
        const std::int64_t* group = find(kind.group_of_entity, entity);
        elements.set_patch(group ? *group : 0, entity);
        const std::int64_t count = source.next_count();
        elements.announce(count);
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t tag = source.next_long();
            elements.read(tag, [&] { return source.next_long(); });
        }
    }
}

// Of the tags of a view, the first text is its name and the third whole number counts its entries.
void read_node_data(Source& source, SoupBuilder& builder, const Model& model) {
    TextScanner& text = source.text();
    std::string name;
    const std::int64_t texts = text.next_count();
    text.skip_line();
    for (std::int64_t i = 0; i < texts; ++i) {
        std::string_view line = text.rest_of_line();
        if (line.size() > 1 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
        if (i == 0) name = line;
    }
    const std::int64_t reals = text.next_count();
    for (std::int64_t i = 0; i < reals; ++i) text.next_real();
    std::array<std::int64_t, 3> numbers = {0, 1, 0};  // step, components, entries
    const std::int64_t integers = text.next_count();
    for (std::int64_t i = 0; i < integers; ++i) {
        const std::int64_t number = text.next_integer();
        if (i < 3) numbers[i] = number;
    }
    if (numbers[1] != 1) return;
    std::vector<double>& values = builder.tets().scalar(name);
    for (std::int64_t i = 0; i < numbers[2]; ++i) {
        const std::int64_t tag = source.next_int();
        const double value = source.next_real();
        if (const std::int64_t* vertex = find(model.vertex_of_node, tag)) values[*vertex] = value;
    }
}

// Passes over the rest of a section; its end may only be missing at the end of the file.
void finish_section(TextScanner& text, std::string_view name) {
    const std::string end = "$End" + std::string(name);
    while (!text.at_end() && text.next_word() != end) continue;
}

// Reads the names of groups that stand behind the elements, as Neper writes them: facets get their patch as they come.
void read_names_ahead(std::string_view bytes, const std::string& path, Model& model) {
    constexpr std::string_view section = "\n$PhysicalNames";
    const std::size_t found = bytes.rfind(section);  // not in comments before
    if (found == std::string_view::npos) return;
    Source ahead(bytes.substr(found + section.size()), path);
    read_physical_names(ahead, model);
}

// The name of the section that begins here, without its $.
std::string_view read_section_name(TextScanner& text) {
    const std::string_view word = text.next_word();
    if (!word.starts_with('$')) text.fail("a section that begins with $ is expected. Save the mesh again.");
    const std::string_view name = word.substr(1);
    if (name == "NOD" || name == "NOE" || name == "ELM") refuse_version(text, "1 ($NOD, $ELM)");
    return name;
}

}  // namespace

}  // namespace gmsh

void scan_gmsh(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    using namespace gmsh;
    Source source(bytes, path);
    Model model;
    Elements elements(source, builder, model);
    std::optional<Version> version;
    bool has_names = false;
    while (!source.text().at_end()) {
        const std::string_view name = read_section_name(source.text());
        const bool is_msh2 = version == Version::msh2;
        if (name == "MeshFormat")
            version = read_format(source);
        else if (!version && name != "Comments")
            source.fail("the section $MeshFormat is missing. Save the mesh again.");
        else if (name == "PhysicalNames" && !std::exchange(has_names, true))
            read_physical_names(source, model);
        else if (name == "Entities")
            read_entities(source, model);
        else if (name == "PartitionedEntities")
            model.is_partitioned = true;
        else if (name == "Nodes")
            is_msh2 ? read_nodes_2(source, builder, model) : read_nodes_4(source, builder, model);
        else if (name == "Elements") {
            if (!std::exchange(has_names, true)) read_names_ahead(bytes, path, model);
            is_msh2 ? read_elements_2(source, elements) : read_elements_4(source, model, elements);
        } else if (name == "NodeData" && builder.wants_scalars())
            read_node_data(source, builder, model);
        finish_section(source.text(), name);
    }
    elements.finish();
}

Soup read_gmsh(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    scan_gmsh(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf
