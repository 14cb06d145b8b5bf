// What would make a surface that can be meshed of a file that has none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "prepare/input.h"
#include "prepare/stage_listener.h"
#include "request/input_options.h"

namespace kerf {

struct Remedy {
    InputOptions options = {};             ///< of the check, changed to what does; with `wrap` where no repair does
    bool was_tried = false;                ///< by repairing a copy; else the steps fit the kinds of the defects
    std::int64_t caps = 0;                 ///< openings that InputOptions::cap closes by patches of their own
    double largest_move = 0;               ///< of a vertex, where it was tried; units of the surface
    double wrap_distance = 0;              ///< of a wrap: estimated_wrap_distance(); 0: not known
    std::vector<std::string> losses = {};  ///< where it was tried: what goes that may be wanted, RepairAction::is_loss
};

/// Repairs a copy of the files in one way after another, unless `options` ask for as much already, and returns the
/// first whose surface can be meshed. The order: shells inside of others are voids, where it is not clear what they
/// are; bodies of several files, or that do not fit, become regions with common walls; then the levels, from the least
/// on. In each way, ends of what is open get caps if that does. None: coordinates are too large to compute with. Of
/// surfaces of more facets than `most_tried`, or of so many crossings as `most_crossings_tried`, only the caps are
/// tried, and else the kinds of defects decide. `checked`: of the files with `options`, not clean. Costs up to eight
/// times check_input() with repairs, sixteen times where caps are made.
std::optional<Remedy> find_remedy(const std::string& path, const InputOptions& options, const CheckedSoup& checked,
                                  StageListener* listener = nullptr);

inline constexpr std::size_t most_tried = 200'000;            ///< facets that find_remedy() repairs, some seconds
inline constexpr std::int64_t most_crossings_tried = 10'000;  ///< pairs of facets; more take minutes to resolve

}  // namespace kerf
