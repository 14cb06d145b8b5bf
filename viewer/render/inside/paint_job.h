// The task of a painter.
#pragma once

#include "viewer/model/camera.h"
#include "viewer/render/inside/gpu_geometry.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// One layer of a scene, its copy on the GPU, and the projection to draw it by.
struct PaintJob {
    const Layer& layer;
    const GpuGeometry& geometry;
    const Scene& scene;
    const Projection& projection;
    bool shows_fronts =
        false;  ///< of glass, whose backs and fronts are drawn one after the other: these are the fronts

    const std::array<float, 4>& clip_plane() const {
        static const ClipPlane everything;
        return layer.clipped ? scene.clip.plane : everything.plane;
    }

    /// Returns whether no back of a triangle can be seen, because the bodies are closed and neither the clip plane nor
    /// the near plane of the projection cuts one open. Errs on the side of false.
    bool hides_backs() const;
};

}  // namespace kerf::view
