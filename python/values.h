// The values that objects of kerf._kerf hold: shared with an object of a subclass, and refused where there are none.
#pragma once

#include <concepts>
#include <memory>

#include <pybind11/pybind11.h>

namespace kerf {
struct CutTree;
struct MeshArrays;
struct Part;
struct PartJob;
struct RankMesh;
struct RecordedTry;
struct SurfaceCheck;
}  // namespace kerf

namespace kerf::python {

struct LocalObject;
struct NodeObject;
struct RunObject;
struct SizesObject;
struct SurfaceObject;

template <class T, class... Types>
concept OneOf = (std::same_as<T, Types> || ...);

/// The types whose classes in Python are public, or inherited there.
template <class T>
concept Held = OneOf<T, CutTree, LocalObject, MeshArrays, NodeObject, Part, PartJob, RankMesh, RecordedTry, RunObject,
                     SizesObject, SurfaceCheck, SurfaceObject>;

/// Returns the constructor by which an object of a subclass in Python has the value of an object of its base: nothing
/// is copied.
template <class T>
auto sharing() {
    return pybind11::init([](std::shared_ptr<T> other) { return other; });
}

}  // namespace kerf::python

namespace pybind11::detail {

/// Takes the value of an object. Throws TypeError where it has none, because its __init__ was not called, or failed and
/// a traceback still shows the object: pybind11 itself would make up one of memory that nobody has written.
template <kerf::python::Held T>
class type_caster<T> : public type_caster_base<T> {
 public:
    bool load(handle source, bool convert) {
        if (isinstance<T>(source) &&
            !reinterpret_cast<instance*>(source.ptr())->get_value_and_holder().holder_constructed())
            throw type_error("The object has no value: its __init__ has not ended.");
        return type_caster_base<T>::load(source, convert);
    }
};

}  // namespace pybind11::detail
