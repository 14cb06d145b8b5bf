// Gmsh's MSH 2 and 4.1: sections between $Name and $EndName. Keywords, names of physical groups and, in MSH 2, counts
// are text; the numbers of the other sections are text or, in a binary file, their bytes, in the order of bytes that a
// 1 behind the version tells.
//
// Nodes carry tags, any different numbers; elements name nodes by tag. An element belongs to a geometric entity, and
// that to physical groups: MSH 2 writes one group and the entity with every element, and an element of several groups
// once for each; MSH 4 lists the groups of each entity in $Entities and the elements entity by entity. The patch of a
// triangle is its first group, else its entity; so is the volume of a tetrahedron. Partitions are no volumes: where MSH
// 4 has them, there is only one.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "io/binary_scanner.h"
#include "io/mesh_scanners.h"
#include "io/soup_builder.h"
#include "io/surface_reader.h"
#include "io/text_scanner.h"

namespace kerf {

namespace {

enum class Version { msh2, msh41 };

// The numbers of the sections, as text or as bytes.
class Source {
 public:
    explicit Source(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path), text_(bytes, path) {}

    /// The part of the file that is text whatever the rest is; it goes on where the numbers ended.
    TextScanner& text() {
        if (binary_) text_.go_to(binary_->position());
        binary_.reset();
        return text_;
    }
    void set_byte_order(std::endian order) { order_ = order; }
    bool is_binary() const { return order_.has_value(); }

    std::int32_t next_int() {
        if (is_binary()) return binary().next<std::int32_t>();
        const std::int64_t value = text_.next_integer();
        if (value != static_cast<std::int32_t>(value))
            fail("a tag or type has more than 32 bits. Save the mesh again.");
        return static_cast<std::int32_t>(value);
    }
    std::int64_t next_long() { return is_binary() ? binary().next<std::int64_t>() : text_.next_integer(); }
    double next_real() { return is_binary() ? binary().next<double>() : text_.next_real(); }
    std::int64_t next_count() {
        const std::int64_t count = next_long();
        if (count < 0) fail("a number of elements is negative. Correct it or export the surface again.");
        return count;
    }
    /// Passes over the numbers of a list in which each takes room in the file.
    void skip_ints(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) next_int();
    }
    void skip_reals(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) next_real();
    }
    [[noreturn]] void fail(const std::string& what) const { binary_ ? binary_->fail(what) : text_.fail(what); }

 private:
    // Behind the end of the line in which text was read last.
    BinaryScanner& binary() {
        if (!binary_) {
            text_.skip_line();
            binary_.emplace(bytes_, text_.position(), path_, *order_);
        }
        return *binary_;
    }

    std::string_view bytes_;
    const std::string& path_;
    TextScanner text_;
    std::optional<std::endian> order_;
    std::optional<BinaryScanner> binary_;  // while numbers are read
};

// Surfaces or volumes.
struct EntityKind {
    const char* name;
    std::vector<std::pair<std::int64_t, std::string>> groups = {};            // tag, name; sorted once complete
    std::vector<std::pair<std::int64_t, std::int64_t>> group_of_entity = {};  // entity, physical tag

    std::string name_of(std::int64_t group, std::int64_t entity) const;
};

// What the elements need from the sections before them.
struct Model {
    EntityKind surfaces{"surface"}, volumes{"volume"};
    std::vector<std::pair<std::int64_t, std::vector<std::int64_t>>> surfaces_of_volume;  // entities
    bool is_partitioned = false;
    std::vector<std::pair<std::int64_t, std::int64_t>> vertex_of_node;  // tag, index

    EntityKind* of_dimension(std::int64_t dimension) {
        return dimension == 2 ? &surfaces : dimension == 3 ? &volumes : nullptr;
    }
};

// The value behind a key in sorted pairs.
template <class Value>
const Value* find(const std::vector<std::pair<std::int64_t, Value>>& pairs, std::int64_t key) {
    const auto found = std::lower_bound(pairs.begin(), pairs.end(), key,
                                        [](const auto& pair, std::int64_t wanted) { return pair.first < wanted; });
    return found != pairs.end() && found->first == key ? &found->second : nullptr;
}

std::string EntityKind::name_of(std::int64_t group, std::int64_t entity) const {
    if (const std::string* found = find(groups, group)) return *found;
    return group != 0 ? "physical_" + std::to_string(group) : std::string(name) + "_" + std::to_string(entity);
}

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

// The entities around one, whose sign says how they are turned.
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

enum class Shape { point, line, triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid, unknown };

constexpr std::array<std::array<const char*, 2>, 8> shape_names = {{{"point", "points"},
                                                                    {"line", "lines"},
                                                                    {"triangle", "triangles"},
                                                                    {"quadrangle", "quadrangles"},
                                                                    {"tetrahedron", "tetrahedra"},
                                                                    {"hexahedron", "hexahedra"},
                                                                    {"prism", "prisms"},
                                                                    {"pyramid", "pyramids"}}};

struct ElementType {
    Shape shape = Shape::unknown;
    std::int64_t nodes = 0;
};

// Gmsh's numbers of element types, from 1.
ElementType element_type(std::int64_t number) {
    using enum Shape;
    constexpr std::array<ElementType, 32> types = {
        {{unknown, 0},      {line, 2},        {triangle, 3}, {quadrangle, 4}, {tetrahedron, 4}, {hexahedron, 8},
         {prism, 6},        {pyramid, 5},     {line, 3},     {triangle, 6},   {quadrangle, 9},  {tetrahedron, 10},
         {hexahedron, 27},  {prism, 18},      {pyramid, 14}, {point, 1},      {quadrangle, 8},  {hexahedron, 20},
         {prism, 15},       {pyramid, 13},    {triangle, 9}, {triangle, 10},  {triangle, 12},   {triangle, 15},
         {triangle, 15},    {triangle, 21},   {line, 4},     {line, 5},       {line, 6},        {tetrahedron, 20},
         {tetrahedron, 35}, {tetrahedron, 56}}};
    return number > 0 && number < static_cast<std::int64_t>(types.size()) ? types[number] : ElementType{};
}

// Takes the elements one by one: faces and tetrahedra. What is neither is only counted, and so are tetrahedra of higher
// order where a surface is wanted.
class Elements {
 public:
    Elements(Source& source, SoupBuilder& builder, const Model& model)
        : source_(source), builder_(builder), model_(model) {}

    /// Elements to come are of this type.
    void set_type(std::int64_t number) {
        type_ = element_type(number);
        if (type_.shape == Shape::unknown || (is_taken() && type_.nodes > 4)) refuse_type(number);
        if (type_.shape == Shape::tetrahedron && type_.nodes > 4) of_higher_order_ = number;
    }
    /// So many of them follow.
    void announce(std::int64_t count) const {
        if (is_face()) builder_.announce_facets(count);
    }
    void set_patch(std::int64_t group, std::int64_t entity) {
        if (std::pair(group, entity) == patch_) return;
        patch_ = {group, entity};
        builder_.set_patch(model_.surfaces.name_of(group, entity));
        volume_ = -1;
    }
    /// The nodes of one element.
    template <class NextNode>
    void read(std::int64_t tag, const NextNode& next_node) {
        ++counts_[static_cast<std::size_t>(type_.shape)];
        last_corners_.swap(corners_);
        corners_.clear();
        for (std::int64_t i = 0; i < type_.nodes; ++i) {
            const std::int64_t node = next_node();
            if (is_taken()) corners_.push_back(to_vertex(tag, node));
        }
        if (is_taken() && !repeats_last()) add_element();
    }
    /// When all have been read.
    void finish() const {
        if (!builder_.has_facets() && !builder_.has_tets() && of_higher_order_) refuse_type(of_higher_order_);
        if (!builder_.wants_tets()) {
            builder_.name_volumes(volume_names());
            if (!builder_.has_tets()) refuse_shared_surfaces();
        }
        note_ignored();
    }

 private:
    void note_ignored() const {
        for (const Shape shape :
             {Shape::tetrahedron, Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::line, Shape::point}) {
            const auto i = static_cast<std::size_t>(shape);
            if (shape == Shape::tetrahedron && (builder_.wants_tets() || !builder_.has_facets())) continue;
            builder_.note_ignored(counts_[i], shape_names[i][0], shape_names[i][1]);
        }
    }
    [[noreturn]] void refuse_type(std::int64_t number) const {
        const ElementType type = element_type(number);
        const bool is_face =
            type.shape == Shape::unknown || type.shape == Shape::triangle || type.shape == Shape::quadrangle;
        source_.fail("elements of type " + std::to_string(number) + " (" + describe(type) + ") cannot be read. " +
                     (builder_.wants_tets() || !is_face ? "Save the mesh with elements of first order: gmsh -order 1."
                                                        : "Save the surface with triangles of three nodes."));
    }
    bool is_face() const { return type_.shape == Shape::triangle || type_.shape == Shape::quadrangle; }
    bool is_taken() const {
        return is_face() || (type_.shape == Shape::tetrahedron && (builder_.wants_tets() || type_.nodes == 4));
    }
    // MSH 2 writes an element of several groups once for each, one directly behind the other.
    bool repeats_last() const {
        return corners_ == last_corners_ && patch_.second == last_patch_.second && patch_.first != last_patch_.first;
    }
    void add_element() {
        last_patch_ = patch_;
        const auto fail = [&](const std::string& what) { source_.fail(what); };
        if (!is_face()) return builder_.add_tet(corners_, fail, volume());
        builder_.add_polygon(corners_, fail);
        if (model_.surfaces_of_volume.empty()) return;
        if (surfaces_.empty() || surfaces_.back().first != patch_.second)
            surfaces_.emplace_back(patch_.second, corners_.front());
    }
    // The number of that of the current patch.
    std::int32_t volume() {
        if (volume_ >= 0) return volume_;
        const auto key = model_.is_partitioned ? std::pair<std::int64_t, std::int64_t>() : patch_;
        const auto [found, is_new] = number_of_volume_.try_emplace(key, static_cast<std::int32_t>(volumes_.size()));
        if (is_new) volumes_.push_back(key);
        return volume_ = found->second;
    }
    // Those in the same group are told by their entities.
    std::vector<std::string> volume_names() const {
        std::map<std::int64_t, int> count_in_group;
        for (const auto& [group, entity] : volumes_) ++count_in_group[group];
        std::vector<std::string> names;
        for (const auto& [group, entity] : volumes_)
            names.push_back(model_.volumes.name_of(count_in_group[group] == 1 ? group : 0, entity));
        return names;
    }
    // Of a file without tetrahedra, the geometry tells which surfaces are between two volumes; only volumes count all
    // of whose surfaces are in the file.
    void refuse_shared_surfaces() const {
        if (model_.is_partitioned || builder_.keeps_walls()) return;
        auto in_file = surfaces_;
        std::sort(in_file.begin(), in_file.end());
        std::vector<std::pair<std::int64_t, std::int64_t>> volume_of_surface;
        for (const auto& [volume, surfaces] : model_.surfaces_of_volume) {
            const auto is_in_file = [&](std::int64_t surface) { return find(in_file, surface) != nullptr; };
            if (!std::all_of(surfaces.begin(), surfaces.end(), is_in_file)) continue;
            for (const std::int64_t surface : surfaces) volume_of_surface.emplace_back(surface, volume);
        }
        std::sort(volume_of_surface.begin(), volume_of_surface.end());
        const auto shared =
            std::adjacent_find(volume_of_surface.begin(), volume_of_surface.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first && a.second != b.second; });
        if (shared == volume_of_surface.end()) return;
        const auto name_of = [&](std::int64_t volume) {
            const std::int64_t* group = find(model_.volumes.group_of_entity, volume);
            return model_.volumes.name_of(group ? *group : 0, volume);
        };
        const std::int64_t vertex = *find(in_file, shared->first);
        builder_.refuse_wall(name_of(shared->second), name_of(std::next(shared)->second), builder_.vertex(vertex));
    }
    static std::string describe(const ElementType& type) {
        if (type.shape == Shape::unknown) return "unknown";
        return std::string(shape_names[static_cast<std::size_t>(type.shape)][1]) + " with " +
               std::to_string(type.nodes) + " nodes";
    }
    // Tags mostly count from 1 without gaps, and need no search then.
    const std::int64_t* find_vertex(std::int64_t node) const {
        const auto& nodes = model_.vertex_of_node;
        const auto place =
            static_cast<std::uint64_t>(node) - (nodes.empty() ? 0 : static_cast<std::uint64_t>(nodes.front().first));
        return place < nodes.size() && nodes[place].first == node ? &nodes[place].second : find(nodes, node);
    }
    std::int64_t to_vertex(std::int64_t element, std::int64_t node) const {
        const std::int64_t* vertex = find_vertex(node);
        if (!vertex)
            source_.fail("element " + std::to_string(element) + " names node " + std::to_string(node) +
                         ", which the file does not have. Save the mesh again.");
        return *vertex;
    }

    Source& source_;
    SoupBuilder& builder_;
    const Model& model_;
    ElementType type_;
    std::pair<std::int64_t, std::int64_t> patch_ = {-1, -1}, last_patch_ = {-1, -1};  // group, entity
    std::vector<std::pair<std::int64_t, std::int64_t>> volumes_;                      // of tetrahedra: group, entity
    std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> number_of_volume_;
    std::int32_t volume_ = -1;                                     // number of that of patch_; -1: not known yet
    std::vector<std::pair<std::int64_t, std::int64_t>> surfaces_;  // of faces: entity, a vertex
    std::int64_t of_higher_order_ = 0;                             // type of such tetrahedra; 0: there are none
    std::vector<std::int64_t> corners_, last_corners_;             // of this face, of the last one
    std::array<std::int64_t, shape_names.size()> counts_{};
};

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
        if (i < 3) numbers[static_cast<std::size_t>(i)] = number;
    }
    if (numbers[1] != 1) return;
    std::vector<double>& values = builder.node_scalar(name);
    for (std::int64_t i = 0; i < numbers[2]; ++i) {
        const std::int64_t tag = source.next_int();
        const double value = source.next_real();
        if (const std::int64_t* vertex = find(model.vertex_of_node, tag))
            values[static_cast<std::size_t>(*vertex)] = value;
    }
}

// Passes over what is left of a section; its end may only be missing at the end of the file.
void finish_section(TextScanner& text, std::string_view name) {
    const std::string end = "$End" + std::string(name);
    while (!text.at_end() && text.next_word() != end) continue;
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

void scan_gmsh(std::string_view bytes, const std::string& path, SoupBuilder& builder) {
    Source source(bytes, path);
    Model model;
    Elements elements(source, builder, model);
    std::optional<Version> version;
    while (!source.text().at_end()) {
        const std::string_view name = read_section_name(source.text());
        const bool is_msh2 = version == Version::msh2;
        if (name == "MeshFormat")
            version = read_format(source);
        else if (!version && name != "Comments")
            source.fail("the section $MeshFormat is missing. Save the mesh again.");
        else if (name == "PhysicalNames")
            read_physical_names(source, model);
        else if (name == "Entities")
            read_entities(source, model);
        else if (name == "PartitionedEntities")
            model.is_partitioned = true;
        else if (name == "Nodes")
            is_msh2 ? read_nodes_2(source, builder, model) : read_nodes_4(source, builder, model);
        else if (name == "Elements")
            is_msh2 ? read_elements_2(source, elements) : read_elements_4(source, model, elements);
        else if (name == "NodeData" && builder.wants_scalars())
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

Soup read_gmsh_with_walls(std::string_view bytes, const std::string& path) {
    SoupBuilder builder(path);
    builder.keep_walls();
    scan_gmsh(bytes, path, builder);
    return builder.finish();
}

}  // namespace kerf
