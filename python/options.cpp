// The table of options comes from the kernel (run/request/run_request.h), so that keyword arguments, their kinds,
// defaults and help follow it without a list of their own; their text is made in kerf/options.py. A Watch is asked from
// any thread of a call without the interpreter's lock, and takes the lock to look at signals, at most every 100 ms, and
// to call `progress`. An exception of Python cannot cross the kernel: the first is kept, the call ends as cancelled,
// and without_lock() raises it again.
#include "python/options.h"

#include <algorithm>
#include <chrono>

#include <pybind11/stl.h>

#include "help/nearest.h"
#include "python/bindings.h"
#include "python/sizes.h"
#include "run/request/run_request.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

const char* kind_of(const OptionField& field) {
    struct Kinds {
        const char* operator()(std::int32_t*) const { return "whole number"; }
        const char* operator()(OptionField::Memory) const { return "memory"; }
        const char* operator()(OptionField::Count) const { return "count"; }
        const char* operator()(double*) const { return "number"; }
        const char* operator()(Length*) const { return "length"; }
        const char* operator()(bool*) const { return "flag"; }
        const char* operator()(std::string*) const { return "text"; }
        const char* operator()(OptionField::List) const { return "list"; }
        const char* operator()(const OptionField::Choice&) const { return "choice"; }
    };
    return std::visit(Kinds(), field.value);
}

py::dict row_of(const OptionField& field, bool is_of_surface) {
    using namespace py::literals;
    const auto* choice = std::get_if<OptionField::Choice>(&field.value);
    return py::dict("name"_a = field.name, "group"_a = field.group, "kind"_a = kind_of(field),
                    "form"_a = field.value_name, "help"_a = field.help, "default"_a = field.text(),
                    "choices"_a = choice ? choice->names : std::vector<std::string>(),
                    "is_of_surface"_a = is_of_surface);
}

// Returns the table of the command line, in its order, with the values of options that are not given.
py::list option_rows() {
    RunRequest options;
    py::list rows;
    const std::vector<OptionField> of_surface = input_option_fields(options.input_options);
    for (const OptionField& field : option_fields(options))
        rows.append(row_of(field, std::any_of(of_surface.begin(), of_surface.end(),
                                              [&](const OptionField& each) { return each.name == field.name; })));
    return rows;
}

}  // namespace

NamedOptions named_options(const py::kwargs& options) {
    return py::module_::import("kerf.options").attr("texts")(options).cast<NamedOptions>();
}

void register_options(py::module_& module) {
    module.def("option_rows", &option_rows);
    module.def("did_you_mean", &did_you_mean, py::arg("word"), py::arg("candidates"));
}

MeshOptions mesh_options(const py::object& sizes, const std::string& programs, const py::kwargs& options,
                         Watch& watch) {
    return {.others = named_options(options),
            .programs = programs,
            .progress = watch.progress(),
            .is_cancelled = watch.is_cancelled(),
            .sizes = sizes.is_none() ? nullptr : sizes.cast<SizesObject&>().sizes};
}

template <class Question>
bool Watch::goes_on(Question question) {
    if (has_raised_) return false;
    const py::gil_scoped_acquire lock;
    if (raised_) return false;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return question();
    } catch (...) {
        raised_ = std::current_exception();
        has_raised_ = true;
        return false;
    }
}

Progress Watch::progress() {
    if (progress_.is_none()) return {};
    return [this](const char* stage, std::size_t done, std::size_t total) {
        return goes_on([&] {
            const py::object answer = progress_(stage, done, total);
            return answer.is_none() || answer.cast<bool>();
        });
    };
}

IsCancelled Watch::is_cancelled() {
    return [this] {
        const auto now =
            std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch())
                .count();
        if (now < next_look_ && !has_raised_) return false;
        next_look_ = now + 100;
        return !goes_on([] { return true; });
    };
}

void Watch::rethrow() {
    if (raised_) std::rethrow_exception(std::exchange(raised_, nullptr));
}

}  // namespace kerf::python
