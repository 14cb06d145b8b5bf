// How often the components of a 3MF file place its objects, as its text says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kerf {

/// What the build items of a model place.
struct PlacedObjects {
    std::uint64_t objects = 0;  ///< with objects of components, and those in them; at most 2^32
    int levels = 0;             ///< the most that are in each other; an item that is a mesh has one
};

/// Counts them by the elements `object`, `component` and `item` of a model in UTF-8, without placing any, so that a few
/// lines that are as many objects as one likes are known before a library follows them. An object has to be there
/// before components name it, as the format wants it; others count once. What is no XML gives no numbers that mean
/// anything, and no error. O(size log #objects).
PlacedObjects count_placed_objects(std::string_view model);

}  // namespace kerf
