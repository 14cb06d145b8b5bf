#include "viewer/model/view_state.h"

namespace kerf::view {

ValueRange extent_along(const Eigen::AlignedBox3d& box, const Vec3& n) {
    const double middle = n.dot(box.center()), half = n.cwiseAbs().dot(box.sizes()) / 2;
    return {middle - half, middle + half};
}

void face(Clip& clip, const Vec3& back) {
    if (const double towards = clip.normal.dot(back); std::abs(towards) > 1e-9) clip.flipped = towards < 0;
}

void snap_to(Clip& clip, const Plane& plane, const Eigen::AlignedBox3d& box) {
    const ValueRange range = extent_along(box, plane.normal);
    clip.on = true;
    clip.normal = plane.normal;
    if (range.high > range.low)
        clip.position = std::clamp((plane.normal.dot(plane.origin) - range.low) / (range.high - range.low), 0., 1.);
}

}  // namespace kerf::view
