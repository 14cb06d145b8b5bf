// Points that the program kerf-cad puts on the faces of a CAD file, as it gets them and as it returns them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/core/bytes.h"
#include "base/core/types.h"

namespace kerf {

/// A place on the model, for points that belong there: some faces, or a curve that they share.
struct CadPlace {
    std::vector<std::int32_t> patches;  ///< numbers of CadPoints::patch_names, ascending
    std::int32_t is_curve = 0;          ///< 1: a curve that the faces of all of these patches share; 0: their faces

    bool operator==(const CadPlace&) const = default;
    auto operator<=>(const CadPlace&) const = default;

    template <class Archive>
    void archive(Archive& a) {
        a(patches, is_curve);
    }
};

/// Points that are to be put on the model, and pairs of them whose middles are to be put there after them. In units of
/// CadBody::soup.
struct CadPoints {
    std::vector<std::string> patch_names;           ///< patches of the soup; an unknown name stands for all faces
    std::vector<CadPlace> places;                   ///< few, each of many points
    std::vector<Vec3> points;                       ///< #P
    std::vector<std::int32_t> place;                ///< #P; number in `places`, -1: the point stays
    std::vector<std::array<std::int32_t, 2>> ends;  ///< #M; the two points of each middle
    std::vector<std::int32_t> place_of_middle;      ///< #M

    template <class Archive>
    void archive(Archive& a) {
        a(patch_names, places, points, place, ends, place_of_middle);
    }
};

/// The points where the model has them. A point for which the model has no place stays where it is.
struct ProjectedPoints {
    std::vector<Vec3> points;   ///< #P
    std::vector<Vec3> middles;  ///< #M; for the middles between the new points

    template <class Archive>
    void archive(Archive& a) {
        a(points, middles);
    }
};

}  // namespace kerf
