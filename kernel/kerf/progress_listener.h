// Progress and IsCancelled of kerf/kerf.h as the listener of a run.
#pragma once

#include <atomic>

#include "kerf/kerf.h"
#include "run/report/listener.h"

namespace kerf {

/// A listener that asks a Progress and an IsCancelled, both of which must outlive it.
class ProgressListener : public RunListener {
 public:
    ProgressListener(const Progress& progress, const IsCancelled& is_cancelled)
        : progress_(progress), is_cancelled_(is_cancelled) {}
    void on_progress(const char* stage, std::size_t done, std::size_t total) override {
        if (progress_ && !progress_(stage, done, total)) was_ended_ = true;
    }
    bool cancelled() const override { return was_ended_ || (is_cancelled_ && is_cancelled_()); }

 private:
    const Progress& progress_;
    const IsCancelled& is_cancelled_;
    std::atomic<bool> was_ended_ = false;
};

}  // namespace kerf
