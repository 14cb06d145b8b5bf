// Copies of geometry in the memory of the GPU.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include <Eigen/Geometry>

#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gl_object.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

// Locations of the attributes in the shaders.
namespace attribute {
constexpr GLuint position = 0, triangle_normal = 1, corner_normal = 2, edges = 3, value = 4;
constexpr GLuint from = 0, to = 1, center = 0;
}  // namespace attribute

/// The vertex array of one geometry.
class GpuGeometry {
 public:
    GpuGeometry(const Gl& gl, const Geometry& geometry);

    /// Binds the array of triangles: triangle i has the vertices 3 i, 3 i + 1 and 3 i + 2.
    void bind_triangles() const { gl_.BindVertexArray(array_.id()); }
    /// Binds the array of strokes: segment or point i has the vertices 6 i to 6 i + 5, all alike. They are two
    /// triangles, which the shader opens to a rectangle. Instances would need less memory, but OpenGL 3.3 cannot draw
    /// some out of the middle of a buffer.
    void bind_strokes() const { gl_.BindVertexArray(array_.id()); }

    const Eigen::AlignedBox3f& box() const {
        return box_;
    }  ///< box of the triangles, in draw coordinates; empty: there are none

 private:
    void upload_triangles(const Geometry& geometry);
    void upload_segments(const Geometry& geometry);
    void upload_points(const Geometry& geometry);

    const Gl& gl_;
    GlObject array_, vertices_, normals_;
    Eigen::AlignedBox3f box_;
};

/// The copies of geometries, each made when it is first asked for.
class GpuGeometryCache {
 public:
    explicit GpuGeometryCache(const Gl& gl) : gl_(gl) {}

    const GpuGeometry& get(const std::shared_ptr<const Geometry>& geometry);

    /// Removes copies whose geometry is gone or was not asked for during `patience` pictures. Call it once per picture.
    void sweep();

 private:
    static constexpr std::int64_t patience = 60;

    struct Entry {
        std::weak_ptr<const Geometry> source;  // tells whether the key, an address, belongs to another geometry by now
        std::unique_ptr<GpuGeometry> copy;
        std::int64_t last_use = 0;
    };

    const Gl& gl_;
    std::unordered_map<const Geometry*, Entry> entries_;
    std::int64_t picture_ = 0;
};

}  // namespace kerf::view
