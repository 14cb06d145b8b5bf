// The camera is a target, a rotation (`turn`) and the height of the piece of the plane through the target that fills
// the viewport. The eye lies on the axis `back`, at the distance at which that height is seen under 30 degrees: zooming
// is a change of the height alone, and both projections show the target's plane alike. An orbit turns about the axis
// that is up first and about the eye's x axis then, so that up stays up; where the camera stands on its head the first
// turn is reversed, so that the body follows the cursor. Near and far planes enclose the box of all that is drawn. In
// perspective the near one is never closer to the eye than a hundredth of the target's distance, because the precision
// of depths is lost otherwise.
#include "viewer/model/camera.h"

#include <algorithm>
#include <cmath>

namespace kerf::view {

namespace {

constexpr double half_field_of_view = 15 * M_PI / 180;  // from the middle to the upper border
constexpr double margin = 1.08;                         // factor of the size of what is fitted
constexpr double orbit_per_height = M_PI;               // a drag over the whole viewport turns by half a turn

Eigen::Quaterniond turn_of(const Vec3& right, const Vec3& up) {
    Eigen::Matrix3d columns;
    columns << right, up, right.cross(up);
    return Eigen::Quaterniond(columns).normalized();
}

// Distances of the box's nearest and farthest point along the view, from the eye.
std::array<double, 2> depth_range(const Camera& camera, const Eigen::AlignedBox3d& box) {
    const Vec3 eye = camera.target + camera.distance() * camera.back();
    const double middle = (eye - box.center()).dot(camera.back());
    const double half = box.sizes().cwiseAbs().dot(camera.back().cwiseAbs()) / 2;
    return {middle - half, middle + half};
}

}  // namespace

double Camera::distance() const { return height / 2 / std::tan(half_field_of_view); }

std::optional<Eigen::Vector2d> seen_from_target(const Camera& camera, const Vec3& point) {
    const Vec3 from_target = camera.turn.conjugate() * (point - camera.target);
    const double distance = camera.distance(), depth = distance - from_target.z();
    if (camera.perspective && !(depth > 0)) return std::nullopt;
    const double nearer = camera.perspective ? distance / depth : 1;
    return Eigen::Vector2d(nearer / camera.height * from_target.head<2>());
}

Frame Frame::around(const Eigen::AlignedBox3d& box) {
    Frame frame;
    if (box.isEmpty()) return frame;
    frame.center = box.center();
    const double diagonal = box.diagonal().norm();
    frame.scale = diagonal > 0 ? 2 / diagonal : 1;
    return frame;
}

void look_from(Camera& camera, Direction direction, int up) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    switch (direction) {
        case Direction::front:
            camera.turn = turn_of(x, z);
            break;
        case Direction::back:
            camera.turn = turn_of(-x, z);
            break;
        case Direction::right:
            camera.turn = turn_of(y, z);
            break;
        case Direction::left:
            camera.turn = turn_of(-y, z);
            break;
        case Direction::top:
            camera.turn = turn_of(x, y);
            break;
        case Direction::bottom:
            camera.turn = turn_of(x, -y);
            break;
        case Direction::corner:
            look_from(camera, Vec3(0.5, -0.8, 0.5).normalized());
            break;
    }
    if (up == 1) camera.turn = turn_of(x, -z) * camera.turn;
    if (up == 0) camera.turn = turn_of(y, z) * camera.turn;
}

void look_from(Camera& camera, const Vec3& back, int up) {
    Vec3 right = Vec3::Unit(up).cross(back);
    if (right.norm() < 1e-3) right = camera.right() - back * back.dot(camera.right());
    if (right.norm() < 1e-3) right = back.unitOrthogonal();
    right.normalize();
    camera.turn = turn_of(right, back.cross(right));
}

// A point at x beside the target and z before it is seen inside of the borders if |x| + s z <= s d, where s is the
// slope of the border's ray and d the distance of the eye, s d half of what is seen at the target.
void fit(Camera& camera, std::span<const Vec3> points, double aspect) {
    if (points.empty()) return;
    const auto reach = [&](const Vec3& axis) {
        double most = -HUGE_VAL;
        for (const Vec3& p : points) most = std::max(most, axis.dot(p));
        return most;
    };
    const Vec3 back = camera.back();
    const double depth = (reach(back) - reach(-back)) / 2;
    double wanted = 0;
    camera.target = depth * back;
    aspect = std::max(aspect, 1e-3);
    for (const auto& [axis, shape] : {std::pair(camera.right(), aspect), {camera.up(), 1.0}}) {
        const double slope = camera.perspective ? shape * std::tan(half_field_of_view) : 0;
        const double low = reach(-axis + slope * back), high = reach(axis + slope * back);
        camera.target += (high - low) / 2 * axis;
        wanted = std::max(wanted, ((high + low) / 2 - slope * depth) / shape);
    }
    camera.height = std::max(2 * margin * wanted, 1e-300);
}

void fit(Camera& camera, const Eigen::AlignedBox3d& box, double aspect) {
    if (box.isEmpty()) return;
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i) corners[i] = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    fit(camera, corners, aspect);
}

void orbit(Camera& camera, double dx, double dy, int up) {
    // About the vertical axis of the file first, so that up stays up.
    const double side = camera.up()[up] < 0 ? -1 : 1;
    const Eigen::AngleAxisd about_up(-side * dx * orbit_per_height, Vec3::Unit(up));
    const Eigen::AngleAxisd about_right(-dy * orbit_per_height, Vec3::UnitX());
    camera.turn = (about_up * camera.turn * about_right).normalized();
}

void pan(Camera& camera, double dx, double dy) {
    camera.target += camera.height * (-dx * camera.right() + dy * camera.up());
}

void focus_depth(Camera& camera, const Vec3& point) {
    const double nearer = (point - camera.target).dot(camera.back()), distance = camera.distance();
    if (!(nearer < distance)) return;
    camera.target += nearer * camera.back();
    if (camera.perspective) camera.height *= (distance - nearer) / distance;
}

void zoom_at(Camera& camera, double factor, double x, double y) {
    const double height = camera.height * factor;
    camera.target += (camera.height - height) * (x * camera.right() + y * camera.up());
    camera.height = height;
}

Projection project(const Camera& camera, const Frame& frame, const Eigen::AlignedBox3d& box, int width, int height) {
    Projection p;
    p.width = width;
    p.height = height;
    const double distance = camera.distance() * frame.scale, half = camera.height * frame.scale / 2;
    const Eigen::Matrix3d to_eye = camera.turn.toRotationMatrix().transpose();
    Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
    view.topLeftCorner<3, 3>() = to_eye;
    view.topRightCorner<3, 1>() = -to_eye * frame.to_draw(camera.target) - Vec3(0, 0, distance);
    const double aspect = static_cast<double>(width) / height;
    auto [near, far] = depth_range(camera, box);
    const double slack = 0.01 * (far - near) + 1e-9;
    near = (near - slack) * frame.scale;
    far = (far + slack) * frame.scale;
    Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
    if (camera.perspective) {
        near = std::max(near, distance / 100);
        far = std::max(far, 2 * near);
        projection(0, 0) = distance / half / aspect;
        projection(1, 1) = distance / half;
        projection(2, 2) = -(far + near) / (far - near);
        projection(2, 3) = -2 * far * near / (far - near);
        projection(3, 2) = -1;
    } else {
        projection(0, 0) = 1 / half / aspect;
        projection(1, 1) = 1 / half;
        projection(2, 2) = -2 / (far - near);
        projection(2, 3) = -(far + near) / (far - near);
        projection(3, 3) = 1;
    }
    p.view = view.cast<float>();
    p.projection = projection.cast<float>();
    return p;
}

void move_center(Projection& projection, double x, double y) {
    Eigen::Matrix4f& m = projection.projection;
    m.row(0) += static_cast<float>(x) * m.row(3).eval();
    m.row(1) += static_cast<float>(y) * m.row(3).eval();
}

}  // namespace kerf::view
