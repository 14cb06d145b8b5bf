#include "python/arrays.h"

#include <cstring>

#include <fmt/format.h>

namespace kerf::python {

namespace {

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

py::array as_array(const py::object& object, const char* name, const char* kinds, const char* wanted) {
    py::array array;
    try {
        array = py::module_::import("numpy").attr("asarray")(object);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
        throw py::type_error(fmt::format("{} is no array: its rows have different lengths, or are no numbers.", name));
    }
    const std::string kind = py::str(array.dtype().attr("kind"));
    if (array.size() > 0 && std::strchr(kinds, kind[0]) == nullptr)
        throw py::type_error(
            fmt::format("{} has the dtype {}, but {} are wanted.", name, std::string(py::str(array.dtype())), wanted));
    return array;
}

// Rows of `columns`, or single numbers where that is 0.
void check_shape(const py::array& array, py::ssize_t columns, const char* name) {
    const bool is_empty = array.size() == 0 && array.ndim() <= 2;
    if (columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns) return;
    if (is_empty && array.ndim() > 0) return;
    throw py::value_error(fmt::format("{} has the shape {}, but {} is wanted.", name, shape_text(array),
                                      columns == 0 ? std::string("(n,)") : fmt::format("(n, {})", columns)));
}

std::vector<std::int64_t> whole_numbers(const py::object& object, py::ssize_t columns, const char* name) {
    const py::array array = as_array(object, name, "iu", "whole numbers");
    check_shape(array, columns, name);
    const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!numbers) throw py::error_already_set();
    std::vector<std::int64_t> result(numbers.data(), numbers.data() + numbers.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        if (result[i] > std::numeric_limits<std::int32_t>::max() ||
            result[i] < std::numeric_limits<std::int32_t>::min())
            throw py::value_error(fmt::format("{} has {} in row {}, which is no number of 32 bits.", name, result[i],
                                              columns == 0 ? i : i / static_cast<std::size_t>(columns)));
    return result;
}

template <std::size_t N>
std::vector<std::array<std::int32_t, N>> rows_of(const py::object& object, const char* name) {
    const std::vector<std::int64_t> numbers = whole_numbers(object, N, name);
    std::vector<std::array<std::int32_t, N>> rows(numbers.size() / N);
    for (std::size_t i = 0; i < numbers.size(); ++i) rows[i / N][i % N] = static_cast<std::int32_t>(numbers[i]);
    return rows;
}

}  // namespace

std::vector<std::array<double, 3>> points_of(const py::object& object, const char* name) {
    const py::array array = as_array(object, name, "fiu", "numbers");
    check_shape(array, 3, name);
    const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
    if (!numbers) throw py::error_already_set();
    std::vector<std::array<double, 3>> rows(static_cast<std::size_t>(numbers.size()) / 3);
    if (!rows.empty()) std::memcpy(rows.data(), numbers.data(), rows.size() * sizeof(rows[0]));
    return rows;
}

std::vector<std::array<std::int32_t, 3>> triangles_of(const py::object& array, const char* name) {
    return rows_of<3>(array, name);
}
std::vector<std::array<std::int32_t, 2>> pairs_of(const py::object& array, const char* name) {
    return rows_of<2>(array, name);
}
std::vector<std::int32_t> numbers_of(const py::object& array, const char* name) {
    const std::vector<std::int64_t> numbers = whole_numbers(array, 0, name);
    return {numbers.begin(), numbers.end()};
}

}  // namespace kerf::python
