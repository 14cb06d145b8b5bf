// Finds what lies under a pixel by drawing numbers instead of colours, only around that pixel.
#pragma once

#include <optional>
#include <string>

#include "viewer/model/camera.h"
#include "viewer/render/framebuffer.h"
#include "viewer/render/gl.h"
#include "viewer/render/gpu_geometry.h"
#include "viewer/render/renderer.h"
#include "viewer/render/stroke_painter.h"
#include "viewer/render/triangle_painter.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// `projection` narrowed to the pixel at (x, y) of its viewport, from its lower left corner: a viewport of 1 x 1.
Projection narrow_to_pixel(const Projection& projection, int x, int y);

class Picker {
 public:
    explicit Picker(const Gl& gl) : gl_(gl), target_(gl, GL_RGBA32UI, 1, 1) {}

    /// See Renderer::pick; (x, y) counts from the lower left corner of the viewport. Leaves another framebuffer bound.
    std::optional<PickHit> pick(const Scene& scene, const Projection& projection, int x, int y, GpuGeometryCache& cache,
                                TrianglePainter& triangles, StrokePainter& strokes);

 private:
    const Gl& gl_;
    Framebuffer target_;
};

}  // namespace kerf::view
