// Axes of their own for the degrees of freedom of nodes that are held askew.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Up to three displacements that are prescribed to a node, each along a unit vector, the first ones taking precedence.
/// Vectors need not be at right angles: of a later one the component at right angles to the earlier ones is kept (Gram
/// and Schmidt).
class NodeHolds {
 public:
    /// The sine of the smallest angle between a new direction and the held ones; below it the direction adds nothing:
    /// noise of coordinates must not hold a node.
    static constexpr double least_sine = 1e-3;

    /// Prescribes the displacement `value` along `direction`, for the support `holder`, unless that direction is held
    /// already. `sine`: as least_sine.
    void hold(Vec3 direction, double value, std::int32_t holder, double sine = least_sine);

    int count() const { return count_; }
    std::int32_t holder(int i) const { return holders_[i]; }
    /// Returns orthonormal rows: the axes that are held, in their order, then the free ones.
    Eigen::Matrix3d axes() const;
    /// Returns the displacement along axis i of axes().
    double value(int i) const { return values_[i]; }
    /// Returns the directions as they were given, as columns, then the free axes.
    Eigen::Matrix3d directions() const;
    /// Returns whether all directions are along x, y or z: then value(i), up to its sign, is that of component(i).
    bool is_global() const;
    int component(int i) const;

 private:
    int count_ = 0;
    std::array<Vec3, 3> axes_, directions_;
    std::array<double, 3> values_{};
    std::array<std::int32_t, 3> holders_{};
};

/// The axes of nodes that have axes of their own. Degree of freedom 3 n + i of such a node is the displacement along
/// its axis i.
class NodeFrames {
 public:
    struct Frame {
        Eigen::Matrix3d axes;        ///< orthonormal rows
        Eigen::Matrix3d directions;  ///< unit columns: the direction in which the holder of degree of freedom i pushes
        Eigen::Matrix3d shares;      ///< the inverse of `directions`: the components of a force along them
    };

    NodeFrames() = default;
    explicit NodeFrames(std::size_t nodes) : of_node_(nodes, none) {}

    void set(std::int32_t node, const NodeHolds& holds);
    bool empty() const { return frames_.empty(); }
    /// Returns the axes of a node, or nullptr if they are x, y and z.
    const Frame* at(std::int32_t node) const {
        return empty() || of_node_[node] == none ? nullptr : &frames_[of_node_[node]];
    }
    /// Returns the direction of a degree of freedom.
    Vec3 axis(std::size_t dof) const {
        const Frame* frame = at(dof / 3);
        return frame ? Vec3(frame->axes.row(dof % 3)) : Vec3(Vec3::Unit(dof % 3));
    }
    /// Returns, along x, y and z, a vector that is given along the axes of the node.
    Vec3 from_frame(std::int32_t node, const Vec3& value) const {
        const Frame* frame = at(node);
        return frame ? Vec3(frame->axes.transpose() * value) : value;
    }
    /// Returns the axes of some of the nodes: those with a new local number, not -1.
    NodeFrames renumbered(const std::vector<std::int32_t>& number) const;
    /// Turn vectors of nodes, three numbers each, for the first nodes or all, to the nodes' own axes and back to x, y
    /// and z.
    void to_frames(std::span<double> of_nodes) const;
    void from_frames(std::span<double> of_nodes) const;

 private:
    static constexpr std::int32_t none = -1;
    std::vector<std::int32_t> of_node_;
    std::vector<Frame> frames_;
};

}  // namespace kerf
