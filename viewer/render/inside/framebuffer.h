// A picture with depth, outside of any window.
#pragma once

#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gl_object.h"

namespace kerf::view {

class Framebuffer {
 public:
    /// Makes a framebuffer with 24 bits of depth and 8 of stencil, and binds it. `color_format`: GL_RGBA8, GL_RGBA32UI,
    /// ... `reads_depth`: depth() is a texture. Throws Error(usage) beyond the largest size of the driver,
    /// Error(internal) if the driver cannot make one.
    Framebuffer(const Gl& gl, GLenum color_format, int width, int height, bool reads_depth = false);

    void bind() const { gl_->BindFramebuffer(GL_FRAMEBUFFER, object_.id()); }
    GLuint id() const { return object_.id(); }
    GLuint depth() const { return depth_.id(); }
    int width() const { return width_; }
    int height() const { return height_; }

 private:
    const Gl* gl_;
    int width_, height_;
    GlObject object_, color_, depth_;
};

}  // namespace kerf::view
