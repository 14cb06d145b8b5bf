// Which repairs mend which defects.
#pragma once

#include <span>

#include "repair/repair_plan.h"
#include "surface/diagnosis.h"

namespace kerf {

/// The steps that mend defects of a kind, in the order of RepairKind; advice() names the same. Empty: none does.
std::span<const RepairKind> repairs_for(DefectKind kind);

/// The least level whose steps are there for all errors of a diagnosis; none: no level has what they need, or there are
/// no errors. What the steps do not refuse only a try tells.
RepairLevel level_for(const Diagnosis& diagnosis);

}  // namespace kerf
