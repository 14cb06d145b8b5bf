// The order of the stages, written once: the command line, the MPI ranks, the viewer and the tests call it.
#pragma once

#include "run/communicator.h"
#include "run/report.h"

namespace kerf {

/// Is told of the progress on this rank. Without one nothing is copied, and the result is the same.
class RunListener : public CutListener {
 public:
    /// `done` of `total` steps of a stage: "read", "decompose", "volume", "write". Root-rank numbers are its own.
    virtual void on_progress(const char* stage, std::size_t done, std::size_t total) = 0;
    /// Whether on_cut() is wanted: recording the stages of every cut costs memory.
    virtual bool wants_cuts() const { return false; }
    void on_cut(const Surface&, const Cut&) override {}
    /// Asked between stages and while workers run. Once true, the run ends with Error(cancelled) and leaves no result.
    virtual bool cancelled() const { return false; }
};

/// Reads, decomposes, meshes every subdomain in worker processes, verifies and writes the run folder.
///
/// Collective. The part files depend on input, options and K alone. Parts that could not be meshed leave a reproducer
/// in DIR/failed and exit_code 4 in the report, 5 if all of them ran out of memory; a law that does not hold leaves
/// exit_code 8. Throws Error on every rank alike for what leaves no result, a full disk among them; the run folder then
/// does not exist.
/// `input` receives the surface that the report refers to.
RunReport run(RunOptions options, int cores_of_rank, Communicator& ranks, Input& input,
              RunListener* listener = nullptr);

}  // namespace kerf
