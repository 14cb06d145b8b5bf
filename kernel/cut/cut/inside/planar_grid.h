// A grid of buckets over the plane, by which near items are found.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

using PlanarBox = Eigen::AlignedBox2d;

/// Returns the box enlarged by `margin` on all sides.
inline PlanarBox grown(const PlanarBox& box, double margin) {
    return {box.min() - Vec2::Constant(margin), box.max() + Vec2::Constant(margin)};
}

/// Boxes in a uniform grid whose cells are about as large as the mean box. Built in O(n).
class PlanarGrid {
 public:
    explicit PlanarGrid(std::vector<PlanarBox> boxes) : boxes_(std::move(boxes)), seen_(boxes_.size(), 0) {
        Vec2 extent = Vec2::Zero();
        for (const PlanarBox& box : boxes_) {
            bounds_.extend(box);
            extent += box.sizes();
        }
        if (boxes_.empty()) return;
        const double n = static_cast<double>(boxes_.size());
        const Vec2 size = bounds_.sizes();
        for (int i = 0; i < 2; ++i) {
            const double cells = std::min(std::floor(size[i] / (extent[i] / n)), std::sqrt(4 * n) + 1);
            count_[i] = cells >= 1 ? static_cast<std::int32_t>(cells) : 1;  // one cell as well where the extent is zero
            scale_[i] = size[i] > 0 ? count_[i] / size[i] : 0;
        }
        fill();
    }

    /// Calls visit(index) once for every box that overlaps `box`, ascending within a cell. Not thread-safe.
    template <class Visit>
    void for_each_overlap(const PlanarBox& box, Visit visit) {
        if (boxes_.empty() || !bounds_.intersects(box)) return;
        ++query_;
        for_each_cell(box, [&](std::size_t cell) {
            for (std::int32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
                const std::int32_t item = items_[i];
                if (seen_[item] == query_) continue;
                seen_[item] = query_;
                if (boxes_[item].intersects(box)) visit(item);
            }
        });
    }

 private:
    std::int32_t cell_coordinate(double x, int axis) const {
        const double cell = (x - bounds_.min()[axis]) * scale_[axis];
        return static_cast<std::int32_t>(std::clamp(cell, 0.0, static_cast<double>(count_[axis] - 1)));
    }
    template <class Visit>
    void for_each_cell(const PlanarBox& box, Visit visit) const {
        const std::int32_t x1 = cell_coordinate(box.max().x(), 0), y1 = cell_coordinate(box.max().y(), 1);
        for (std::int32_t y = cell_coordinate(box.min().y(), 1); y <= y1; ++y)
            for (std::int32_t x = cell_coordinate(box.min().x(), 0); x <= x1; ++x)
                visit(static_cast<std::size_t>(y) * count_[0] + x);
    }
    void fill() {
        first_.assign(static_cast<std::size_t>(count_[0]) * count_[1] + 1, 0);
        for (const PlanarBox& box : boxes_) for_each_cell(box, [&](std::size_t cell) { ++first_[cell + 1]; });
        for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
        items_.resize(first_.back());
        std::vector<std::int32_t> end(first_.begin(), first_.end() - 1);
        for (std::int32_t i = 0; i < count_of(boxes_); ++i)
            for_each_cell(boxes_[i], [&](std::size_t cell) { items_[end[cell]++] = i; });
    }

    std::vector<PlanarBox> boxes_;
    PlanarBox bounds_;
    std::array<std::int32_t, 2> count_ = {1, 1};
    Vec2 scale_ = Vec2::Zero();
    std::vector<std::int32_t> first_, items_;
    std::vector<std::int32_t> seen_;
    std::int32_t query_ = 0;
};

}  // namespace kerf
