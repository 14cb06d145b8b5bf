// The report of a repair, step by step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "surface/repair/repair_plan.h"

namespace kerf {

/// A place where something was done.
struct RepairPlace {
    Vec3 where = Vec3::Zero();              ///< units of the surface
    std::vector<std::int32_t> facets = {};  ///< numbers in the file (Soup::file_facets()); a few of many
    double measure = 0;                     ///< a distance, a number of edges, ..., see RepairAction; 0: none
};

/// One thing that a step did, or refused to do.
struct RepairAction {
    static constexpr std::size_t most_places = 1000;
    const char *one, *many;    ///< "hole filled", "holes filled"; literals
    const char* measure = "";  ///< the meaning of RepairPlace::measure: "apart", "edges"; empty: none
    std::int64_t count = 0;
    std::vector<RepairPlace> places = {};  ///< the first ones, at most most_places
    const char* refused_because = "";      ///< empty: it was done
    bool changes_surface = true;           ///< false for a mere remark
    bool is_loss = false;  ///< a part that goes may be wanted: a body, a wall, a piece that bounds nothing

    /// Counts one more place, which is kept while there is room.
    void add(RepairPlace place);
};

/// Returns an action of which each place will be left as it is, for the same reason.
RepairAction refused_action(const char* one, const char* many, const char* measure, const char* because);

struct StepReport {
    RepairKind kind;
    std::vector<RepairAction> actions;  ///< actions with a count
    double largest_move = 0;            ///< the largest move of a vertex of the input, units of the surface
    double amount = 0;                  ///< the amount that was used: a length in units of the surface, or a count
    std::int64_t added_facets = 0;      ///< facets of `span`

    bool changed() const;
};

struct RepairReport {
    double diagonal = 0;  ///< diagonal of the bounding box behind the preparations; the unit of percentages
    double bound = 0;     ///< the bound that was used, units of the surface
    std::vector<StepReport> preparations = {};  ///< the steps that were done of is_preparation(), in their order
    std::vector<StepReport> steps = {};         ///< the other steps that were done, in their order

    /// Whether the surface has changed.
    bool changed() const;
    /// Returns the largest move by one of `steps`, which `bound` limits.
    double largest_move() const;
    /// Returns the number of things that steps of one kind did, without those that they refused.
    std::int64_t done_by(RepairKind kind) const;
    /// Returns the report of a preparation, an empty one where it was not done.
    StepReport preparation(RepairKind kind) const;
};

/// Returns an action as text, with its first place and the reason of a refusal: "3 holes filled, the first near (0, 0,
/// 1), 12 edges".
std::string to_text(const RepairAction& action);

/// Returns lines for people on the steps behind the preparations, each with the name of its step: "holes         3
/// holes filled, the first near (0, 0, 1), 12 edges". `indent`: the beginning of each line.
std::string to_text(const RepairReport& report, const std::string& indent = "  ");

}  // namespace kerf
