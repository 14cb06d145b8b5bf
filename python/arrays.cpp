// Arguments become rows by copies that are checked at the boundary, so that errors name the argument and the row, and
// the kernel sees 32-bit numbers and doubles alone. numpy makes the array, of lists, too; masked values, ragged rows
// and dtypes of another kind are refused, and an array without numbers may have any dtype. Whole numbers are read as
// 64-bit ones, signed or not as they come, and each must fit in 32 bits: numpy's own conversion would wrap them
// silently.
#include "python/arrays.h"

#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf::python {

namespace {

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

// Returns the array that numpy makes of an object. `kinds`: the kinds of dtypes that are allowed.
py::array as_array(const py::object& object, const char* name, const char* kinds, const char* wanted) {
    const py::module_ numpy = py::module_::import("numpy");
    if (numpy.attr("ma").attr("is_masked")(object).cast<bool>())
        throw Error(ErrorCode::usage,
                    fmt::format("{} has values that are masked: fill them, or leave their rows out.", name));
    py::array array;
    try {
        array = numpy.attr("asarray")(object);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
        const std::string text =
            fmt::format("{} is no array: its rows have different lengths, or are no numbers.", name);
        py::raise_from(error, py::module_::import("kerf.errors").attr("UsageError").ptr(), text.c_str());
        throw py::error_already_set();
    }
    const std::string kind = py::str(array.dtype().attr("kind"));
    if (array.size() > 0 && std::strchr(kinds, kind[0]) == nullptr)
        throw Error(ErrorCode::usage, fmt::format("{} has the dtype {}, but {} are wanted.", name,
                                                  std::string(py::str(array.dtype())), wanted));
    return array;
}

// Requires rows of `columns` numbers, or single numbers where that is 0.
void check_shape(const py::array& array, py::ssize_t columns, const char* name) {
    if (array.ndim() > 0 && array.shape(0) > std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorCode::usage, fmt::format("{} has {} rows, but at most {} are possible.", name, array.shape(0),
                                                  std::numeric_limits<std::int32_t>::max()));
    const bool is_empty = array.size() == 0 && array.ndim() <= 2;
    if (columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns) return;
    if (is_empty && array.ndim() > 0) return;
    throw Error(ErrorCode::usage, fmt::format("{} has the shape {}, but {} is wanted.", name, shape_text(array),
                                              columns == 0 ? std::string("(n,)") : fmt::format("(n, {})", columns)));
}

// Returns the numbers as T, in one piece of memory.
template <class T>
py::array_t<T> in_one_piece(const py::array& array) {
    return py::module_::import("numpy").attr("require")(array, py::dtype::of<T>(), "CA");
}

// Adds the numbers of an array to `rows`, N in each. Throws UsageError for the first that does not fit in 32 bits.
template <class Wide, std::size_t N>
void append_rows(std::vector<std::array<std::int32_t, N>>& rows, const py::array& array, const char* name) {
    using Limits = std::numeric_limits<std::int32_t>;
    const py::array_t<Wide> numbers = in_one_piece<Wide>(array);
    const std::size_t count = numbers.size();
    rows.resize(count / N);
    for (std::size_t i = 0; i < count; ++i) {
        const Wide number = numbers.data()[i];
        if (std::cmp_greater(number, Limits::max()) || std::cmp_less(number, Limits::min()))
            throw Error(ErrorCode::usage,
                        fmt::format("{} has {} in row {}, which is no number of 32 bits.", name, number, i / N));
        rows[i / N][i % N] = number;
    }
}

// Returns whole numbers as rows. `is_flat`: N is 1, and the array has one dimension.
template <std::size_t N>
std::vector<std::array<std::int32_t, N>> rows_of(const py::object& object, const char* name, bool is_flat = false) {
    const py::array array = as_array(object, name, "iu", "whole numbers");
    check_shape(array, is_flat ? 0 : N, name);
    std::vector<std::array<std::int32_t, N>> rows;
    if (array.size() == 0) return rows;
    const bool is_unsigned = array.dtype().kind() == 'u';
    if (is_unsigned)
        append_rows<std::uint64_t>(rows, array, name);
    else
        append_rows<std::int64_t>(rows, array, name);
    return rows;
}

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

Doubles doubles_of(const py::object& object, py::ssize_t columns, const char* name) {
    const py::array array = as_array(object, name, "fiu", "numbers");
    check_shape(array, columns, name);
    Doubles numbers = Doubles::ensure(array);
    if (!numbers) throw py::error_already_set();
    return numbers;
}

}  // namespace

std::vector<std::array<double, 3>> points_of(const py::object& object, const char* name) {
    const Doubles numbers = doubles_of(object, 3, name);
    std::vector<std::array<double, 3>> rows(numbers.size() / 3);
    if (!rows.empty()) std::memcpy(rows.data(), numbers.data(), rows.size() * sizeof(rows[0]));
    return rows;
}

std::vector<std::array<std::int32_t, 3>> triangles_of(const py::object& array, const char* name) {
    return rows_of<3>(array, name);
}
std::vector<std::array<std::int32_t, 4>> tetrahedra_of(const py::object& array, const char* name) {
    return rows_of<4>(array, name);
}
std::vector<double> lengths_of(const py::object& array, const char* name) {
    const Doubles numbers = doubles_of(array, 0, name);
    return {numbers.data(), numbers.data() + numbers.size()};
}
std::vector<std::array<std::int32_t, 2>> pairs_of(const py::object& array, const char* name) {
    return rows_of<2>(array, name);
}
std::vector<std::int32_t> numbers_of(const py::object& array, const char* name) {
    const std::vector<std::array<std::int32_t, 1>> rows = rows_of<1>(array, name, true);
    std::vector<std::int32_t> numbers(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) numbers[i] = rows[i][0];
    return numbers;
}

}  // namespace kerf::python
