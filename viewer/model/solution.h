// What kerf solve has found on a run: where its files are, and what they hold.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "viewer/model/view_state.h"

namespace kerf::view {

/// A solution and the run that it stands on.
struct Solution {
    std::string folder, mesh;  ///< of its parts, and of the run
    /// One set of loads.
    struct Case {
        std::string name;  ///< empty where there is one only
        double largest_displacement = 0;
    };
    std::vector<Case> cases;
};

/// The solution under a path: its folder, or that of kerf solve on a surface, whose last step counts. Nothing if the
/// folder is no solution's. Throws Error(io) for a report that is damaged, or whose run is not where it was.
std::optional<Solution> find_solution(const std::string& folder);

/// The values of a part, in the units of the case.
struct PartSolution {
    std::vector<Vec3> displacement;            ///< #V; the boundary's vertices first
    std::vector<std::array<float, 6>> stress;  ///< #V; XX YY ZZ XY YZ XZ
    std::vector<float> von_mises;              ///< #V
    std::vector<float> error_of_tet;           ///< #T; estimated, in the energy norm
    std::vector<float> error_at_facet;         ///< #F; of the cells behind the facets of the part's surface

    /// Of a colour for which is_at_vertices() holds.
    float value_at(ColorBy color, std::size_t vertex) const;
};

/// Reads those of one case. Throws Error(io).
PartSolution read_part_solution(const Solution& solution, std::size_t number, NodeId part);

/// The factor with which the largest displacement is drawn as long as a twentieth of the body, rounded to 1, 2 or 5
/// times a power of ten; 0 where nothing moves.
double good_deformation(double largest_displacement, double diagonal);

}  // namespace kerf::view
