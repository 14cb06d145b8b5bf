#include "files/io/inside/gmsh_elements.h"

#include <algorithm>

namespace kerf::gmsh {

namespace {

constexpr std::array<std::array<const char*, 2>, 8> shape_names = {{{"point", "points"},
                                                                    {"line", "lines"},
                                                                    {"triangle", "triangles"},
                                                                    {"quadrangle", "quadrangles"},
                                                                    {"tetrahedron", "tetrahedra"},
                                                                    {"hexahedron", "hexahedra"},
                                                                    {"prism", "prisms"},
                                                                    {"pyramid", "pyramids"}}};

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
    return number > 0 && number < std::ssize(types) ? types[number] : ElementType{};
}

}  // namespace

void Elements::set_type(std::int64_t number) {
    type_ = element_type(number);
    if (type_.shape == Shape::unknown)
        source_.fail("elements of type " + std::to_string(number) +
                     " cannot be read. Save the mesh with elements of first order: gmsh -order 1.");
}

void Elements::set_patch(std::int64_t group, std::int64_t entity) {
    if (std::pair(group, entity) == patch_) return;
    patch_ = {group, entity};
    builder_.set_patch(model_.surfaces.name_of(group, entity));
    volume_ = -1;
}

void Elements::finish() const {
    builder_.tets().name_volumes([&](const VolumeKey& key) { return model_.volumes.name_of(key.first, key.second); });
    if (!builder_.wants_tets() && builder_.tets().empty()) {
        SurfaceSides found = sides_of_surfaces(model_, surfaces_, builder_.soup());
        builder_.set_sides(std::move(found.sides), std::move(found.region_names));
    }
    note_ignored();
}

void Elements::note_ignored() const {
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::line, Shape::point}) {
        const auto i = static_cast<std::size_t>(shape);
        if (shape != Shape::line && shape != Shape::point) builder_.count_other_cells(counts_[i]);
        builder_.note_ignored(counts_[i], shape_names[i][0], shape_names[i][1]);
    }
}

void Elements::add_element() {
    last_patch_ = patch_;
    if (type_.nodes > corner_count()) builder_.count_cell_by_corners();
    const auto fail = [&](const std::string& what) { source_.fail(what); };
    if (!is_face()) return builder_.tets().add(corners_, fail, volume());
    if (!model_.surfaces_of_volume.empty() && (surfaces_.empty() || surfaces_.back().entity != patch_.second))
        surfaces_.push_back({patch_.second, builder_.soup().facets.size()});
    builder_.add_polygon(corners_, fail);
}

// Returns the number of the volume of the current patch.
std::int32_t Elements::volume() {
    if (volume_ < 0) volume_ = builder_.tets().volume(model_.is_partitioned ? VolumeKey() : patch_);
    return volume_;
}

// Tags mostly count from 1 without gaps, and need no search then.
const std::int64_t* Elements::find_vertex(std::int64_t node) const {
    const auto& nodes = model_.vertex_of_node;
    const auto place =
        static_cast<std::uint64_t>(node) - (nodes.empty() ? 0 : static_cast<std::uint64_t>(nodes.front().first));
    return place < nodes.size() && nodes[place].first == node ? &nodes[place].second : find(nodes, node);
}

std::int64_t Elements::to_vertex(std::int64_t element, std::int64_t node) const {
    const std::int64_t* vertex = find_vertex(node);
    if (!vertex)
        source_.fail("element " + std::to_string(element) + " names node " + std::to_string(node) +
                     ", which the file does not have. Save the mesh again.");
    return *vertex;
}

}  // namespace kerf::gmsh
