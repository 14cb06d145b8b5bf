// Points that the program kerf-cad puts on the faces of a CAD file, and how it is told of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/bytes.h"
#include "core/types.h"

namespace kerf {

/// Where on the model points belong.
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

/// What is to be put on the model: points, and then the middles between some of them. Units of CadBody::soup.
struct CadPoints {
    std::vector<std::string> patch_names;           ///< those of the soup; what it has not stands for all faces
    std::vector<CadPlace> places;                   ///< some, for many points each
    std::vector<Vec3> points;                       ///< #P
    std::vector<std::int32_t> place;                ///< #P; of `places`, -1: the point stays
    std::vector<std::array<std::int32_t, 2>> ends;  ///< #M; the points between which the middles are
    std::vector<std::int32_t> place_of_middle;      ///< #M

    template <class Archive>
    void archive(Archive& a) {
        a(patch_names, places, points, place, ends, place_of_middle);
    }
};

/// What became of them. A point for which the model has nothing stays where it is.
struct ProjectedPoints {
    std::vector<Vec3> points;   ///< #P
    std::vector<Vec3> middles;  ///< #M; of the middles between the new points

    template <class Archive>
    void archive(Archive& a) {
        a(points, middles);
    }
};

}  // namespace kerf
