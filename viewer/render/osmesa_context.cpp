// OSMesa is loaded when a picture is drawn: it brings LLVM, for which every start would wait, and need not be there.
#include <dlfcn.h>

#include <array>

#include "viewer/render/inside/offscreen_contexts.h"

// Before osmesa.h, whose own OpenGL header hides the types of the functions of 1.1.
#include "viewer/render/inside/gl.h"

#include <GL/osmesa.h>

#include "base/core/error.h"

namespace kerf::view {

namespace {

// The renderer draws into a framebuffer of its own, so that the one that OSMesa asks for need not be large.
constexpr int buffer_size = 16;

// The functions of OSMesa that are called. Once loaded, the library stays until the program ends.
struct Osmesa {
    void* library = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    decltype(&OSMesaCreateContextAttribs) create = find<decltype(create)>("OSMesaCreateContextAttribs");
    decltype(&OSMesaMakeCurrent) make_current = find<decltype(make_current)>("OSMesaMakeCurrent");
    decltype(&OSMesaGetProcAddress) function = find<decltype(function)>("OSMesaGetProcAddress");
    decltype(&OSMesaDestroyContext) destroy = find<decltype(destroy)>("OSMesaDestroyContext");

    bool is_complete() const { return create && make_current && function && destroy; }

 private:
    template <class Function>
    Function find(const char* name) const {
        return library ? reinterpret_cast<Function>(::dlsym(library, name)) : nullptr;
    }
};

const Osmesa& osmesa() {
    static const Osmesa loaded;
    return loaded;
}

OSMesaContext create_osmesa_context() {
    if (!has_osmesa()) throw Error(ErrorCode::io, "libOSMesa.so.8 cannot be loaded. Install libosmesa6, or take egl.");
    const std::array attributes = {OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_PROFILE,
                                   OSMESA_CORE_PROFILE,
                                   OSMESA_CONTEXT_MAJOR_VERSION,
                                   3,
                                   OSMESA_CONTEXT_MINOR_VERSION,
                                   3,
                                   0};
    return osmesa().create(attributes.data(), nullptr);
}

class OsmesaContext : public OffscreenContext {
 public:
    OsmesaContext() {
        if (!context_ ||
            !osmesa().make_current(context_.get(), pixels_.data(), GL_UNSIGNED_BYTE, buffer_size, buffer_size))
            throw Error(ErrorCode::internal, "OSMesa cannot make an OpenGL 3.3 core context. Reinstall libosmesa6.");
        gl_ = load_gl([](const char* name) { return reinterpret_cast<void*>(osmesa().function(name)); });
    }
    const Gl& gl() const override { return gl_; }

 private:
    struct Destroy {
        void operator()(OSMesaContext unused) const { osmesa().destroy(unused); }
    };
    std::array<unsigned char, 4 * buffer_size* buffer_size> pixels_ = {};
    std::unique_ptr<osmesa_context, Destroy> context_{create_osmesa_context()};
    Gl gl_;
};

}  // namespace

bool has_osmesa() { return osmesa().is_complete(); }
std::unique_ptr<OffscreenContext> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace kerf::view
