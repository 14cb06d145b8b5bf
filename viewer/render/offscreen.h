// An OpenGL context without a display: OSMesa, which computes on the CPU.
#pragma once

#include <memory>

namespace kerf::view {

struct Gl;

/// Makes its context current when it is built. One at a time in a process.
class OffscreenContext {
 public:
    /// Throws Error(internal) if the driver cannot make a 3.3 core context.
    OffscreenContext();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

    const Gl& gl() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace kerf::view
