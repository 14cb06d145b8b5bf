// Vertices are welded in one pass over a hash table that is filled in the order of the vertices, so that each vertex
// finds the first of its equals. With a tolerance the table holds the cells of a grid, and the 27 cells around a vertex
// are searched. In both cases the first vertex of a group stays.
#include "surface/soup/soup.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/core/check.h"
#include "base/core/drop_items.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "surface/soup/vertex_table.h"

namespace kerf {

namespace {

// The first vertex with equal coordinates, for each vertex. Most of the time is waiting for the table, in blocks.
std::vector<std::int32_t> find_representatives(const std::vector<Vec3>& vertices) {
    constexpr std::size_t block = 128;
    std::array<std::uint64_t, block> hashes;
    VertexTable table(vertices.size() / 4);  // of separate corners a sixth is left
    std::vector<std::int32_t> representative(vertices.size());
    for (std::size_t begin = 0; begin < vertices.size(); begin += block) {
        const std::size_t count = std::min(block, vertices.size() - begin);
        for (std::size_t i = 0; i < count; ++i) table.prefetch(hashes[i] = hash_of_point(vertices[begin + i]));
        for (std::size_t i = 0; i < count; ++i) representative[begin + i] = table.enter(begin + i, hashes[i], vertices);
    }
    return representative;
}

// Removes model edges that have lost an end or have become a point.
void renumber_edges(std::vector<ModelEdge>& edges, const std::vector<std::int32_t>& new_number) {
    std::erase_if(edges, [&](ModelEdge& edge) {
        const auto [a, b] = edge.vertices;
        edge.vertices = undirected(new_number[a], new_number[b]);
        return edge.vertices[0] < 0 || edge.vertices[0] == edge.vertices[1];
    });
}

// Keeps the vertices that stand for themselves. representative[v]: v itself, an earlier vertex that replaces it, or -1
// for a vertex that no facet uses. Returns the number removed.
std::int64_t renumber(Soup& soup, std::vector<std::int32_t> representative) {
    std::vector<std::int32_t>& new_number = representative;
    std::int32_t kept = 0;
    const auto loses = [&](std::int32_t v) { return new_number[v] != v; };
    const std::size_t count = soup.vertices.size();
    if (soup.vertex_number.empty()) {
        bool any = false;
        for (std::size_t v = 0; v < count && !any; ++v) any = loses(v);
        if (!any) return 0;
        soup.vertex_number.resize(count);
        std::iota(soup.vertex_number.begin(), soup.vertex_number.end(), 0);
    }
    for (std::int32_t v = 0; v < count_of(soup.vertices); ++v) {
        if (new_number[v] == v) {
            soup.vertices[kept] = soup.vertices[v];
            soup.vertex_number[kept] = soup.vertex_number[v];
            new_number[v] = kept++;
        } else if (new_number[v] >= 0) {
            new_number[v] = new_number[new_number[v]];  // an earlier vertex, whose new number is known
        }
    }
    const auto removed = std::ssize(soup.vertices) - kept;
    const bool is_much = 2 * removed > kept;  // of separate corners, of which most are gone
    soup.vertices.resize(kept);
    soup.vertex_number.resize(kept);
    if (is_much) soup.vertices.shrink_to_fit(), soup.vertex_number.shrink_to_fit();
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) v = new_number[v];
    renumber_edges(soup.model_edges, new_number);
    return removed;
}

// Vertices in cells of a grid; only the first vertex of a group is entered. Cells are numbered before neighbours are
// counted off, and are wider than the tolerance: far from the origin a sum or a quotient of coordinates is rounded by a
// good part of a cell.
class WeldGrid {
 public:
    WeldGrid(const std::vector<Vec3>& vertices, double tolerance)
        : vertices_(vertices),
          tolerance_(tolerance),
          mask_(std::bit_ceil(2 * vertices.size() + 1) - 1),
          first_(mask_ + 1, -1),
          next_(vertices.size(), -1) {}

    // The first entered vertex within the tolerance of v, or -1.
    std::int32_t find(std::int32_t v) const {
        const Vec3 &p = vertices_[v], own = cell(p);
        std::int32_t found = -1;
        for (int i = 0; i < 27; ++i) {
            const Vec3 offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            for (std::int32_t u = first_[slot(own + offset)]; u >= 0; u = next_[u])
                if ((vertices_[u] - p).norm() <= tolerance_ && (found < 0 || u < found)) found = u;
        }
        return found;
    }
    void enter(std::int32_t v) { next_[v] = std::exchange(first_[slot(cell(vertices_[v]))], v); }

 private:
    Vec3 cell(const Vec3& p) const { return (p / (1.5 * tolerance_)).array().floor(); }
    std::size_t slot(const Vec3& cell) const { return hash_of_point(cell) & mask_; }

    const std::vector<Vec3>& vertices_;
    double tolerance_;
    std::size_t mask_;
    std::vector<std::int32_t> first_, next_;  // of the vertices in a slot
};

std::vector<std::int32_t> numbers_in_file(std::vector<std::int32_t> own, const std::vector<std::int32_t>& file) {
    if (!file.empty())
        for (std::int32_t& i : own) i = file[i];
    return own;
}

template <class T>
void append_items(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

// Numbers in the file that are those of the soup are not written out.
void write_out(std::vector<std::int32_t>& numbers, std::size_t count) {
    if (!numbers.empty()) return;
    numbers.resize(count);
    std::iota(numbers.begin(), numbers.end(), 0);
}

void append_numbers(std::vector<std::int32_t>& all, std::size_t count, std::vector<std::int32_t> more,
                    std::size_t more_count) {
    write_out(all, count);
    write_out(more, more_count);
    const std::int32_t next = all.empty() ? 0 : *std::max_element(all.begin(), all.end()) + 1;
    for (const std::int32_t number : more) all.push_back(next + number);
}

void append_polygons(Soup& all, const Soup& more) {
    if (all.polygon.empty() && more.polygon.empty()) return;
    write_out(all.polygon, all.facets.size());
    const std::int32_t next = all.polygon.empty() ? 0 : all.polygon.back() + 1;
    for (const std::int32_t polygon : more.unfit_polygons) all.unfit_polygons.push_back(next + polygon);
    append_numbers(all.polygon, all.facets.size(), more.polygon, more.facets.size());
}

void append_patches(Soup& all, const Soup& more) {
    const auto first = count_of(all.patch_names);
    for (const std::int32_t patch : more.patch) all.patch.push_back(first + patch);
    const bool has_colours = !all.patch_colours.empty() || !more.patch_colours.empty();
    if (has_colours) all.patch_colours.resize(all.patch_names.size());
    append_items(all.patch_names, more.patch_names);
    append_items(all.patch_colours, more.patch_colours);
    if (has_colours) all.patch_colours.resize(all.patch_names.size());
}

}  // namespace

std::vector<std::int32_t> Soup::file_facets(const std::vector<std::int32_t>& own) const {
    std::vector<std::int32_t> numbers = numbers_in_file(own, polygon);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}
std::vector<std::int32_t> Soup::file_vertices(const std::vector<std::int32_t>& own) const {
    return numbers_in_file(own, vertex_number);
}

std::int64_t weld_within(Soup& soup, double tolerance) {
    KERF_CHECK(tolerance > 0);
    WeldGrid grid(soup.vertices, tolerance);
    std::vector<std::int32_t> representative(soup.vertices.size());
    for (std::int32_t v = 0; v < count_of(soup.vertices); ++v) {
        const std::int32_t found = soup.vertices[v].allFinite() ? grid.find(v) : -1;
        representative[v] = found < 0 ? v : found;
        if (found < 0) grid.enter(v);
    }
    return renumber(soup, std::move(representative));
}

void append(Soup& all, const Soup& more) {
    KERF_CHECK(all.sides.empty() && more.sides.empty());
    append_polygons(all, more);
    if (!all.vertex_number.empty() || !more.vertex_number.empty())
        append_numbers(all.vertex_number, all.vertices.size(), more.vertex_number, more.vertices.size());
    append_patches(all, more);
    const auto first = count_of(all.vertices);
    for (const Triangle& t : more.facets) all.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
    for (const auto& [vertices, sharp] : more.model_edges)
        all.model_edges.push_back({{vertices[0] + first, vertices[1] + first}, sharp});
    append_items(all.vertices, more.vertices);
    append_items(all.holes, more.holes);
    append_items(all.seeds, more.seeds);
    append_items(all.notes, more.notes);
    all.is_of_model |= more.is_of_model;
    all.may_end_inside |= more.may_end_inside;
}

void scale(Soup& soup, double factor) {
    if (factor == 1) return;
    for (std::vector<Vec3>* points : {&soup.vertices, &soup.holes})
        for (Vec3& p : *points) p *= factor;
    for (RegionSeed& seed : soup.seeds) {
        seed.point *= factor;
        seed.largest_cell *= factor * factor * factor;
    }
}

void drop_facets(Soup& soup, const std::vector<char>& drop) {
    KERF_CHECK(drop.size() == soup.facets.size() && soup.patch.size() == soup.facets.size());
    if (std::none_of(drop.begin(), drop.end(), [](char d) { return d; })) return;
    if (soup.polygon.empty()) {
        soup.polygon.resize(soup.facets.size());
        std::iota(soup.polygon.begin(), soup.polygon.end(), 0);
    }
    drop_items(soup.facets, drop);
    drop_items(soup.patch, drop);
    drop_items(soup.polygon, drop);
    if (!soup.sides.empty()) drop_items(soup.sides, drop);
}

std::int64_t weld_exactly(Soup& soup) { return renumber(soup, find_representatives(soup.vertices)); }

std::int64_t drop_unused_vertices(Soup& soup) {
    KERF_CHECK(are_in_range(soup.facets, soup.vertices.size()));
    std::vector<std::int32_t> representative(soup.vertices.size(), -1);
    for (const Triangle& t : soup.facets)
        for (std::int32_t v : t) representative[v] = v;
    return renumber(soup, std::move(representative));
}

}  // namespace kerf
