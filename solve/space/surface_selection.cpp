// The triangles of the outer boundary on this rank are listed once, with areas and normals, and selections choose among
// them: by the patch, or by all three corners in a box or, within 1e-6 of the diagonal of the mesh, on a plane. Walls
// between regions and interfaces between parts are no surface and are never selected. All ranks agree by a reduction at
// the end of each function, so that an empty selection throws on all of them. The vertex nearest to a point is the one
// at the smallest distance and, of several, with the smallest row, which does not depend on the number of ranks.
#include "solve/space/surface_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/name_pattern.h"

namespace kerf {

namespace {

constexpr double on_plane = 1e-6, beside_body = 0.01;  // of the diagonal

}  // namespace

SurfaceSelector::SurfaceSelector(const FeSpace& space, std::vector<std::string> names)
    : space_(space), names_(std::move(names)) {
    std::array<double, 6> low;  // the lowest coordinates, then the negative highest ones
    low.fill(std::numeric_limits<double>::infinity());
    for (std::size_t p = 0; p < space.parts().size(); ++p) {
        const Part& part = space.parts()[p];
        for (std::size_t f = 0; f < part.facets.size(); ++f) {
            if (!part.is_on_outer_boundary(f)) continue;
            std::array<Vec3, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = part.mesh.vertices[part.facets[f][i]];
                for (int c = 0; c < 3; ++c) {
                    low[c] = std::min(low[c], corners[i][c]);
                    low[c + 3] = std::min(low[c + 3], -corners[i][c]);
                }
            }
            const FacetElement element = space.facet_element(p, f);
            surface_.push_back({p, f, element.area(), element.normal()});
        }
    }
    space.ranks().all_reduce(std::span<double>(low), Reduction::smallest);
    diagonal_ = std::hypot(low[0] + low[3], low[1] + low[4], low[2] + low[5]);
    low_ = Vec3(low[0], low[1], low[2]);
    high_ = -Vec3(low[3], low[4], low[5]);
}

std::vector<char> SurfaceSelector::match(const std::vector<std::string>& patterns, const std::string& who) const {
    std::vector<char> matched(names_.size(), 0);
    for (const std::string& pattern : patterns)
        for (const std::int32_t patch : matching_names(who, "patch", pattern, names_)) matched[patch] = 1;
    return matched;
}

bool SurfaceSelector::selects(const SurfaceSelection& where, const std::vector<char>& patches,
                              const SurfaceFacet& facet) const {
    const Part& part = space_.parts()[facet.part];
    if (!where.patches.empty()) {
        const std::int32_t patch = part.patch[facet.facet];
        return patch >= 0 && patches[patch] != 0;
    }
    const Triangle& corners = part.facets[facet.facet];
    return std::all_of(corners.begin(), corners.end(), [&](std::int32_t v) {
        const Vec3& p = part.mesh.vertices[v];
        if (where.box) return ((p - (*where.box)[0]).array() >= 0).all() && (((*where.box)[1] - p).array() >= 0).all();
        const Vec3 normal((*where.plane)[0], (*where.plane)[1], (*where.plane)[2]);
        return std::abs(normal.dot(p) - (*where.plane)[3]) <= on_plane * diagonal_ * normal.norm();
    });
}

std::vector<SurfaceFacet> SurfaceSelector::facets(const SurfaceSelection& where, const std::string& who) const {
    const std::vector<char> patches = match(where.patches, who);
    std::vector<SurfaceFacet> selected;
    for (const SurfaceFacet& facet : surface_)
        if (selects(where, patches, facet)) selected.push_back(facet);
    const std::int64_t count = space_.ranks().all_reduce(std::int64_t{std::ssize(selected)}, Reduction::sum);
    if (count == 0)
        throw Error(ErrorCode::usage,
                    fmt::format("{} selects no triangle of the surface{}. kerf solve DIR --list-patches says where "
                                "patches are.",
                                who,
                                where.patches.empty() ? ": those with all corners there count, those between parts "
                                                        "do not"
                                                      : ", for its patches are walls between regions, inside of the "
                                                        "body. Name a patch of the outside, or a box or plane there"));
    return selected;
}

std::int64_t SurfaceSelector::nearest_vertex(const Vec3& point, const std::string& who) const {
    const Vec3 margin = Vec3::Constant(beside_body * diagonal_);
    if (((point - low_ + margin).array() < 0).any() || ((high_ + margin - point).array() < 0).any())
        throw Error(
            ErrorCode::usage,
            fmt::format("{} is at ({:g}, {:g}, {:g}), away from the body, which reaches from ({:g}, {:g}, {:g}) "
                        "to ({:g}, {:g}, {:g}). Give a point of it, in units of the mesh.",
                        who, point.x(), point.y(), point.z(), low_.x(), low_.y(), low_.z(), high_.x(), high_.y(),
                        high_.z()));
    double nearest = std::numeric_limits<double>::infinity();
    std::int64_t row = std::numeric_limits<std::int64_t>::max();
    for (const SurfaceFacet& facet : surface_)
        for (const std::int32_t v : space_.parts()[facet.part].facets[facet.facet]) {
            const double distance = (space_.parts()[facet.part].mesh.vertices[v] - point).squaredNorm();
            const std::int64_t candidate = space_.row_of(space_.nodes_of_parts()[facet.part].of_vertex[v]);
            if (distance < nearest || (distance == nearest && candidate < row)) {
                nearest = distance;
                row = candidate;
            }
        }
    const double least = space_.ranks().all_reduce(nearest, Reduction::smallest);
    if (nearest > least) row = std::numeric_limits<std::int64_t>::max();
    return space_.ranks().all_reduce(row, Reduction::smallest);
}

std::vector<PatchSummary> SurfaceSelector::summaries() const {
    std::vector<PatchSummary> patches(names_.size());
    for (const SurfaceFacet& facet : surface_) {
        const Part& part = space_.parts()[facet.part];
        const auto& [a, b, c] = part.facets[facet.facet];
        const std::vector<Vec3>& points = part.mesh.vertices;
        if (part.patch[facet.facet] >= 0) patches[part.patch[facet.facet]].add(points[a], points[b], points[c]);
    }
    std::vector<double> sums;
    for (const PatchSummary& own : patches)
        for (const double sum : {static_cast<double>(own.triangles), own.area, own.centroid.x(), own.centroid.y(),
                                 own.centroid.z(), own.normal.x(), own.normal.y(), own.normal.z()})
            sums.push_back(sum);
    space_.ranks().all_reduce(std::span(sums), Reduction::sum);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const double* sum = &sums[8 * i];
        patches[i] = {names_[i],
                      "",
                      static_cast<std::int64_t>(sum[0]),
                      sum[1],
                      Vec3(sum[2], sum[3], sum[4]),
                      Vec3(sum[5], sum[6], sum[7])};
        patches[i].finish();
    }
    return patches;
}

}  // namespace kerf
