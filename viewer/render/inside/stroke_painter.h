// The painter of lines and points, which are strokes of a width in pixels.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/paint_job.h"
#include "viewer/render/inside/shader_program.h"

namespace kerf::view {

/// A painter of layers of lines and points. The framebuffer and its viewport are the caller's. Before and after each
/// call the depth test is on with GL_LESS and depth is written; blending and the stencil test are off.
class StrokePainter {
 public:
    StrokePainter(const Gl& gl, const std::string& shader_folder);

    /// Begins a picture, whose stencil has been cleared to 0.
    void begin_picture() { stencil_ = 0; }

    /// Draws the layer. Opaque lines and points write depth, others do not.
    void draw(const PaintJob& job);

    /// Draws the parts of the layer before which something lies, faintly. Call it before draw(), lest lines and points
    /// hide themselves.
    void draw_hidden(const PaintJob& job);

    /// Draws points into a framebuffer of unsigned integers, as the numbers (`id`, point, range, 0).
    void draw_ids(const PaintJob& job, std::uint32_t id);

 private:
    struct Pass {
        float least = 0;  // pixels are drawn whose coverage is in [`least`, `below`)
        float below = 2;
        float nearer = 0;  // distance before its place at which a stroke is drawn, in units of its radius and a pixel
        float alpha = 1;
    };
    void draw_opaque(ShaderProgram& program, const PaintJob& job);
    void draw_see_through(ShaderProgram& program, const PaintJob& job, float alpha);
    void draw_pass(ShaderProgram& program, const PaintJob& job, const Pass& pass);
    ShaderProgram& program_for(const PaintJob& job);
    int next_stencil();

    const Gl& gl_;
    ShaderProgram segments_, points_, point_ids_;
    int stencil_ = 0;
};

}  // namespace kerf::view
