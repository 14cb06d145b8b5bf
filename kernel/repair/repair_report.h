// What a repair did, step by step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/types.h"
#include "repair/repair_plan.h"

namespace kerf {

/// Where something was done.
struct RepairPlace {
    Vec3 where = Vec3::Zero();              ///< units of the surface
    std::vector<std::int32_t> facets = {};  ///< as the file numbers them (Soup::file_facets()); a few of many
    double measure = 0;                     ///< what its action says: a distance, a number of edges; 0: nothing
};

/// One thing that a step did, or refused to do.
struct RepairAction {
    static constexpr std::size_t most_places = 1000;
    const char *one, *many;    ///< "hole filled", "holes filled"; literals
    const char* measure = "";  ///< of its places: "apart", "edges"; empty: none
    std::int64_t count = 0;
    std::vector<RepairPlace> places = {};  ///< of the first ones, at most most_places
    const char* refused_because = "";      ///< empty: it was done
    bool changes_surface = true;           ///< false for what is only said
    bool is_loss = false;                  ///< what goes may be wanted: a body, a wall, a piece that bounds nothing

    /// Counts one more, whose place is kept while there is room.
    void add(RepairPlace place);
};

struct StepReport {
    RepairKind kind;
    std::vector<RepairAction> actions;  ///< those with a count
    double largest_move = 0;            ///< of a vertex of the input, units of the surface

    bool changed() const;
};

struct RepairReport {
    double diagonal = 0;            ///< of the bounding box before; the unit of percentages
    double bound = 0;               ///< that was used, units of the surface
    std::vector<StepReport> steps;  ///< that were done, in their order

    /// Whether the surface is another one now.
    bool changed() const;
    double largest_move() const;
};

/// What was done, or not, where first, and why not: "3 holes filled, the first near (0, 0, 1), 12 edges".
std::string to_text(const RepairAction& action);

/// Lines for people, each begins with the name of a step: "holes         3 holes filled, the first near (0, 0, 1), 12
/// edges". `indent`: what each begins with.
std::string to_text(const RepairReport& report, const std::string& indent = "  ");

}  // namespace kerf
