// Arrays of numpy as rows, and rows as arrays of numpy.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

#include "base/core/types.h"

namespace kerf::python {

namespace py = pybind11;

/// Returns a read-only array that shares the memory of `owner`.
template <class T>
py::array_t<T> view(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
    py::array_t<T> result(std::move(shape), data, owner);
    result.attr("flags").attr("writeable") = false;
    return result;
}
template <class T, std::size_t N>
py::array_t<T> view(const std::vector<std::array<T, N>>& rows, py::handle owner) {
    return view(rows.empty() ? nullptr : rows.front().data(), {std::ssize(rows), N}, owner);
}
template <class T>
py::array_t<T> view(const std::vector<T>& values, py::handle owner) {
    return view(values.data(), {std::ssize(values)}, owner);
}

/// Returns ids as their numbers.
template <class Tag>
py::array_t<std::int32_t> view(const std::vector<Id<Tag>>& ids, py::handle owner) {
    static_assert(sizeof(Id<Tag>) == sizeof(std::int32_t));
    return view(reinterpret_cast<const std::int32_t*>(ids.data()), {std::ssize(ids)}, owner);
}

inline py::array_t<double> view(const std::vector<Vec3>& points, py::handle owner) {
    return view(points.empty() ? nullptr : points.front().data(), {std::ssize(points), 3}, owner);
}

/// Returns a read-only array that keeps the rows itself.
template <class Rows>
py::array owned(Rows rows) {
    auto kept = std::make_unique<Rows>(std::move(rows));
    Rows* const data = kept.get();
    const py::capsule owner(kept.release(), [](void* pointer) { delete static_cast<Rows*>(pointer); });
    return view(*data, owner);
}

/// Returns the getter of a member of an object: a view of it.
template <class Object, class Values>
auto array_of(Values Object::*member) {
    return [member](const py::object& self) { return view(self.cast<Object&>().*member, self); };
}

/// Each returns rows of N numbers, or for N = 1 numbers, of any object of which numpy makes an array. Throws
/// UsageError, naming the argument, its shape or type and, for whole numbers that do not fit in 32 bits, the row.
std::vector<std::array<double, 3>> points_of(const py::object& array, const char* name);
std::vector<std::array<std::int32_t, 3>> triangles_of(const py::object& array, const char* name);
std::vector<std::array<std::int32_t, 2>> pairs_of(const py::object& array, const char* name);
std::vector<std::array<std::int32_t, 4>> tetrahedra_of(const py::object& array, const char* name);
std::vector<double> lengths_of(const py::object& array, const char* name);
std::vector<std::int32_t> numbers_of(const py::object& array, const char* name);

}  // namespace kerf::python
