// The options of a box of air around bodies.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "base/core/user_number.h"
#include "base/geometry/box.h"

namespace kerf {

/// The direction in which air flows along an axis.
enum class Wind { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

/// The box as a user asks for it. Lengths are in units of the bodies or, with %, of the diagonal of the box around
/// them.
struct EnclosureOptions {
    /// x0,y0,z0,x1,y1,z1: two corners. UP,SIDES,DOWN: the distances from the bodies upstream, to all sides and
    /// downstream, in multiples of the longest side of the box around the bodies. Empty: there is no box of air.
    std::string box = {};
    Wind wind = Wind::plus_x;
    std::string ground = {};  ///< a coordinate z, or y=-0.3: the plane of the box's low face of this axis; empty: none
    Length edge = {};  ///< edge length on the faces of the box, and of air far from bodies; 0: a twentieth of its
                       ///< longest side
    Length wake = {};  ///< edge length behind the bodies; 0: as elsewhere

    /// Whether there is a box.
    bool encloses() const { return !box.empty(); }
    /// Throws Error(usage) naming option, value and form.
    void check() const;
};

inline constexpr NumberRange air_edge_range = {
    "0 (the usual one) or a positive length in units of the input, or with % of its diagonal", 0};

/// A box of air that has a place.
struct Enclosure {
    Box box;
    Box bodies;  ///< around the bodies, before the box cuts them
    /// Names of the faces at the low and the high end of each axis: inlet, outlet, ground, and side_y_min and its kin.
    std::array<std::array<std::string, 2>, 3> face_names;
    double edge = 0;          ///< edge length on the faces
    std::optional<Box> wake;  ///< the space behind the bodies that has a size of its own
    double wake_edge = 0;     ///< edge length there
    double body_volume = 0;   ///< volume of the box that is not meshed, known once bodies are enclosed

    double diagonal() const { return bodies.diagonal().norm(); }  ///< of the box around the bodies
    static constexpr const char* ground = "ground";               ///< name of the face that cuts the bodies
    /// Whether a patch of this name is a face of the box.
    bool has_face(const std::string& patch) const;
};

/// Places the box around bodies. The wake begins in the middle of the bodies, is a quarter of them wider on each side,
/// and ends two of their longest sides behind them, or with the box. Throws Error(usage) as check(), and for a box
/// without volume, or with so many facets that no memory has room.
Enclosure enclosure_around(const Box& bodies, const EnclosureOptions& options);

}  // namespace kerf
