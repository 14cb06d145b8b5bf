// EGL on Mesa's platform without surfaces: no display, no config; the renderer draws into a framebuffer of its own.
#include <array>
#include <cstdlib>

#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/offscreen_contexts.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::view {

namespace {

// The display of Mesa's software. It ends with the program: Mesa keeps it, and other contexts of the process may use
// it, too.
EGLDisplay software_display() {
    // A graphics card would draw other pictures. A user who wants it all the same sets the variable to 0.
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLContext create_egl_context(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
        return EGL_NO_CONTEXT;
    const std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

class EglContext : public OffscreenContext {
 public:
    EglContext() : display_(software_display()), context_(create_egl_context(display_)) {
        if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            const EGLint reason = eglGetError();
            destroy();
            throw Error(ErrorCode::internal,
                        fmt::format("EGL cannot make an OpenGL 3.3 core context without a surface (error {:#x}). "
                                    "Install libegl-mesa0 and libgl1-mesa-dri.",
                                    reason));
        }
        gl_ = load_gl([](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); });
    }
    ~EglContext() override { destroy(); }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    const Gl& gl() const override { return gl_; }

 private:
    void destroy() {
        if (context_ == EGL_NO_CONTEXT) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }

    EGLDisplay display_;
    EGLContext context_;
    Gl gl_;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace kerf::view
