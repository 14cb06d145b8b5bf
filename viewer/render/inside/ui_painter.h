// The painter of the user interface that Dear ImGui has laid out. ImGui's own OpenGL renderer does not start without a
// window system, therefore this one.
#pragma once

#include <string>
#include <vector>

#include "viewer/render/image.h"
#include "viewer/render/inside/gl.h"
#include "viewer/render/inside/gl_object.h"
#include "viewer/render/inside/shader_program.h"

struct ImDrawCmd;
struct ImDrawData;
struct ImDrawList;
struct ImFontAtlas;

namespace kerf::view {

class UiPainter {
 public:
    UiPainter(const Gl& gl, const std::string& shader_folder);

    /// Draws into the framebuffer that is bound, of `width` x `height` pixels. `fonts` is uploaded when it has been
    /// built anew, and loses its copy of the pixels then.
    void draw(const ImDrawData& ui, ImFontAtlas& fonts, int width, int height);
    /// Returns a picture as ImGui's ImTextureID, which is valid as long as the painter lives.
    void* add_picture(const Image& picture);

 private:
    void update_fonts(ImFontAtlas& fonts);
    void draw_list(const ImDrawList& list, const ImDrawData& ui, int width, int height);
    void draw_command(const ImDrawCmd& command, const ImDrawData& ui, int width, int height);

    const Gl& gl_;
    ShaderProgram program_;
    GlObject array_, vertices_, indices_, fonts_;
    std::vector<GlObject> pictures_;
};

}  // namespace kerf::view
