// OpenGL contexts without a display. Two libraries of Mesa make them, and both compute on the CPU: OSMesa, which went
// with Mesa 25.1, and EGL without a surface. The same Mesa draws the same pixels by both.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kerf::view {

struct Gl;

enum class OffscreenLibrary { osmesa, egl };

/// "osmesa", "egl".
std::string name(OffscreenLibrary library);
/// Throws Error(usage).
OffscreenLibrary offscreen_library_from_name(const std::string& name);
/// Those that this program was built with, the default first; at least one.
std::vector<OffscreenLibrary> offscreen_libraries();

/// Current from when it is made. One at a time in a process.
class OffscreenContext {
 public:
    OffscreenContext() = default;
    virtual ~OffscreenContext() = default;
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    virtual const Gl& gl() const = 0;
};

/// Without a library: the default, or EGL where OSMesa is not installed. EGL sets the variable LIBGL_ALWAYS_SOFTWARE to
/// 1 where it is not set, so that it is to be called before there are threads. Throws Error(usage) for a library that
/// the program was built without, Error(io) for OSMesa where it is not installed, Error(internal) if it cannot make
/// a 3.3 core context.
std::unique_ptr<OffscreenContext> make_offscreen_context(std::optional<OffscreenLibrary> library = {});

}  // namespace kerf::view
