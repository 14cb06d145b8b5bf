#include "viewer/render/inside/seen_lines.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace kerf::view {

namespace {

class SeenLines {
 public:
    SeenLines(const Projection& projection, std::span<const std::uint32_t> ids)
        : matrix_(projection.projection * projection.view),
          width_(projection.width),
          height_(projection.height),
          ids_(ids) {}

    void add(const Layer& layer, std::uint32_t surface) {
        const Range& range = layer.ranges.front();
        const Eigen::Vector3f offset(range.offset[0], range.offset[1], range.offset[2]);
        for (std::size_t i = 0; i < layer.geometry->segments.size(); ++i) {
            const Segment& segment = layer.geometry->segments[i];
            const Geometry::Origin& origin = layer.geometry->origins[i];
            const Eigen::Vector2f from = pixel_of(segment.from, offset), to = pixel_of(segment.to, offset);
            if (shows((from + to) / 2, surface, origin.triangle)) seen.push_back({origin.value, from, to});
        }
    }

    std::vector<SeenSegment> seen;

 private:
    // The place of a point on the picture; far outside if it lies behind the eye.
    Eigen::Vector2f pixel_of(const std::array<float, 3>& p, const Eigen::Vector3f& offset) const {
        const Eigen::Vector3f moved = Eigen::Vector3f(p[0], p[1], p[2]) + offset;
        const Eigen::Vector4f clip = matrix_ * moved.homogeneous();
        if (!(clip.w() > 0)) return {-1e6f, -1e6f};
        return {(clip.x() / clip.w() + 1) / 2 * width_, (clip.y() / clip.w() + 1) / 2 * height_};
    }

    bool shows(const Eigen::Vector2f& place, std::uint32_t layer, std::uint32_t triangle) const {
        if (!(place.x() >= 0 && place.y() >= 0)) return false;
        const auto x = static_cast<std::int64_t>(place.x()), y = static_cast<std::int64_t>(place.y());
        for (std::int64_t row = std::max<std::int64_t>(0, y - 1); row <= std::min<std::int64_t>(height_ - 1, y + 1);
             ++row)
            for (std::int64_t column = std::max<std::int64_t>(0, x - 1);
                 column <= std::min<std::int64_t>(width_ - 1, x + 1); ++column) {
                const std::int64_t at = 4 * (row * width_ + column);
                if (ids_[at] == layer && ids_[at + 1] == triangle) return true;
            }
        return false;
    }

    Eigen::Matrix4f matrix_;
    std::int64_t width_, height_;
    std::span<const std::uint32_t> ids_;
};

}  // namespace

std::vector<SeenSegment> seen_lines(const Scene& scene, const Projection& projection,
                                    std::span<const std::uint32_t> ids) {
    SeenLines lines(projection, ids);
    for (const Layer& layer : scene.layers)
        if (layer.lies_on >= 0) lines.add(layer, layer.lies_on + 1);
    return std::move(lines.seen);
}

}  // namespace kerf::view
