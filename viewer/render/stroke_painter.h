// Draws layers of lines and points.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/render/gl.h"
#include "viewer/render/paint_job.h"
#include "viewer/render/shader_program.h"

namespace kerf::view {

/// The framebuffer and its viewport are the caller's. Before and after each call the depth test is on with GL_LESS and
/// depth is written; blending and the stencil test are off.
class StrokePainter {
 public:
    StrokePainter(const Gl& gl, const std::string& shader_folder);

    /// The stencil has been cleared to 0.
    void begin_picture() { stencil_ = 0; }

    /// Opaque lines and points write depth, others do not.
    void draw(const PaintJob& job);

    /// Where something lies before them, faintly. Call it before draw(), lest they hide themselves.
    void draw_hidden(const PaintJob& job);

    /// Points into a framebuffer of unsigned integers: (`id`, number of the point, of the range, 0).
    void draw_ids(const PaintJob& job, std::uint32_t id);

 private:
    struct Pass {
        float least = 0;  // coverage of a pixel that is drawn: from `least` to below `below`
        float below = 2;
        float nearer = 0;  // how far before its place a stroke is drawn, in units of its radius and a pixel
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
