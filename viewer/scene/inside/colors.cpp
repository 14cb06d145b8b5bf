// Things that have no order have the eight colours of Okabe and Ito, with grey for black, and then the same eight
// lighter and darker. Values have Viridis, whose lightness grows evenly. Measures of the shape of cells, of which one
// end is bad, have ten colours of ColorBrewer's RdYlBu from the bad end to the good one. People who see fewer colours
// can tell the ends of both scales apart. All are given as texts "#RRGGBB"; a new member of SceneColors needs a colour
// for the light and for the dark theme.
#include "viewer/scene/inside/colors.h"

#include <algorithm>
#include <cstdlib>

namespace kerf::view {

namespace {

constexpr std::array<const char*, 8> okabe_ito = {"#56B4E9", "#E69F00", "#009E73", "#F0E442",
                                                  "#CC79A7", "#0072B2", "#D55E00", "#999999"};

// From bad to good: ColorBrewer's RdYlBu (Harrower and Brewer 2003) without its darkest red, so that
// the worst cells stand out and the best ones are the darkest. People who see fewer colours can tell its ends apart.
constexpr std::array<const char*, 10> red_to_blue = {"#D73027", "#F46D43", "#FDAE61", "#FEE090", "#FFFFBF",
                                                     "#E0F3F8", "#ABD9E9", "#74ADD1", "#4575B4", "#313695"};

// Every 16th colour of Viridis and its last one.
constexpr std::array<const char*, 17> viridis = {"#440154", "#481668", "#482878", "#433E85", "#3B528B", "#33638D",
                                                 "#2C728E", "#26828E", "#21918C", "#1FA088", "#28AE80", "#3FBC73",
                                                 "#5EC962", "#84D44B", "#ADDC30", "#D8E219", "#FDE725"};

// Measures of which one end is bad.
bool is_of_shape(ColorBy color) {
    return color == ColorBy::min_dihedral || color == ColorBy::radius_edge || color == ColorBy::aspect ||
           color == ColorBy::shape;
}

Color mixed(const Color& a, const Color& b, float share) {
    return {a.r + share * (b.r - a.r), a.g + share * (b.g - a.g), a.b + share * (b.b - a.b), a.a};
}

}  // namespace

Color color_from_hex(const char* text, float alpha) {
    const auto channel = [&](int i) {
        const char digits[3] = {text[1 + 2 * i], text[2 + 2 * i], 0};
        return std::strtol(digits, nullptr, 16) / 255.f;
    };
    return {channel(0), channel(1), channel(2), alpha};
}

Color category_color(std::size_t i) {
    const Color base = color_from_hex(okabe_ito[i % okabe_ito.size()]);
    switch (i / okabe_ito.size() % 3) {
        case 1:
            return mixed(base, {1, 1, 1, 1}, 0.45f);
        case 2:
            return mixed(base, {0, 0, 0, 1}, 0.35f);
        default:
            return base;
    }
}

std::vector<Color> value_colors(ColorBy color) {
    std::vector<Color> colors;
    if (!is_of_shape(color)) {
        for (const char* text : viridis) colors.push_back(color_from_hex(text));
        return colors;
    }
    for (const char* text : red_to_blue) colors.push_back(color_from_hex(text));
    if (color == ColorBy::radius_edge || color == ColorBy::aspect) std::reverse(colors.begin(), colors.end());
    return colors;
}

std::optional<ValueRange> natural_range(ColorBy color) {
    switch (color) {
        case ColorBy::min_dihedral:
            return ValueRange{0, 70};
        case ColorBy::radius_edge:
            return ValueRange{0.6, 2};
        case ColorBy::aspect:
            return ValueRange{1, 6};
        case ColorBy::shape:
            return ValueRange{0, 1};
        default:
            return std::nullopt;
    }
}

SceneColors scene_colors(Theme theme) {
    SceneColors c;
    const bool light = theme == Theme::light;
    c.background_top = color_from_hex(light ? "#FFFFFF" : "#2B313A");
    c.background_bottom = color_from_hex(light ? "#DDE3EA" : "#15181D");
    c.edge = color_from_hex(light ? "#1C2733" : "#0B0D10", light ? 0.55f : 0.7f);
    c.surface = color_from_hex(light ? "#C6CED6" : "#97A2AE");
    c.interface = color_from_hex("#E6B65C");
    c.context = color_from_hex(light ? "#8FA3B8" : "#6F8296");
    c.plane = color_from_hex("#3F8FD2");
    c.normal = color_from_hex(light ? "#1F5F99" : "#7FBFF0");
    c.none = color_from_hex(light ? "#C9CED4" : "#5A6068");
    c.crossed = color_from_hex("#7B4A12");
    c.contour = color_from_hex("#D5430B");
    c.projected = color_from_hex("#005F45");
    c.refused = color_from_hex("#4A148C");
    c.selection = color_from_hex(light ? "#B000C8" : "#FF66FF");
    c.feature = color_from_hex(light ? "#101A26" : "#F4F6F8");
    c.error = color_from_hex("#E53935");
    c.warning = color_from_hex("#E68A00");
    // Colours of the coordinate axes belong to the gizmo and are not used here.
    c.axes = {color_from_hex("#F0A000"), color_from_hex(light ? "#A83A7C" : "#7E1B5A"),
              color_from_hex(light ? "#1C2733" : "#F4F6F8")};
    c.colliding = color_from_hex("#FFB000");
    c.collided = color_from_hex(light ? "#3B2FA0" : "#9C8CFF");
    return c;
}

}  // namespace kerf::view
