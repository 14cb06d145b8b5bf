// The camera: it frames, flies to and turns to parts of the scene, and fits the body beside the legend.
#pragma once

#include <optional>
#include <utility>

#include "viewer/app/view.h"

namespace kerf::view {

class Navigation : public CameraActions {
 public:
    explicit Navigation(View& view) : view_(view) {}

    void fit_all() override { view_.state.camera.reset(); }
    void frame_selection() override;
    void fly_to(const Vec3& point, double radius, const Vec3& back) override;
    void turn_to_selection() override { turning_to_ = view_.state.selection; }
    void clip_through_selection(bool faces_eye) override;
    void hide_patch() override;
    void take_camera(const Camera& camera) override { view_.state.camera = view_.camera = camera; }
    void show_earlier() override { show_again(view_.history.go_back(view_.state)); }
    void show_later() override { show_again(view_.history.go_on(view_.state)); }

    /// Notes where the mouse is in the scene, so that a command which is chosen elsewhere knows.
    void note_mouse(float x, float y) { mouse_ = {x, y}; }
    /// Returns the name of the patch that is seen at a pixel; null: there is none.
    const std::string* patch_at(float x, float y);
    /// Zooms towards the point that is seen under the cursor, and not through it.
    void zoom(float x, float y, float notches);
    /// Makes the camera turn about the point that was hit from now on.
    void center(const PickHit& hit);
    void resolve_turn();  ///< turns, and comes close, to the selection once its cells have arrived
    void resolve_clip();  ///< moves a plane that was asked for off faces of the body, once these are known
    /// Sets the camera and its projection for the scene as it was built.
    void project_scene();
    /// Notes the view in the history once nothing moves it.
    void remember();

 private:
    void update_camera();
    void come_to(const PartCells& cells, std::int32_t cell);
    void show_again(const std::optional<ViewState>& view);
    template <class Body>
    void fit_body(Camera& camera, const Body& body) const;
    Vec3 seen_point(const PickHit& hit) const;

    View& view_;
    std::optional<std::pair<float, float>> mouse_;  // where the mouse was in the scene last
    std::optional<Selection> turning_to_;           // a selected cell whose part is being read
};

}  // namespace kerf::view
