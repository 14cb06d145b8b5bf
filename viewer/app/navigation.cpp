// Where the camera stands: what it frames, flies to and turns to, and what of the scene fits beside the legend.
#include <algorithm>

#include "viewer/app/app.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

Eigen::AlignedBox3d framed_box(const std::vector<Vec3>& points, double least) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 more = Vec3::Constant(least) + box.sizes();
    return {box.min() - more, box.max() + more};
}

}  // namespace

void App::frame_selection() {
    const double diagonal = session_.document().box.diagonal().norm();
    const std::vector<Vec3> points = selected_points(session_, state_.selection);
    if (!points.empty()) {
        camera_.target = framed_box(points, 0.01 * diagonal).center();
        Camera framed = camera_;
        fit_body(framed, framed_box(points, 0.01 * diagonal));
        state_.camera = framed;
    } else if (const auto surface = surface_of(session_, state_.node)) {
        Camera framed = camera_;
        fit_body(framed, framed_box(surface->vertices, 0));
        framed.height /= 2;
        state_.camera = framed;
    }
}

void App::fly_to(const Vec3& point, double radius, const Vec3& back) {
    Camera camera = camera_;
    if (back.squaredNorm() > 0 && !back.isApprox(camera.back())) look_from(camera, back);
    camera.target = point;
    camera.height = std::max(6 * radius, 1e-4 * session_.document().box.diagonal().norm());
    state_.camera = camera_ = camera;
    if (state_.selection.kind != Selection::Kind::cell) {
        state_.selection = {};
        state_.selection.kind = Selection::Kind::place;
        state_.selection.owner = state_.node;
        state_.selection.place = point;
    }
}

void App::resolve_turn() {
    if (!turning_to_) return;
    const Selection& s = *turning_to_;
    const auto cells = session_.cells(s.owner);
    const auto part = session_.part_surface(s.owner), shown = surface_of(session_, state_.node);
    const bool is_known = cells && part && shown;
    if (!is_known && session_.pending()) return;
    if (is_known && state_.selection == s && state_.camera)
        if (const auto back = direction_to_cell(*cells, *part, *shown, s.index, camera_.back())) {
            if (!back->isApprox(state_.camera->back())) look_from(*state_.camera, *back);
            wake();
        }
    turning_to_.reset();
}

void App::clip_through_selection(bool faces_eye) {
    const std::vector<Vec3> points = selected_points(session_, state_.selection);
    if (points.empty() || session_.document().box.isEmpty()) return notify("Select something to clip through first.");
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    // What lies towards the eye is cut away.
    const Vec3 normal = faces_eye ? camera_.back() : state_.clip.normal;
    if (faces_eye) state_.clip.flipped = false;
    snap_to(state_.clip, Plane(middle, normal), session_.document().box);
}

void App::look(Direction direction) {
    Camera camera = camera_;
    look_from(camera, direction);
    state_.camera = camera;
}

// Without a camera in the state everything fits, whatever is shown.
void App::update_camera() {
    if (state_.camera) {
        camera_ = *state_.camera;
        return;
    }
    camera_ = {};
    const Clip& clip = state_.clip;
    const bool fits_rest = chosen_.faces_clip && clip.on && !built_.left.isEmpty();
    if (chosen_.turn)
        camera_.turn = *chosen_.turn;
    else if (fits_rest)
        look_from(camera_, clip.flipped ? Vec3(-clip.normal) : clip.normal);
    else
        look_from(camera_, Direction::corner);
    fit_body(camera_, fits_rest ? built_.left : built_.box);
}

void App::project_scene() {
    projection_ =
        project(camera_, built_.frame, built_.box, static_cast<int>(area_.width), static_cast<int>(area_.height));
    move_center(projection_, (2 * body_.x + body_.width - 2 * area_.x - area_.width) / std::max(area_.width, 1.f),
                -(2 * body_.y + body_.height - 2 * area_.y - area_.height) / std::max(area_.height, 1.f));
    projection_.x = static_cast<int>(area_.x);
    projection_.y = size_.height - static_cast<int>(area_.y + area_.height);
    projection_.pixel_ratio = size_.scale;
    renderer_.resize(size_.width, size_.height);
}

// Into what the legend leaves of the scene.
void App::fit_body(Camera& camera, const Eigen::AlignedBox3d& box) const {
    const float height = std::max(body_.height, 1.f);
    fit(camera, box, body_.width / height);
    camera.height *= area_.height / height;
}

}  // namespace kerf::view
