#include "python/errors.h"

#include <pybind11/stl.h>

#include "core/error.h"

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

}  // namespace

void register_errors(py::module_&) {
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const Error& error) {
            const py::object made =
                py::module_::import("kerf.errors")
                    .attr("error_of")(static_cast<int>(error.code()), error.what(), elements_of(error));
            PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(made.ptr())), made.ptr());
        }
    });
}

}  // namespace kerf::python
