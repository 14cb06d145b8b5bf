#include "files/part/cell_fields.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

constexpr std::size_t cells_at_once = 1024;
constexpr Tetrahedron nothing = {0, 0, 0, 0};
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

using TakeColumn = std::function<void(std::size_t column, std::int64_t first, std::span<const float> values)>;

// Columns of a few cells, the first of which has the number `first`.
void measure_fields(const std::vector<Vec3>& points, CellFieldSet fields, std::int64_t first,
                    std::span<const Tetrahedron> cells, const TakeColumn& take) {
    std::array<float, cells_at_once> values;
    const std::span<const float> column_values = std::span(values).first(cells.size());
    if (fields == default_cell_fields) {  // the smallest dihedral angle, as most often
        std::array<double, cells_at_once> degrees;
        measure_min_dihedrals(points, cells, std::span(degrees).first(cells.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) values[i] = cells[i] == nothing ? unknown : degrees[i];
        return take(0, first, column_values);
    }
    std::array<TetQuality, cells_at_once> quality;
    measure_cells(points, cells, std::span(quality).first(cells.size()));
    for (std::size_t field = 0, column = 0; field < cell_fields.size(); ++field) {
        if (!fields[field]) continue;
        for (std::size_t i = 0; i < cells.size(); ++i)
            values[i] = cells[i] == nothing ? unknown : quality[i].*cell_fields[field].measure;
        take(column++, first, column_values);
    }
}

}  // namespace

CellFieldSet parse_cell_fields(std::string_view list) {
    if (list.empty()) return default_cell_fields;
    if (list == "all") return ~CellFieldSet();
    if (list == "none") return {};
    CellFieldSet fields;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const std::string_view name = list.substr(begin, end - begin);
        const auto found = std::find_if(cell_fields.begin(), cell_fields.end(),
                                        [&](const CellField& field) { return field.name == name; });
        if (found == cell_fields.end()) {
            std::string known;
            for (const CellField& field : cell_fields) known += fmt::format("{}, ", field.name);
            throw Error(ErrorCode::usage,
                        fmt::format("'{}' is no field of cells. There are {}all and none.", name, known));
        }
        fields.set(found - cell_fields.begin());
        begin = end + 1;
    }
    return fields;
}

void for_all_cell_fields(const Part& part, CellFieldSet fields, const TakeColumn& take) {
    const std::vector<Tetrahedron>& tets = part.mesh.tets;
    for (std::size_t begin = 0; begin < tets.size(); begin += cells_at_once)
        measure_fields(part.mesh.vertices, fields, begin,
                       std::span(tets).subspan(begin, std::min(cells_at_once, tets.size() - begin)), take);
    std::array<Tetrahedron, cells_at_once> behind;
    for (std::size_t begin = 0; begin < part.tet_at_facet.size(); begin += cells_at_once) {
        const std::size_t count = std::min(cells_at_once, part.tet_at_facet.size() - begin);
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t t = part.tet_at_facet[begin + i];
            behind[i] = t < 0 ? nothing : tets[t];
        }
        measure_fields(part.mesh.vertices, fields, part.tet_count() + begin, std::span(behind).first(count), take);
    }
}

}  // namespace kerf
