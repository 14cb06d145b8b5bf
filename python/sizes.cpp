#include "python/sizes.h"

#include "python/arrays.h"
#include "python/bindings.h"

namespace kerf::python {

namespace {

std::shared_ptr<SizesObject> make_sizes(const py::object& points, const py::object& tetrahedra,
                                        const py::object& sizes) {
    auto given = std::make_shared<const GivenSizes>(
        GivenSizes{points_of(points, "points"), tetrahedra_of(tetrahedra, "tetrahedra"), lengths_of(sizes, "sizes")});
    check_sizes(*given);
    return std::make_shared<SizesObject>(SizesObject{std::move(given)});
}

}  // namespace

void register_sizes(py::module_& module) {
    py::class_<SizesObject, std::shared_ptr<SizesObject>>(module, "SizeField")
        .def(py::init(&make_sizes), py::arg("points"), py::arg("tetrahedra"), py::arg("sizes"))
        .def_property_readonly(
            "points", [](const py::object& self) { return view(self.cast<SizesObject&>().sizes->vertices, self); },
            "(n, 3) float64.")
        .def_property_readonly(
            "tetrahedra", [](const py::object& self) { return view(self.cast<SizesObject&>().sizes->tets, self); },
            "(m, 4) int32: rows of `points`.")
        .def_property_readonly(
            "sizes", [](const py::object& self) { return view(self.cast<SizesObject&>().sizes->sizes, self); },
            "(n,) float64: of the points.");
}

}  // namespace kerf::python
