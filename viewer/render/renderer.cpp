// A picture is drawn in this order: background; opaque triangles; their hollows darker; the parts of lines and points
// that shine through; lines and points; triangles that are not opaque, backs before fronts, without writing depth.
// Backs before fronts is the right order within a convex body and needs no sorting. Closed bodies that nothing cuts
// open are drawn without their backs (PaintJob::hides_backs()), which is up to twice as fast. The picture is in a
// framebuffer of its own, so that it is the same with and without a window. A Projection's viewport counts pixels from
// the lower left corner as OpenGL does; places that callers give and get count from the top left. OpenGL's state is at
// its default between calls.
#include "viewer/render/renderer.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/error.h"
#include "viewer/render/inside/framebuffer.h"
#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gpu_geometry.h"
#include "viewer/render/inside/occlusion.h"
#include "viewer/render/inside/picker.h"
#include "viewer/render/inside/shader_program.h"
#include "viewer/render/inside/stroke_painter.h"
#include "viewer/render/inside/triangle_painter.h"
#include "viewer/render/inside/ui_painter.h"

namespace kerf::view {

namespace {

const Gl& checked_version(const Gl& gl) {
    GLint major = 0, minor = 0;
    gl.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (10 * major + minor < 33)
        throw Error(ErrorCode::internal,
                    fmt::format("Kerf needs OpenGL 3.3, this driver has {}.{}; update it.", major, minor));
    return gl;
}

// Checks OpenGL's errors in developer builds only: asking waits for the driver.
void check_in_debug([[maybe_unused]] const Gl& gl, [[maybe_unused]] const char* where) {
#ifndef NDEBUG
    check_gl(gl, where);
#endif
}

bool has_triangles(const Layer& layer) { return layer.geometry && !layer.geometry->corners.empty(); }

bool has_strokes(const Layer& layer) {
    return layer.geometry && !(layer.geometry->segments.empty() && layer.geometry->points.empty());
}

DrawnLayer count(const Layer& layer) {
    DrawnLayer drawn{.kind = layer.kind, .owner = layer.owner};
    if (!layer.geometry) return drawn;
    std::int64_t primitives = 0;
    for (const Range& range : layer.ranges) primitives += range.count;
    if (has_triangles(layer))
        drawn.triangles = primitives;
    else if (!layer.geometry->segments.empty())
        drawn.segments = primitives;
    else
        drawn.points = primitives;
    return drawn;
}

}  // namespace

class Renderer::Impl {
 public:
    Impl(const Gl& gl, const std::string& shader_folder)
        : gl_(checked_version(gl)),
          target_(gl, GL_RGBA8, 1, 1, true),
          background_(gl, shader_folder, "background.vert", "background.frag"),
          no_vertices_(GlObject::vertex_array(gl)),
          cache_(gl),
          triangles_(gl, shader_folder),
          strokes_(gl, shader_folder),
          occlusion_(gl, shader_folder),
          ui_(gl, shader_folder),
          picker_(gl) {
        gl.Enable(GL_CLIP_DISTANCE0);
        gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        target_.bind();
        check_in_debug(gl, "the start of the renderer");
    }

    void resize(int width, int height) {
        if (width != target_.width() || height != target_.height())
            target_ = Framebuffer(gl_, GL_RGBA8, width, height, true);
    }

    void clear(const Color& color) {
        const GLfloat rgba[] = {color.r, color.g, color.b, 1};
        target_.bind();
        gl_.ClearBufferfv(GL_COLOR, 0, rgba);
    }

    void draw(const Scene& scene, const Projection& projection);

    void* add_picture(const Image& picture) { return ui_.add_picture(picture); }
    void draw_ui(const ImDrawData& ui, ImFontAtlas& fonts) {
        target_.bind();
        ui_.draw(ui, fonts, target_.width(), target_.height());
        check_in_debug(gl_, "the user interface");
    }

    std::optional<PickHit> pick(const Scene& scene, const Projection& projection, int x, int y);
    std::vector<NumberPlace> places_of_patches(const Scene& scene, const Projection& projection);
    std::vector<SeenSegment> seen_isolines(const Scene& scene, const Projection& projection);
    const std::vector<DrawnLayer>& drawn() const { return drawn_; }
    void finish() { gl_.Finish(); }
    Image read();
    void present();
    std::string driver() const;

 private:
    PaintJob job(const Layer& layer, const Scene& scene, const Projection& projection) {
        return {layer, cache_.get(layer.geometry), scene, projection, false};
    }
    void begin(const Projection& projection);
    void end();
    void draw_background(const Scene& scene);
    void draw_opaque_triangles(const Scene& scene, const Projection& projection);
    void draw_strokes(const Scene& scene, const Projection& projection);
    void draw_see_through_triangles(const Scene& scene, const Projection& projection);

    const Gl& gl_;
    Framebuffer target_;
    ShaderProgram background_;
    GlObject no_vertices_;  // core profiles want an array even where the shader makes the vertices
    GpuGeometryCache cache_;
    TrianglePainter triangles_;
    StrokePainter strokes_;
    Occlusion occlusion_;
    UiPainter ui_;
    Picker picker_;
    std::vector<DrawnLayer> drawn_;
};

void Renderer::Impl::draw(const Scene& scene, const Projection& projection) {
    if (projection.width < 1 || projection.height < 1) return;
    cache_.sweep();
    begin(projection);
    draw_background(scene);
    draw_opaque_triangles(scene, projection);
    if (scene.occlusion > 0) occlusion_.draw(target_, projection, scene.occlusion);
    draw_strokes(scene, projection);
    draw_see_through_triangles(scene, projection);
    end();
    drawn_.clear();
    for (const Layer& layer : scene.layers) drawn_.push_back(count(layer));
    check_in_debug(gl_, "the scene");
}

void Renderer::Impl::begin(const Projection& projection) {
    target_.bind();
    gl_.Viewport(projection.x, projection.y, projection.width, projection.height);
    gl_.Scissor(projection.x, projection.y, projection.width, projection.height);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    strokes_.begin_picture();
}

void Renderer::Impl::end() {
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_SCISSOR_TEST);
}

void Renderer::Impl::draw_background(const Scene& scene) {
    background_.use();
    background_.set("top", scene.background_top);
    background_.set("bottom", scene.background_bottom);
    gl_.BindVertexArray(no_vertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
    gl_.Enable(GL_DEPTH_TEST);
}

void Renderer::Impl::draw_opaque_triangles(const Scene& scene, const Projection& projection) {
    for (const Layer& layer : scene.layers) {
        if (!has_triangles(layer) || layer.opacity < 1) continue;
        const PaintJob triangles = job(layer, scene, projection);
        gl_.CullFace(layer.backs_only ? GL_FRONT : GL_BACK);
        if (layer.backs_only || triangles.hides_backs()) gl_.Enable(GL_CULL_FACE);
        triangles_.draw(triangles);
        gl_.Disable(GL_CULL_FACE);
    }
}

void Renderer::Impl::draw_strokes(const Scene& scene, const Projection& projection) {
    for (const Layer& layer : scene.layers)
        if (has_strokes(layer) && layer.shines_through) strokes_.draw_hidden(job(layer, scene, projection));
    for (const Layer& layer : scene.layers)
        if (has_strokes(layer)) strokes_.draw(job(layer, scene, projection));
}

void Renderer::Impl::draw_see_through_triangles(const Scene& scene, const Projection& projection) {
    gl_.DepthMask(GL_FALSE);
    gl_.Enable(GL_BLEND);
    gl_.Enable(GL_CULL_FACE);
    for (GLenum hidden_side : {GL_FRONT, GL_BACK}) {
        gl_.CullFace(hidden_side);
        for (const Layer& layer : scene.layers)
            if (has_triangles(layer) && layer.opacity < 1 && !(layer.front_share == 0 && hidden_side == GL_BACK)) {
                PaintJob glass = job(layer, scene, projection);
                glass.shows_fronts = hidden_side == GL_BACK;
                triangles_.draw(glass);
            }
    }
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    gl_.DepthMask(GL_TRUE);
}

std::optional<PickHit> Renderer::Impl::pick(const Scene& scene, const Projection& projection, int x, int y) {
    const int right = x - projection.x, up = target_.height() - 1 - y - projection.y;
    if (right < 0 || up < 0 || right >= projection.width || up >= projection.height) return std::nullopt;
    std::optional<PickHit> hit = picker_.pick(scene, projection, right, up, cache_, triangles_, strokes_);
    check_in_debug(gl_, "picking");
    return hit;
}

std::vector<NumberPlace> Renderer::Impl::places_of_patches(const Scene& scene, const Projection& projection) {
    if (projection.width < 1 || projection.height < 1) return {};
    const std::vector<std::int32_t> patches = picker_.patches(scene, projection, cache_, triangles_, strokes_);
    std::vector<NumberPlace> places = widest_places(patches, projection.width, projection.height);
    for (NumberPlace& place : places) {
        place.x += projection.x;
        place.y = target_.height() - 1 - projection.y - place.y;
    }
    check_in_debug(gl_, "numbers of patches");
    return places;
}

std::vector<SeenSegment> Renderer::Impl::seen_isolines(const Scene& scene, const Projection& projection) {
    if (projection.width < 1 || projection.height < 1) return {};
    const std::vector<GLuint> ids = picker_.ids(scene, projection, cache_, triangles_, strokes_);
    std::vector<SeenSegment> seen = seen_lines(scene, projection, ids);
    for (SeenSegment& segment : seen)
        for (Eigen::Vector2f* end : {&segment.from, &segment.to})
            *end = {end->x() + projection.x, target_.height() - projection.y - end->y()};
    check_in_debug(gl_, "isolines");
    return seen;
}

Image Renderer::Impl::read() {
    Image image{target_.width(), target_.height(), {}};
    const std::size_t row = 3 * image.width;
    image.rgb.resize(row * image.height);
    target_.bind();
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    for (int low = 0, high = image.height - 1; low < high; ++low, --high)
        std::swap_ranges(&image.rgb[row * low], &image.rgb[row * low] + row, &image.rgb[row * high]);
    return image;
}

void Renderer::Impl::present() {
    const int width = target_.width(), height = target_.height();
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_.id());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    target_.bind();
    check_in_debug(gl_, "copying the picture to the window");
}

std::string Renderer::Impl::driver() const {
    const auto text = [&](GLenum name) {
        const GLubyte* words = gl_.GetString(name);
        return std::string(words != nullptr ? reinterpret_cast<const char*>(words) : "unknown");
    };
    return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

Renderer::Renderer(const Gl& gl, const std::string& shader_folder) : impl_(std::make_unique<Impl>(gl, shader_folder)) {}
Renderer::~Renderer() = default;

void Renderer::resize(int width, int height) { impl_->resize(width, height); }
void Renderer::clear(const Color& color) { impl_->clear(color); }
void Renderer::draw(const Scene& scene, const Projection& projection) { impl_->draw(scene, projection); }
void* Renderer::add_picture(const Image& picture) { return impl_->add_picture(picture); }
void Renderer::draw_ui(const ImDrawData& ui, ImFontAtlas& fonts) { impl_->draw_ui(ui, fonts); }
std::optional<PickHit> Renderer::pick(const Scene& scene, const Projection& projection, int x, int y) {
    return impl_->pick(scene, projection, x, y);
}
std::vector<NumberPlace> Renderer::places_of_patches(const Scene& scene, const Projection& projection) {
    return impl_->places_of_patches(scene, projection);
}
std::vector<SeenSegment> Renderer::seen_isolines(const Scene& scene, const Projection& projection) {
    return impl_->seen_isolines(scene, projection);
}
const std::vector<DrawnLayer>& Renderer::drawn() const { return impl_->drawn(); }
void Renderer::finish() { impl_->finish(); }
Image Renderer::read() { return impl_->read(); }
void Renderer::present() { impl_->present(); }
std::string Renderer::driver() const { return impl_->driver(); }

}  // namespace kerf::view
