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

/// `max_volume=0.1` as {"max-volume", "0.1"}, see kerf/options.py. Throws UsageError for a name that is no option, and
/// TypeError for a value that has no text.
NamedOptions named_options(const pybind11::kwargs& options);

/// The table of options, and what a wrong name may have been meant to be.
void register_options(pybind11::module_& module);

/// What a long call asks and tells of Python: `progress`, which is called with (stage, done, total), and whether the
/// user has pressed Ctrl-C. Ends the work where `progress` returns False or raises. Any thread may ask.
class Watch {
 public:
    /// `progress`: None, or what can be called.
    explicit Watch(pybind11::object progress) : progress_(std::move(progress)) {}
    Progress progress();
    IsCancelled is_cancelled();
    /// Raises what was raised meanwhile.
    void rethrow();

 private:
    template <class Question>
    bool goes_on(Question question);

    pybind11::object progress_;
    std::atomic<std::int64_t> next_look_ = 0;  // at signals, in milliseconds of a steady clock
    std::exception_ptr raised_;                // written and read with the interpreter's lock
    std::atomic<bool> has_raised_ = false;
};

/// Those of mesh(), all by their names, with a SizeField or None; told to a watch that must outlive them.
MeshOptions mesh_options(const pybind11::object& sizes, const std::string& programs, const pybind11::kwargs& options,
                         Watch& watch);

/// Runs work() without the interpreter's lock; what the watch has raised comes before Error(cancelled).
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
