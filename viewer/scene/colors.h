// What colours mean: parts, values, themes. People who see fewer colours can tell them apart.
#pragma once

#include <string>
#include <vector>

#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// "#RRGGBB".
Color color_from_hex(const char* text, float alpha = 1);

/// Colour of the i-th part, rank, level or patch: Okabe and Ito's palette without its black, then lighter and darker
/// ones of it. Neighbours in the order differ in lightness, too.
Color category_color(std::size_t i);
inline constexpr std::size_t category_count = 24;  ///< then they repeat

/// Viridis (van der Walt and Smith), from dark to light; of the shape of cells, red where it is bad and blue where it
/// is good.
std::vector<Color> value_colors(ColorBy color);

/// The range that a measure's colours span where the user gives none: that of useful cells, so that colours mean the
/// same in every picture. Empty for measures with a unit.
std::optional<ValueRange> natural_range(ColorBy color);

/// Colours of things, by theme.
struct SceneColors {
    Color background_top, background_bottom, edge;
    Color surface, interface, context, plane, normal, none;
    Color crossed, contour, projected, refused, selection, feature;
    Color error, warning;
    Color colliding, collided;  ///< of two triangles that meet: that of the interface and the other one
    std::array<Color, 3> axes;  ///< of inertia, the long direction first
};
SceneColors scene_colors(Theme theme);

}  // namespace kerf::view
