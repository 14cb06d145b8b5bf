#include "repair/repair_step.h"

namespace kerf {

void manifold_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
