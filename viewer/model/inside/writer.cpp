// The viewer writes no format itself: it starts the command that a user would start, and shows its error as it is.
#include "viewer/model/inside/writer.h"

namespace kerf::view {

void Writer::start(const std::vector<std::string>& arguments, const std::string& file,
                   std::shared_ptr<ScratchFolder> keeps) {
    if (process_) return;
    file_ = file;
    try {
        process_ = std::make_unique<RunProcess>(kerf_, arguments, std::move(keeps));
    } catch (const std::exception& error) {
        result_ = Result{file, error.what()};
    }
}

bool Writer::poll() {
    if (!process_) return false;
    const std::optional<ChildResult> end = process_->wait(0);
    if (!end) return false;
    process_.reset();
    const bool is_done = end->end == ChildResult::End::exited && end->exit_code == 0;
    result_ = Result{file_, is_done ? "" : reason_of(*end)};
    return true;
}

}  // namespace kerf::view
