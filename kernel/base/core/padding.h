// The types that may be hashed or sent as they lie in memory: those without padding, whose bytes would be undefined.
#pragma once

#include <array>
#include <type_traits>

#include <Eigen/Core>

namespace kerf {

/// Whether all bytes of a T belong to its value. C++ can tell for types without floating-point numbers; a struct with
/// some specialises this and compares its size with that of its members.
template <class T>
struct HasNoPadding : std::bool_constant<std::has_unique_object_representations_v<T> || std::is_same_v<T, double> ||
                                         std::is_same_v<T, float>> {};
template <class T, std::size_t count>
struct HasNoPadding<std::array<T, count>> : HasNoPadding<T> {};
template <class T, int rows>
struct HasNoPadding<Eigen::Matrix<T, rows, 1>> : HasNoPadding<T> {};

}  // namespace kerf
