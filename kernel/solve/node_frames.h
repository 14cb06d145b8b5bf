// Axes of their own for the degrees of freedom of nodes that are held askew.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Up to three displacements that a node is given, each along a unit vector, the first ones counting. Vectors need not
/// be at right angles: what a later one says beside the earlier ones is kept (Gram and Schmidt).
class NodeHolds {
 public:
    /// Directions at a smaller angle to what is held already add nothing: noise of coordinates must not hold a node.
    static constexpr double least_sine = 1e-3;

    /// The displacement along `direction` is `value`, by the support `holder`. Nothing, if that is held already.
    /// `sine`: of the angle to what is held that is needed.
    void hold(Vec3 direction, double value, std::int32_t holder, double sine = least_sine);

    int count() const { return count_; }
    std::int32_t holder(int i) const { return holders_[i]; }
    /// Orthonormal rows: what is held, in its order, then what is free.
    Eigen::Matrix3d axes() const;
    /// Along axis i of axes().
    double value(int i) const { return values_[i]; }
    /// As they were given, as columns; then free axes.
    Eigen::Matrix3d directions() const;
    /// Whether all directions are those of x, y or z: then value(i) belongs to component(i).
    bool is_global() const;
    int component(int i) const;

 private:
    int count_ = 0;
    std::array<Vec3, 3> axes_, directions_;
    std::array<double, 3> values_{};
    std::array<std::int32_t, 3> holders_{};
};

/// Which nodes have axes of their own. Degree of freedom 3 n + i of such a node is the displacement along its axis i.
class NodeFrames {
 public:
    struct Frame {
        Eigen::Matrix3d axes;        ///< orthonormal rows
        Eigen::Matrix3d directions;  ///< unit columns: along which what holds the degree of freedom i pushes
        Eigen::Matrix3d shares;      ///< the inverse of that: how much force is along each of them
    };

    NodeFrames() = default;
    explicit NodeFrames(std::size_t nodes) : of_node_(nodes, none) {}

    void set(std::int32_t node, const NodeHolds& holds);
    bool empty() const { return frames_.empty(); }
    /// Nothing: x, y and z.
    const Frame* at(std::int32_t node) const {
        return empty() || of_node_[node] == none ? nullptr : &frames_[of_node_[node]];
    }
    /// The direction of a degree of freedom.
    Vec3 axis(std::size_t dof) const {
        const Frame* frame = at(static_cast<std::int32_t>(dof / 3));
        return frame ? Vec3(frame->axes.row(dof % 3)) : Vec3(Vec3::Unit(dof % 3));
    }
    /// What is along the axes of a node, along x, y and z.
    Vec3 from_frame(std::int32_t node, const Vec3& value) const {
        const Frame* frame = at(node);
        return frame ? Vec3(frame->axes.transpose() * value) : value;
    }
    /// Of some of the nodes: those with a new local number, not -1.
    NodeFrames renumbered(const std::vector<std::int32_t>& number) const;
    /// Vectors of nodes, three numbers each, for the first nodes or all.
    void to_frames(std::span<double> of_nodes) const;
    void from_frames(std::span<double> of_nodes) const;

 private:
    static constexpr std::int32_t none = -1;
    std::vector<std::int32_t> of_node_;
    std::vector<Frame> frames_;
};

}  // namespace kerf
