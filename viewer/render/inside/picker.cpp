// Picking by an id buffer: the shaders write numbers (layer + 1, primitive, range, 0) instead of colours into a target
// of 32-bit integers, so that the answer is exact whatever is drawn over the primitive. Layers that are opaque but
// cannot be picked write layer 0: they hide others and are not hit. For a single pixel the projection is narrowed to a
// viewport of 1 x 1, so that the GPU rasters one pixel. The point that is hit is the intersection of the line of sight
// with the triangle, in double: the depth buffer's 24 bits are too coarse for close looks. Value and place at rest are
// interpolated by barycentric coordinates; `offset` is the range's, by which a part is pulled away when it is drawn.
#include "viewer/render/inside/picker.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kerf::view {

namespace {

using Vec3d = Eigen::Vector3d;

struct Ray {
    Vec3d from, to;
};

Vec3d to_double(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

bool is_pickable(const Layer& layer) { return layer.geometry && !layer.geometry->element.empty(); }

// The line of sight, in draw coordinates, through the middle of the only pixel of a narrowed projection.
Ray ray_of(const Projection& pixel) {
    const Eigen::Matrix4d back = (pixel.projection.cast<double>() * pixel.view.cast<double>()).inverse();
    const auto unproject = [&](double depth) { return Vec3d((back * Eigen::Vector4d(0, 0, depth, 1)).hnormalized()); };
    return {unproject(-1), unproject(1)};
}

// The point of the triangle's plane on the line of sight; the triangle's centre where the plane holds that line.
Vec3d point_on_triangle(const Corner* corners, const Ray& ray) {
    const Vec3d a = to_double(corners[0].position);
    const Vec3d b = to_double(corners[1].position), c = to_double(corners[2].position);
    const Vec3d normal = (b - a).cross(c - a);
    const double slope = normal.dot(ray.to - ray.from);
    if (std::abs(slope) <= 1e-9 * normal.norm() * (ray.to - ray.from).norm()) return (a + b + c) / 3;
    return ray.from + normal.dot(a - ray.from) / slope * (ray.to - ray.from);
}

Eigen::Vector3f point_of(const Geometry& geometry, std::uint32_t primitive, const Range& range, Ray ray) {
    if (geometry.corners.empty()) return to_double(geometry.points[primitive]).cast<float>();
    const Vec3d offset = to_double(range.offset);
    ray = {ray.from - offset, ray.to - offset};
    return point_on_triangle(&geometry.corners[3 * std::size_t{primitive}], ray).cast<float>();
}

// The barycentric coordinates of a point of a triangle; thirds where the triangle has no area.
Vec3d shares_of_corners(const Corner* corners, const Vec3d& point) {
    const Vec3d a = to_double(corners[0].position);
    const Vec3d ab = to_double(corners[1].position) - a, ac = to_double(corners[2].position) - a;
    const Vec3d normal = ab.cross(ac);
    if (!(normal.squaredNorm() > 0)) return Vec3d::Constant(1.0 / 3);
    const double b = normal.dot((point - a).cross(ac)) / normal.squaredNorm();
    const double c = normal.dot(ab.cross(point - a)) / normal.squaredNorm();
    return {1 - b - c, b, c};
}

void set_value(const Layer& layer, PickHit& hit) {
    hit.rest = hit.point;
    hit.value = std::nanf("");
    const Geometry& geometry = *layer.geometry;
    if (geometry.corners.empty()) return;
    const std::size_t first = 3 * static_cast<std::size_t>(hit.primitive);
    const Vec3d shares = shares_of_corners(&geometry.corners[first], hit.point.cast<double>());
    double value = 0;
    Vec3d rest = Vec3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = shares[k];
        value += share * geometry.corners[first + k].value;
        if (!geometry.rest.empty()) rest += share * to_double(geometry.rest[first + k]);
    }
    if (layer.fill == Fill::scale) hit.value = static_cast<float>(value);
    if (!geometry.rest.empty()) hit.rest = rest.cast<float>();
}

PickHit describe(const Scene& scene, std::size_t number, std::uint32_t primitive, std::uint32_t range,
                 const Projection& pixel) {
    const Layer& layer = scene.layers[number];
    PickHit hit;
    hit.layer = number;
    hit.owner = layer.ranges[range].owner;
    hit.range = range;
    hit.primitive = primitive;
    hit.element = layer.geometry->element[primitive];
    hit.point = point_of(*layer.geometry, primitive, layer.ranges[range], ray_of(pixel));
    set_value(layer, hit);
    return hit;
}

}  // namespace

Projection narrow_to_pixel(const Projection& projection, int x, int y) {
    const double width = projection.width, height = projection.height;
    Eigen::Matrix4d narrow = Eigen::Matrix4d::Identity();
    narrow(0, 0) = width;
    narrow(1, 1) = height;
    narrow(0, 3) = width - 2 * x - 1;
    narrow(1, 3) = height - 2 * y - 1;
    Projection pixel = projection;
    pixel.projection = (narrow * projection.projection.cast<double>()).cast<float>();
    pixel.x = pixel.y = 0;
    pixel.width = pixel.height = 1;
    return pixel;
}

// Draws the numbers of each pixel: layer + 1, primitive, range, 0.
std::vector<GLuint> Picker::draw(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                                 TrianglePainter& triangles, StrokePainter& strokes) {
    if (target_.width() != projection.width || target_.height() != projection.height)
        target_ = Framebuffer(gl_, GL_RGBA32UI, projection.width, projection.height);
    target_.bind();
    gl_.Viewport(0, 0, projection.width, projection.height);
    constexpr GLuint nothing[4] = {};
    constexpr GLfloat far = 1;
    gl_.ClearBufferuiv(GL_COLOR, 0, nothing);
    gl_.ClearBufferfv(GL_DEPTH, 0, &far);
    gl_.Enable(GL_DEPTH_TEST);
    for (std::uint32_t i = 0; i < scene.layers.size(); ++i) {
        const Layer& layer = scene.layers[i];
        if (!layer.geometry || layer.opacity < 1 || layer.backs_only) continue;
        const std::uint32_t id = is_pickable(layer) ? i + 1 : 0;
        const PaintJob job = {layer, cache.get(layer.geometry), scene, projection};
        if (!layer.geometry->corners.empty())
            triangles.draw_ids(job, id);
        else if (id != 0 && !layer.geometry->points.empty())
            strokes.draw_ids(job, id);
    }
    gl_.Disable(GL_DEPTH_TEST);
    std::vector<GLuint> ids(4 * static_cast<std::size_t>(projection.width) * projection.height);
    gl_.ReadPixels(0, 0, projection.width, projection.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, ids.data());
    return ids;
}

std::optional<PickHit> Picker::pick(const Scene& scene, const Projection& projection, int x, int y,
                                    GpuGeometryCache& cache, TrianglePainter& triangles, StrokePainter& strokes) {
    const Projection pixel = narrow_to_pixel(projection, x, y);
    const std::vector<GLuint> id = draw(scene, pixel, cache, triangles, strokes);
    if (id[0] == 0) return std::nullopt;
    return describe(scene, id[0] - 1, id[1], id[2], pixel);
}

std::vector<GLuint> Picker::ids(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                                TrianglePainter& triangles, StrokePainter& strokes) {
    Projection whole = projection;
    whole.x = whole.y = 0;
    return draw(scene, whole, cache, triangles, strokes);
}

std::vector<std::int32_t> Picker::patches(const Scene& scene, const Projection& projection, GpuGeometryCache& cache,
                                          TrianglePainter& triangles, StrokePainter& strokes) {
    const std::vector<GLuint> ids = this->ids(scene, projection, cache, triangles, strokes);
    std::vector<std::int32_t> patches;
    patches.reserve(ids.size() / 4);
    for (std::size_t i = 0; i < ids.size(); i += 4) {
        const Layer* layer = ids[i] > 0 ? &scene.layers[ids[i] - 1] : nullptr;
        patches.push_back(layer && layer->patch ? (*layer->patch)[ids[i + 1]] : -1);
    }
    return patches;
}

}  // namespace kerf::view
