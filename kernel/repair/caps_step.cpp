#include "repair/repair_step.h"

namespace kerf {

void caps_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
