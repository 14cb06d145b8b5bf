#include "python/options.h"

#include <algorithm>
#include <chrono>

namespace kerf::python {

namespace py = pybind11;

namespace {

std::string text_of(const py::handle& value) { return py::str(value); }

void add_option(NamedOptions& options, const std::string& name, const py::handle& value) {
    if (value.is_none()) return;
    if (py::isinstance<py::bool_>(value)) {
        options.emplace_back(name, value.cast<bool>() ? "true" : "false");
    } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
        for (const py::handle each : value) options.emplace_back(name, text_of(each));
    } else {
        options.emplace_back(name, text_of(value));
    }
}

}  // namespace

NamedOptions named_options(const py::kwargs& options) {
    NamedOptions named;
    for (const auto& [key, value] : options) {
        std::string name = py::str(key);
        std::replace(name.begin(), name.end(), '_', '-');
        add_option(named, name, value);
    }
    return named;
}

MeshOptions mesh_options(std::int32_t parts, double size, std::int32_t workers, const std::string& programs,
                         const py::kwargs& options, Watch& watch) {
    return {.size = size,
            .parts = parts,
            .workers = workers,
            .others = named_options(options),
            .programs = programs,
            .progress = watch.progress(),
            .is_cancelled = watch.is_cancelled()};
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
