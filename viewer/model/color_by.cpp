// The names of colourings, for files and command lines, and their titles in the legend.
#include <array>

#include "viewer/model/inside/name_index.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

namespace {

struct Names {
    const char* name;
    const char* title;
};

constexpr std::array<Names, color_by_count> color_texts = {{
    {"part", "Part"},
    {"rank", "Rank"},
    {"level", "Level of the tree"},
    {"region", "Region"},
    {"patch", "Patch"},
    {"deviation", "Deviation"},
    {"size", "Wanted edge length"},
    {"kind", "At an interface or inside"},
    {"origin", "Core, shell or other mesher"},
    {"min-dihedral", "Min dihedral angle (deg)"},
    {"radius-edge", "Radius-edge ratio"},
    {"aspect", "Aspect ratio"},
    {"shape", "Shape (regular: 1)"},
    {"volume", "Volume"},
    {"edge-length", "Longest edge"},
    {"error", "Estimated error (energy norm)"},
    {"displacement", "Displacement"},
    {"von-mises", "von Mises stress"},
    {"stress-xx", "Stress XX"},
    {"stress-yy", "Stress YY"},
    {"stress-zz", "Stress ZZ"},
    {"stress-xy", "Stress XY"},
    {"stress-yz", "Stress YZ"},
    {"stress-xz", "Stress XZ"},
}};

}  // namespace

const char* name(ColorBy color) { return color_texts[static_cast<std::size_t>(color)].name; }
const char* title(ColorBy color) { return color_texts[static_cast<std::size_t>(color)].title; }

ColorBy color_by_from_name(const std::string& text) {
    std::array<const char*, color_by_count> names = {};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = color_texts[i].name;
    return value_named<ColorBy>(names, text, "colouring");
}

}  // namespace kerf::view
