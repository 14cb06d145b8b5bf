// Files that commands of kerf make of the open run, such as kerf merge, in a process of their own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/inside/run_process.h"

namespace kerf::view {

/// Starts one such command at a time, and tells how it has ended.
class Writer {
 public:
    /// `kerf`: the path of the program.
    explicit Writer(std::string kerf) : kerf_(std::move(kerf)) {}

    /// Starts kerf with these arguments, which write `file`; does nothing while another command is under way. `keeps`
    /// is the temporary folder that the command reads from, or null.
    void start(const std::vector<std::string>& arguments, const std::string& file,
               std::shared_ptr<ScratchFolder> keeps);
    bool is_writing() const { return process_ != nullptr; }

    /// The end of a command: a file that is there, or the error.
    struct Result {
        std::string file, error;
    };
    /// Returns the result of the last command, once.
    std::optional<Result> take_result() { return std::exchange(result_, std::nullopt); }
    /// Returns whether a command has ended; called once a frame.
    bool poll();

 private:
    std::string kerf_, file_;
    std::unique_ptr<RunProcess> process_;
    std::optional<Result> result_;
};

}  // namespace kerf::view
