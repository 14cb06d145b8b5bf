// Objects as pickles: their arrays by names, or the bytes by which processes of Kerf send them to each other.
#pragma once

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "base/core/bytes.h"
#include "base/core/version.h"

namespace kerf::python {

/// Returns the rows of an array of a pickle. Throws ValueError, naming it, for another shape.
template <class T, std::size_t N>
std::vector<std::array<T, N>> rows_of_state(const pybind11::dict& state, const char* name) {
    const auto array = state[name].cast<pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>>();
    if (array.ndim() != 2 || std::cmp_not_equal(array.shape(1), N))
        throw pybind11::value_error(std::string("The pickle is damaged: its array ") + name + " has another shape.");
    std::vector<std::array<T, N>> rows(array.shape(0));
    if (!rows.empty()) std::memcpy(rows.data(), array.data(), rows.size() * sizeof(rows[0]));
    return rows;
}
/// Returns the numbers of an array of a pickle.
template <class T>
std::vector<T> numbers_of_state(const pybind11::dict& state, const char* name) {
    const auto array = state[name].cast<pybind11::array_t<T, pybind11::array::c_style | pybind11::array::forcecast>>();
    return {array.data(), array.data() + array.size()};
}

/// Returns the pickling of a T by `write(ByteWriter&, const T&)` and `read(ByteReader&, T&)`. It throws ValueError for
/// a pickle of another version, whose bytes may mean something else, and for one that is damaged.
template <class T, class Write, class Read>
auto pickled_as_bytes(Write write, Read read) {
    return pybind11::pickle(
        [write](const T& self) {
            Bytes bytes;
            ByteWriter writer(bytes);
            write(writer, self);
            return pybind11::make_tuple(version, pybind11::bytes(bytes.data(), bytes.size()));
        },
        [read](const pybind11::tuple& state) {
            if (state.size() != 2 || state[0].cast<std::string>() != version)
                throw pybind11::value_error(std::string("The pickle is not one of Kerf ") + version +
                                            ": only the version that has written it reads it.");
            const auto bytes = state[1].cast<std::string>();
            T made;
            try {
                ByteReader reader(bytes);
                read(reader, made);
            } catch (const Error& error) {
                throw pybind11::value_error(std::string("The pickle is damaged. ") + error.what());
            }
            return made;
        });
}

/// Returns the pickling of a T by its archive().
template <class T>
auto pickled_as_bytes() {
    return pickled_as_bytes<T>([](ByteWriter& writer, const T& self) { writer(self); },
                               [](ByteReader& reader, T& made) { reader(made); });
}

}  // namespace kerf::python
