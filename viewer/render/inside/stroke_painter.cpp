// Strokes: lines and points of a width in pixels, with soft borders. Strokes of a line overlap where they join. Opaque
// strokes therefore write depth first, where they cover half of a pixel or more; then their colour is blended from a
// little nearer, so that the joint of two strokes is not cut by the depth of the first. See-through strokes must not
// add up where they overlap: the stencil lets every pixel be drawn once, first the pixels that they cover, then their
// borders around these. Each such drawing takes the next of 255 stencil values, so that the stencil is cleared only
// when they are used up. "Coverage" is the share of a pixel that a stroke covers; "nearer" the distance by which it is
// drawn before its place.
#include "viewer/render/inside/stroke_painter.h"

#include <algorithm>

namespace kerf::view {

namespace {

constexpr float hidden_alpha = 0.25f;
constexpr float depth_nearer = 3, color_nearer = 5;
constexpr float least_coverage = 1.f / 512;  // less does not change 8 bits of colour

float radius_of(const PaintJob& job) { return 0.5f * job.layer.pixels * job.projection.pixel_ratio; }

// The width of the dark rim of a disc; small discs, which would be all rim, get none.
float rim_of(const PaintJob& job) {
    const float radius = radius_of(job), ratio = job.projection.pixel_ratio;
    return radius < 2 * ratio ? -1 : std::min(0.35f * radius, 1.5f * ratio);
}

}  // namespace

StrokePainter::StrokePainter(const Gl& gl, const std::string& shader_folder)
    : gl_(gl),
      segments_(gl, shader_folder, "strokes.vert", "strokes.frag", {"SEGMENTS"}),
      points_(gl, shader_folder, "strokes.vert", "strokes.frag", {"POINTS"}),
      point_ids_(gl, shader_folder, "strokes.vert", "strokes.frag", {"POINTS", "IDS"}) {}

void StrokePainter::draw(const PaintJob& job) {
    ShaderProgram& program = program_for(job);
    gl_.DepthFunc(GL_LEQUAL);
    if (job.layer.opacity < 1)
        draw_see_through(program, job, job.layer.opacity);
    else
        draw_opaque(program, job);
    gl_.DepthFunc(GL_LESS);
}

void StrokePainter::draw_hidden(const PaintJob& job) {
    gl_.DepthFunc(GL_GREATER);
    draw_see_through(program_for(job), job, hidden_alpha * job.layer.opacity);
    gl_.DepthFunc(GL_LESS);
}

void StrokePainter::draw_ids(const PaintJob& job, std::uint32_t id) {
    point_ids_.use();
    point_ids_.set("layer", id);
    draw_pass(point_ids_, job, {.least = 0.5f, .nearer = depth_nearer});
}

void StrokePainter::draw_opaque(ShaderProgram& program, const PaintJob& job) {
    gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_pass(program, job, {.least = 0.5f, .nearer = depth_nearer});
    gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

    gl_.DepthMask(GL_FALSE);
    gl_.Enable(GL_BLEND);
    draw_pass(program, job, {.least = least_coverage, .nearer = color_nearer});
    gl_.Disable(GL_BLEND);
    gl_.DepthMask(GL_TRUE);
}

void StrokePainter::draw_see_through(ShaderProgram& program, const PaintJob& job, float alpha) {
    constexpr float inner = 0.9f;
    gl_.DepthMask(GL_FALSE);
    gl_.Enable(GL_BLEND);
    gl_.Enable(GL_STENCIL_TEST);
    gl_.StencilFunc(GL_NOTEQUAL, next_stencil(), 0xff);
    gl_.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    draw_pass(program, job, {.least = inner, .nearer = color_nearer, .alpha = alpha});
    gl_.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    draw_pass(program, job, {.least = least_coverage, .below = inner, .nearer = color_nearer, .alpha = alpha});
    gl_.Disable(GL_STENCIL_TEST);
    gl_.Disable(GL_BLEND);
    gl_.DepthMask(GL_TRUE);
}

void StrokePainter::draw_pass(ShaderProgram& program, const PaintJob& job, const Pass& pass) {
    const float radius = radius_of(job);
    program.use();
    program.set("view", job.projection.view);
    program.set("projection", job.projection.projection);
    program.set("clip_plane", job.clip_plane());
    program.set("viewport", Eigen::Vector2f(job.projection.width, job.projection.height));
    program.set("radius", radius);
    program.set("rim", rim_of(job));
    program.set("nearer", pass.nearer * (radius + 1));
    program.set("coverages", Eigen::Vector2f(pass.least, pass.below));
    job.geometry.bind_strokes();
    for (unsigned i = 0; i < job.layer.ranges.size(); ++i) {
        const Range& range = job.layer.ranges[i];
        if (range.count == 0) continue;
        Color color = range.color;
        color.a *= pass.alpha;
        program.set("color", color);
        program.set("offset", range.offset);
        program.set("range", i);
        gl_.DrawArrays(GL_TRIANGLES, 6 * range.first, 6 * range.count);
    }
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
}

ShaderProgram& StrokePainter::program_for(const PaintJob& job) {
    return job.layer.geometry->segments.empty() ? points_ : segments_;
}

int StrokePainter::next_stencil() {
    if (stencil_ == 255) {
        gl_.Clear(GL_STENCIL_BUFFER_BIT);
        stencil_ = 0;
    }
    return ++stencil_;
}

}  // namespace kerf::view
