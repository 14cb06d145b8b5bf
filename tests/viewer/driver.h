// The viewer without a display, with a hand on its mouse and keys.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/app/app.h"
#include "viewer/render/offscreen.h"

namespace kerf::test {

/// Drives the same App as the window does. Every change of input is followed by frames as fast as they can be laid out,
/// painted where they are looked at. The time that the viewer sees goes on by 1/60 s a frame. What does not come within
/// 60 s fails the test.
class Driver {
 public:
    struct Options {
        int width = 1280, height = 800;  ///< of the window, in its units
        float pixels_per_unit = 1;       ///< the picture is so many times as large
        float scale = 1;                 ///< of fonts and lines
        bool auto_run = true, volume = true, asks_to_save = false;
        std::int32_t parts = 4;
        ContourMethod contour = ContourMethod::min_cut;
        Remeshing remeshing = Remeshing::where_needed;
        double frame_seconds = view::AppOptions().frame_seconds;
        std::string config_folder, example_folder, screenshot_folder = ".";
    };
    explicit Driver(const Options& options);
    Driver() : Driver(Options()) {}

    view::App& app() { return *app_; }
    view::ViewState& state() { return app_->state(); }
    const view::Document& document() { return app_->session().document(); }

    /// Opens a file and waits until it, and the run that it starts, are there.
    void open(const std::string& path) { open_files({path}); }
    /// Several at once.
    void open_files(const std::vector<std::string>& paths);
    /// One frame, for the viewer so much later than the last.
    void frame(float seconds = 1.f / 60);
    /// Frames until nothing changes any more.
    void settle();
    /// Frames until the condition holds.
    void await(const std::string& what, const std::function<bool()>& condition);
    /// Without panels: only the scene and its legend.
    void show_panels(bool shown) { panels_ = shown; }

    /// As if the window had been moved to a screen with another scale.
    void move_to_screen(float pixels_per_unit, float scale);

    // Places are pixels of the picture, as those of items. The mouse comes in units of the window, as there.
    void move_to(float x, float y);
    void press(int button = 0);
    void release(int button = 0);
    void click_at(float x, float y, int button = 0);
    void drag(float from_x, float from_y, float to_x, float to_y, int button = 0);
    void wheel(float x, float y, float notches);
    /// Whether an item is there and can be used.
    bool offers(const std::string& label) const;
    /// Clicks an item by its label. Scrolls to it if it is out of sight.
    void click(const std::string& label);
    /// Drags over an item; places are fractions of its width.
    void drag_over(const std::string& label, float from, float to);
    void key(int key, bool control = false, bool shift = false);
    /// So short that all of them are pressed and released before the next frame.
    void keys_in_one_frame(const std::vector<view::KeyEvent>& keys);
    void type(const std::string& text);
    /// What the window does with a dropped file.
    void drop(const std::string& path);

    /// The picture as it is after settle().
    view::Image picture();
    /// Numbers drawn, summed over the layers of a kind, or those of one owner.
    view::DrawnLayer drawn(view::LayerKind kind, std::optional<NodeId> owner = {});

 private:
    view::ItemRect item(const std::string& label);
    view::ItemRect item_in_sight(const std::string& label);
    void frames(int count);
    view::FrameSize size() const;

    Options options_;
    std::unique_ptr<view::OffscreenContext> context_ = view::make_offscreen_context();
    view::ImGuiOwner imgui_;
    std::unique_ptr<view::App> app_;
    bool panels_ = true;
    float mouse_x_ = -1000, mouse_y_ = -1000;
};

}  // namespace kerf::test
