#include "viewer/panels/inside/font_file.h"

#include <filesystem>
#include <memory>

#include <fontconfig/fontconfig.h>

namespace kerf::view {

namespace {

struct DestroyOfFontconfig {
    void operator()(FcConfig* unused) const { FcConfigDestroy(unused); }
    void operator()(FcPattern* unused) const { FcPatternDestroy(unused); }
};
using Fonts = std::unique_ptr<FcConfig, DestroyOfFontconfig>;
using Pattern = std::unique_ptr<FcPattern, DestroyOfFontconfig>;

const FcChar8* fontconfig_text(const std::string& text) { return reinterpret_cast<const FcChar8*>(text.c_str()); }

std::string text_of(FcPattern* font, const char* property) {
    FcChar8* text = nullptr;
    if (FcPatternGetString(font, property, 0, &text) != FcResultMatch) return "";
    return reinterpret_cast<const char*>(text);
}

bool has_letters(FcPattern* font) {
    FcCharSet* letters = nullptr;
    return FcPatternGetCharSet(font, FC_CHARSET, 0, &letters) == FcResultMatch && FcCharSetHasChar(letters, 'a');
}

Pattern nearest_font(FcConfig* fonts, const std::string& family) {
    const Pattern wanted(FcPatternCreate());
    if (!wanted) return nullptr;
    FcPatternAddString(wanted.get(), FC_FAMILY, fontconfig_text(family));
    FcPatternAddString(wanted.get(), FC_FONTFORMAT, fontconfig_text("TrueType"));
    FcConfigSubstitute(fonts, wanted.get(), FcMatchPattern);
    FcDefaultSubstitute(wanted.get());
    FcResult result = FcResultNoMatch;
    return Pattern(FcFontMatch(fonts, wanted.get(), &result));
}

}  // namespace

FontFile find_font(const std::string& family) {
    const Fonts fonts(FcInitLoadConfigAndFonts());
    if (!fonts) return {};
    const Pattern font = nearest_font(fonts.get(), family);
    if (!font || text_of(font.get(), FC_FONTFORMAT) != "TrueType" || !has_letters(font.get())) return {};
    FontFile file{text_of(font.get(), FC_FILE), 0};
    std::error_code missing;
    if (!std::filesystem::is_regular_file(file.path, missing)) return {};  // a cache may be older than the fonts
    FcPatternGetInteger(font.get(), FC_INDEX, 0, &file.number);
    file.number &= 0xffff;  // the higher bits are the variant of a variable font
    return file;
}

}  // namespace kerf::view
