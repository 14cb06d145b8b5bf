#include "files/cad/inside/face_surface.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <BRepAdaptor_Surface.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>

namespace kerf::cad {

PatchFace surface_of(const TopoDS_Face& face) {
    const BRepAdaptor_Surface surface(face);
    switch (surface.GetType()) {
        case GeomAbs_Plane:
            return {"", "plane"};
        case GeomAbs_Cylinder:
            return {"", "cylinder", surface.Cylinder().Radius()};
        case GeomAbs_Cone:
            return {"", fmt::format("cone of {:.4g} degrees",
                                    std::abs(surface.Cone().SemiAngle()) * 180 / std::numbers::pi)};
        case GeomAbs_Sphere:
            return {"", "sphere", surface.Sphere().Radius()};
        case GeomAbs_Torus:
            return {"", "torus", surface.Torus().MajorRadius(), surface.Torus().MinorRadius()};
        case GeomAbs_BezierSurface:
        case GeomAbs_BSplineSurface:
            return {"", "spline"};
        case GeomAbs_SurfaceOfRevolution:
            return {"", "revolved curve"};
        case GeomAbs_SurfaceOfExtrusion:
            return {"", "extruded curve"};
        case GeomAbs_OffsetSurface:
            return {"", "offset surface"};
        case GeomAbs_OtherSurface:
            break;
    }
    return {"", "surface"};
}

}  // namespace kerf::cad
