// A tree that finds which of many boxes meet; it is built in the time of a sort, and compares four boxes at once.
//
// The boxes lie in the order of their middles along a curve that fills space, four to a packet: these are the leaves. A
// packet of the next level holds the boxes around four packets, and so on up to a single one. Children are found by
// counting: there are no pointers.
//
// Boxes are kept as floats. Each coordinate x goes through the same function, (x - origin) * scale rounded to a float,
// which is monotone: so where boxes meet, their float boxes do, and so do the boxes around these. A few boxes seem to
// meet although they are apart, by a ten millionth of the whole.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/geometry/box.h"
#include "base/geometry/morton_order.h"

namespace kerf {

namespace detail {

/// Four numbers; operators act on each.
using FloatFour = float __attribute__((vector_size(16)));

inline FloatFour four(float x) { return FloatFour{x, x, x, x}; }

/// Returns a bit for each of four comparisons.
template <class Mask>
unsigned bits_of(const Mask& mask) {
#ifdef __SSE2__
    return static_cast<unsigned>(__builtin_ia32_movmskps(std::bit_cast<FloatFour>(mask)));
#else
    return static_cast<unsigned>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}

/// A box that four others are compared with: each of its numbers is there four times.
struct BoxQuery {
    std::array<FloatFour, 3> low, high;
};

/// Four boxes side by side.
struct BoxPacket {
    std::array<FloatFour, 3> low, high;

    /// Returns a bit for each of the four boxes, set if it meets the box, borders included.
    unsigned meeting(const BoxQuery& box) const {
        return bits_of((low[0] <= box.high[0]) & (box.low[0] <= high[0]) & (low[1] <= box.high[1]) &
                       (box.low[1] <= high[1]) & (low[2] <= box.high[2]) & (box.low[2] <= high[2]));
    }
    BoxQuery query(int lane) const {
        BoxQuery box;
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = four(low[axis][lane]);
            box.high[axis] = four(high[axis][lane]);
        }
        return box;
    }
    /// The box around all four.
    BoxQuery around() const {
        BoxQuery box;
        for (int axis = 0; axis < 3; ++axis) {
            const FloatFour &l = low[axis], &h = high[axis];
            box.low[axis] = four(std::min(std::min(l[0], l[1]), std::min(l[2], l[3])));
            box.high[axis] = four(std::max(std::max(h[0], h[1]), std::max(h[2], h[3])));
        }
        return box;
    }
    void set(int lane, const std::array<float, 3>& lowest, const std::array<float, 3>& highest) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis][lane] = lowest[axis];
            high[axis][lane] = highest[axis];
        }
    }
    /// Returns four boxes that meet nothing.
    static BoxPacket none() {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        BoxPacket packet;
        for (int axis = 0; axis < 3; ++axis) {
            packet.low[axis] = four(infinity);
            packet.high[axis] = four(-infinity);
        }
        return packet;
    }
};

}  // namespace detail

/// A tree over boxes, each known by its number. Built in O(n) on threads, with the same result for any number of them,
/// and immutable; takes 36 bytes a box, and as many while it is built.
class OverlapTree {
 public:
    static constexpr std::size_t boxes_of_leaf = 4;

    OverlapTree() = default;
    /// Builds a tree over `count` boxes. `box_of(i)`, i below `count`, must not be empty and must have finite
    /// coordinates; it is called several times, from several threads.
    template <class BoxOf>
    OverlapTree(std::size_t count, const BoxOf& box_of) {
        if (count == 0) return;
        scale_to(count, box_of);
        order_ = morton_order(count, [&](std::size_t i) {
            const auto [low, high] = scaled(box_of(i));
            return std::array<float, 3>{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
        });
        add_levels();
        for_ranges_on_threads(leaf_count(), grain, [&](const IndexRange& range) {
            for (std::size_t leaf = range.first; leaf < range.last; ++leaf)
                for (std::size_t i = 0; i < boxes_of_leaf && leaf * boxes_of_leaf + i < order_.size(); ++i) {
                    const auto [low, high] = scaled(box_of(order_[leaf * boxes_of_leaf + i]));
                    packets_[leaf].set(static_cast<int>(i), low, high);
                }
        });
        for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) gather(level);
    }

    std::size_t leaf_count() const { return (order_.size() + boxes_of_leaf - 1) / boxes_of_leaf; }

    /// Calls visit(i, j) for the pairs of boxes that may meet, borders included, of which one is in these leaves and
    /// the other in the same leaf or a later one, until visit returns true. Returns whether it did. So all leaves
    /// together give each pair once, in an order that depends on the boxes alone.
    template <class Visit>
    bool any_pair(const IndexRange& leaves, const Visit& visit) const {
        for (std::size_t leaf = leaves.first; leaf < leaves.last; ++leaf)
            if (any_pair_of(leaf, visit)) return true;
        return false;
    }

    /// Calls visit(i) for the boxes that may meet `box`, borders included, until it returns true. Returns whether it
    /// did. The order is the same every time.
    template <class Visit>
    bool any_meeting(const Box& box, const Visit& visit) const {
        if (order_.empty()) return false;
        const auto [low, high] = scaled(box);
        detail::BoxPacket packet;
        packet.set(0, low, high);
        const detail::BoxQuery query = packet.query(0);
        return any_leaf(level_begin_.size() - 2, 0, query, [&](std::size_t leaf) {
            return any_lane(packets_[leaf].meeting(query),
                            [&](unsigned lane) { return visit(order_[leaf * boxes_of_leaf + lane]); });
        });
    }

 private:
    static constexpr std::size_t grain = 1 << 12;

    // Maps a coordinate to a number between 0 and 1; takes a quarter of it first, as differences may overflow.
    float scaled(double x, int axis) const { return static_cast<float>((x * 0.25 - origin_[axis]) * scale_); }
    std::pair<std::array<float, 3>, std::array<float, 3>> scaled(const Box& box) const {
        std::pair<std::array<float, 3>, std::array<float, 3>> both;
        for (int axis = 0; axis < 3; ++axis) {
            both.first[axis] = scaled(box.min()[axis], axis);
            both.second[axis] = scaled(box.max()[axis], axis);
        }
        return both;
    }
    template <class BoxOf>
    void scale_to(std::size_t count, const BoxOf& box_of) {
        Box all;
        for (const Box& box : values_of_ranges(count, grain, [&](const IndexRange& range) {
                 Box around;
                 for (std::size_t i = range.first; i < range.last; ++i) around.extend(box_of(i));
                 return around;
             }))
            all.extend(box);
        origin_ = all.min() * 0.25;
        const double extent = (all.max() * 0.25 - origin_).maxCoeff();
        scale_ = extent > 1e-300 ? 1 / extent : 1;
    }
    void add_levels() {
        std::size_t count = leaf_count();
        level_begin_ = {0, count};
        for (; count > 1; level_begin_.push_back(level_begin_.back() + count))
            count = (count + boxes_of_leaf - 1) / boxes_of_leaf;
        packets_.assign(level_begin_.back(), detail::BoxPacket::none());
    }
    // Fills a level with the boxes around the packets of the level below.
    void gather(std::size_t level) {
        const std::size_t begin = level_begin_[level], below = level_begin_[level - 1];
        for_ranges_on_threads(begin - below, 4 * grain, [&](const IndexRange& range) {
            for (std::size_t i = range.first; i < range.last; ++i) {
                const detail::BoxQuery box = packets_[below + i].around();
                const auto numbers = [](const auto& fours) {
                    return std::array<float, 3>{fours[0][0], fours[1][0], fours[2][0]};
                };
                packets_[begin + i / 4].set(static_cast<int>(i % 4), numbers(box.low), numbers(box.high));
            }
        });
    }

    template <class OfLane>
    static bool any_lane(unsigned lanes, const OfLane& of_lane) {
        for (; lanes != 0; lanes &= lanes - 1)
            if (of_lane(static_cast<unsigned>(std::countr_zero(lanes)))) return true;
        return false;
    }
    // Calls of_leaf(leaf) for the leaves below a packet all of whose ancestors' boxes meet the query.
    template <class OfLeaf>
    bool any_leaf(std::size_t level, std::size_t packet, const detail::BoxQuery& query, const OfLeaf& of_leaf) const {
        if (level == 0) return of_leaf(packet);
        return any_lane(packets_[level_begin_[level] + packet].meeting(query), [&](unsigned lane) {
            return any_leaf(level - 1, boxes_of_leaf * packet + lane, query, of_leaf);
        });
    }
    template <class Visit>
    bool any_pair_of(std::size_t leaf, const Visit& visit) const {
        const detail::BoxPacket& own = packets_[leaf];
        const std::size_t first = leaf * boxes_of_leaf;
        const auto count = static_cast<unsigned>(std::min(boxes_of_leaf, order_.size() - first));
        std::array<detail::BoxQuery, boxes_of_leaf> queries;
        for (unsigned i = 0; i < count; ++i) queries[i] = own.query(static_cast<int>(i));
        const auto visit_with = [&](unsigned i, std::size_t other, unsigned lanes) {
            return any_lane(lanes, [&](unsigned j) { return visit(order_[first + i], order_[other + j]); });
        };
        for (unsigned i = 0; i < count; ++i)
            if (visit_with(i, first, own.meeting(queries[i]) & (0xeU << i))) return true;
        const detail::BoxQuery around = own.around();
        const auto of_leaf = [&](std::size_t other) {
            for (unsigned i = 0; i < count; ++i)
                if (visit_with(i, other * boxes_of_leaf, packets_[other].meeting(queries[i]))) return true;
            return false;
        };
        // The later leaves lie below the later children of the packets above.
        std::size_t packet = leaf;
        for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) {
            const auto child = static_cast<unsigned>(packet % boxes_of_leaf);
            packet /= boxes_of_leaf;
            const unsigned later = packets_[level_begin_[level] + packet].meeting(around) & (0xeU << child);
            if (any_lane(later, [&](unsigned lane) {
                    return any_leaf(level - 1, boxes_of_leaf * packet + lane, around, of_leaf);
                }))
                return true;
        }
        return false;
    }

    Vec3 origin_ = Vec3::Zero();
    double scale_ = 1;
    std::vector<std::int32_t> order_;            // numbers of boxes; the boxes of a leaf lie side by side
    std::vector<detail::BoxPacket> packets_;     // level by level, leaves first
    std::vector<std::size_t> level_begin_ = {};  // the first packet of each level, and the end of the last
};

}  // namespace kerf
