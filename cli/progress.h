// Progress on a terminal or in a log.
#pragma once

#include <chrono>
#include <string>

#include "run/pipeline.h"

namespace kerf {

/// One line that is rewritten on a terminal; a line per 10 % otherwise. Writes to standard error. While it lives,
/// SIGINT and SIGTERM cancel the run.
class ProgressLine : public RunListener {
 public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() override;
    void on_progress(const char* stage, std::size_t done, std::size_t total) override;
    bool cancelled() const override;

 private:
    void print(const std::string& text);

    bool quiet_, terminal_, line_open_ = false;
    std::string stage_;
    std::size_t last_tenth_ = 0;
    std::chrono::steady_clock::time_point stage_start_;
};

}  // namespace kerf
