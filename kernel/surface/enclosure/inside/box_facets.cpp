// Each axis has one list of grid lines, so that faces beside each other have the same points on their common edge, to
// the last bit, and become one by welding. The diagonals of squares alternate, which makes vertices of four and eight
// facets in turn and no direction the longer one.
#include "surface/enclosure/inside/box_facets.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

namespace {

// Legs of a right-angled triangle are shorter than the mean of its edges.
constexpr double mean_edge_per_leg = (2 + 1.4142135623730951) / 3;

// The coordinates of the lines of a grid, equally spaced, whose ends are exact.
std::vector<double> grid_lines(double low, double high, double spacing) {
    const int steps = std::max(1, static_cast<int>(std::lround((high - low) / spacing)));
    std::vector<double> lines;
    for (int i = 0; i < steps; ++i) lines.push_back(low + (high - low) * i / steps);
    lines.push_back(high);
    return lines;
}

}  // namespace

Soup facets_of_box(const Box& box, double edge, const std::array<std::array<std::string, 2>, 3>& face_names) {
    std::array<std::vector<double>, 3> lines;
    for (int axis = 0; axis < 3; ++axis)
        lines[axis] = grid_lines(box.min()[axis], box.max()[axis], edge / mean_edge_per_leg);
    Soup soup;
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            const std::vector<double>&u = lines[(axis + 1) % 3], &v = lines[(axis + 2) % 3];
            const auto first = count_of(soup.vertices), columns = count_of(v), patch = count_of(soup.patch_names);
            soup.patch_names.push_back(face_names[axis][end]);
            for (const double at_u : u)
                for (const double at_v : v) {
                    Vec3& p = soup.vertices.emplace_back();
                    p[axis] = end == 0 ? box.min()[axis] : box.max()[axis];
                    p[(axis + 1) % 3] = at_u;
                    p[(axis + 2) % 3] = at_v;
                }
            const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
                soup.facets.push_back(end == 1 ? Triangle{a, b, c} : Triangle{a, c, b});
                soup.patch.push_back(patch);
            };
            for (std::int32_t i = 0; i + 1 < count_of(u); ++i)
                for (std::int32_t j = 0; j + 1 < columns; ++j) {
                    const std::int32_t a = first + i * columns + j, b = a + columns, c = b + 1, d = a + 1;
                    if ((i + j) % 2 == 0) {
                        add(a, b, c);
                        add(a, c, d);
                    } else {
                        add(a, b, d);
                        add(b, c, d);
                    }
                }
        }
    weld_exactly(soup);
    soup.vertex_number.clear();
    return soup;
}

}  // namespace kerf
