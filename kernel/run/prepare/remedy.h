// Options that make a surface which can be meshed of a file that has none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/prepare/input.h"
#include "run/prepare/stage_listener.h"
#include "run/request/input_options.h"

namespace kerf {

/// A way to mesh a file with errors.
struct Remedy {
    InputOptions options = {};  ///< options of the check with the changes that help; `wrap` where no repair does
    bool was_tried = false;     ///< whether a copy was repaired; else the steps fit the kinds of the defects
    std::int64_t caps = 0;      ///< openings that RepairOptions::cap closes by patches of their own
    double largest_move = 0;    ///< the largest move of a vertex, where it was tried; units of the surface
    double wrap_distance = 0;   ///< estimated_wrap_distance() of a wrap; 0: not known
    std::vector<std::string> losses = {};  ///< losses that may be wanted, where it was tried, see RepairAction::is_loss
};

/// Repairs a copy of the files in one way after another, unless `options` ask for as much already, and returns the
/// first way whose surface can be meshed. The order: shells inside of others are voids, where it is not clear whether
/// they are; bodies of several files, or bodies that do not fit, become regions with common walls; then the levels,
/// from the least on. In each way, open ends get caps if that helps. Returns none if coordinates are too large to
/// compute with. For surfaces of more facets than `most_tried`, or of as many crossings as `most_crossings_tried`, only
/// the caps are tried, and otherwise the kinds of defects decide. Surfaces with regions and of CAD models are only
/// wrapped. `checked`: of the files with `options`, not clean. Costs up to eight times check_input() with repairs,
/// sixteen times where caps are made.
std::optional<Remedy> find_remedy(const std::string& path, const InputOptions& options, const CheckedSoup& checked,
                                  StageListener* listener = nullptr);

inline constexpr std::size_t most_tried = 200'000;            ///< most facets that find_remedy() repairs, some seconds
inline constexpr std::int64_t most_crossings_tried = 10'000;  ///< pairs of facets; as many take minutes to resolve

}  // namespace kerf
