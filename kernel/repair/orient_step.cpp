#include "repair/repair_step.h"

namespace kerf {

void orient_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
