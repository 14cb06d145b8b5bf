#include "repair/distinct_points.h"

#include <bit>
#include <utility>

#include "core/mixed_bits.h"

namespace kerf {

namespace {

std::uint64_t hash_of_point(const Vec3& p) {
    std::uint64_t hash = 0;
    for (const double x : p) hash = mixed_bits(hash ^ std::bit_cast<std::uint64_t>(x + 0.0));  // -0 becomes 0
    return hash;
}

}  // namespace

DistinctPoints::DistinctPoints(std::vector<Vec3> points) : points_(std::move(points)) {
    slots_.assign(std::bit_ceil(2 * points_.size() + 16), -1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        std::int32_t& slot = slots_[slot_of(points_[i])];
        if (slot >= 0) continue;
        slot = static_cast<std::int32_t>(i);
        ++used_;
    }
}

std::int32_t DistinctPoints::number_of(const Vec3& p) {
    if (2 * (used_ + 1) > slots_.size()) make_room();
    std::int32_t& slot = slots_[slot_of(p)];
    if (slot < 0) {
        slot = static_cast<std::int32_t>(points_.size());
        points_.push_back(p);
        ++used_;
    }
    return slot;
}

std::size_t DistinctPoints::slot_of(const Vec3& p) const {
    std::size_t at = hash_of_point(p) & (slots_.size() - 1);
    while (slots_[at] >= 0 && points_[slots_[at]] != p) at = (at + 1) & (slots_.size() - 1);
    return at;
}

void DistinctPoints::make_room() {
    const std::vector<std::int32_t> old = std::exchange(slots_, std::vector<std::int32_t>(2 * slots_.size(), -1));
    for (const std::int32_t point : old)
        if (point >= 0) slots_[slot_of(points_[point])] = point;
}

}  // namespace kerf
