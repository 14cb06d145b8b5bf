// Dear ImGui's draw lists by OpenGL 3.3: each list is uploaded and drawn command by command, with the command's clip
// rectangle as the scissor and its texture bound. ImTextureID holds OpenGL's name of a texture. The font atlas is a
// texture of one channel, swizzled to white with the font's coverage as alpha, so that one shader serves text and
// pictures. An atlas whose pixels are there has been built since its last upload, and is uploaded again; its pixels are
// freed then. Lists that were laid out before the first upload have no texture yet and get the atlas. The scissor
// counts from the lower left, ImGui from the upper left.
#include "viewer/render/inside/ui_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <imgui.h>

namespace kerf::view {

namespace {

ImTextureID to_imgui(GLuint texture) { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)); }
GLuint from_imgui(ImTextureID texture) { return static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(texture)); }

}  // namespace

UiPainter::UiPainter(const Gl& gl, const std::string& shader_folder)
    : gl_(gl),
      program_(gl, shader_folder, "ui.vert", "ui.frag"),
      array_(GlObject::vertex_array(gl)),
      vertices_(GlObject::buffer(gl)),
      indices_(GlObject::buffer(gl)) {
    gl.BindVertexArray(array_.id());
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    constexpr GLsizei stride = sizeof(ImDrawVert);
    for (GLuint location : {0, 1, 2}) gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, buffer_offset(offsetof(ImDrawVert, pos)));
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, buffer_offset(offsetof(ImDrawVert, uv)));
    gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, buffer_offset(offsetof(ImDrawVert, col)));
    gl.BindVertexArray(0);
    gl.BindBuffer(GL_ARRAY_BUFFER, 0);
}

void UiPainter::draw(const ImDrawData& ui, ImFontAtlas& fonts, int width, int height) {
    update_fonts(fonts);
    if (ui.TotalVtxCount == 0 || ui.DisplaySize.x <= 0 || ui.DisplaySize.y <= 0) return;
    gl_.Viewport(0, 0, width, height);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Enable(GL_BLEND);
    program_.use();
    program_.set("area", std::array<float, 4>{ui.DisplayPos.x, ui.DisplayPos.y, ui.DisplaySize.x, ui.DisplaySize.y});
    program_.set("image", 0);
    for (int i = 0; i < ui.CmdListsCount; ++i) draw_list(*ui.CmdLists[i], ui, width, height);
    gl_.UseProgram(0);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    gl_.BindVertexArray(0);
    gl_.BindBuffer(GL_ARRAY_BUFFER, 0);
    gl_.Disable(GL_BLEND);
    gl_.Disable(GL_SCISSOR_TEST);
}

// Uploads the fonts if they have been built anew: an atlas that holds pixels has been built since they were last freed
// here.
void UiPainter::update_fonts(ImFontAtlas& fonts) {
    if (fonts_.id() != 0 && fonts.TexID == to_imgui(fonts_.id()) && fonts.TexPixelsAlpha8 == nullptr) return;
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    fonts.GetTexDataAsAlpha8(&pixels, &width, &height);
    if (fonts_.id() == 0) fonts_ = GlObject::texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, fonts_.id());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    // White, with the font's coverage as alpha: the same shader serves pictures.
    for (GLenum part : {GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G, GL_TEXTURE_SWIZZLE_B})
        gl_.TexParameteri(GL_TEXTURE_2D, part, GL_ONE);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_A, GL_RED);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, pixels);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    fonts.ClearTexData();
    fonts.SetTexID(to_imgui(fonts_.id()));
}

void* UiPainter::add_picture(const Image& picture) {
    pictures_.push_back(GlObject::texture(gl_));
    gl_.BindTexture(GL_TEXTURE_2D, pictures_.back().id());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                   picture.rgb.data());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_.BindTexture(GL_TEXTURE_2D, 0);
    return to_imgui(pictures_.back().id());
}

void UiPainter::draw_list(const ImDrawList& list, const ImDrawData& ui, int width, int height) {
    gl_.BindVertexArray(array_.id());
    gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    gl_.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback == nullptr)
            draw_command(command, ui, width, height);
        else if (command.UserCallback != ImDrawCallback_ResetRenderState)
            command.UserCallback(&list, &command);
    }
}

void UiPainter::draw_command(const ImDrawCmd& command, const ImDrawData& ui, int width, int height) {
    const ImVec4& clip = command.ClipRect;
    const auto pixel = [](float place, float origin, float scale, int size) {
        return std::clamp(static_cast<int>(std::lround((place - origin) * scale)), 0, size);
    };
    const int left = pixel(clip.x, ui.DisplayPos.x, ui.FramebufferScale.x, width);
    const int right = pixel(clip.z, ui.DisplayPos.x, ui.FramebufferScale.x, width);
    const int top = pixel(clip.y, ui.DisplayPos.y, ui.FramebufferScale.y, height);
    const int bottom = pixel(clip.w, ui.DisplayPos.y, ui.FramebufferScale.y, height);
    if (right <= left || bottom <= top) return;
    gl_.Scissor(left, height - bottom, right - left, bottom - top);
    // A list that was laid out before the fonts were first uploaded does not know their texture yet.
    const GLuint texture = from_imgui(command.GetTexID());
    gl_.BindTexture(GL_TEXTURE_2D, texture != 0 ? texture : fonts_.id());
    gl_.DrawElementsBaseVertex(GL_TRIANGLES, command.ElemCount,
                               sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                               buffer_offset(command.IdxOffset * sizeof(ImDrawIdx)), command.VtxOffset);
}

}  // namespace kerf::view
