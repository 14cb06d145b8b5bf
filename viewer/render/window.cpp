// The window by GLFW, which calls back while events are taken. Our callbacks note that something happened; ImGui's own
// are installed after them and call them. Keys and characters are different: ImGui looks at the state of keys once a
// frame, so that a key pressed and let go between two frames would be missed. They are queued, and handed over frame by
// frame, as many as do not hide one another; the rest waits and asks for another frame. The window's framebuffer has no
// depth and no samples, as pictures are copied into it. GLFW's places and sizes are in units of the window
// (frame_size.h).
#include "viewer/render/window.h"

#include <algorithm>
#include <deque>
#include <set>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <fmt/format.h>

#include "base/core/error.h"
#include "viewer/render/inside/gl.h"

namespace kerf::view {

namespace {

std::string glfw_reason() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    return reason != nullptr ? reason : "no reason is given";
}

// The lifetime of GLFW.
class Glfw {
 public:
    Glfw() {
        if (!glfwInit())
            throw Error(ErrorCode::io, fmt::format("There is no display to open a window on ({}). Set DISPLAY, or use "
                                                   "kerf screenshot, which needs none.",
                                                   glfw_reason()));
    }
    ~Glfw() { glfwTerminate(); }
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

FrameSize frame_size_of(GLFWwindow* window) {
    int pixel_width = 0, pixel_height = 0, width = 0, height = 0;
    float scale = 1;
    glfwGetFramebufferSize(window, &pixel_width, &pixel_height);
    glfwGetWindowSize(window, &width, &height);
    glfwGetWindowContentScale(window, &scale, nullptr);
    return frame_size_of_window(pixel_width, pixel_height, width, height, scale);
}

// Limits the window: not so small that it could not be read, and no larger than the largest screen, as its size may
// come from another one.
void fit_to_screens(GLFWwindow* window) {
    const FrameSize size = frame_size_of(window);
    int least_width = static_cast<int>(900 * size.scale / size.pixels_per_unit_x);
    int least_height = static_cast<int>(560 * size.scale / size.pixels_per_unit_y);
    int screen_width = 0, screen_height = 0, count = 0;
    GLFWmonitor** const monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int x = 0, y = 0, width = 0, height = 0;
        glfwGetMonitorWorkarea(monitors[i], &x, &y, &width, &height);
        screen_width = std::max(screen_width, width);
        screen_height = std::max(screen_height, height);
    }
    if (screen_width > 0 && screen_height > 0) {
        least_width = std::min(least_width, screen_width);
        least_height = std::min(least_height, screen_height);
        int width = 0, height = 0;
        glfwGetWindowSize(window, &width, &height);
        if (width > screen_width || height > screen_height)
            glfwSetWindowSize(window, std::min(width, screen_width), std::min(height, screen_height));
    }
    glfwSetWindowSizeLimits(window, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
}

GLFWwindow* create_window(const std::string& title, int width, int height) {
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    // The picture is copied in as it is: the window needs no depth of its own and must not shine through.
    glfwWindowHint(GLFW_SAMPLES, 0);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "kerf");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "kerf");
    GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window == nullptr)
        throw Error(ErrorCode::internal,
                    fmt::format("The display offers no OpenGL 3.3 ({}). Update its driver, set LIBGL_ALWAYS_SOFTWARE=1,"
                                " or use kerf screenshot.",
                                glfw_reason()));
    fit_to_screens(window);
    return window;
}

}  // namespace

struct Window::Impl {
    struct Destroy {
        void operator()(GLFWwindow* unused) const { glfwDestroyWindow(unused); }
    };

    Impl(const std::string& title, int width, int height) : window(create_window(title, width, height)) {}

    void install_callbacks();
    void install_key_callbacks();
    void hand_keys_to_imgui();

    Glfw glfw;
    std::unique_ptr<GLFWwindow, Destroy> window;
    Gl gl;
    // A change of a key or, where that is -1, a character.
    struct KeyChange {
        int key = -1, scancode = 0, action = 0, mods = 0;
        unsigned character = 0;
    };
    std::deque<KeyChange> for_imgui;  // changes that ImGui has not seen yet
    std::vector<KeyEvent> key_events;
    bool happened = true;  // the first picture is due
    std::vector<std::string> dropped;
};

namespace {

template <class Impl>
Impl& impl_of(GLFWwindow* window) {
    return *static_cast<Impl*>(glfwGetWindowUserPointer(window));
}

}  // namespace

void Window::Impl::install_callbacks() {
    GLFWwindow* w = window.get();
    glfwSetWindowUserPointer(w, this);
    const auto note = [](GLFWwindow* source, auto...) { impl_of<Impl>(source).happened = true; };
    glfwSetFramebufferSizeCallback(w, note);
    glfwSetWindowContentScaleCallback(w, note);
    glfwSetWindowRefreshCallback(w, note);
    glfwSetWindowCloseCallback(w, note);
    glfwSetWindowIconifyCallback(w, note);
    glfwSetWindowFocusCallback(w, note);
    glfwSetCursorEnterCallback(w, note);
    glfwSetCursorPosCallback(w, note);
    glfwSetMouseButtonCallback(w, note);
    glfwSetScrollCallback(w, note);
    glfwSetKeyCallback(w, note);
    glfwSetCharCallback(w, note);
    glfwSetDropCallback(w, [](GLFWwindow* source, int count, const char** paths) {
        Impl& impl = impl_of<Impl>(source);
        impl.happened = true;
        impl.dropped.insert(impl.dropped.end(), paths, paths + count);
    });
}

// Installs callbacks of keys in the place of ImGui's own, which are called frame by frame.
void Window::Impl::install_key_callbacks() {
    glfwSetKeyCallback(window.get(), [](GLFWwindow* source, int key, int scancode, int action, int mods) {
        Impl& impl = impl_of<Impl>(source);
        impl.happened = true;
        impl.for_imgui.push_back({.key = key, .scancode = scancode, .action = action, .mods = mods});
        if (action == GLFW_RELEASE) return;
        impl.key_events.push_back({.key = key,
                                   .control = (mods & GLFW_MOD_CONTROL) != 0,
                                   .shift = (mods & GLFW_MOD_SHIFT) != 0,
                                   .repeat = action == GLFW_REPEAT});
    });
    glfwSetCharCallback(window.get(), [](GLFWwindow* source, unsigned character) {
        Impl& impl = impl_of<Impl>(source);
        impl.happened = true;
        impl.for_imgui.push_back({.character = character});
    });
}

// Hands changes of keys to ImGui, which looks at the state of keys once a frame, after the characters: a change that
// would hide an earlier one from it waits for the next frame.
void Window::Impl::hand_keys_to_imgui() {
    std::set<int> changed;
    for (; !for_imgui.empty(); for_imgui.pop_front()) {
        const KeyChange& change = for_imgui.front();
        if (change.key >= 0) {
            if (changed.contains(change.key)) break;
            // Other keys matter to it by their characters.
            if (change.key >= GLFW_KEY_ESCAPE || (change.mods & GLFW_MOD_CONTROL) != 0) changed.insert(change.key);
            ImGui_ImplGlfw_KeyCallback(window.get(), change.key, change.scancode, change.action, change.mods);
        } else {
            const bool is_after_key = changed.lower_bound(GLFW_KEY_ESCAPE) != changed.lower_bound(GLFW_KEY_F1);
            if (is_after_key) break;
            ImGui_ImplGlfw_CharCallback(window.get(), change.character);
        }
    }
    if (!for_imgui.empty()) happened = true;
}

Window::Window(const std::string& title, int width, int height) : impl_(std::make_unique<Impl>(title, width, height)) {
    glfwMakeContextCurrent(impl_->window.get());
    glfwSwapInterval(1);
    impl_->gl = load_gl([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); });
    impl_->install_callbacks();
    ImGui_ImplGlfw_InitForOpenGL(impl_->window.get(), true);
    impl_->install_key_callbacks();
}

Window::~Window() { ImGui_ImplGlfw_Shutdown(); }

const Gl& Window::gl() const { return impl_->gl; }

FrameSize Window::frame_size() const { return frame_size_of(impl_->window.get()); }

bool Window::take_close() {
    GLFWwindow* window = impl_->window.get();
    const bool is_asked = glfwWindowShouldClose(window);
    glfwSetWindowShouldClose(window, GLFW_FALSE);
    return is_asked;
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(impl_->window.get(), title.c_str()); }

bool Window::take_events(double wait_seconds) {
    if (wait_seconds > 0 && !impl_->happened)
        glfwWaitEventsTimeout(wait_seconds);
    else
        glfwPollEvents();
    return std::exchange(impl_->happened, false);
}

void Window::begin_frame() {
    impl_->hand_keys_to_imgui();
    ImGui_ImplGlfw_NewFrame();
}

std::vector<KeyEvent> Window::take_key_events() { return std::exchange(impl_->key_events, {}); }

std::vector<std::string> Window::take_dropped_files() { return std::exchange(impl_->dropped, {}); }

void Window::swap() { glfwSwapBuffers(impl_->window.get()); }

}  // namespace kerf::view
