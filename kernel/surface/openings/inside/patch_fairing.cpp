#include "surface/openings/inside/patch_fairing.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/box.h"
#include "base/geometry/sparse_factors.h"

namespace kerf {

namespace {

// The equations of a fair patch: the sum over points w of the patch of |sum over v of weight(w, v) (x_v - x_w)|^2 /
// area(w) is least; x is unknown for points within the rims.
class FairnessEquations {
 public:
    FairnessEquations(const PatchMesh& patch, const PatchSurroundings& around, const Vec3& origin, double scale)
        : patch_(patch), around_(around), origin_(origin), scale_(scale), area_(patch.count(), 0) {
        known_ = PointRows::Zero(patch.count(), 3);
        for (const Triangle& t : patch.triangles()) add({t[0], t[1], t[2]}, patch.count());
        for (const auto& t : around.facets) add(t, patch.rim_count());
    }

    // Returns the new places of the points within the rims; none if there is no solution.
    PointRows solve() {
        Eigen::VectorXd weight(patch_.count());
        for (std::int32_t w = 0; w < patch_.count(); ++w) {
            const bool counts = w >= patch_.rim_count() || around_.is_whole[w];
            weight[w] = counts && area_[w] > 0 ? 1 / area_[w] : 0;
        }
        return least_squares(patch_.count() - patch_.rim_count(), laplacian_, weight, known_);
    }

 private:
    Vec3 place(std::int32_t v, std::int32_t rim_or_all) const {
        const bool is_beside = v >= rim_or_all;
        return ((is_beside ? around_.points[v - rim_or_all] : patch_.points()[v]) - origin_) / scale_;
    }
    // `count`: numbers below it are points of the patch.
    void add(const std::array<std::int32_t, 3>& t, std::int32_t count) {
        const std::array<Vec3, 3> x = {place(t[0], count), place(t[1], count), place(t[2], count)};
        const double doubled_area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
        for (int i = 0; i < 3; ++i) {  // the angle at corner i is opposite to the edge between the others
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            constexpr double steepest = 20;  // needles have no say
            const double dot = (x[j] - x[i]).dot(x[k] - x[i]);
            const double weight = doubled_area > 0 ? std::clamp(dot / doubled_area, -steepest, steepest) / 2
                                                   : std::copysign(steepest, dot);
            if (t[i] < count) area_[t[i]] += doubled_area / 6;
            add_edge(t[j], t[k], weight, x[j], x[k], count);
            add_edge(t[k], t[j], weight, x[k], x[j], count);
        }
    }
    void add_edge(std::int32_t w, std::int32_t v, double weight, const Vec3& at_w, const Vec3& at_v,
                  std::int32_t count) {
        if (w >= count) return;
        add_term(w, v, weight, at_v, count);
        add_term(w, w, -weight, at_w, count);
    }
    void add_term(std::int32_t row, std::int32_t v, double weight, const Vec3& at, std::int32_t count) {
        if (v >= patch_.rim_count() && v < count)
            laplacian_.push_back({row, v - patch_.rim_count(), weight});
        else
            known_.row(row) += weight * at.transpose();
    }

    const PatchMesh& patch_;
    const PatchSurroundings& around_;
    Vec3 origin_;
    double scale_;
    std::vector<double> area_;
    std::vector<SparseEntry> laplacian_;
    PointRows known_;
};

}  // namespace

bool fair_patch(PatchMesh& patch, const PatchSurroundings& around) {
    const std::int32_t rim = patch.rim_count();
    Box box;
    for (std::int32_t v = 0; v < rim; ++v) box.extend(patch.points()[v]);
    const Vec3 origin = box.center();
    const double scale = box.diagonal().norm(), farthest = scale / 2;
    const std::vector<Vec3> before = patch.points();
    constexpr int rounds = 3;
    for (int round = 0; round < rounds && patch.count() > rim; ++round) {
        const PointRows places = FairnessEquations(patch, around, origin, scale).solve();
        if (places.rows() != patch.count() - rim || !places.allFinite()) return false;
        for (std::int32_t v = rim; v < patch.count(); ++v) {
            const Vec3 to = origin + scale * places.row(v - rim).transpose();
            if ((to - before[v]).norm() > farthest) return false;
            patch.move(v, to);
        }
        patch.relax();
    }
    return true;
}

}  // namespace kerf
