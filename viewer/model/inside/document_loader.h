// Opens the file or folder under a path, which is read on the loader's thread as far as the first picture needs it; the
// rest follows.
#pragma once

#include <memory>
#include <string>

#include "viewer/model/inside/opened_run.h"
#include "viewer/model/inside/repairs.h"
#include "viewer/model/inside/run_follower.h"

namespace kerf::view {

class DocumentLoader {
 public:
    DocumentLoader(Background& background, ShownPair& pair, Fetched& fetched, Repairs& repairs, RunFollower& follower)
        : background_(background),
          pair_(pair),
          shown_(pair.now),
          fetched_(fetched),
          repairs_(repairs),
          follower_(follower) {}

    /// Opens a path as Session::open() does, where nothing is open.
    void open(const std::string& path, const RunRequest& options);

 private:
    Loader::Completion read(const std::string& path, const InputOptions& input);  // on the loader's thread
    void show_error(ErrorCode code, const std::string& message);
    void show_files(const std::shared_ptr<const InputFiles>& files, const std::shared_ptr<const NodeSurface>& surface);
    void show_trace(std::shared_ptr<const Trace> trace, const RunRequest& options);
    void show_run(OpenedRun run);
    void show_runs(OpenedRun before, OpenedRun now, const std::string& path);
    void show_partial_run(const OpenedPartialRun& run);
    void find_trace_of_run(const std::string& path);

    Background& background_;
    ShownPair& pair_;
    Shown& shown_;
    Fetched& fetched_;
    Repairs& repairs_;
    RunFollower& follower_;
};

}  // namespace kerf::view
