// Supports may hold a node along any directions. They are made orthogonal in their order (Gram and Schmidt), so that
// each held axis is one degree of freedom of the node: a later direction counts by its component at right angles to the
// earlier ones, with the displacement that is left for it, and not at all if that component is too short. Supports
// still push along their directions as they were given, so that a force is divided among them by the inverse of the
// matrix of directions (`shares`), not along the axes. Directions that are x, y or z but for rounding become these
// exactly, and a node with such directions alone needs no frame.
#include "solve/multigrid/node_frames.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/core/ids.h"

namespace kerf {

namespace {

// Returns x, y or z, with a sign, for a direction that differs from it by rounding; else the direction.
Vec3 without_rounding(const Vec3& direction) {
    for (int c = 0; c < 3; ++c)
        if (std::abs(direction[c]) > 1 - 1e-14) return std::copysign(1.0, direction[c]) * Vec3::Unit(c);
    return direction;
}

template <class Turn>
void turn_nodes(const NodeFrames& frames, std::span<double> of_nodes, const Turn& turn) {
    if (frames.empty()) return;
    for (std::size_t n = 0; n < of_nodes.size() / 3; ++n) {
        const NodeFrames::Frame* frame = frames.at(n);
        if (!frame) continue;
        Eigen::Map<Vec3> value(&of_nodes[3 * n]);
        value = turn(frame->axes, Vec3(value));
    }
}

}  // namespace

void NodeHolds::hold(Vec3 direction, double value, std::int32_t holder, double sine) {
    if (count_ == 3) return;
    direction = without_rounding(direction);
    Vec3 rest = direction;
    double of_rest = value;
    for (int i = 0; i < count_; ++i) {
        const double along = direction.dot(axes_[i]);
        rest -= along * axes_[i];
        of_rest -= along * values_[i];
    }
    const double length = rest.norm();
    if (length < sine) return;
    axes_[count_] = without_rounding(rest / length);
    values_[count_] = of_rest / length;
    directions_[count_] = direction;
    holders_[count_] = holder;
    ++count_;
}

Eigen::Matrix3d NodeHolds::axes() const {
    std::array<Vec3, 3> all = axes_;
    if (count_ == 1) {
        Eigen::Index least = 0;
        all[0].cwiseAbs().minCoeff(&least);
        all[1] = all[0].cross(Vec3::Unit(least)).normalized();
    }
    if (count_ < 3) all[2] = all[0].cross(all[1]);
    Eigen::Matrix3d rows;
    for (int i = 0; i < 3; ++i) rows.row(i) = all[i];
    return rows;
}

Eigen::Matrix3d NodeHolds::directions() const {
    Eigen::Matrix3d columns = axes().transpose();
    for (int i = 0; i < count_; ++i) columns.col(i) = directions_[i];
    return columns;
}

bool NodeHolds::is_global() const {
    for (int i = 0; i < count_; ++i)
        if (directions_[i].cwiseAbs().maxCoeff() != 1) return false;
    return true;
}

int NodeHolds::component(int i) const {
    Eigen::Index largest = 0;
    directions_[i].cwiseAbs().maxCoeff(&largest);
    return largest;
}

void NodeFrames::set(std::int32_t node, const NodeHolds& holds) {
    of_node_[node] = count_of(frames_);
    const Eigen::Matrix3d directions = holds.directions();
    frames_.push_back({holds.axes(), directions, directions.inverse()});
}

NodeFrames NodeFrames::renumbered(const std::vector<std::int32_t>& number) const {
    NodeFrames some;
    if (empty()) return some;
    for (std::size_t n = 0; n < number.size(); ++n) {
        if (number[n] < 0) continue;
        const std::size_t place = number[n];
        if (place >= some.of_node_.size()) some.of_node_.resize(place + 1, none);
        some.of_node_[place] = of_node_[n];
    }
    some.frames_ = frames_;
    return some;
}

void NodeFrames::to_frames(std::span<double> of_nodes) const {
    turn_nodes(*this, of_nodes, [](const Eigen::Matrix3d& axes, const Vec3& v) -> Vec3 { return axes * v; });
}

void NodeFrames::from_frames(std::span<double> of_nodes) const {
    turn_nodes(*this, of_nodes,
               [](const Eigen::Matrix3d& axes, const Vec3& v) -> Vec3 { return axes.transpose() * v; });
}

}  // namespace kerf
