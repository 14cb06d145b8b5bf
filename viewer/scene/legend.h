// The legend of a scene as plain data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "viewer/model/view_state.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// The meaning of the colours in a scene.
struct Legend {
    std::string title;                    ///< title of a colouring; empty: the things in the scene are explained
    std::optional<ValueRange> values;     ///< range of the colours of values
    std::optional<ValueRange> extremes;   ///< the least and the largest value of a solution that are drawn
    std::vector<PlacedValue> marked;      ///< the least and the largest value, if Coloring::extremes asks for them
    double percentile = 100;              ///< per cent of the drawn values that the colours span, where they span fewer
    std::vector<Color> scale;             ///< colours from the low to the high end of the range
    bool goes_below = false;              ///< values that are drawn lie below `values`
    bool goes_above = false;              ///< values that are drawn lie above `values`
    std::vector<LegendEntry> categories;  ///< colours of other things, also beside a scale
};

}  // namespace kerf::view
