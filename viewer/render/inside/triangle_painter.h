// The painter of triangles.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gl_object.h"
#include "viewer/render/inside/paint_job.h"
#include "viewer/render/inside/shader_program.h"

namespace kerf::view {

/// A painter of layers of triangles. The framebuffer and its viewport, the depth test, blending and culling are the
/// caller's.
class TrianglePainter {
 public:
    TrianglePainter(const Gl& gl, const std::string& shader_folder);

    void draw(const PaintJob& job);

    /// Draws triangles into a framebuffer of unsigned integers, as the numbers (`id`, triangle, range, 0).
    void draw_ids(const PaintJob& job, std::uint32_t id);

 private:
    void set_place(ShaderProgram& program, const PaintJob& job);
    void set_light(ShaderProgram& program, const Projection& projection);
    void set_scale(ShaderProgram& program, const ColorScale& scale);
    void draw_ranges(ShaderProgram& program, const PaintJob& job, bool colored);

    // A row of colours as a texture, uploaded again when they change.
    struct ColorRow {
        GlObject texture;
        std::vector<std::uint8_t> rgba;
    };
    void bind_row(ColorRow& row, const std::vector<Color>& colors);

    const Gl& gl_;
    std::map<int, std::unique_ptr<ShaderProgram>> programs_;  // programs by fill, edges and smooth (key_of())
    ShaderProgram ids_;
    ColorRow scale_, palette_;
};

}  // namespace kerf::view
