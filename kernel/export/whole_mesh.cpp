#include "export/whole_mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "export/by_patch.h"

namespace kerf {

namespace {

constexpr std::int64_t rows_at_once = std::int64_t{1} << 21;  // 48 MB of points

// The pieces of the numbers, of `rows_at_once` each, that the part has some of.
std::vector<bool> pieces_of(const Part& part, std::int64_t count) {
    std::vector<bool> pieces(count / rows_at_once + 1);
    for (const std::int64_t id : part.global_id) pieces[id / rows_at_once] = true;
    return pieces;
}

// Rows of the vertices of the whole mesh in the order of their global numbers, a piece at a time; row(part, v) has
// those of a part. Values at walls differ on their sides: those of the first part count.
template <class Row, class RowOf>
void for_each_row(const PartSource& parts, PartContent content, const RowOf& row,
                  const std::function<void(std::int64_t first, std::span<const Row> rows)>& take) {
    const std::int64_t count = parts.outline().vertices;
    Array<PartIndex, std::vector<bool>> pieces(parts.outline().parts.size());  // known after the first piece
    std::vector<Row> rows(std::min(count, rows_at_once));
    for (std::int64_t begin = 0; begin < count; begin += rows_at_once) {
        const std::int64_t end = std::min(count, begin + rows_at_once);
        const bool is_first = begin == 0;
        for (auto i = std::ssize(pieces); i-- > 0;) {  // so that the first part has the last word
            const auto index = PartIndex(i);
            if (!is_first && !pieces[index][begin / rows_at_once]) continue;
            const Part part = parts.load_only(index, content);
            if (is_first) pieces[index] = pieces_of(part, count);
            for (std::size_t v = 0; v < part.global_id.size(); ++v)
                if (const std::int64_t id = part.global_id[v]; id >= begin && id < end) rows[id - begin] = row(part, v);
        }
        take(begin, std::span<const Row>(rows).first(end - begin));
    }
}

template <std::size_t width>
void for_each_value_row(const PartSource& parts, std::size_t k,
                        const std::function<void(std::int64_t first, std::span<const double> rows)>& take) {
    using Row = std::array<double, width>;
    const auto row_of = [k](const Part& part, std::size_t v) {
        Row row;
        for (std::size_t i = 0; i < width; ++i) row[i] = part.values[k].number(width * v + i);
        return row;
    };
    for_each_row<Row>(parts, PartContent::all, row_of, [&](std::int64_t first, std::span<const Row> rows) {
        take(first, std::span<const double>(rows.front().data(), width * rows.size()));
    });
}

}  // namespace

void for_each_node(const PartSource& parts,
                   const std::function<void(std::int64_t first, std::span<const Vec3> points)>& take) {
    for_each_row<Vec3>(
        parts, PartContent::vertices, [](const Part& part, std::size_t v) -> Vec3 { return part.mesh.vertices[v]; },
        take);
}

void for_each_node_value(const PartSource& parts, std::size_t k,
                         const std::function<void(std::int64_t first, std::span<const double> rows)>& take) {
    switch (parts.outline().values[k].components) {
        case 1:
            return for_each_value_row<1>(parts, k, take);
        case 3:
            return for_each_value_row<3>(parts, k, take);
        default:
            return for_each_value_row<6>(parts, k, take);
    }
}

void for_each_part(const PartSource& parts, PartContent content,
                   const std::function<void(PartIndex index, const Part& part)>& take) {
    for (const PartIndex index : parts.outline().parts.ids()) take(index, parts.load_only(index, content));
}

std::vector<std::int64_t> patch_sizes(const PartSource& parts) {
    std::vector<std::int64_t> sizes(parts.outline().patch_names.size(), 0);
    for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
        for (std::size_t f = 0; f < part.facets.size(); ++f)
            if (part.is_listed(f)) ++sizes.at(part.patch[f]);
    });
    return sizes;
}

void for_each_patch_triangle(
    const PartSource& parts, std::span<const std::int64_t> sizes,
    const std::function<void(std::int32_t patch, std::span<const PatchTriangle> triangles)>& take, OnPatches wanted) {
    for_each_by_patch<PatchTriangle>(
        sizes,
        [&](const auto& add) {
            for_each_part(parts, PartContent::surface, [&](PartIndex, const Part& part) {
                for (std::size_t f = 0; f < part.facets.size(); ++f)
                    if (part.is_listed(f) && (wanted == OnPatches::all || !part.is_wall(f)))
                        add({part.patch[f], global_corners(part, part.facets[f])});
            });
        },
        take);
}

void require_numbers_fit(const MeshOutline& outline, std::string_view format, std::int64_t most) {
    const auto require = [&](std::int64_t count, const char* what) {
        if (count <= most) return;
        throw Error(ErrorCode::usage,
                    fmt::format("The mesh has {} {}, but {} can number no more than {}. Write vtu or msh, or mesh "
                                "with a larger --size.",
                                count, what, format, most));
    };
    require(outline.vertices, "vertices");
    require(outline.tets(), "tetrahedra");
    require(outline.patch_facets(), "boundary triangles");
}

}  // namespace kerf
