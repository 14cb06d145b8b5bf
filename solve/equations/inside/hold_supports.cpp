// Supports are taken in their order. For each one its nodes are marked by sums over its triangles, of normals times
// areas (`sums_`), which ranks exchange: a part may have a node of a patch without having a triangle of it. A marked
// node then gets the displacements of the support, along the axes of its frame; NodeHolds keeps at most three
// directions, in which earlier ones take precedence. Normals are means patch by patch, so that a node on an edge
// between two patches of a support is held along both, unless they differ by less than 20 degrees. Which nodes need
// axes of their own is known at the end (`finish()`): those with a direction that is not x, y or z.
#include "solve/equations/inside/hold_supports.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

constexpr double same_surface = 0.342;  // sine of 20 degrees
constexpr std::size_t node_sums = 4;    // the sum of its triangles' normals times areas, and their number

class SupportHolder {
 public:
    SupportHolder(ElasticProblem& problem, const SurfaceSelector& selector)
        : problem_(problem),
          space_(*problem.space),
          selector_(selector),
          slot_(space_.node_count(), -1),
          sums_(node_sums * space_.node_count()) {}

    void hold(const Support& support) {
        number_ = count_of(problem_.supports);
        problem_.supports.push_back(support.name);
        const std::string who = fmt::format("Support '{}'", support.name);
        if (support.where.point) {
            problem_.places.push_back(mark_vertex(selector_.nearest_vertex(*support.where.point, who)));
            return hold_marked(support);
        }
        const std::vector<SurfaceFacet> all = selector_.facets(support.where, who);
        problem_.places.push_back(centre_of(space_, all));
        if (support.frame != Support::Frame::normal || support.where.patches.empty()) {
            mark(all);
            return hold_marked(support);
        }
        const std::vector<char> patches = selector_.match(support.where.patches, who);
        for (std::int32_t patch = 0; patch < count_of(patches); ++patch) {
            if (!patches[patch]) continue;
            std::vector<SurfaceFacet> of_patch;
            for (const SurfaceFacet& facet : all)
                if (space_.parts()[facet.part].patch[facet.facet] == patch) of_patch.push_back(facet);
            mark(of_patch);
            hold_marked(support);
        }
    }

    void finish() {
        bool is_askew = false;
        for (const NodeHolds& node : holds_) is_askew = is_askew || !node.is_global();
        if (is_askew) problem_.frames = NodeFrames(space_.node_count());
        for (std::int32_t n = 0; n < space_.node_count(); ++n) {
            if (slot_[n] < 0) continue;
            const NodeHolds& node = holds_[slot_[n]];
            if (!node.is_global()) problem_.frames.set(n, node);
            for (int i = 0; i < node.count(); ++i) {
                const std::size_t dof = 3 * n + (node.is_global() ? node.component(i) : i);
                const double sign = node.is_global() ? node.axes()(i, node.component(i)) : 1;
                problem_.support_of[dof] = node.holder(i);
                problem_.prescribed[dof] = sign * node.value(i);
            }
        }
    }

 private:
    // Marks the nodes of triangles, also on ranks that have such a node without a triangle of it.
    void mark(const std::vector<SurfaceFacet>& facets) {
        std::fill(sums_.begin(), sums_.end(), 0);
        for (const SurfaceFacet& facet : facets)
            for (const std::int32_t node : space_.nodes_of_facet(facet.part, facet.facet)) {
                if (node < 0) continue;
                Eigen::Map<Vec3>(&sums_[node_sums * node]) += facet.area * facet.normal;
                sums_[node_sums * node + 3] += 1;
            }
        space_.ownership().sum_to_owners(std::span(sums_), node_sums);
        space_.ownership().from_owners(std::span(sums_), node_sums);
    }
    // Marks one vertex and returns its place.
    Vec3 mark_vertex(std::int64_t row) {
        std::fill(sums_.begin(), sums_.end(), 0);
        Vec3 place = Vec3::Zero();
        for (std::int32_t n = 0; n < space_.node_count(); ++n) {
            if (space_.row_of(n) != row) continue;
            sums_[node_sums * n + 3] = 1;
            if (n < space_.owned_count()) place = space_.points()[n];
        }
        space_.ranks().all_reduce(std::span(place.data(), 3), Reduction::sum);
        return place;
    }

    void hold_marked(const Support& support) {
        std::int32_t failed = -1;
        for (std::int32_t n = 0; n < space_.node_count(); ++n) {
            if (sums_[node_sums * n + 3] == 0) continue;
            if (slot_[n] < 0) {
                slot_[n] = count_of(holds_);
                holds_.emplace_back();
            }
            if (!hold_node(support, n)) failed = n;
        }
        refuse(support, failed);
    }
    // Returns false where the frame of the support has no direction at the node.
    bool hold_node(const Support& support, std::int32_t n) {
        NodeHolds& node = holds_[slot_[n]];
        if (support.frame == Support::Frame::normal) {
            const Vec3 normal = Eigen::Map<const Vec3>(&sums_[node_sums * n]);
            if (normal.norm() == 0) return false;
            const bool is_of_this = node.count() > 0 && node.holder(node.count() - 1) == number_;
            node.hold(normal.normalized(), *support.displacement[0], number_,
                      is_of_this ? same_surface : NodeHolds::least_sine);
            return true;
        }
        if (support.frame == Support::Frame::direction) {
            node.hold(support.direction, *support.displacement[0], number_);
            return true;
        }
        Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
        if (support.frame == Support::Frame::cylinder) {
            const Vec3& along = support.axis.direction;
            const Vec3 arm = space_.points()[n] - support.axis.point;
            const Vec3 radial = arm - along.dot(arm) * along;
            if (radial.norm() <= 1e-9 * selector_.diagonal()) {
                if (support.displacement[0] || support.displacement[2]) return false;
                node.hold(along, *support.displacement[1], number_);
                return true;
            }
            axes.row(0) = radial.normalized();
            axes.row(1) = along;
            axes.row(2) = along.cross(radial).normalized();
        }
        for (int c = 0; c < 3; ++c)
            if (support.displacement[c]) node.hold(axes.row(c), *support.displacement[c], number_);
        return true;
    }
    // Throws if a node has failed on any rank. Collective.
    void refuse(const Support& support, std::int32_t failed) const {
        if (space_.ranks().all_reduce(failed, Reduction::largest) < 0) return;
        const Vec3 here = failed >= 0 ? space_.points()[failed] : Vec3::Constant(-INFINITY).eval();
        std::array<double, 4> found = {failed >= 0 ? 1.0 : 0.0, here.x(), here.y(), here.z()};
        for (const std::array<double, 4>& of_rank : all_gather(space_.ranks(), found))
            if (of_rank[0] > found[0]) found = of_rank;
        const std::string place = fmt::format("({:.6g}, {:.6g}, {:.6g})", found[1], found[2], found[3]);
        throw Error(
            ErrorCode::usage,
            support.frame == Support::Frame::normal
                ? fmt::format("Support '{}': at {} the triangles' normals cancel. Write a support for each side.",
                              support.name, place)
                : fmt::format("Support '{}' has a node on its axis, at {}: nothing is radial or tangential "
                              "there. Say axial alone, or x, y and z.",
                              support.name, place));
    }

    ElasticProblem& problem_;
    const FeSpace& space_;
    const SurfaceSelector& selector_;
    std::int32_t number_ = 0;
    std::vector<std::int32_t> slot_;  // of each node: its place in holds_, or -1
    std::vector<NodeHolds> holds_;
    std::vector<double> sums_;
};

}  // namespace

Vec3 centre_of(const FeSpace& space, const std::vector<SurfaceFacet>& facets) {
    std::array<double, 4> sums{};
    for (const SurfaceFacet& facet : facets) {
        const Part& part = space.parts()[facet.part];
        for (const std::int32_t v : part.facets[facet.facet])
            for (std::size_t c = 0; c < 3; ++c) sums[c] += facet.area / 3 * part.mesh.vertices[v][c];
        sums[3] += facet.area;
    }
    space.ranks().all_reduce(std::span<double>(sums), Reduction::sum);
    return Vec3(sums[0], sums[1], sums[2]) / sums[3];
}

void hold_supports(ElasticProblem& problem, const std::vector<Support>& supports, const SurfaceSelector& selector) {
    SupportHolder holder(problem, selector);
    for (const Support& support : supports) holder.hold(support);
    holder.finish();
}

}  // namespace kerf
