// A window with an OpenGL context, and its events on their way to Dear ImGui. The only place that knows GLFW.
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
    /// Opens the window and makes its context current. Width and height are pixels of a screen of scale 1: a HiDPI
    /// screen has more for it. It becomes no larger than the largest screen. An ImGui context must exist. Throws
    /// Error(io) where there is no display, saying so and naming `kerf screenshot`; Error(internal) if the display
    /// offers no OpenGL 3.3.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    const Gl& gl() const;
    FrameSize frame_size() const;
    bool should_close() const;
    void close();
    void set_title(const std::string& title);

    /// Hands what has happened to ImGui's input (ImGui_ImplGlfw_NewFrame included). Sleeps until something happens, at
    /// most `wait_seconds`. Returns whether anything did; the first call does, at once, since nothing is drawn yet.
    bool take_events(double wait_seconds);
    /// Hands it to ImGui's input, and the time since the last call. Before every frame.
    void begin_frame();
    /// Keys that were pressed since the last call.
    std::vector<KeyEvent> take_key_events();
    /// Files that were dropped onto the window since the last call.
    std::vector<std::string> take_dropped_files();
    /// Shows what was drawn.
    void swap();

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf::view
