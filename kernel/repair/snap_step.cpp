#include "repair/repair_step.h"

namespace kerf {

void snap_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
