// Ambient occlusion: hollows of opaque bodies are darker, since less of the sky is seen from there.
#pragma once

#include <string>

#include "viewer/model/camera.h"
#include "viewer/render/inside/framebuffer.h"
#include "viewer/render/inside/shader_program.h"

namespace kerf::view {

class Occlusion {
 public:
    Occlusion(const Gl& gl, const std::string& shader_folder);

    /// Darkens all that has been drawn into the viewport of `target`, whose depth is a texture. `strength`: 0 to 1.
    /// Colours keep their hue. Leaves `target` bound.
    void draw(const Framebuffer& target, const Projection& projection, float strength);

 private:
    // A picture of one channel.
    struct Shade {
        GlObject texture, framebuffer;
    };
    void resize(int width, int height);
    void fill(const Shade& shade, ShaderProgram& program, GLuint picture);

    const Gl& gl_;
    ShaderProgram measure_, blur_, shade_;
    GlObject no_vertices_;
    Shade rough_, smooth_;
    int width_ = 0, height_ = 0;
};

}  // namespace kerf::view
