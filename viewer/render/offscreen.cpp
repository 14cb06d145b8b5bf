#include "viewer/render/offscreen.h"

#include <fmt/format.h>

#include "base/core/error.h"
#include "viewer/render/inside/offscreen_contexts.h"

namespace kerf::view {

std::string name(OffscreenLibrary library) { return library == OffscreenLibrary::osmesa ? "osmesa" : "egl"; }

OffscreenLibrary offscreen_library_from_name(const std::string& name) {
    if (name == "osmesa") return OffscreenLibrary::osmesa;
    if (name == "egl") return OffscreenLibrary::egl;
    throw Error(ErrorCode::usage, fmt::format("'{}' makes no OpenGL contexts. Choose osmesa or egl.", name));
}

std::vector<OffscreenLibrary> offscreen_libraries() {
    std::vector<OffscreenLibrary> libraries;
#ifdef KERF_HAS_OSMESA
    libraries.push_back(OffscreenLibrary::osmesa);
#endif
#ifdef KERF_HAS_EGL
    libraries.push_back(OffscreenLibrary::egl);
#endif
    return libraries;
}

namespace {

// The first library that is installed.
OffscreenLibrary usual_library() {
#if defined(KERF_HAS_OSMESA) && defined(KERF_HAS_EGL)
    if (!has_osmesa()) return OffscreenLibrary::egl;
#endif
    return offscreen_libraries().front();
}

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context(std::optional<OffscreenLibrary> library) {
    const OffscreenLibrary wanted = library ? *library : usual_library();
#ifdef KERF_HAS_OSMESA
    if (wanted == OffscreenLibrary::osmesa) return make_osmesa_context();
#endif
#ifdef KERF_HAS_EGL
    if (wanted == OffscreenLibrary::egl) return make_egl_context();
#endif
    throw Error(ErrorCode::usage, fmt::format("This program was built without {}. It has {}.", name(wanted),
                                              name(offscreen_libraries().front())));
}

}  // namespace kerf::view
