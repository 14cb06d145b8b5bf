#include "repair/repair_step.h"

namespace kerf {

void thicken_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
