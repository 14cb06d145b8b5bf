// The palettes of both themes, ImGui's style, and the fonts. Colours are given once by their meaning (Palette), and
// ImGui's own colours are made of them, so that no panel names a colour. Lengths here are in pixels at scale 1; panels
// measure in em(), the height of the font, which scales with the screen. Two fonts are loaded, the usual one first and
// then one for titles; the usual one has Latin, Greek and Cyrillic letters, as names of files and patches may be in any
// European language. Without any font file ImGui's own font is taken, as ImGui would abort.
#include "viewer/panels/inside/style.h"

#include "viewer/panels/inside/font_file.h"
#include "viewer/panels/panels.h"

namespace kerf::view {

namespace {

constexpr const char* font_family = "DejaVu Sans";
constexpr float title_ratio = 1.6f;

ImVec4 rgb(unsigned hex, float alpha = 1) {
    return {(hex >> 16 & 255) / 255.f, (hex >> 8 & 255) / 255.f, (hex & 255) / 255.f, alpha};
}

const Palette light = {.text = rgb(0x1d2430),
                       .dim = rgb(0x606b7b),
                       .accent = rgb(0x2a66b1),
                       .on_accent = rgb(0xffffff),
                       .good = rgb(0x2b7d47),
                       .busy = rgb(0x2a66b1),
                       .warning = rgb(0x9a6200),
                       .bad = rgb(0xbd2b2b),
                       .waiting = rgb(0x858e9b),
                       .panel = rgb(0xf4f5f7),
                       .frame = rgb(0xe3e6eb),
                       .border = rgb(0xcdd2da),
                       .backdrop = rgb(0xffffff, 0.82f)};

const Palette dark = {.text = rgb(0xe4e8ee),
                      .dim = rgb(0x98a3b3),
                      .accent = rgb(0x5b9be0),
                      .on_accent = rgb(0x0e1520),
                      .good = rgb(0x6cc48a),
                      .busy = rgb(0x5b9be0),
                      .warning = rgb(0xe0ab4e),
                      .bad = rgb(0xf07a74),
                      .waiting = rgb(0x7c8798),
                      .panel = rgb(0x20252d),
                      .frame = rgb(0x323a46),
                      .border = rgb(0x414b59),
                      .backdrop = rgb(0x171b21, 0.82f)};

void set_surfaces(ImVec4* colors, const Palette& p) {
    colors[ImGuiCol_Text] = p.text;
    colors[ImGuiCol_TextDisabled] = p.dim;
    colors[ImGuiCol_WindowBg] = p.panel;
    colors[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_PopupBg] = p.panel;
    colors[ImGuiCol_Border] = p.border;
    colors[ImGuiCol_Separator] = p.border;
    colors[ImGuiCol_MenuBarBg] = p.frame;
    colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = colors[ImGuiCol_TitleBgCollapsed] = p.frame;
    colors[ImGuiCol_FrameBg] = p.frame;
    colors[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_ScrollbarGrab] = faded(p.dim, 0.35f);
    colors[ImGuiCol_ScrollbarGrabHovered] = faded(p.dim, 0.6f);
    colors[ImGuiCol_ScrollbarGrabActive] = faded(p.dim, 0.8f);
    colors[ImGuiCol_TableHeaderBg] = p.frame;
    colors[ImGuiCol_TableBorderStrong] = colors[ImGuiCol_TableBorderLight] = p.border;
    colors[ImGuiCol_TableRowBg] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_TableRowBgAlt] = faded(p.dim, 0.07f);
    colors[ImGuiCol_ModalWindowDimBg] = rgb(0x10151c, 0.45f);
}

void set_interactive(ImVec4* colors, const Palette& p) {
    colors[ImGuiCol_FrameBgHovered] = faded(p.accent, 0.25f);
    colors[ImGuiCol_FrameBgActive] = faded(p.accent, 0.4f);
    colors[ImGuiCol_Button] = p.frame;
    colors[ImGuiCol_ButtonHovered] = faded(p.accent, 0.3f);
    colors[ImGuiCol_ButtonActive] = faded(p.accent, 0.5f);
    colors[ImGuiCol_Header] = faded(p.accent, 0.22f);
    colors[ImGuiCol_HeaderHovered] = faded(p.accent, 0.16f);
    colors[ImGuiCol_HeaderActive] = faded(p.accent, 0.34f);
    colors[ImGuiCol_CheckMark] = p.accent;
    colors[ImGuiCol_SliderGrab] = faded(p.accent, 0.45f);  // the number over it stays readable
    colors[ImGuiCol_SliderGrabActive] = faded(p.accent, 0.6f);
    colors[ImGuiCol_SeparatorHovered] = colors[ImGuiCol_SeparatorActive] = p.accent;
    colors[ImGuiCol_ResizeGrip] = ImVec4(0, 0, 0, 0);
    colors[ImGuiCol_Tab] = colors[ImGuiCol_TabUnfocused] = p.panel;
    colors[ImGuiCol_TabActive] = colors[ImGuiCol_TabUnfocusedActive] = faded(p.accent, 0.28f);
    colors[ImGuiCol_TabHovered] = faded(p.accent, 0.2f);
    colors[ImGuiCol_PlotHistogram] = p.accent;
    colors[ImGuiCol_TextSelectedBg] = faded(p.accent, 0.35f);
    colors[ImGuiCol_NavHighlight] = p.accent;
    colors[ImGuiCol_DragDropTarget] = p.accent;
}

}  // namespace

const Palette& palette(Theme theme) { return theme == Theme::light ? light : dark; }

void set_style(Theme theme, float scale) {
    ImGuiStyle style;
    style.WindowPadding = {8, 8};
    style.FramePadding = {6, 3};
    style.ItemSpacing = {7, 5};
    style.ItemInnerSpacing = {5, 4};
    style.CellPadding = {3, 2};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 10;
    style.WindowRounding = 0;
    style.ChildRounding = style.PopupRounding = 4;
    style.FrameRounding = style.GrabRounding = style.TabRounding = 3;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.FrameBorderSize = 1;
    style.PopupBorderSize = style.ChildBorderSize = 1;
    style.DisabledAlpha = 0.5f;
    style.ScaleAllSizes(scale);
    style.WindowMinSize = {1, 1};  // whatever the scale: bars are lower than the default, and ImGui takes no less
    set_surfaces(style.Colors, palette(theme));
    set_interactive(style.Colors, palette(theme));
    ImGui::GetStyle() = style;
}

float em() {
    const ImGuiIO& io = ImGui::GetIO();
    const ImFont* font = io.FontDefault ? io.FontDefault : io.Fonts->Fonts.empty() ? nullptr : io.Fonts->Fonts[0];
    return font ? font->FontSize * io.FontGlobalScale : 15;
}

ImFont* large_font() {
    const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    return atlas.Fonts.Size > 1 ? atlas.Fonts[1] : ImGui::GetFont();
}

void load_fonts(ImFontAtlas& atlas, float pixels) {
    // Names of files and patches may be in any European language.
    static const ImWchar letters[] = {0x20, 0x17f, 0x370, 0x3ff, 0x400, 0x45f, 0x2010, 0x2027, 0};
    atlas.Clear();
    const FontFile file = find_font(font_family);
    if (file.path.empty()) {  // ImGui would abort
        ImFontConfig config;
        config.SizePixels = pixels;
        atlas.AddFontDefault(&config);
        config.SizePixels = title_ratio * pixels;
        atlas.AddFontDefault(&config);
    } else {
        ImFontConfig config;
        config.OversampleH = 2;
        config.OversampleV = 1;
        config.FontNo = file.number;
        atlas.AddFontFromFileTTF(file.path.c_str(), pixels, &config, letters);
        atlas.AddFontFromFileTTF(file.path.c_str(), title_ratio * pixels, &config);
    }
    atlas.Build();
}

}  // namespace kerf::view
