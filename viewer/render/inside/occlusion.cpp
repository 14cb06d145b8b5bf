// Three passes over pixels, none over triangles, so that the cost does not grow with the scene: occlusion.frag looks
// around each place in the depth of the picture, at half the resolution; occlusion_blur.frag takes the mean of 4 x 4
// pixels of one surface, which have looked in different directions; occlusion_shade.frag multiplies the picture by it,
// but for the background, which the depth test leaves out. Directions are a fixed pattern, so that the same scene gives
// the same bytes. The projection is passed in pieces by which a shader gets the place in eye coordinates back.
#include "viewer/render/inside/occlusion.h"

#include <algorithm>
#include <cmath>

namespace kerf::view {

namespace {

constexpr float reach = 0.22f;          // of hollows that are looked for, in draw coordinates
constexpr float largest_reach = 0.14f;  // of the height of the viewport

}  // namespace

Occlusion::Occlusion(const Gl& gl, const std::string& shader_folder)
    : gl_(gl),
      measure_(gl, shader_folder, "background.vert", "occlusion.frag"),
      blur_(gl, shader_folder, "background.vert", "occlusion_blur.frag"),
      shade_(gl, shader_folder, "occlusion_shade.vert", "occlusion_shade.frag"),
      no_vertices_(GlObject::vertex_array(gl)) {}

void Occlusion::draw(const Framebuffer& target, const Projection& projection, float strength) {
    // At half of the resolution that is looked at, of which a finer screen or a picture to be averaged has more pixels.
    const int step = std::max(2, static_cast<int>(std::lround(2 * projection.pixel_ratio)));
    resize((projection.width + step - 1) / step, (projection.height + step - 1) / step);
    const Eigen::Matrix4f& p = projection.projection;
    const bool perspective = p(3, 2) != 0;
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.BindVertexArray(no_vertices_.id());
    gl_.Viewport(0, 0, width_, height_);
    for (ShaderProgram* program : {&measure_, &blur_}) {
        program->use();
        program->set("perspective", perspective ? 1.f : 0.f);
        program->set("depth_terms",
                     std::array<float, 4>{perspective ? 0.f : 1.f, -p(2, 3), perspective ? 1.f : 0.f, p(2, 2)});
        program->set("place_terms", std::array<float, 4>{p(0, 0), p(1, 1), p(0, 2), p(1, 2)});
        program->set("place_shift", Eigen::Vector2f(p(0, 3), p(1, 3)));
        program->set("corner",
                     std::array<float, 4>{static_cast<float>(projection.x), static_cast<float>(projection.y),
                                          static_cast<float>(projection.width), static_cast<float>(projection.height)});
        program->set("step", step);
        program->set("reach", Eigen::Vector2f(reach, largest_reach));
        program->set("depths", 0);
        program->set("occlusion", 1);
    }
    measure_.use();
    fill(rough_, measure_, target.depth());
    blur_.use();
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, rough_.texture.id());
    gl_.ActiveTexture(GL_TEXTURE0);
    fill(smooth_, blur_, target.depth());
    gl_.ActiveTexture(GL_TEXTURE1);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.ActiveTexture(GL_TEXTURE0);

    target.bind();
    gl_.Viewport(projection.x, projection.y, projection.width, projection.height);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthMask(GL_FALSE);
    gl_.DepthFunc(GL_GREATER);
    gl_.Enable(GL_BLEND);
    gl_.BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    shade_.use();
    shade_.set("strength", strength);
    shade_.set("occlusion", 0);
    gl_.BindTexture(GL_TEXTURE_2D, smooth_.texture.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.Disable(GL_BLEND);
    gl_.DepthFunc(GL_LESS);
    gl_.DepthMask(GL_TRUE);
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
}

void Occlusion::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    for (Shade* shade : {&rough_, &smooth_}) {
        shade->texture = GlObject::texture(gl_);
        shade->framebuffer = GlObject::framebuffer(gl_);
        gl_.BindTexture(GL_TEXTURE_2D, shade->texture.id());
        for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
        for (const GLenum border : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            gl_.TexParameteri(GL_TEXTURE_2D, border, GL_CLAMP_TO_EDGE);
        gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, nullptr);
        gl_.BindTexture(GL_TEXTURE_2D, 0);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, shade->framebuffer.id());
        gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, shade->texture.id(), 0);
    }
}

void Occlusion::fill(const Shade& shade, ShaderProgram& program, GLuint picture) {
    program.use();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, shade.framebuffer.id());
    gl_.BindTexture(GL_TEXTURE_2D, picture);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
}

}  // namespace kerf::view
