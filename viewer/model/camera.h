// Where one looks from, and the ways to move there.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Geometry>

#include "core/types.h"

namespace kerf::view {

/// Coordinates are those of the file. `height` is what is seen of the plane through the target, from the lower to the
/// upper border of the viewport, in perspective too: so both projections show the target alike.
struct Camera {
    Vec3 target = Vec3::Zero();
    Eigen::Quaterniond turn =
        Eigen::Quaterniond::Identity();  ///< eye coordinates (x right, y up, z to the eye) to file
    double height = 1;
    bool perspective = true;

    Vec3 right() const { return turn * Vec3::UnitX(); }
    Vec3 up() const { return turn * Vec3::UnitY(); }
    Vec3 back() const { return turn * Vec3::UnitZ(); }  ///< from the target to the eye
    double distance() const;                            ///< of the eye from the target

    bool operator==(const Camera&) const = default;
};

/// The file's coordinates in draw coordinates: the box is centred at the origin, its diagonal is 2 long.
struct Frame {
    Vec3 center = Vec3::Zero();
    double scale = 1;  ///< draw = (file - center) * scale

    static Frame around(const Eigen::AlignedBox3d& box);
    Vec3 to_draw(const Vec3& p) const { return (p - center) * scale; }
    Vec3 to_file(const Vec3& p) const { return p / scale + center; }
    std::array<float, 3> draw(const Vec3& p) const {
        const Vec3 q = to_draw(p);
        return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z())};
    }
};

/// Where a point is seen from the target, in fractions of the viewport's height, y up; none: behind the eye.
std::optional<Eigen::Vector2d> seen_from_target(const Camera& camera, const Vec3& point);

/// Where the scene is looked at from and where on the picture it goes.
struct Projection {
    Eigen::Matrix4f view = Eigen::Matrix4f::Identity();        ///< draw coordinates to eye coordinates
    Eigen::Matrix4f projection = Eigen::Matrix4f::Identity();  ///< eye to clip coordinates
    int x = 0, y = 0;           ///< lower left corner of the viewport in pixels of the picture, y up
    int width = 1, height = 1;  ///< of the viewport in pixels
    float pixel_ratio = 1;      ///< pixels per unit of line widths; 2 on a HiDPI screen
};

/// Named directions as in Blender; the z axis is up.
enum class Direction { front, back, right, left, top, bottom, corner };
/// `up`: another axis (0 to 2) that points up instead. Then the front has x to the right where y is up, y where x is.
void look_from(Camera& camera, Direction direction, int up = 2);
/// `back`: from the target to the eye, of length 1. The z axis is up where it can be.
void look_from(Camera& camera, const Vec3& back);

/// Fits a sphere around the box into a viewport of the given width over height.
void fit(Camera& camera, const Eigen::AlignedBox3d& box, double aspect);

/// Moves by a drag in fractions of the viewport's height; y is down as on screens.
void orbit(Camera& camera, double dx, double dy);
void pan(Camera& camera, double dx, double dy);
/// Moves the target along the line of sight to the depth of a point that lies before the eye; the picture stays.
void focus_depth(Camera& camera, const Vec3& point);
/// Zooms by a factor below 1 to come closer, so that what is at the cursor stays there. The cursor: from the centre of
/// the viewport, in fractions of its height, y up.
void zoom_at(Camera& camera, double factor, double x, double y);

/// The matrices for a viewport of this size. `box` in coordinates of the file: everything that is drawn; it sets the
/// near and far planes.
Projection project(const Camera& camera, const Frame& frame, const Eigen::AlignedBox3d& box, int width, int height);
/// Moves the target from the centre of the viewport, in fractions of half its width and height, y up.
void move_center(Projection& projection, double x, double y);

}  // namespace kerf::view
