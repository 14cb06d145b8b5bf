// OpenGL contexts without a display. Two libraries of Mesa make them, and both compute on the CPU: OSMesa, which Mesa
// 25.1 and later do not have, and EGL without a surface. The same Mesa draws the same pixels by both.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kerf::view {

struct Gl;

enum class OffscreenLibrary { osmesa, egl };

/// Returns "osmesa" or "egl".
std::string name(OffscreenLibrary library);
/// Returns the library of this name. Throws Error(usage) for another name.
OffscreenLibrary offscreen_library_from_name(const std::string& name);
/// Returns the libraries that this program was built with, the default first; at least one.
std::vector<OffscreenLibrary> offscreen_libraries();

/// A context that is current from its making on. There is one at a time in a process.
class OffscreenContext {
 public:
    OffscreenContext() = default;
    virtual ~OffscreenContext() = default;
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    virtual const Gl& gl() const = 0;
};

/// Makes a context by a library; without one by the default, or by EGL where OSMesa is not installed. EGL sets the
/// variable LIBGL_ALWAYS_SOFTWARE to 1 where it is not set, so that this is to be called before there are threads.
/// Throws Error(usage) for a library that the program was built without, Error(io) for OSMesa where it is not
/// installed, Error(internal) if the library cannot make a 3.3 core context.
std::unique_ptr<OffscreenContext> make_offscreen_context(std::optional<OffscreenLibrary> library = {});

}  // namespace kerf::view
