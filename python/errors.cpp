#include "python/errors.h"

#include <utility>

#include <pybind11/stl.h>

#include "kerf/kerf.h"

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
        element["names"] = each.names;
        list.append(element);
    }
    return list;
}

py::list parts_of(const PartsFailed& error) {
    py::list list;
    for (const FailedPart& each : error.parts())
        list.append(py::make_tuple(each.number, each.place, each.message, each.reproducer));
    return list;
}

void raise(const Error& error, const py::list& failed_parts) {
    const py::object made =
        py::module_::import("kerf.errors")
            .attr("error_of")(static_cast<int>(error.code()), error.what(), elements_of(error), failed_parts);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
}

}  // namespace

void register_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(std::move(pointer));
        } catch (const PartsFailed& error) {
            raise(error, parts_of(error));
        } catch (const Error& error) {
            raise(error, py::list());
        }
    });
}

}  // namespace kerf::python
