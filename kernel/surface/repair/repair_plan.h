// The repairs that a surface is to have, as users write them: "near", "full,holes=200,bound=0.2%", "weld,stitch".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/user_number.h"

namespace kerf {

/// The steps of the ladder, in the order in which they are done.
enum class RepairKind {
    merge,          ///< vertices nearer than a tolerance become one, wherever they are: --weld
    largest,        ///< only the connected component of the largest area stays: --keep-largest
    span,           ///< closed loops of few edges are spanned by facets of their own vertices: --fill-holes
    weld,           ///< vertices nearer than a tolerance become one
    clean,          ///< facets that are copies, folded upon each other, or without area go
    stitch,         ///< borders that are nearer than a tolerance become one
    orient,         ///< facets are turned to agree
    manifold,       ///< edges of more than two facets, and vertices of several fans, are opened
    specks,         ///< small pieces go
    caps,           ///< large openings are closed by patches of their own
    holes,          ///< openings of few edges are filled
    thicken,        ///< open sheets become walls
    snap,           ///< walls of two bodies that nearly coincide become one
    intersections,  ///< facets that cross share the curve, and facets inside go
    renew,          ///< remaining defects go, with facets around them, and are filled
};

/// The name of the patch of a cap, before its number.
inline constexpr std::string_view cap_name = "cap_";
/// Returns whether a patch has the name of a cap: "cap_1".
inline bool is_cap(std::string_view patch) {
    return patch.starts_with(cap_name) && patch.size() > cap_name.size() &&
           patch.find_first_not_of("0123456789", cap_name.size()) == std::string_view::npos;
}

/// Returns whether a step prepares the surface for the others: it has an option of its own in place of a word, it takes
/// surfaces whose facets say what they bound, too, and percentages of the steps behind it are of what it leaves.
constexpr bool is_preparation(RepairKind kind) { return kind < RepairKind::weld; }

/// The extent of a repair; each level has the steps of the one before.
enum class RepairLevel {
    none,
    exact,  ///< no area is added, and points move only to part contacts, by 1e-4 of the edges there
    near,   ///< points move within the bound, holes are filled
    full,   ///< facets that cross are resolved, too
};

const char* name(RepairLevel level);

/// The treatment of bodies that overlap, or that share walls.
enum class BodyRepair {
    as_found,  ///< regions that share walls stay so; other bodies become their hull
    unite,     ///< bodies become their hull, without walls
    regions    ///< bodies become a region each, with common walls
};

struct RepairStep {
    RepairKind kind;
    std::optional<Length> amount = {};  ///< a tolerance, a number of edges, ..., see RepairStepRow; none: its usual one
};

struct RepairPlan {
    std::vector<RepairStep> steps;        ///< ascending by kind, each once
    Length bound = Length::percent(0.1);  ///< the largest move of a vertex of the input from its place, > 0
    BodyRepair bodies = BodyRepair::as_found;
    bool are_walls = false;          ///< facets part regions that are named elsewhere: no facet goes, except copies
    bool voids_are_parity = false;   ///< shells within others that cross none stay, whichever way they are turned
    bool outside_is_meshed = false;  ///< where bodies touch, they are joined, so that no crack is left between them

    bool empty() const { return steps.empty(); }
    /// Returns whether there is no step behind the preparations.
    bool only_prepares() const { return steps.empty() || is_preparation(steps.back().kind); }
    const RepairStep* find(RepairKind kind) const;
    /// Adds a step at its place; it replaces one of the same kind.
    void put(const RepairStep& step);
};

/// Returns the steps of a level, with their usual amounts.
RepairPlan plan_of(RepairLevel level);

/// Returns the plan that a list with commas stands for: a level ("none", "exact", "near", "full"), then steps by name,
/// with "=AMOUNT" where they have one, "no-NAME" for a step of the level that is left out, "bound=D", and
/// "bodies=unite" or "bodies=regions". An empty text asks for nothing. Throws Error(usage), naming `option`, the word
/// and its alternatives.
RepairPlan parse_repair_plan(std::string_view option, std::string_view text);

/// Returns the words that parse_repair_plan() takes, as a sentence for help.
std::string repair_words();

}  // namespace kerf
