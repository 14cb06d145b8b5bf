// What would make a surface that can be meshed of a file that has none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "repair/repair_plan.h"

namespace kerf {

struct Remedy {
    RepairLevel level = RepairLevel::none;  ///< the least that does; none: no level does, but a wrap would
    bool takes_parity = false;              ///< with --voids parity, which the input was read without
    bool was_tried = false;                 ///< of the level; else its steps fit the kinds of the defects
    double largest_move = 0;                ///< of a vertex, where it was tried; units of the surface
    double wrap_distance = 0;               ///< where no level does: estimated_wrap_distance(); 0: not known
    std::vector<std::string> losses = {};   ///< where it was tried: what goes that may be wanted, RepairAction::is_loss
};

/// Repairs a copy of the file by one level after another, from the least on, unless `options` ask for as
/// much already, and checks it; with shells inside of others as voids, first, where it is not clear what these are.
/// None: coordinates are too large to compute with. Of surfaces of more facets than `most_tried`, or of so many
/// crossings as `most_crossings_tried`, only the kinds of defects decide. `checked`: of the file with `options`, not
/// clean. Costs up to six times check_input() with repairs.
std::optional<Remedy> find_remedy(const std::string& path, const InputOptions& options, const CheckedSoup& checked,
                                  StageListener* listener = nullptr);

inline constexpr std::size_t most_tried = 200'000;            ///< facets that find_remedy() repairs, some seconds
inline constexpr std::int64_t most_crossings_tried = 10'000;  ///< pairs of facets; more take minutes to resolve

}  // namespace kerf
