// Counts how often the components of a 3MF file place its objects, from its text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kerf {

/// The objects that the build items of a model place.
struct PlacedObjects {
    std::uint64_t objects = 0;  ///< all placed objects, those in components of any level included; at most 2^32
    int levels = 0;             ///< the most objects within each other; an item that is a mesh has one
};

/// Counts objects by the elements `object`, `component` and `item` of a model in UTF-8, without placing any, so that a
/// few lines that stand for any number of objects are known before a library follows them. An object has to be there
/// before components name it, as the format wants it; an unknown one counts once. For a text that is no XML the numbers
/// mean nothing, and there is no error. O(size log #objects).
PlacedObjects count_placed_objects(std::string_view model);

}  // namespace kerf
