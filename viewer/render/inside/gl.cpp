#include "viewer/render/inside/gl.h"

#include <string>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::view {

Gl load_gl(const GlLoader& loader) {
    Gl gl;
    const auto find = [&](const char* name) {
        void* function = loader(name);
        if (function == nullptr)
            throw Error(ErrorCode::internal,
                        fmt::format("The OpenGL driver has no {}. Kerf needs OpenGL 3.3; update the driver.", name));
        return function;
    };
#define KERF_GL_LOAD(type, name) gl.name = reinterpret_cast<type>(find("gl" #name));
    KERF_GL_FUNCTIONS(KERF_GL_LOAD)
#undef KERF_GL_LOAD
    return gl;
}

void check_gl(const Gl& gl, const char* where) {
    std::string codes;
    // A lost context may answer with errors for ever.
    for (int i = 0; i < 16; ++i) {
        const GLenum code = gl.GetError();
        if (code == GL_NO_ERROR) break;
        codes += fmt::format(" 0x{:04x}", code);
    }
    if (!codes.empty()) throw Error(ErrorCode::internal, fmt::format("OpenGL error{} in {}.", codes, where));
}

}  // namespace kerf::view
