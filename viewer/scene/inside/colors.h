// The colours of parts, values and themes. People who see fewer colours can tell them apart.
#pragma once

#include <string>
#include <vector>

#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// Returns the colour of a text "#RRGGBB".
Color color_from_hex(const char* text, float alpha = 1);

/// Returns the colour of the i-th part, rank, level or patch: Okabe and Ito's palette with grey for its black, then
/// lighter and darker colours of it. Neighbours in the order differ in lightness, too.
Color category_color(std::size_t i);
inline constexpr std::size_t category_count = 24;  ///< number of colours before they repeat

/// Returns Viridis (van der Walt and Smith), from dark to light; for the shape of cells colours from red, where it is
/// bad, to blue, where it is good. They are in the order of ascending values, at equal distances.
std::vector<Color> value_colors(ColorBy color);

/// Returns the range that a measure's colours span where the user gives none: that of useful cells, so that a colour
/// means the same in every picture. Empty for measures with a unit.
std::optional<ValueRange> natural_range(ColorBy color);

/// The colours of the things in a scene, which depend on the theme.
struct SceneColors {
    Color background_top, background_bottom, edge;
    Color surface, interface, context, plane, normal, none;
    Color crossed, contour, projected, refused, selection, feature;
    Color error, warning;
    Color colliding, collided;  ///< two triangles that meet: the interface's, the other one
    std::array<Color, 3> axes;  ///< axes of inertia, the long direction first
};
SceneColors scene_colors(Theme theme);

}  // namespace kerf::view
