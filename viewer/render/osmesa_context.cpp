#include <array>

#include "viewer/render/offscreen_contexts.h"

// Before osmesa.h, whose own OpenGL header hides the types of the functions of 1.1.
#include "viewer/render/gl.h"

#include <GL/osmesa.h>

#include "core/error.h"

namespace kerf::view {

namespace {

// The renderer draws into a framebuffer of its own, so that the one that OSMesa asks for need not be large.
constexpr int buffer_size = 16;

OSMesaContext create_osmesa_context() {
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

class OsmesaContext : public OffscreenContext {
 public:
    OsmesaContext() {
        if (!context_ || !OSMesaMakeCurrent(context_.get(), pixels_.data(), GL_UNSIGNED_BYTE, buffer_size, buffer_size))
            throw Error(ErrorCode::internal, "OSMesa cannot make an OpenGL 3.3 core context. Reinstall libosmesa6.");
        gl_ = load_gl([](const char* name) { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); });
    }
    const Gl& gl() const override { return gl_; }

 private:
    struct Destroy {
        void operator()(OSMesaContext unused) const { OSMesaDestroyContext(unused); }
    };
    std::array<unsigned char, 4 * buffer_size* buffer_size> pixels_ = {};
    std::unique_ptr<osmesa_context, Destroy> context_{create_osmesa_context()};
    Gl gl_;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace kerf::view
