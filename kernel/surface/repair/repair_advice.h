// Advice which repairs mend which defects.
#pragma once

#include <span>

#include "surface/diagnosis/diagnosis.h"
#include "surface/repair/repair_plan.h"

namespace kerf {

/// Returns the steps that mend defects of a kind, in the order of RepairKind; advice() names the same. Empty: none
/// does.
std::span<const RepairKind> repairs_for(DefectKind kind);

/// Returns the least level with a step for each error of a diagnosis; none: no level has steps for all, or there are no
/// errors. Whether these steps refuse something is only known by a try.
RepairLevel level_for(const Diagnosis& diagnosis);

}  // namespace kerf
