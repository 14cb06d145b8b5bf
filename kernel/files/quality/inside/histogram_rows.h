// Chooses the intervals of a histogram: which fine bins of distributions are shown, and how many of them together.
#pragma once

#include <span>

#include "fill/mesh/quality.h"

namespace kerf {

/// The intervals of a histogram in fine bins: see Distribution::histogram().
struct HistogramRows {
    int first = 0, group = 1, groups = 0;
};

struct RowsWanted {
    int most = 20;       ///< most intervals
    double tail = 0;     ///< fraction of the cells that may be left out at each end of a logarithmic scale
    int least_bins = 1;  ///< least number of fine bins that are covered, however few are used
};

/// Returns intervals that cover the used bins of distributions, of which there is at least one and which have one
/// range. On a linear scale their width is a round number that divides the range, and they begin at multiples of it.
HistogramRows choose_rows(std::span<const Distribution* const> distributions, const RowsWanted& wanted);

}  // namespace kerf
