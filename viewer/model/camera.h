// The camera, and the ways to move it.
#pragma once

#include <array>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "base/core/types.h"

namespace kerf::view {

/// The camera, in coordinates of the file. `height` is the height of the visible piece of the plane through the target,
/// from the lower to the upper border of the viewport, in perspective too, so that both projections show the target
/// alike.
struct Camera {
    Vec3 target = Vec3::Zero();
    Eigen::Quaterniond turn =
        Eigen::Quaterniond::Identity();  ///< rotates eye coordinates (x right, y up, z to the eye) to the file's
    double height = 1;
    bool perspective = true;

    Vec3 right() const { return turn * Vec3::UnitX(); }
    Vec3 up() const { return turn * Vec3::UnitY(); }
    Vec3 back() const { return turn * Vec3::UnitZ(); }  ///< direction from the target to the eye
    double distance() const;                            ///< distance of the eye from the target

    bool operator==(const Camera&) const = default;
};

/// The map from the file's coordinates to draw coordinates, in which the box is centred at the origin and its diagonal
/// is 2 long.
struct Frame {
    Vec3 center = Vec3::Zero();
    double scale = 1;  ///< draw = (file - center) * scale

    static Frame around(const Eigen::AlignedBox3d& box);
    Vec3 to_draw(const Vec3& p) const { return (p - center) * scale; }
    Vec3 to_file(const Vec3& p) const { return p / scale + center; }
    std::array<float, 3> draw(const Vec3& p) const {
        const Eigen::Vector3f q = to_draw(p).cast<float>();
        return {q.x(), q.y(), q.z()};
    }
};

/// Returns the offset of a point from the target in the picture, in fractions of the viewport's height, y up; none in
/// perspective for a point that lies behind the eye.
std::optional<Eigen::Vector2d> seen_from_target(const Camera& camera, const Vec3& point);

/// The matrices from the scene to the picture, and the viewport in it.
struct Projection {
    Eigen::Matrix4f view = Eigen::Matrix4f::Identity();        ///< draw coordinates to eye coordinates
    Eigen::Matrix4f projection = Eigen::Matrix4f::Identity();  ///< eye to clip coordinates
    int x = 0, y = 0;           ///< lower left corner of the viewport in pixels of the picture, y up
    int width = 1, height = 1;  ///< size of the viewport in pixels
    float pixel_ratio = 1;      ///< pixels per unit of line widths; 2 on a HiDPI screen
};

/// Named directions as in Blender; the z axis is up.
enum class Direction { front, back, right, left, top, bottom, corner };
/// Turns the camera to a named direction. `up` is the axis (0 to 2) that points up; the front has x to the right where
/// z or y is up, and y where x is.
void look_from(Camera& camera, Direction direction, int up = 2);
/// Turns the camera so that `back`, of length 1, leads from the target to the eye. The axis `up` is up where it can be.
void look_from(Camera& camera, const Vec3& back, int up = 2);

/// Moves target and height so that the points, as they are seen from the present direction, fill a viewport but for a
/// small margin, in its middle. `aspect` is width over height.
void fit(Camera& camera, std::span<const Vec3> points, double aspect);
/// Fits the corners of a box.
void fit(Camera& camera, const Eigen::AlignedBox3d& box, double aspect);

/// Turns the camera about the target by a drag in fractions of the viewport's height; y is down as on screens. `up` is
/// the axis that points up.
void orbit(Camera& camera, double dx, double dy, int up = 2);
/// Moves the target with the cursor by a drag in fractions of the viewport's height; y is down as on screens.
void pan(Camera& camera, double dx, double dy);
/// Moves the target along the line of sight to the depth of a point that lies before the eye; the picture stays.
void focus_depth(Camera& camera, const Vec3& point);
/// Zooms by a factor, below 1 to come closer, so that the point of the target's plane under the cursor stays there. The
/// cursor (x, y) is given from the centre of the viewport, in fractions of its height, y up.
void zoom_at(Camera& camera, double factor, double x, double y);

/// Returns the matrices for a viewport of this size. `box`, in coordinates of the file, holds everything that is drawn;
/// it sets the near and far planes.
Projection project(const Camera& camera, const Frame& frame, const Eigen::AlignedBox3d& box, int width, int height);
/// Moves the picture of the target from the centre of the viewport to (x, y), in fractions of half its width and
/// height, y up.
void move_center(Projection& projection, double x, double y);

}  // namespace kerf::view
