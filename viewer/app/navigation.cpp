// The camera's moves. view_.camera is the camera in use; view_.state.camera is the one that somebody has chosen, and
// none means that everything fits, whatever is shown, so that the camera follows a body that grows. `area` is the
// rectangle of the scene and `body` the part that the legend leaves: the projection covers the area, its centre is
// moved into the middle of the body's part, and fit_body() fits into that part. A zoom first sets the camera's depth to
// the point under the cursor, so that it goes towards that point and not through it. A turn to a cell waits until the
// cells around it have been read (resolve_turn()).
#include "viewer/app/navigation.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "viewer/app/keys.h"
#include "viewer/model/off_faces.h"
#include "viewer/model/shown_parts.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr double zoom_per_notch = 0.88;

Eigen::AlignedBox3d framed_box(const std::vector<Vec3>& points, double least) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 more = Vec3::Constant(least) + box.sizes();
    return {box.min() - more, box.max() + more};
}

}  // namespace

// Fits a box, or points, into the part of the scene that the legend leaves.
template <class Body>
void Navigation::fit_body(Camera& camera, const Body& body) const {
    const float height = std::max(view_.body.height, 1.f);
    fit(camera, body, view_.body.width / height);
    camera.height *= view_.area.height / height;
}

void Navigation::frame_selection() {
    const double diagonal = view_.diagonal();
    const std::vector<Vec3> points = selected_points(view_.session, view_.state.selection);
    if (!points.empty()) {
        view_.camera.target = framed_box(points, 0.01 * diagonal).center();
        Camera framed = view_.camera;
        fit_body(framed, framed_box(points, 0.01 * diagonal));
        view_.state.camera = framed;
    } else if (const auto surface = surface_of(view_.session, view_.state.node)) {
        Camera framed = view_.camera;
        fit_body(framed, framed_box(surface->vertices, 0));
        framed.height /= 2;
        view_.state.camera = framed;
    }
}

void Navigation::fly_to(const Vec3& point, double radius, const Vec3& back) {
    Camera camera = view_.camera;
    if (back.squaredNorm() > 0 && !back.isApprox(camera.back())) look_from(camera, back, view_.up());
    camera.target = point;
    camera.height = std::max(6 * radius, 1e-4 * view_.diagonal());
    view_.state.camera = view_.camera = camera;
    if (view_.state.selection.kind != Selection::Kind::cell) {
        view_.state.selection = {};
        view_.state.selection.kind = Selection::Kind::place;
        view_.state.selection.owner = view_.state.node;
        view_.state.selection.place = point;
    }
}

void Navigation::resolve_turn() {
    if (!turning_to_) return;
    const Selection& s = *turning_to_;
    const auto cells = view_.session.fetched().cells(s.owner);
    const auto part = view_.session.fetched().part_surface(s.owner),
               shown = surface_of(view_.session, view_.state.node);
    const bool is_known = cells && part && shown;
    if (!is_known && view_.session.pending()) return;
    if (is_known && view_.state.selection == s && view_.state.camera) {
        come_to(*cells, s.index);
        if (const auto back = direction_to_cell(*cells, *part, *shown, s.index, view_.camera.back())) {
            if (!back->isApprox(view_.state.camera->back())) look_from(*view_.state.camera, *back, view_.up());
            view_.wake();
        }
    }
    turning_to_.reset();
}

// Makes the cell a third as high as the scene, and moves the clip plane so that it and its neighbours are seen.
void Navigation::come_to(const PartCells& cells, std::int32_t cell) {
    const std::array<std::int32_t, 4>& corners = cells.tets[cell];
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : corners) middle += cells.vertices[v] / 4;
    double radius = 0;
    for (const std::int32_t v : corners) radius = std::max(radius, (cells.vertices[v] - middle).norm());
    view_.state.camera->target = middle + explosion_offset(view_.session.document().tree, cells.part, view_.state.node,
                                                           view_.state.explosion.amount, view_.diagonal());
    view_.state.camera->height = std::max(6 * radius, 1e-4 * view_.diagonal());
    if (!view_.state.clip.on) return;
    std::vector<Vec3> around;
    for (const std::array<std::int32_t, 4>& tet : cells.tets)
        if (std::any_of(tet.begin(), tet.end(),
                        [&](std::int32_t v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); }))
            for (const std::int32_t v : tet) around.push_back(cells.vertices[v]);
    keep(view_.state.clip, around, view_.session.document().box);
}

void Navigation::resolve_clip() {
    const Document& document = view_.session.document();
    if (!view_.chosen.clip_fraction || document.box.isEmpty() || !document.tree.find(view_.state.node)) return;
    const auto surface = surface_of(view_.session, view_.state.node);
    if (!surface) return;
    keep_off_faces(view_.state.clip, *surface, document.box);
    view_.chosen.clip_fraction = false;
}

void Navigation::clip_through_selection(bool faces_eye) {
    const std::vector<Vec3> points = selected_points(view_.session, view_.state.selection);
    if (points.empty() || view_.session.document().box.isEmpty())
        return view_.notify("Select something to clip through first.");
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) middle += p / points.size();
    // The side towards the eye is cut away.
    const Vec3 normal = faces_eye ? view_.camera.back() : view_.state.clip.normal;
    if (faces_eye) view_.state.clip.flipped = false;
    snap_to(view_.state.clip, Plane(middle, normal), view_.session.document().box);
}

// Without a camera in the state everything fits, whatever is shown.
void Navigation::update_camera() {
    if (view_.state.camera) {
        view_.camera = *view_.state.camera;
        return;
    }
    view_.camera = {};
    const Clip& clip = view_.state.clip;
    const bool fits_rest = view_.chosen.faces_clip && clip.on && !view_.built.left.isEmpty();
    if (fits_rest && !view_.chosen.from)
        look_from(view_.camera, clip.flipped ? Vec3(-clip.normal) : clip.normal, view_.up());
    else
        look_from(view_.camera, view_.chosen.from.value_or(Direction::corner), view_.up());
    if (fits_rest) return fit_body(view_.camera, view_.built.left);
    std::vector<Vec3> outline = view_.built.outline;
    if (view_.beside)
        outline.insert(outline.end(), view_.beside->built.outline.begin(), view_.beside->built.outline.end());
    fit_body(view_.camera, outline);
}

void Navigation::project_scene() {
    update_camera();
    view_.projection = view_.projection_into(view_.area, view_.built);
    if (view_.beside) view_.beside->projection = view_.projection_into(view_.beside->area, view_.beside->built);
    view_.renderer.resize(view_.size.width, view_.size.height);
}

void Navigation::remember() {
    const Document& document = view_.session.document();
    if (!ImGui::IsAnyMouseDown() && !view_.facts.playing)
        view_.history.note(view_.state, document.kind == Document::Kind::none ? "" : document.path, ImGui::GetTime());
    view_.facts.has_earlier = view_.history.has_earlier();
    view_.facts.has_later = view_.history.has_later();
}

void Navigation::show_again(const std::optional<ViewState>& view) {
    if (view) view_.state = *view;
}

const std::string* Navigation::patch_at(float x, float y) {
    const std::optional<PickHit> hit = view_.pick(x, y);
    if (!hit) return nullptr;
    Fetched& fetched = view_.session.fetched();
    const LayerKind kind = view_.built.scene.layers[hit->layer].kind;
    const bool is_of_facets = kind == LayerKind::part || kind == LayerKind::surface ||
                              kind == LayerKind::file_surface || kind == LayerKind::half;
    if (!is_of_facets) return nullptr;
    const auto surface = kind == LayerKind::part ? fetched.part_surface(hit->owner) : fetched.surface(hit->owner);
    if (!surface || hit->element >= std::ssize(surface->patch)) return nullptr;
    const std::int32_t patch = surface->patch[hit->element];
    const std::vector<std::string>& names = view_.session.document().patch_names;
    return patch >= 0 && patch < std::ssize(names) ? &names[patch] : nullptr;
}

void Navigation::hide_patch() {
    const std::string* patch = mouse_ ? patch_at(mouse_->first, mouse_->second) : nullptr;
    if (!patch) return view_.notify("There is no patch with a name under the mouse.");
    if (is_last_patch(view_.state, view_.session.document(), *patch))
        return view_.notify("Without this patch nothing would be left to be seen.");
    set_member(view_.state.visibility.hidden_patches, *patch, true);
}

// Zooms towards the point that is seen under the cursor, and not through it.
void Navigation::zoom(float x, float y, float notches) {
    Camera camera = view_.camera;
    const double diagonal = view_.diagonal();
    if (const auto found = view_.pick(x, y)) focus_depth(camera, seen_point(*found));
    const double height = view_.height();
    zoom_at(camera, std::pow(zoom_per_notch, notches), (x - view_.body.x - view_.body.width / 2) / height,
            -(y - view_.body.y - view_.body.height / 2) / height);
    camera.height = std::clamp(camera.height, 1e-6 * diagonal, 1e2 * diagonal);
    view_.state.camera = camera;
}

// The point that was hit as the picture shows it, with parts pulled apart.
Vec3 Navigation::seen_point(const PickHit& hit) const {
    const std::array<float, 3>& offset = view_.built.scene.layers[hit.layer].ranges[hit.range].offset;
    const Eigen::Vector3f moved = hit.point + Eigen::Vector3f(offset[0], offset[1], offset[2]);
    return view_.built.frame.to_file(moved.cast<double>());
}

void Navigation::center(const PickHit& hit) {
    Camera camera = view_.camera;
    camera.target = seen_point(hit);
    view_.state.camera = camera;
}

}  // namespace kerf::view
