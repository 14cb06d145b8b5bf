// Single steps of a repair, and what they did.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/geometry/box.h"
#include "surface/repair/repair_step.h"

namespace kerf::test {

inline double diagonal_of(const Soup& soup) { return box_around_finite(soup.vertices).diagonal().norm(); }

inline StepReport apply(RepairKind kind, Soup& soup, StepRequest request = {}) {
    if (soup.facets.empty()) return {kind, {}};
    request.diagonal = diagonal_of(soup);
    if (request.bound == 0) request.bound = 1e-3 * request.diagonal;
    if (request.amount == 0) request.amount = request.bound;
    StepReport report{kind, {}};
    repair_step_rows()[static_cast<std::size_t>(kind)].apply(soup, request, report);
    return report;
}

inline std::int64_t count(const StepReport& report, const std::string& many) {
    for (const RepairAction& action : report.actions)
        if (action.many == many) return action.count;
    return 0;
}

inline bool same(const Soup& a, const Soup& b) {
    return a.vertices == b.vertices && a.facets == b.facets && a.patch == b.patch && a.polygon == b.polygon &&
           a.vertex_number == b.vertex_number && a.patch_names == b.patch_names;
}

// The corners of each facet from the lowest on, sorted: what a surface is, however it is numbered.
inline std::vector<std::array<double, 9>> facets_of(const Soup& soup) {
    std::vector<std::array<double, 9>> all;
    for (Triangle t : soup.facets) {
        const auto lowest = std::min_element(t.begin(), t.end(), [&](std::int32_t v, std::int32_t w) {
            const Vec3 &p = soup.vertices[v], &q = soup.vertices[w];
            return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
        });
        std::rotate(t.begin(), lowest, t.end());
        std::array<double, 9> corners;
        for (std::size_t i = 0; i < 9; ++i) corners[i] = soup.vertices[t[i / 3]][static_cast<Eigen::Index>(i % 3)];
        all.push_back(corners);
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace kerf::test
