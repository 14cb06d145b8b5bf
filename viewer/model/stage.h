// The steps of one cut that can be looked at, in the order in which they happen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace kerf::view {

enum class Stage {
    input,            ///< the surface of the node, its principal axes and its centre of gravity
    plane,            ///< the cutting plane
    crossed_edges,    ///< edges with ends on both sides of the plane
    hanging_removed,  ///< the boundary of the majority labels
    closed_loops,     ///< ears and islands removed
    paths_removed,    ///< vertices with more than two contour edges opened
    contour,          ///< the smoothed contour, which was used
    projected,        ///< it in the plane
    triangulation,    ///< the section inside of it, in the plane
    interface,        ///< mapped back to the surface
    split,            ///< both halves
    tetrahedra,       ///< the parts below the node
};
inline constexpr int stage_count = static_cast<int>(Stage::tetrahedra) + 1;

/// One stop of the timeline: a stage, or one of the tries that were refused before.
struct Step {
    Stage stage = Stage::input;
    std::int32_t refused_try = -1;  ///< index in Cut::tries of a refused try; then `stage` is `plane`

    bool operator==(const Step&) const = default;
};

/// As the command line and the state file spell it: "contour", "try:3" (counted from 0).
std::string name(const Step& step);
/// Throws Error(usage) naming all stages.
Step step_from_name(const std::string& text);
const char* name(Stage stage);
/// For people: "Smoothed contour".
const char* title(Stage stage);

}  // namespace kerf::view
