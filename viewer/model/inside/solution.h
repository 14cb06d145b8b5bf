// The solutions of kerf solve on a run: the places of their files, and the values in these.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/view_state.h"

namespace kerf::view {

/// A solution and the run that it stands on.
struct Solution {
    std::string folder, mesh;  ///< folder of its parts, and folder of the run
    int order = 1;             ///< order of its elements, 1 or 2
    /// A set of loads, or a mode of vibration.
    struct Case {
        std::string name;  ///< empty where there is a single one; for a mode "Mode 1"
        double largest_displacement = 0;
        double frequency = -1;  ///< frequency of a mode, in cycles per unit of time; negative: loads

        bool is_mode() const { return frequency >= 0; }
        std::string title() const;  ///< "braking", "Mode 1, 12.3 Hz"
    };
    std::vector<Case> cases;  ///< modes come last

    bool has_modes() const { return !cases.empty() && cases.back().is_mode(); }
};

/// Returns the solution under a path: its folder, or that of kerf solve on a surface, whose last step counts; none if
/// the folder is no solution's. Throws Error(io) for a report that is damaged, or whose run is not where it was.
std::optional<Solution> find_solution(const std::string& folder);

/// The values of a case in a part, in the units of the case. A mode has displacements alone, and NaN as errors.
struct PartSolution {
    std::vector<Vec3> displacement;            ///< #N; nodes: the boundary's vertices, the other ones, edges
    std::vector<std::array<float, 6>> stress;  ///< #N; XX YY ZZ XY YZ XZ
    std::vector<float> von_mises;              ///< #N
    std::vector<float> error_of_tet;           ///< #T; estimated error, in the energy norm
    std::vector<float> error_at_facet;         ///< #F; error of the cell behind each facet of the part's surface

    /// Returns the value of a colouring for which is_at_vertices() holds; NaN: there is none.
    float value_at(ColorBy color, std::size_t vertex) const;
};

/// Reads the values of the case of this number in a part. Throws Error(io).
PartSolution read_part_solution(const Solution& solution, std::size_t number, NodeId part);

/// Returns the factor with which the largest displacement is drawn as long as a twentieth of the body's diagonal,
/// rounded down to 1, 2 or 5 times a power of ten; 0 where nothing moves.
double good_deformation(double largest_displacement, double diagonal);

}  // namespace kerf::view
