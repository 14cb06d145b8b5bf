#include "viewer/render/offscreen.h"

#include <array>

// Before osmesa.h, whose own OpenGL header hides the types of the functions of 1.1.
#include "viewer/render/gl.h"

#include <GL/osmesa.h>

#include "core/error.h"

namespace kerf::view {

namespace {

// The renderer draws into a framebuffer of its own, so that the one that OSMesa asks for need not be large.
constexpr int buffer_size = 16;

OSMesaContext create_context() {
    const std::array attributes = {OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   3,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   3,
                                   0};
    return OSMesaCreateContextAttribs(attributes.data(), nullptr);
}

}  // namespace

struct OffscreenContext::Impl {
    struct Destroy {
        void operator()(OSMesaContext unused) const { OSMesaDestroyContext(unused); }
    };
    std::array<unsigned char, 4 * buffer_size* buffer_size> pixels = {};
    std::unique_ptr<osmesa_context, Destroy> context{create_context()};
    Gl gl;
};

OffscreenContext::OffscreenContext() : impl_(std::make_unique<Impl>()) {
    if (!impl_->context ||
        !OSMesaMakeCurrent(impl_->context.get(), impl_->pixels.data(), GL_UNSIGNED_BYTE, buffer_size, buffer_size))
        throw Error(ErrorCode::internal, "OSMesa cannot make an OpenGL 3.3 core context. Reinstall libosmesa6.");
    impl_->gl = load_gl([](const char* name) { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); });
}

OffscreenContext::~OffscreenContext() = default;

const Gl& OffscreenContext::gl() const { return impl_->gl; }

}  // namespace kerf::view
