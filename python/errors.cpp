#include <utility>

#include <pybind11/stl.h>

#include "base/core/error.h"
#include "kerf/kerf.h"
#include "python/bindings.h"
#include "python/defects.h"
#include "python/text.h"

namespace kerf::python {

namespace py = pybind11;

namespace {

const char* kind_name(ElementKind kind) {
    constexpr const char* names[] = {"vertex", "edge", "facet", "solid"};
    return names[static_cast<std::size_t>(kind)];
}

py::list elements_of(const Error& error) {
    py::list list;
    for (const ErrorElements& each : error.elements()) {
        py::dict element;
        element["kind"] = kind_name(each.kind);
        element["ids"] = each.ids;
        element["points"] = each.points;
        element["names"] = decoded(each.names);
        list.append(element);
    }
    return list;
}

py::list parts_of(const PartsFailed& error) {
    py::list list;
    for (const FailedPart& each : error.parts())
        list.append(py::make_tuple(each.number, each.place, decoded(each.message), decoded(each.reproducer)));
    return list;
}

// Returns the error as an exception of Python, with all that this is told of it.
py::object exception_of(const Error& error) {
    const auto* of_surface = dynamic_cast<const SurfaceError*>(&error);
    const auto* of_parts = dynamic_cast<const PartsFailed*>(&error);
    return py::module_::import("kerf.errors")
        .attr("error_of")(static_cast<int>(error.code()), decoded(error.what()), elements_of(error),
                          of_parts ? parts_of(*of_parts) : py::list(),
                          of_surface ? defects_of(of_surface->defects()) : py::list());
}

}  // namespace

void register_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(std::move(pointer));
        } catch (const Error& error) {
            const py::object made = exception_of(error);
            PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
        }
    });
}

}  // namespace kerf::python
