// The steps of one cut that can be looked at, in the order in which they happen.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace kerf::view {

/// A stage of a cut, or a state of the surface before it or of the parts after it.
enum class Stage {
    before_repair,     ///< of the root: the surface as the file has it, where repairs have changed it
    before_remeshing,  ///< of the root: the surface as it was read and repaired, where another one was cut
    input,             ///< the surface of the node
    plane,             ///< the cutting plane, the principal axes and the centre of gravity
    crossed_edges,     ///< edges with ends on both sides of the plane
    hanging_removed,   ///< the boundary of the majority labels
    closed_loops,      ///< ears and islands removed
    paths_removed,     ///< vertices with more than two contour edges opened
    contour,           ///< the smoothed contour, which was used
    projected,         ///< the contour in the plane
    triangulation,     ///< the section inside of the contour, triangulated in the plane
    interface,         ///< the triangulated section, mapped back to the surface
    split,             ///< both halves
    parts,             ///< the surfaces of the parts below the node, of a run that has not filled them
    tetrahedra,        ///< the parts below the node
};
constexpr bool shows_parts(Stage stage) { return stage == Stage::parts || stage == Stage::tetrahedra; }
inline constexpr int stage_count = static_cast<int>(Stage::tetrahedra) + 1;

/// One stop of the timeline: a stage, or one of the tries that were refused before.
struct Step {
    Stage stage = Stage::input;
    std::int32_t refused_try = -1;  ///< index in Cut::tries of a refused try; then `stage` is `plane`

    bool operator==(const Step&) const = default;
};

/// Return the words of a stage, wherever it is named: its name, "crossed-edges", for the command line, the state file
/// and the layer of the scene that shows it, and in_words() of it for legends; its title, "Crossed edges", for buttons
/// and headings.
const char* name(Stage stage);
std::string title(Stage stage);

/// Returns the stage's name, or "try:3" (counted from 0).
std::string name(const Step& step);
/// Returns the stage's title, or "Try 4" (counted from 1).
std::string title(const Step& step);
/// Returns the step of a name. Throws Error(usage) naming all stages.
Step step_from_name(const std::string& text);
/// Returns the names of all stages, as a list for people: "input, plane, ...".
std::string names_of_stages();

}  // namespace kerf::view
