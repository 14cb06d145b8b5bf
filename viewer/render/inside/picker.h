// The primitive under a pixel, or under each pixel, found by drawing numbers instead of colours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/camera.h"
#include "viewer/render/inside/framebuffer.h"
#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gpu_geometry.h"
#include "viewer/render/inside/stroke_painter.h"
#include "viewer/render/inside/triangle_painter.h"
#include "viewer/render/renderer.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// Returns `projection` narrowed to the pixel at (x, y) of its viewport, counted from the lower left corner: its
/// viewport is 1 x 1.
Projection narrow_to_pixel(const Projection& projection, int x, int y);

class Picker {
 public:
    explicit Picker(const Gl& gl) : gl_(gl), target_(gl, GL_RGBA32UI, 1, 1) {}

    /// Returns the foremost primitive at a pixel (see Renderer::pick); (x, y) counts from the lower left corner of the
    /// viewport. Leaves another framebuffer bound.
    std::optional<PickHit> pick(const Scene& scene, const Projection& projection, int x, int y, GpuGeometryCache& cache,
                                TrianglePainter& triangles, StrokePainter& strokes);

    /// Returns four numbers for each pixel of the viewport: layer + 1 or 0, triangle or point, range, 0; rows from the
    /// bottom to the top. Leaves another framebuffer bound.
    std::vector<GLuint> ids(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                            TrianglePainter& triangles, StrokePainter& strokes);

    /// Returns for each pixel of the viewport the number in Layer::patch of the triangle seen there, or -1; rows from
    /// the bottom to the top. Leaves another framebuffer bound.
    std::vector<std::int32_t> patches(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                                      TrianglePainter& triangles, StrokePainter& strokes);

 private:
    std::vector<GLuint> draw(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                             TrianglePainter& triangles, StrokePainter& strokes);

    const Gl& gl_;
    Framebuffer target_;
};

}  // namespace kerf::view
