// Finds the point of a curved face or curve that is nearest to another point, from a start that is near.
#pragma once

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include "base/core/types.h"

namespace kerf::cad {

/// The surface of a face. Planes, cylinders, cones, spheres and tori have formulas; on other surfaces a point is found
/// by Newton's iteration within the parameters of the face. The surface is not trimmed: the nearest point may lie
/// beside the face.
class NearestOnFace {
 public:
    explicit NearestOnFace(const TopoDS_Face& face) : surface_(face) {}
    /// Returns the nearest point, in millimetres. `u`, `v`: parameters of a point of the face that is near.
    /// Deterministic.
    Vec3 find(const Vec3& p, double u, double v) const;

 private:
    Vec3 iterate(const Vec3& p, double u, double v) const;
    BRepAdaptor_Surface surface_;
};

/// The curve of an edge, which ends where the edge does.
class NearestOnEdge {
 public:
    explicit NearestOnEdge(const TopoDS_Edge& edge) : curve_(edge) {}
    double first() const { return curve_.FirstParameter(); }
    double last() const { return curve_.LastParameter(); }
    Vec3 at(double t) const;
    /// Returns the nearest point, in millimetres. `t`: parameter of a point of the edge that is near.
    Vec3 find(const Vec3& p, double t) const;

 private:
    BRepAdaptor_Curve curve_;
};

}  // namespace kerf::cad
