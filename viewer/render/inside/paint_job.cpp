#include "viewer/render/inside/paint_job.h"

#include <algorithm>
#include <array>

namespace kerf::view {

namespace {

using Corners = std::array<Eigen::Vector4f, 8>;

Corners corners_of(const Eigen::AlignedBox3f& box) {
    Corners corners;
    for (int i = 0; i < 8; ++i) corners[i] = box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i)).homogeneous();
    return corners;
}

// Whether all corners, moved by `offset`, lie on the positive side of the plane.
bool all_before(const Corners& corners, const Eigen::Vector3f& offset, const Eigen::Vector4f& plane) {
    return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector4f& corner) {
        return plane.dot(corner) + plane.head<3>().dot(offset) >= 0;
    });
}

}  // namespace

bool PaintJob::hides_backs() const {
    if (!layer.closed || geometry.box().isEmpty()) return false;
    const Corners corners = corners_of(geometry.box());
    if (!all_before(corners, Eigen::Vector3f::Zero(), Eigen::Vector4f(clip_plane().data()))) return false;
    const Eigen::Matrix4f transform = projection.projection * projection.view;
    const Eigen::Vector4f near = transform.row(2) + transform.row(3);
    return std::all_of(layer.ranges.begin(), layer.ranges.end(), [&](const Range& range) {
        return all_before(corners, Eigen::Vector3f(range.offset.data()), near);
    });
}

}  // namespace kerf::view
