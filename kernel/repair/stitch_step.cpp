#include "repair/repair_step.h"

namespace kerf {

void stitch_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
