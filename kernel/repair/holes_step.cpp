#include "repair/repair_step.h"

namespace kerf {

void holes_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
