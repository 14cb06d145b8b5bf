#include "repair/repair_step.h"

namespace kerf {

void intersections_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
