// Results as tables for spreadsheets: CSV (RFC 4180), numbers with all their digits.
#pragma once

#include <string>
#include <vector>

#include "solve/run/inside/case_report.h"

namespace kerf {

/// A support, spring or inertia relief, and the point about which its moments are.
struct Reacting {
    std::string name;
    Vec3 place = Vec3::Zero();
};

inline constexpr const char* results_file = "results.csv";
inline constexpr const char* reactions_file = "reactions.csv";

/// Returns a row for each case, and after it one for each of several regions: `region` is empty for the whole. Unknown
/// values are empty.
std::string results_csv(const std::vector<CaseReport>& cases);
/// Returns a row for each case and support, and after it one for each of several regions.
std::string reactions_csv(const std::vector<CaseReport>& cases, const std::vector<Reacting>& reacting);

}  // namespace kerf
