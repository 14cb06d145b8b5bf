// Triangles by a program for each combination of fill, edges and shading, twelve in all: a driver that computes on the
// CPU pays for every unused line of a shader. Colours come from a texture of one row, of which shaders fetch single
// texels: a scale is subdivided into 1024 steps, finer than 8 bits of colour show, and a palette is taken as it is; a
// row is uploaded again only when its bytes change. Lights are fixed to the eye, so that the side that is looked at is
// lit. Edges fade where triangles are only a few pixels high, as they would blacken a fine mesh.
#include "viewer/render/inside/triangle_painter.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace kerf::view {

namespace {

// Heights of triangles in pixels: edges are not drawn below the first, and fully the second above it.
constexpr float least_height = 3, height_span = 11;
constexpr int scale_steps = 1024;  // finer than 8 bits of colour show

int key_of(Fill fill, bool edges, bool smooth) { return 4 * static_cast<int>(fill) + 2 * edges + smooth; }

std::vector<std::string> defines_of(Fill fill, bool edges, bool smooth) {
    std::vector<std::string> defines;
    if (fill == Fill::scale) defines.push_back("SCALE");
    if (fill == Fill::categories) defines.push_back("CATEGORIES");
    if (edges) defines.push_back("EDGES");
    if (smooth) defines.push_back("SMOOTH");
    return defines;
}

Color mix(const Color& a, const Color& b, float t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

std::vector<Color> subdivide(const std::vector<Color>& colors) {
    std::vector<Color> steps(scale_steps);
    for (int i = 0; i < scale_steps; ++i) {
        const float place = static_cast<float>(i) / (scale_steps - 1) * (colors.size() - 1);
        const std::size_t left = std::min(static_cast<std::size_t>(place), colors.size() - 2);
        steps[i] = mix(colors[left], colors[left + 1], place - left);
    }
    return steps;
}

std::vector<std::uint8_t> to_bytes(const std::vector<Color>& colors) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * colors.size());
    for (const Color& c : colors)
        for (float part : {c.r, c.g, c.b, c.a})
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.f, 1.f))));
    return bytes;
}

// The fill that a layer really gets: without colours to choose from, those of the ranges.
Fill fill_of(const Layer& layer, const Scene& scene) {
    if (layer.fill == Fill::scale && scene.scale.colors.size() < 2) return Fill::plain;
    if (layer.fill == Fill::categories && scene.palette.empty()) return Fill::plain;
    return layer.fill;
}

// Turns a direction from eye coordinates to draw coordinates.
Eigen::Vector3f from_eye(const Projection& projection, const Eigen::Vector3f& direction) {
    return (projection.view.topLeftCorner<3, 3>().transpose() * direction).normalized();
}

// The point of the eye (w = 1), or the direction towards it (w = 0), in draw coordinates.
std::array<float, 4> eye_of(const Projection& projection) {
    const bool perspective = projection.projection(3, 2) != 0;
    const Eigen::Vector4f in_eye(0, 0, perspective ? 0 : 1, perspective ? 1 : 0);
    const Eigen::Vector4f eye = projection.view.inverse() * in_eye;
    return {eye[0], eye[1], eye[2], eye[3]};
}

}  // namespace

TrianglePainter::TrianglePainter(const Gl& gl, const std::string& shader_folder)
    : gl_(gl), ids_(gl, shader_folder, "triangles.vert", "triangle_ids.frag", {"IDS"}) {
    for (Fill fill : {Fill::plain, Fill::scale, Fill::categories})
        for (bool edges : {false, true})
            for (bool smooth : {false, true})
                programs_[key_of(fill, edges, smooth)] = std::make_unique<ShaderProgram>(
                    gl, shader_folder, "triangles.vert", "triangles.frag", defines_of(fill, edges, smooth));
}

void TrianglePainter::draw(const PaintJob& job) {
    const Fill fill = fill_of(job.layer, job.scene);
    ShaderProgram& program = *programs_.at(key_of(fill, job.layer.edges, job.layer.smooth));
    program.use();
    set_place(program, job);
    set_light(program, job.projection);
    program.set("opacity", job.layer.opacity * (job.shows_fronts ? job.layer.front_share : 1));
    program.set("two_sided", job.layer.two_sided ? 1 : 0);
    program.set("shading", job.layer.shading);
    program.set("edge", job.scene.edge);
    const float ratio = job.projection.pixel_ratio;
    program.set("edge_widths", Eigen::Vector3f(ratio, least_height * ratio, 1 / (height_span * ratio)));
    if (fill == Fill::scale) set_scale(program, job.scene.scale);
    if (fill == Fill::categories) bind_row(palette_, job.scene.palette);
    if (fill != Fill::plain) program.set("color", job.scene.scale.none);
    draw_ranges(program, job, fill == Fill::plain);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.UseProgram(0);
}

void TrianglePainter::draw_ids(const PaintJob& job, std::uint32_t id) {
    ids_.use();
    set_place(ids_, job);
    ids_.set("layer", id);
    draw_ranges(ids_, job, false);
    gl_.UseProgram(0);
}

void TrianglePainter::set_place(ShaderProgram& program, const PaintJob& job) {
    program.set("transform", Eigen::Matrix4f(job.projection.projection * job.projection.view));
    program.set("clip_plane", job.clip_plane());
}

void TrianglePainter::set_light(ShaderProgram& program, const Projection& projection) {
    program.set("key_light", from_eye(projection, {-0.35f, 0.45f, 1}));
    program.set("fill_light", from_eye(projection, {0.8f, -0.35f, 0.3f}));
    program.set("eye", eye_of(projection));
    program.set("up", from_eye(projection, {0, 1, 0}));
}

void TrianglePainter::set_scale(ShaderProgram& program, const ColorScale& scale) {
    const float length = scale.high - scale.low;
    program.set("value_range", Eigen::Vector2f(scale.low, length != 0 ? 1 / length : 0));
    bind_row(scale_, subdivide(scale.colors));
}

void TrianglePainter::draw_ranges(ShaderProgram& program, const PaintJob& job, bool colored) {
    const bool hides_inside = job.hides_backs();
    job.geometry.bind_triangles();
    for (unsigned i = 0; i < job.layer.ranges.size(); ++i) {
        const Range& range = job.layer.ranges[i];
        if (range.count == 0 || (range.inside && hides_inside)) continue;
        program.set("range", i);
        program.set("offset", range.offset);
        if (colored) program.set("color", range.color);
        gl_.DrawArrays(GL_TRIANGLES, 3 * range.first, 3 * range.count);
    }
    gl_.BindVertexArray(0);
}

void TrianglePainter::bind_row(ColorRow& row, const std::vector<Color>& colors) {
    std::vector<std::uint8_t> bytes = to_bytes(colors);
    if (row.texture.id() == 0) row.texture = GlObject::texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, row.texture.id());
    if (bytes == row.rgba) return;
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, colors.size(), 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    row.rgba = std::move(bytes);
}

}  // namespace kerf::view
