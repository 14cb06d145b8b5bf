#include "viewer/render/inside/framebuffer.h"

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::view {

namespace {

void check_size(const Gl& gl, int width, int height) {
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest)
        throw Error(ErrorCode::usage, fmt::format("A picture of {} x {} pixels cannot be drawn: width and height must "
                                                  "be from 1 to {}.",
                                                  width, height, largest));
}

GlObject attach(const Gl& gl, GLenum attachment, GLenum format, int width, int height) {
    GlObject buffer = GlObject::renderbuffer(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.id());
    gl.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    gl.BindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.id());
    return buffer;
}

GlObject attach_depth_texture(const Gl& gl, int width, int height) {
    GlObject texture = GlObject::texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, texture.id());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl.TexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH24_STENCIL8, width, height, 0, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8,
                  nullptr);
    gl.BindTexture(GL_TEXTURE_2D, 0);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_TEXTURE_2D, texture.id(), 0);
    return texture;
}

}  // namespace

Framebuffer::Framebuffer(const Gl& gl, GLenum color_format, int width, int height, bool reads_depth)
    : gl_(&gl), width_(width), height_(height) {
    check_size(gl, width, height);
    object_ = GlObject::framebuffer(gl);
    bind();
    color_ = attach(gl, GL_COLOR_ATTACHMENT0, color_format, width, height);
    depth_ = reads_depth ? attach_depth_texture(gl, width, height)
                         : attach(gl, GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8, width, height);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error(ErrorCode::internal,
                    fmt::format("The OpenGL driver cannot make a picture of {} x {} pixels.", width, height));
}

}  // namespace kerf::view
