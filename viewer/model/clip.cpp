#include <algorithm>
#include <cmath>

#include "viewer/model/view_state.h"

namespace kerf::view {

ValueRange extent_along(const Eigen::AlignedBox3d& box, const Vec3& n) {
    const double middle = n.dot(box.center()), half = n.cwiseAbs().dot(box.sizes()) / 2;
    return {middle - half, middle + half};
}

double position_of(const Clip& clip, const Eigen::AlignedBox3d& box) {
    const ValueRange range = extent_along(box, clip.normal);
    const double length = range.high - range.low, place = range.low + clip.position * length;
    if (!(length > 0)) return place;
    const double step = std::pow(10, std::ceil(std::log10(1e-6 * length)));
    return std::abs(place) < 10 * step ? 0 : std::round(place / step) * step;
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

void keep(Clip& clip, const std::vector<Vec3>& points, const Eigen::AlignedBox3d& box) {
    const ValueRange range = extent_along(box, clip.normal);
    const double length = range.high - range.low;
    if (points.empty() || !(length > 0)) return;
    ValueRange kept = {1, 0};
    for (const Vec3& p : points) {
        const double place = (clip.normal.dot(p) - range.low) / length;
        kept = {std::min(kept.low, place), std::max(kept.high, place)};
    }
    constexpr double beyond_rounding = 1e-6;
    double& position = clip.position;
    if (clip.style == ClipStyle::layer)
        position = std::clamp((kept.low + kept.high) / 2, 0., 1.);
    else if (clip.flipped)
        position = std::clamp(kept.low - beyond_rounding, 0., position);
    else
        position = std::clamp(kept.high + beyond_rounding, position, 1.);
}

}  // namespace kerf::view
