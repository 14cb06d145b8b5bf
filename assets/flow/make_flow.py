#!/usr/bin/python3
"""Make the STL surfaces of two flows: car.stl, to put air around, and
vessel.stl, whose three ends are open.

    make_flow.py [DIR]

Lengths of the car are metres: it drives towards -x and stands on z = 0, into
which its tyres reach by five centimetres.  Those of the vessel are millimetres.
Needs what make_assets.py needs; the results are committed.
"""

import math
import os
import sys

import gmsh
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import make_assets  # noqa: E402

# The side of the body: x, z.
OUTLINE = ((0.0, 0.35), (0.02, 0.62), (0.25, 0.78), (1.15, 0.90), (1.85, 1.38),
           (2.95, 1.42), (3.75, 1.08), (4.18, 1.02), (4.22, 0.40), (3.95, 0.22),
           (0.20, 0.20))
WIDTH, TYRE, RADIUS = 1.7, 0.2, 0.31
SUNK = 0.05
AXLES = (0.80, 3.30)


def car():
    occ = make_assets.start_model("car")
    points = [occ.addPoint(x, -WIDTH / 2, z) for x, z in OUTLINE]
    lines = [occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
    side = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    body = [tag for dim, tag in occ.extrude([(2, side)], 0, WIDTH, 0) if dim == 3][0]
    wheels = [occ.addCylinder(x, y, RADIUS - SUNK, 0, TYRE, 0, RADIUS)
              for x in AXLES for y in (-WIDTH / 2 + 0.02, WIDTH / 2 - TYRE - 0.02)]
    make_assets.merge(occ, body, wheels)
    occ.synchronize()
    make_assets.set_uniform_size(0.12)
    return make_assets.mesh_model()


def vessel():
    """A trunk that divides in two."""
    occ = make_assets.start_model("vessel")
    trunk = occ.addCylinder(0, 0, -12, 0, 0, 12, 2)
    branches = []
    for angle, radius in ((0.6, 1.5), (-0.5, 1.3)):
        branches.append(occ.addCylinder(0, 0, 0, 12 * math.sin(angle), 0, 12 * math.cos(angle), radius))
    joint = occ.addSphere(0, 0, 0, 2.0)
    make_assets.merge(occ, trunk, branches + [joint])
    occ.synchronize()
    make_assets.set_uniform_size(0.5)
    mesh = make_assets.mesh_model()
    # The ends are the flat faces.
    ends = {tag for _, tag in gmsh.model.getEntities(2) if gmsh.model.getType(2, tag) == "Plane"}
    keep = [i for i, tag in enumerate(mesh.patch) if tag not in ends]
    return mesh._replace(facets=np.asarray(mesh.facets)[keep])


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    gmsh.initialize()
    for name, make in (("car", car), ("vessel", vessel)):
        make_assets.write_stl(name, make_assets.rounded(make()), folder)
    gmsh.finalize()


if __name__ == "__main__":
    main()
