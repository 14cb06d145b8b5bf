// A merged file wants nodes and triangles in one order over all parts, of which only one is in memory at a time. Nodes
// are handed out in pieces of 2^21 global numbers: the rows of a piece lie in an array, and each part that has some of
// its numbers is loaded and fills them in. Which part has numbers in which piece is known after the first round, in
// which all are loaded. Parts are visited backwards, so that where several have a node, the row of the first part
// stays. Triangles are sorted by patches in batches (files/export/inside/by_patch.h). So memory does not grow with the
// mesh, for more reads of its parts.
#include "files/export/whole_mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/inside/by_patch.h"

namespace kerf {

namespace {

template <std::size_t n>
std::array<std::int64_t, n> global_nodes(const Part& part, const std::array<std::int32_t, n>& nodes) {
    std::array<std::int64_t, n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = part.node_id(nodes[i]);
    return ids;
}

constexpr std::int64_t rows_at_once = std::int64_t{1} << 21;  // 48 MB of points

// Tells for each piece of `rows_at_once` numbers whether the part has some of them.
std::vector<bool> pieces_of(const Part& part, std::int64_t count) {
    std::vector<bool> pieces(count / rows_at_once + 1);
    for (std::int64_t n = 0; n < part.node_count(); ++n) pieces[part.node_id(n) / rows_at_once] = true;
    return pieces;
}

// Hands out rows of the nodes of the whole mesh in the order of their global numbers, a piece at a time; row(part, n)
// has the row of a node of a part. Values at walls differ on their sides: those of the first part count.
template <class Row, class RowOf>
void for_each_row(const PartSource& parts, PartContent content, const RowOf& row,
                  const std::function<void(std::int64_t first, std::span<const Row> rows)>& take) {
    const std::int64_t count = parts.outline().nodes();
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
            for (std::int64_t n = 0; n < part.node_count(); ++n)
                if (const std::int64_t id = part.node_id(n); id >= begin && id < end) rows[id - begin] = row(part, n);
        }
        take(begin, std::span<const Row>(rows).first(end - begin));
    }
}

template <std::size_t width>
void for_each_value_row(const PartSource& parts, std::size_t k,
                        const std::function<void(std::int64_t first, std::span<const double> rows)>& take) {
    using Row = std::array<double, width>;
    const auto row_of = [k](const Part& part, std::size_t n) {
        Row row;
        for (std::size_t i = 0; i < width; ++i) row[i] = part.values[k].number(width * n + i);
        return row;
    };
    for_each_row<Row>(parts, PartContent::all, row_of, [&](std::int64_t first, std::span<const Row> rows) {
        take(first, std::span<const double>(rows.front().data(), width * rows.size()));
    });
}

}  // namespace

CellNodes nodes_of_tet(const Part& part, std::int64_t t) {
    return part.order() == 1 ? CellNodes(global_corners(part, part.mesh.tets[t]))
                             : CellNodes(global_nodes(part, part.nodes_of_tet(t)));
}

CellNodes nodes_of_facet(const Part& part, std::int64_t f) {
    return part.order() == 1 ? CellNodes(global_corners(part, part.facets[f]))
                             : CellNodes(global_nodes(part, part.nodes_of_facet(f)));
}

// Nodes on edges are known only with the cells.
PartContent patch_content(const MeshOutline& outline) {
    return outline.order == 1 ? PartContent::surface : PartContent::cells;
}

std::vector<bool> own_nodes(const Part& part) {
    std::vector<bool> is_own(part.node_count(), true);
    for_each_shared_group(part, [&](const std::vector<NodeId>& parts, const std::vector<std::int32_t>& nodes) {
        for (const std::int32_t n : nodes) is_own[n] = parts.front() == part.id;
    });
    return is_own;
}

void for_each_node(const PartSource& parts,
                   const std::function<void(std::int64_t first, std::span<const Vec3> points)>& take) {
    for_each_row<Vec3>(
        parts, PartContent::vertices, [](const Part& part, std::int64_t n) -> Vec3 { return part.node_point(n); },
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

template <std::size_t n>
void for_each_patch_triangle(
    const PartSource& parts, std::span<const std::int64_t> sizes,
    const std::function<void(std::int32_t patch, std::span<const PatchTriangle<n>> triangles)>& take,
    OnPatches wanted) {
    const PartContent content = n == 3 ? PartContent::surface : patch_content(parts.outline());
    for_each_by_patch<PatchTriangle<n>>(
        sizes,
        [&](const auto& add) {
            for_each_part(parts, content, [&](PartIndex, const Part& part) {
                for (std::size_t f = 0; f < part.facets.size(); ++f) {
                    if (!part.is_listed(f) || (wanted == OnPatches::outer && part.is_wall(f))) continue;
                    if constexpr (n == 3)
                        add({part.patch[f], global_corners(part, part.facets[f])});
                    else
                        add({part.patch[f], global_nodes(part, part.nodes_of_facet(f))});
                }
            });
        },
        take);
}

template void for_each_patch_triangle<3>(const PartSource&, std::span<const std::int64_t>,
                                         const std::function<void(std::int32_t, std::span<const PatchTriangle<3>>)>&,
                                         OnPatches);
template void for_each_patch_triangle<6>(const PartSource&, std::span<const std::int64_t>,
                                         const std::function<void(std::int32_t, std::span<const PatchTriangle<6>>)>&,
                                         OnPatches);

void require_numbers_fit(const MeshOutline& outline, std::string_view format, std::int64_t most) {
    const auto require = [&](std::int64_t count, const char* what) {
        if (count <= most) return;
        throw Error(ErrorCode::usage,
                    fmt::format("The mesh has {} {}, but {} can number no more than {}. Write vtu or msh, or mesh "
                                "with a larger --size.",
                                count, what, format, most));
    };
    require(outline.nodes(), outline.order == 1 ? "vertices" : "nodes");
    require(outline.tets(), "tetrahedra");
    require(outline.patch_facets(), "boundary triangles");
}

}  // namespace kerf
