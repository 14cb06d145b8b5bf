// Text of the kernel as str; it may have any bytes that a file or a file system has.
#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace kerf::python {

/// Returns text as str. Bytes that are no UTF-8 become surrogates, as os.fsdecode() has them; os.fsencode() takes them
/// back.
inline pybind11::str decoded(const std::string& text) {
    PyObject* made = PyUnicode_DecodeUTF8(text.data(), text.size(), "surrogateescape");
    if (!made) throw pybind11::error_already_set();
    return pybind11::reinterpret_steal<pybind11::str>(made);
}

inline pybind11::list decoded(const std::vector<std::string>& texts) {
    pybind11::list list;
    for (const std::string& text : texts) list.append(decoded(text));
    return list;
}

}  // namespace kerf::python
