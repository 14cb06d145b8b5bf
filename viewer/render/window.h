// A window with an OpenGL context, and its events on their way to Dear ImGui. This is the only place that knows GLFW.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "viewer/render/frame_size.h"
#include "viewer/render/key_event.h"

namespace kerf::view {

struct Gl;

class Window {
 public:
    /// Opens the window and makes its context current. Width and height are pixels of a screen of scale 1; a HiDPI
    /// screen takes more pixels. The window becomes no larger than the largest screen. An ImGui context must exist.
    /// Throws Error(io) where there is no display, saying so and naming `kerf screenshot`; Error(internal) if the
    /// display offers no OpenGL 3.3.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const Gl& gl() const;
    FrameSize frame_size() const;
    /// Returns whether somebody has asked to close the window since the last call.
    bool take_close();
    void set_title(const std::string& title);

    /// Takes the events of the window. Sleeps until something happens, at most `wait_seconds`, and returns whether
    /// anything did; the first call does at once, since nothing is drawn yet.
    bool take_events(double wait_seconds);
    /// Hands the events to ImGui's input, with the time since the last call. Call it before every frame.
    void begin_frame();
    /// Returns the keys that were pressed since the last call.
    std::vector<KeyEvent> take_key_events();
    /// Returns the files that were dropped onto the window since the last call.
    std::vector<std::string> take_dropped_files();
    /// Shows the picture that was drawn.
    void swap();

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf::view
