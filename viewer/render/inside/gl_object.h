// Names of OpenGL objects that delete themselves.
#pragma once

#include <utility>

#include "viewer/render/inside/gl.h"

namespace kerf::view {

/// A buffer, vertex array, texture, framebuffer or renderbuffer of OpenGL. Its context must be current when it dies.
class GlObject {
 public:
    GlObject() = default;
    GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)), destroy_(other.destroy_) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~GlObject() {
        if (id_ != 0) destroy_(1, &id_);
    }

    static GlObject buffer(const Gl& gl) { return {gl.GenBuffers, gl.DeleteBuffers}; }
    static GlObject vertex_array(const Gl& gl) { return {gl.GenVertexArrays, gl.DeleteVertexArrays}; }
    static GlObject texture(const Gl& gl) { return {gl.GenTextures, gl.DeleteTextures}; }
    static GlObject framebuffer(const Gl& gl) { return {gl.GenFramebuffers, gl.DeleteFramebuffers}; }
    static GlObject renderbuffer(const Gl& gl) { return {gl.GenRenderbuffers, gl.DeleteRenderbuffers}; }

    GLuint id() const { return id_; }  ///< OpenGL's name of the object; 0: none

 private:
    using Create = PFNGLGENBUFFERSPROC;
    using Destroy = PFNGLDELETEBUFFERSPROC;
    GlObject(Create create, Destroy destroy) : destroy_(destroy) { create(1, &id_); }

    GLuint id_ = 0;
    Destroy destroy_ = nullptr;
};

}  // namespace kerf::view
