// Keyword arguments as options of the command line.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "kerf/kerf.h"

namespace kerf::python {

/// Returns `max_volume=0.1` as {"max-volume", "0.1"}, see kerf/options.py. Throws UsageError for a name that is no
/// option, and for a value that has no text.
NamedOptions named_options(const pybind11::kwargs& options);

/// The questions of a long call to Python: it calls `progress` with (stage, done, total), and asks whether the user has
/// pressed Ctrl-C. Ends the work where `progress` returns False or raises. Any thread may ask.
class Watch {
 public:
    /// `progress`: None or a callable.
    explicit Watch(pybind11::object progress) : progress_(std::move(progress)) {}
    Progress progress();
    IsCancelled is_cancelled();
    /// Raises the exception that was raised meanwhile, if there is one.
    void rethrow();

 private:
    template <class Question>
    bool goes_on(Question question);

    pybind11::object progress_;
    std::atomic<std::int64_t> next_look_ = 0;  // time of the next look at signals, in milliseconds of a steady clock
    std::exception_ptr raised_;                // written and read with the interpreter's lock
    std::atomic<bool> has_raised_ = false;
};

/// Returns the options of mesh(), all by their names, with a SizeField or None, and with a watch that must outlive
/// them.
MeshOptions mesh_options(const pybind11::object& sizes, const std::string& programs, const pybind11::kwargs& options,
                         Watch& watch);

/// Runs work() without the interpreter's lock; an exception that the watch has kept comes before Error(cancelled).
template <class Work>
auto without_lock(Watch& watch, Work work) {
    try {
        const pybind11::gil_scoped_release released;
        return work();
    } catch (const Error&) {
        watch.rethrow();
        throw;
    }
}

}  // namespace kerf::python
