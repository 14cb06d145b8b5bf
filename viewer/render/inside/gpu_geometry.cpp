// Upload of geometry to the GPU. A corner goes up as it is in memory (struct Corner is the vertex format); the normals
// of triangles are computed here and go into a buffer of their own, 16 bits a component, because the scene does not
// keep them. A segment or point is copied six times, all alike: the vertex shader opens the copies to a rectangle by
// their number. The cache is keyed by the address of a geometry, which may be used again for another one, so that each
// entry holds a weak pointer and is made anew when that is not the same geometry. A copy dies with its geometry or
// after `patience` pictures without use.
#include "viewer/render/inside/gpu_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::view {

namespace {

Eigen::Vector3f to_eigen(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

// A normal of 16 bits a component; the shader reads three of the four as a direction.
struct PackedNormal {
    std::int16_t x, y, z, unused;
};

PackedNormal pack(const Eigen::Vector3f& normal) {
    const auto part = [&](int i) { return static_cast<std::int16_t>(std::lround(32767 * normal[i])); };
    return {part(0), part(1), part(2), 0};
}

// The normal of a triangle, in double, since the corners of small triangles differ in their last digits only.
Eigen::Vector3f normal_of(const Corner* corners) {
    const Eigen::Vector3d a = to_eigen(corners[0].position).cast<double>();
    const Eigen::Vector3d b = to_eigen(corners[1].position).cast<double>();
    const Eigen::Vector3d c = to_eigen(corners[2].position).cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const double length = normal.norm();
    return length > 0 && std::isfinite(length) ? Eigen::Vector3f((normal / length).cast<float>())
                                               : Eigen::Vector3f::UnitZ();
}

std::vector<PackedNormal> triangle_normals(const std::vector<Corner>& corners) {
    std::vector<PackedNormal> normals(corners.size());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) std::fill_n(&normals[i], 3, pack(normal_of(&corners[i])));
    return normals;
}

template <class Item>
std::vector<Item> six_of_each(const std::vector<Item>& items) {
    std::vector<Item> copies;
    copies.reserve(6 * items.size());
    for (const Item& item : items) copies.insert(copies.end(), 6, item);
    return copies;
}

template <class Item>
void upload(const Gl& gl, const GlObject& buffer, const std::vector<Item>& items) {
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer.id());
    gl.BufferData(GL_ARRAY_BUFFER, items.size() * sizeof(Item), items.data(), GL_STATIC_DRAW);
}

}  // namespace

GpuGeometry::GpuGeometry(const Gl& gl, const Geometry& geometry)
    : gl_(gl), array_(GlObject::vertex_array(gl)), vertices_(GlObject::buffer(gl)) {
    gl.BindVertexArray(array_.id());
    if (!geometry.corners.empty())
        upload_triangles(geometry);
    else if (!geometry.segments.empty())
        upload_segments(geometry);
    else
        upload_points(geometry);
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

void GpuGeometry::upload_triangles(const Geometry& geometry) {
    constexpr GLsizei stride = sizeof(Corner);
    upload(gl_, vertices_, geometry.corners);
    gl_.EnableVertexAttribArray(attribute::position);
    gl_.VertexAttribPointer(attribute::position, 3, GL_FLOAT, GL_FALSE, stride,
                            buffer_offset(offsetof(Corner, position)));
    gl_.EnableVertexAttribArray(attribute::corner_normal);
    gl_.VertexAttribPointer(attribute::corner_normal, 3, GL_SHORT, GL_TRUE, stride,
                            buffer_offset(offsetof(Corner, normal)));
    gl_.EnableVertexAttribArray(attribute::edges);
    gl_.VertexAttribIPointer(attribute::edges, 1, GL_UNSIGNED_SHORT, stride, buffer_offset(offsetof(Corner, edges)));
    gl_.EnableVertexAttribArray(attribute::value);
    gl_.VertexAttribPointer(attribute::value, 1, GL_FLOAT, GL_FALSE, stride, buffer_offset(offsetof(Corner, value)));
    for (const Corner& corner : geometry.corners) box_.extend(to_eigen(corner.position));
    normals_ = GlObject::buffer(gl_);
    upload(gl_, normals_, triangle_normals(geometry.corners));
    gl_.EnableVertexAttribArray(attribute::triangle_normal);
    gl_.VertexAttribPointer(attribute::triangle_normal, 3, GL_SHORT, GL_TRUE, sizeof(PackedNormal), buffer_offset(0));
}

void GpuGeometry::upload_segments(const Geometry& geometry) {
    constexpr GLsizei stride = sizeof(Segment);
    upload(gl_, vertices_, six_of_each(geometry.segments));
    gl_.EnableVertexAttribArray(attribute::from);
    gl_.VertexAttribPointer(attribute::from, 3, GL_FLOAT, GL_FALSE, stride, buffer_offset(offsetof(Segment, from)));
    gl_.EnableVertexAttribArray(attribute::to);
    gl_.VertexAttribPointer(attribute::to, 3, GL_FLOAT, GL_FALSE, stride, buffer_offset(offsetof(Segment, to)));
}

void GpuGeometry::upload_points(const Geometry& geometry) {
    upload(gl_, vertices_, six_of_each(geometry.points));
    gl_.EnableVertexAttribArray(attribute::center);
    gl_.VertexAttribPointer(attribute::center, 3, GL_FLOAT, GL_FALSE, sizeof(geometry.points[0]), buffer_offset(0));
}

const GpuGeometry& GpuGeometryCache::get(const std::shared_ptr<const Geometry>& geometry) {
    Entry& entry = entries_[geometry.get()];
    if (entry.source.lock() != geometry) {
        entry.copy = std::make_unique<GpuGeometry>(gl_, *geometry);
        entry.source = geometry;
    }
    entry.last_use = picture_;
    return *entry.copy;
}

void GpuGeometryCache::sweep() {
    ++picture_;
    std::erase_if(entries_, [&](const auto& item) {
        return item.second.source.expired() || item.second.last_use + patience < picture_;
    });
}

}  // namespace kerf::view
