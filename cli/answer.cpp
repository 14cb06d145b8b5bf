#include "cli/answer.h"

#include "cli/ranks.h"
#include "files/io/standard_streams.h"

namespace kerf {

int tell_answer(const Answer& answer) {
    if (!is_first_rank()) return answer.exit_code;
    if (answer.exit_code == 0)
        print_data(answer.text);
    else
        tell(answer.text);
    return answer.exit_code;
}

int run_on_first_rank(const std::function<int()>& command) { return is_first_rank() ? command() : 0; }

}  // namespace kerf
