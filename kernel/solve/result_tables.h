// Results as tables for spreadsheets: CSV (RFC 4180), numbers with all their digits.
#pragma once

#include <string>
#include <vector>

#include "solve/case_report.h"

namespace kerf {

/// A support, spring or what else reacts, and about which point its moments are.
struct Reacting {
    std::string name;
    Vec3 place = Vec3::Zero();
};

inline constexpr const char* results_file = "results.csv";
inline constexpr const char* reactions_file = "reactions.csv";

/// A row for each case, and after it for each of several regions: `region` is empty for the whole. What is not known is
/// empty.
std::string results_csv(const std::vector<CaseReport>& cases);
/// A row for each case and support, and after it for each of several regions.
std::string reactions_csv(const std::vector<CaseReport>& cases, const std::vector<Reacting>& reacting);

}  // namespace kerf
