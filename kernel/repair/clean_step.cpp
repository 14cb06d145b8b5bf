#include "repair/repair_step.h"

namespace kerf {

void clean_step(Soup&, const StepRequest&, StepReport&) {}

}  // namespace kerf
