#include "repair/repair_step.h"

namespace kerf {

void specks_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
