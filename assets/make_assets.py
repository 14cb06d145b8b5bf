#!/usr/bin/python3
"""Make the STL surface meshes in this directory.

A developer's tool: its results are committed, so neither the build nor the
tests need it.  It needs gmsh 4.8 with its Python module, numpy and vtk
(Debian: python3-gmsh python3-numpy python3-vtk9).

    make_assets.py [--out DIR] [NAME ...]

Every mesh is closed, manifold and oriented: normals point out of the
material, thus shells of a void have a negative signed volume.
"""

import argparse
import math
import os
import sys
import time
from collections import defaultdict, namedtuple

import gmsh
import numpy as np

# Facets with a smaller angle (degrees) are worked on by `polish`.
GOAL_ANGLE = 30.0

# vertices: (n, 3) float64; facets: (m, 3) int; owner: per vertex the
# (dimension, tag) of the lowest CAD entity it lies on, patch: per facet the
# tag of its CAD surface.
Mesh = namedtuple("Mesh", "vertices facets owner patch")


# --------------------------------------------------------------------------
# Measures
# --------------------------------------------------------------------------

def facet_angles(vertices, facets):
    """Angles in degrees, one row of three for each facet."""
    corner = vertices[facets]
    angles = np.empty(facets.shape)
    for k in range(3):
        u = corner[:, (k + 1) % 3] - corner[:, k]
        v = corner[:, (k + 2) % 3] - corner[:, k]
        cross = np.linalg.norm(np.cross(u, v), axis=1)
        angles[:, k] = np.degrees(np.arctan2(cross, (u * v).sum(axis=1)))
    return angles


def area_vectors(vertices, facets):
    a, b, c = (vertices[facets[:, k]] for k in range(3))
    return 0.5 * np.cross(b - a, c - a)


def signed_volume(vertices, facets):
    a, b, c = (vertices[facets[:, k]] - vertices[0] for k in range(3))
    return (a * np.cross(b, c)).sum() / 6.0


def winding_number(point, vertices, facets):
    """Number of times the (closed) surface winds around the point."""
    a, b, c = (vertices[facets[:, k]] - point for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    numerator = (a * np.cross(b, c)).sum(axis=1)
    denominator = (la * lb * lc + (a * b).sum(axis=1) * lc
                   + (b * c).sum(axis=1) * la + (c * a).sum(axis=1) * lb)
    return np.arctan2(numerator, denominator).sum() / (2.0 * math.pi)


# --------------------------------------------------------------------------
# Orientation
# --------------------------------------------------------------------------

def edge_map(facets):
    """Undirected edge -> list of (facet, is it used as low to high)."""
    edges = defaultdict(list)
    for f, (a, b, c) in enumerate(facets.tolist()):
        for u, v in ((a, b), (b, c), (c, a)):
            edges[(u, v) if u < v else (v, u)].append((f, u < v))
    return edges


def flood_shells(facets):
    """Orient the facets of each shell alike; returns (facets, shell ids)."""
    neighbours = defaultdict(list)
    for uses in edge_map(facets).values():
        assert len(uses) == 2, "surface is open or not manifold"
        (f, f_up), (g, g_up) = uses
        neighbours[f].append((g, f_up == g_up))
        neighbours[g].append((f, f_up == g_up))
    shell = [-1] * len(facets)
    flip = [False] * len(facets)
    count = 0
    for seed in range(len(facets)):
        if shell[seed] >= 0:
            continue
        shell[seed] = count
        stack = [seed]
        while stack:
            f = stack.pop()
            for g, differs in neighbours[f]:
                if shell[g] < 0:
                    shell[g] = count
                    flip[g] = flip[f] ^ differs
                    stack.append(g)
                assert flip[g] == flip[f] ^ differs, "not orientable"
        count += 1
    flip = np.array(flip)
    facets = facets.copy()
    facets[flip] = facets[flip][:, ::-1]
    return facets, np.array(shell)


def orient(mesh):
    """Turn all normals out of the material.

    The order of the vertices within a facet as given by gmsh follows the
    parametrisation of the CAD surface, which says nothing about inside and
    outside; so it is found here: by flood within a shell, by the sign of the
    volume and the depth of nesting between shells.
    """
    facets, shell = flood_shells(mesh.facets)
    vertices = mesh.vertices
    for s in range(shell.max() + 1):
        own = facets[shell == s]
        if signed_volume(vertices, own) < 0.0:
            facets[shell == s] = own[:, ::-1]
    outward = facets.copy()
    for s in range(shell.max() + 1):
        point = vertices[outward[shell == s][0, 0]]
        depth = sum(round(winding_number(point, vertices, outward[shell == t]))
                    for t in range(shell.max() + 1) if t != s)
        if depth % 2 == 1:
            facets[shell == s] = outward[shell == s][:, ::-1]
    return mesh._replace(facets=facets)


# --------------------------------------------------------------------------
# Shape improvement
# --------------------------------------------------------------------------

def _sub(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def _dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def _cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0])


def _unit(p):
    length = math.sqrt(_dot(p, p)) or 1.0
    return (p[0] / length, p[1] / length, p[2] / length)


def _normal(p, q, r):
    return _unit(_cross(_sub(q, p), _sub(r, p)))


def _min_angle(p, q, r):
    pq, qr, rp = _unit(_sub(q, p)), _unit(_sub(r, q)), _unit(_sub(p, r))
    cosine = max(-_dot(pq, rp), -_dot(qr, pq), -_dot(rp, qr))
    return math.degrees(math.acos(max(-1.0, min(1.0, cosine))))


class Surface:
    """An editable triangulation for local operations."""

    def __init__(self, mesh):
        self.points = [tuple(p) for p in mesh.vertices.tolist()]
        self.facets = [tuple(f) for f in mesh.facets.tolist()]
        self.owner = list(mesh.owner)
        self.patch = list(mesh.patch)
        self.ring = [set() for _ in self.points]
        for f, corners in enumerate(self.facets):
            for v in corners:
                self.ring[v].add(f)

    def mesh(self):
        """The result, without removed facets and unused vertices."""
        alive = [f for f in range(len(self.facets)) if self.facets[f]]
        used = sorted({v for f in alive for v in self.facets[f]})
        number = {v: i for i, v in enumerate(used)}
        return Mesh(np.array([self.points[v] for v in used]),
                    np.array([[number[v] for v in self.facets[f]]
                              for f in alive]),
                    [self.owner[v] for v in used],
                    [self.patch[f] for f in alive])

    def corners(self, f):
        return [self.points[v] for v in self.facets[f]]

    def edges(self):
        return sorted({(min(u, v), max(u, v)) for f in self.facets if f
                       for u, v in ((f[0], f[1]), (f[1], f[2]), (f[2], f[0]))})

    def length(self, u, v):
        return math.dist(self.points[u], self.points[v])

    def adjacent(self, v):
        return {w for f in self.ring[v] for w in self.facets[f]} - {v}

    def set_facet(self, f, corners):
        for v in self.facets[f]:
            self.ring[v].discard(f)
        self.facets[f] = corners
        for v in corners:
            self.ring[v].add(f)

    def add_facet(self, corners, patch):
        self.facets.append(())
        self.patch.append(patch)
        self.set_facet(len(self.facets) - 1, corners)

    def wings(self, u, v):
        """(f, g, c, d): f = (u, v, c), g = (v, u, d) up to rotation."""
        both = self.ring[u] & self.ring[v]
        if len(both) != 2:
            return None
        f, g = sorted(both)
        if not self.has_directed(f, u, v):
            f, g = g, f
        c = next(w for w in self.facets[f] if w not in (u, v))
        d = next(w for w in self.facets[g] if w not in (u, v))
        return f, g, c, d

    def has_directed(self, f, u, v):
        a, b, c = self.facets[f]
        return (u, v) in ((a, b), (b, c), (c, a))

    def flip(self, u, v, better):
        """Flip edge uv if legal, flat enough and better(c, d, f, g) holds."""
        found = self.wings(u, v)
        if not found:
            return False
        f, g, c, d = found
        if self.patch[f] != self.patch[g] or d in self.adjacent(c):
            return False
        p = self.points
        before = _normal(*self.corners(f)), _normal(*self.corners(g))
        after = _normal(p[u], p[d], p[c]), _normal(p[v], p[c], p[d])
        if min(_dot(m, n) for m in before for n in after) < 0.7:
            return False
        if not better(c, d, f, g):
            return False
        self.set_facet(f, (u, d, c))
        self.set_facet(g, (v, c, d))
        return True

    def split(self, u, v, owner):
        f, g, c, d = self.wings(u, v)
        m = len(self.points)
        self.points.append(tuple(0.5 * (s + t) for s, t
                                 in zip(self.points[u], self.points[v])))
        self.ring.append(set())
        self.owner.append(owner)
        self.set_facet(f, (u, m, c))
        self.set_facet(g, (m, u, d))
        self.add_facet((m, v, c), self.patch[f])
        self.add_facet((v, m, d), self.patch[g])

    def can_collapse(self, u, v, accept):
        """May u be moved into v?  accept(p, q, r) judges each new facet."""
        if len(self.adjacent(u) & self.adjacent(v)) != 2:
            return False
        for f in self.ring[u] - self.ring[v]:
            moved = [self.points[v if w == u else w] for w in self.facets[f]]
            if _dot(_normal(*self.corners(f)), _normal(*moved)) < 0.7:
                return False
            if not accept(*moved):
                return False
        return True

    def collapse(self, u, v):
        for f in list(self.ring[u]):
            if v in self.facets[f]:
                self.set_facet(f, ())
            else:
                self.set_facet(f, tuple(v if w == u else w
                                        for w in self.facets[f]))

    def worst(self, facets):
        return min(_min_angle(*self.corners(f)) for f in facets)


def relocate(surface, v, project):
    """Pattern search for the place of v with the largest smallest angle."""
    ring = surface.ring[v]
    start = surface.points[v]
    normals = {f: _normal(*surface.corners(f)) for f in ring}
    best = surface.worst(ring)
    first = best
    reach = sum(surface.length(v, w) for w in surface.adjacent(v)) \
        / len(surface.adjacent(v))
    axis = normals[min(ring)]
    side = _unit(_cross(axis, (0.36, 0.48, 0.8)))
    other = _cross(axis, side)
    step = 0.25 * reach
    while step > 0.01 * reach:
        moved = False
        base = surface.points[v]
        for k in range(8):
            s = step * math.cos(k * math.pi / 4)
            t = step * math.sin(k * math.pi / 4)
            trial = project(v, tuple(base[i] + s * side[i] + t * other[i]
                                     for i in range(3)))
            if trial is None:
                return False
            kept, surface.points[v] = surface.points[v], trial
            score = surface.worst(ring)
            upright = all(_dot(normals[f], _normal(*surface.corners(f))) > 0.7
                          for f in ring)
            if upright and score > best + 1e-3:
                best, moved = score, True
            else:
                surface.points[v] = kept
        if not moved:
            step *= 0.5
    if best <= first:
        surface.points[v] = start
    return best > first


def polish(mesh, project, rounds=12):
    """Raise small angles: flips, collapses and moves on the CAD entities."""
    surface = Surface(mesh)

    def better_angles(c, d, f, g):
        p = surface.points
        u, v = sorted(set(surface.facets[f]) & set(surface.facets[g]))
        return min(_min_angle(p[u], p[c], p[d]),
                   _min_angle(p[v], p[c], p[d])) > surface.worst((f, g)) + .01

    for _ in range(rounds):
        bad = [f for f in range(len(surface.facets)) if surface.facets[f]
               and _min_angle(*surface.corners(f)) < GOAL_ANGLE]
        changed = False
        for f in bad:
            if not surface.facets[f]:
                continue
            a, b, c = surface.facets[f]
            for u, v in ((a, b), (b, c), (c, a)):
                changed |= surface.flip(u, v, better_angles)
            for v in surface.facets[f]:
                changed |= relocate(surface, v, project)
            changed |= collapse_short(surface, f)
        if not changed:
            break
    return surface.mesh()


def collapse_short(surface, f):
    """Remove the shortest edge of a facet if this helps all angles around."""
    a, b, c = surface.facets[f]
    u, v = min(((a, b), (b, c), (c, a)), key=lambda e: surface.length(*e))
    for s, t in ((u, v), (v, u)):
        if surface.owner[s][0] != 2:
            continue
        floor = surface.worst(surface.ring[s] | surface.ring[t]) + 1.0
        if surface.can_collapse(
                s, t, lambda *corner: _min_angle(*corner) > floor):
            surface.collapse(s, t)
            return True
    return False


# --------------------------------------------------------------------------
# Meshing of CAD models by gmsh
# --------------------------------------------------------------------------

def start_model(name):
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.clear()
    gmsh.model.add(name)
    for option, value in (
            ("General.NumThreads", 1),
            ("Mesh.RandomSeed", 1), ("Mesh.Algorithm", 6),
            ("Mesh.Smoothing", 10), ("Mesh.Optimize", 0),
            ("Mesh.MeshSizeExtendFromBoundary", 1),
            ("Mesh.MeshSizeFromPoints", 1),
            ("Mesh.MeshSizeFromCurvature", 0),
            ("Mesh.MeshSizeMin", 0.0), ("Mesh.MeshSizeMax", 1e22)):
        gmsh.option.setNumber(option, value)
    return gmsh.model.occ


def set_uniform_size(size):
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)


def set_size_near_curves(curves, near, far, distance, samples=200):
    """Size `near` on the curves, growing linearly to `far` at `distance`."""
    field = gmsh.model.mesh.field
    source = field.add("Distance")
    field.setNumbers(source, "EdgesList", curves)
    field.setNumber(source, "NNodesByEdge", samples)
    size = field.add("Threshold")
    field.setNumber(size, "InField", source)
    for key, value in (("SizeMin", near), ("SizeMax", far),
                       ("DistMin", 0.0), ("DistMax", distance)):
        field.setNumber(size, key, value)
    field.setAsBackgroundMesh(size)
    for option in ("MeshSizeExtendFromBoundary", "MeshSizeFromPoints"):
        gmsh.option.setNumber("Mesh." + option, 0)


def collect_mesh():
    """Vertices and facets of the boundary of the current model's solids."""
    owner_of, point_of = {}, {}
    for dim, tag in gmsh.model.getEntities():
        tags, coordinates, _ = gmsh.model.mesh.getNodes(dim, tag)
        for node, point in zip(tags, np.reshape(coordinates, (-1, 3))):
            owner_of[int(node)] = (dim, tag)
            point_of[int(node)] = point
    facets, patch = [], []
    # Surfaces from which solids were made may still be in the model.
    boundary = gmsh.model.getBoundary(gmsh.model.getEntities(3),
                                      combined=False, oriented=False)
    for _, tag in sorted(set(boundary)):
        _, corners = gmsh.model.mesh.getElementsByType(2, tag)
        rows = np.reshape(corners, (-1, 3)).astype(int)
        facets.append(rows)
        patch += [tag] * len(rows)
    used, flat = np.unique(np.concatenate(facets), return_inverse=True)
    return Mesh(np.array([point_of[n] for n in used.tolist()]),
                flat.reshape(-1, 3),
                [owner_of[n] for n in used.tolist()], patch)


def mesh_model():
    """Mesh the surfaces of the current model; the result is oriented."""
    gmsh.model.mesh.generate(2)
    mesh = orient(collect_mesh())

    def project(v, point):
        dim, tag = mesh.owner[v]
        if dim == 0:
            return None
        # The closest point of the whole carrier surface is fine: a vertex
        # which leaves its face would make a facet turn over.
        closest, _ = gmsh.model.getClosestPoint(dim, tag, point)
        return tuple(closest)

    return polish(mesh, project)


def select(dim, test):
    """Tags of entities whose bounding box passes test(low, high)."""
    tags = []
    for _, tag in gmsh.model.getEntities(dim):
        box = gmsh.model.getBoundingBox(dim, tag)
        if test(np.array(box[:3]), np.array(box[3:])):
            tags.append(tag)
    return tags


def merge(occ, first, others):
    return [tag for _, tag in occ.fuse([(3, first)],
                                       [(3, t) for t in others])[0]][0]


def carve(occ, body, tools):
    return [tag for _, tag in occ.cut([(3, body)],
                                      [(3, t) for t in tools])[0]][0]


# --------------------------------------------------------------------------
# The assets
# --------------------------------------------------------------------------

def bearing_cap(size):
    """Bearing cap of an engine, bore along z, parting plane y = 0."""
    occ = start_model("bearing_cap")
    depth, bore, outer, foot = 33.0, 28.5, 47.0, 68.0
    ring = occ.addCylinder(0, 0, 0, 0, 0, depth, outer)
    feet = occ.addBox(-foot, -1, 0, 2 * foot, 25, depth)
    body = merge(occ, ring, [feet])
    mid = 0.5 * depth
    tools = [occ.addBox(-100, -100, -1, 200, 100, depth + 2),
             occ.addCylinder(0, 0, -1, 0, 0, depth + 2, bore),
             # oil groove all around the bore, fed by the oil hole
             occ.addCylinder(0, 0, mid - 4.5, 0, 0, 9, bore + 3.3),
             occ.addCylinder(0, 0, mid, 0, 60, 0, 2.7)]
    tools += [occ.addCylinder(x, -5, mid, 0, 60, 0, 6)
              for x in (-0.5 * (foot + bore) - 6, 0.5 * (foot + bore) + 6)]
    carve(occ, body, tools)
    occ.synchronize()
    set_uniform_size(size)
    return mesh_model()


def bearing_cap_14k():
    return bearing_cap(1.96)


def bearing_cap_52k():
    return bearing_cap(0.993)


def cylinder():
    occ = start_model("cylinder")
    occ.addCylinder(0, 0, 0, 0, 0, 3, 1)
    occ.synchronize()
    set_uniform_size(0.0985)
    return mesh_model()


def cube():
    """The unit cube: all its sides lie exactly in coordinate planes."""
    occ = start_model("cube")
    occ.addBox(0, 0, 0, 1, 1, 1)
    occ.synchronize()
    set_uniform_size(0.056)
    return mesh_model()


def hollow_box():
    occ = start_model("hollow_box")
    carve(occ, occ.addBox(0, 0, 0, 4, 3, 2), [occ.addBox(1, 1, .5, 2, 1, 1)])
    occ.synchronize()
    set_uniform_size(0.2)
    return mesh_model()


def l_bracket():
    """Two legs of 100, 40 wide and 20 thick, whose inner edge is sharp."""
    occ = start_model("l_bracket")
    carve(occ, occ.addBox(0, 0, 0, 100, 20, 100),
          [occ.addBox(40, -1, 40, 61, 22, 61)])
    occ.synchronize()
    set_uniform_size(7.5)
    return mesh_model()


def pipe_with_holes():
    occ = start_model("pipe_with_holes")
    length, outer, inner = 60.0, 10.0, 7.0
    body = carve(occ, occ.addCylinder(0, 0, 0, 0, 0, length, outer),
                 [occ.addCylinder(0, 0, -1, 0, 0, length + 2, inner)])
    tools = []
    # No hole meets the seam of the cylinders (angle 0): it would be cut into
    # pieces much shorter than the facets.
    for z, radius, angles in ((10, 2.5, (45, 135, 225, 315)),
                              (24, 2.0, (90, 180, 270)),
                              (37, 3.0, (60, 180, 300)),
                              (50, 2.5, (45, 135, 225, 315))):
        for angle in np.radians(angles):
            tools.append(occ.addCylinder(0, 0, z, 15 * math.cos(angle),
                                         15 * math.sin(angle), 0, radius))
    carve(occ, body, tools)
    occ.synchronize()
    set_uniform_size(1.08)
    return mesh_model()


def naca_section(occ, chord, x0, y, count=24):
    """Wire of a symmetric NACA section, 12 % thick, blunt trailing edge."""
    def half_thickness(x):
        # The last term is changed so that the edge is 1.6 % of the chord
        # thick: a finer one would need very small facets.
        return 0.6 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x ** 2
                      + 0.2843 * x ** 3 - 0.0902 * x ** 4)

    stations = [0.5 * (1 - math.cos(math.pi * i / count))
                for i in range(count + 1)]
    rim = [occ.addPoint(x0 + chord * x, y, chord * half_thickness(x))
           for x in reversed(stations)]
    low = [occ.addPoint(x0 + chord * x, y, -chord * half_thickness(x))
           for x in stations[1:]]
    upper = occ.addSpline(rim)
    lower = occ.addSpline([rim[-1]] + low)
    edge = occ.addLine(low[-1], rim[0])
    return occ.addWire([upper, lower, edge])


def wing_in_box():
    """Flow domain around a tapered half wing on the side wall y = 0."""
    occ = start_model("wing_in_box")
    root = naca_section(occ, 1.0, 0.0, -0.2)
    tip = naca_section(occ, 0.6, 0.3, 1.5)
    wing = occ.addThruSections([root, tip], makeSolid=True, makeRuled=True)
    box = occ.addBox(-2, 0, -1.75, 5.5, 3, 3.5)
    carve(occ, box, [wing[0][1]])
    occ.synchronize()
    curves = select(1, lambda low, high: (low > (-1, -0.5, -1)).all()
                    and (high < (2, 2, 1)).all())
    set_size_near_curves(curves, 0.0135, 0.3, 2.2)
    return mesh_model()


def outline(occ, points, height):
    """Solid made by extrusion of a closed spline in the plane z = height."""
    tags = [occ.addPoint(x, y, height) for x, y in points]
    wire = occ.addWire([occ.addSpline(tags + tags[:1])])
    return occ.addPlaneSurface([wire])


def knee_tibial():
    """Tray of kidney shape with a rim, a stem and two fins (millimetres)."""
    occ = start_model("knee_tibial")
    kidney = [(0, 20), (16, 22), (29, 16), (35, 2), (31, -13), (20, -20),
              (9, -17), (0, -12), (-9, -17), (-20, -20), (-31, -13),
              (-35, 2), (-29, 16), (-16, 22)]
    plate = outline(occ, kidney, 0.0)
    tray = occ.extrude([(2, plate)], 0, 0, 6)[1][1]
    inner = [(0.93 * x, 0.90 * y) for x, y in kidney]
    recess = occ.extrude([(2, outline(occ, inner, 3.5))], 0, 0, 6)[1][1]
    stem = occ.addCone(0, 0, 1, 0, 0, -39, 7.5, 5.5)
    fins = []
    for sign in (-1, 1):
        corners = [occ.addPoint(*p) for p in (
            (0, -2, 1), (sign * 24, -2, 1), (sign * 24, -2, -3),
            (sign * 4, -2, -30), (0, -2, -30))]
        lines = [occ.addLine(corners[i], corners[(i + 1) % 5])
                 for i in range(5)]
        side = occ.addPlaneSurface([occ.addWire(lines)])
        fin = occ.extrude([(2, side)], 0, 4, 0)[1]
        occ.rotate([fin], 0, 0, 0, 0, 0, 1, -sign * math.radians(25))
        fins.append(fin[1])
    body = carve(occ, merge(occ, tray, [stem] + fins), [recess])
    occ.synchronize()
    tip = select(1, lambda low, high: high[2] < -37)
    occ.fillet([body], tip, [3.0])
    occ.synchronize()
    set_uniform_size(1.25)
    return mesh_model()


# Sagittal outline of the femoral component: articulating side (J curve) and
# the five box cuts on the side of the bone; x anterior, z proximal.
J_CURVE = [(-28.5, 28), (-31.5, 15), (-28.5, 2), (-20, -6.5), (-8, -9.8),
           (4, -9.8), (16, -6.5), (26, 2.5), (31, 15), (31, 29), (29, 42)]
BOX_CUTS = [(24.5, 42), (22, 8), (14, 0), (-14, 0), (-22, 8), (-23, 28)]


def femoral_groove(occ, radius, lift):
    """Tool for the patellar groove: a pipe along the J curve, lifted off."""
    path = []
    for k in range(5, len(J_CURVE)):
        x, z = J_CURVE[k]
        before, after = J_CURVE[k - 1], J_CURVE[min(k + 1, len(J_CURVE) - 1)]
        tx, tz = _unit((after[0] - before[0], after[1] - before[1], 0.0))[:2]
        path.append((x + lift * tz, z - lift * tx))
    # straight on past the proximal edge
    (x0, z0), (x1, z1) = path[-2:]
    path.append((x1 + 0.7 * (x1 - x0), z1 + 0.7 * (z1 - z0)))
    spline = occ.addSpline([occ.addPoint(x, 0, z) for x, z in path])
    disk = occ.addDisk(path[0][0], 0, path[0][1], radius, radius)
    # the disk has to stand across the path
    occ.rotate([(2, disk)], path[0][0], 0, path[0][1], 0, 1, 0, math.pi / 2)
    return occ.addPipe([(2, disk)], occ.addWire([spline]))[0][1]


def knee_femoral():
    """Femoral component: J-shaped shell, two condyles, notch and pegs."""
    occ = start_model("knee_femoral")
    half = 31.0
    curve = [occ.addPoint(x, -half, z) for x, z in J_CURVE]
    cuts = [occ.addPoint(x, -half, z) for x, z in BOX_CUTS]
    lines = [occ.addSpline(curve)]
    chain = [curve[-1]] + cuts + [curve[0]]
    lines += [occ.addLine(p, q) for p, q in zip(chain, chain[1:])]
    side = occ.addPlaneSurface([occ.addWire(lines)])
    body = occ.extrude([(2, side)], 0, 2 * half, 0)[1][1]
    occ.synchronize()
    # round the corners of the flange and of the condyles as seen from front
    flange = select(1, lambda low, high: low[2] > 41 and high[1] - low[1] < 1)
    condyle = select(1, lambda low, high: low[2] > 27 and high[2] < 29
                     and high[1] - low[1] < 1)
    body = occ.fillet([body], flange + condyle,
                      [14.0] * len(flange) + [6.0] * len(condyle))[0][1]
    occ.synchronize()
    rims = select(1, lambda low, high: low[2] < -9)
    body = occ.fillet([body], rims, [3.0])[0][1]
    notch = [occ.addBox(-50, -9, -30, 52, 18, 80),
             occ.addCylinder(2, 0, -30, 0, 0, 60, 9)]
    body = carve(occ, body, notch + [femoral_groove(occ, 12.0, 8.5)])
    pegs = [occ.addCylinder(0, y, -2, 0, 0, 16, 3.2) for y in (-20, 20)]
    body = merge(occ, body, pegs)
    occ.synchronize()
    ends = select(1, lambda low, high: 13 < low[2] and high[2] < 15
                  and abs(low[0] + high[0]) < 0.1)
    occ.fillet([body], ends, [1.2])
    occ.synchronize()
    set_uniform_size(1.66)
    return mesh_model()


# --------------------------------------------------------------------------
# Porous packing from an implicit function
# --------------------------------------------------------------------------

class Packing:
    """Smooth union of spheres: negative inside, necks between neighbours."""

    def __init__(self):
        # RandomState: its stream of numbers is the same in all versions.
        # The seed is one for which no two spheres nearly touch and no window
        # between four spheres is nearly closed: facets of this size could
        # not resolve these, and the surface would intersect itself.
        random = np.random.RandomState(69)
        lattice = np.stack(np.meshgrid(range(3), range(3), range(4),
                                       indexing="ij"), axis=-1).reshape(-1, 3)
        self.centres = 1.74 * lattice + random.uniform(-.07, .07,
                                                       lattice.shape)
        self.radii = random.uniform(0.95, 1.05, len(lattice))
        self.blend = 0.06

    def evaluate(self, points):
        """Values and gradients."""
        offset = points[:, None, :] - self.centres[None]
        length = np.linalg.norm(offset, axis=2)
        distance = length - self.radii
        nearest = distance.min(axis=1, keepdims=True)
        weight = np.exp((nearest - distance) / self.blend)
        total = weight.sum(axis=1, keepdims=True)
        value = nearest - self.blend * np.log(total)
        gradient = ((weight / total)[:, :, None]
                    * offset / length[:, :, None]).sum(axis=1)
        return value[:, 0], gradient

    def project(self, points, steps=4):
        for _ in range(steps):
            value, gradient = self.evaluate(points)
            square = (gradient * gradient).sum(axis=1)
            points = points - (value / square)[:, None] * gradient
        return points

    def contour(self, spacing):
        """First triangulation, by a lookup on a grid."""
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        low = (self.centres - self.radii[:, None]).min(axis=0) - 3 * spacing
        high = (self.centres + self.radii[:, None]).max(axis=0) + 3 * spacing
        count = np.ceil((high - low) / spacing).astype(int) + 1
        axes = [low[k] + spacing * np.arange(count[k]) for k in range(3)]
        z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
        points = np.stack([x, y, z], axis=-1).reshape(-1, 3)
        values = np.concatenate([self.evaluate(part)[0] for part
                                 in np.array_split(points, 50)])
        image = vtk.vtkImageData()
        image.SetDimensions(*count.tolist())
        image.SetSpacing(spacing, spacing, spacing)
        image.SetOrigin(*low.tolist())
        image.GetPointData().SetScalars(numpy_to_vtk(values, deep=1))
        contour = vtk.vtkFlyingEdges3D()
        contour.SetInputData(image)
        contour.SetValue(0, 0.0)
        contour.ComputeNormalsOff()
        contour.Update()
        output = contour.GetOutput()
        vertices = vtk_to_numpy(output.GetPoints().GetData()).astype(float)
        facets = vtk_to_numpy(output.GetPolys().GetConnectivityArray())
        facets = facets.reshape(-1, 3).astype(int)
        return Mesh(vertices, facets, [(2, 1)] * len(vertices),
                    [1] * len(facets))


def isotropic_remesh(mesh, length, project, rounds=10):
    """Split, collapse and flip edges and smooth until all are about equal."""
    for _ in range(rounds):
        surface = Surface(mesh)
        for u, v in surface.edges():
            if surface.length(u, v) > 4 / 3 * length:
                surface.split(u, v, (2, 1))
        collapse_all(surface, length)
        equalise_valences(surface)
        mesh = smooth(surface.mesh(), project)
    return mesh


def collapse_all(surface, length):
    def short(*corners):
        return max(math.dist(corners[k], corners[k - 1])
                   for k in range(3)) < 4 / 3 * length

    for u, v in surface.edges():
        alive = surface.ring[u] & surface.ring[v]
        if alive and surface.length(u, v) < 4 / 5 * length \
                and surface.can_collapse(u, v, short):
            surface.collapse(u, v)


def equalise_valences(surface):
    for u, v in surface.edges():
        def better(c, d, _f, _g):
            now = [len(surface.ring[w]) - 6 for w in (u, v, c, d)]
            new = [now[0] - 1, now[1] - 1, now[2] + 1, now[3] + 1]
            return sum(n * n for n in new) < sum(n * n for n in now)
        surface.flip(u, v, better)


def smooth(mesh, project):
    """Tangential move to the mean of the neighbours, back to the surface."""
    vertices, facets = mesh.vertices, mesh.facets
    total = np.zeros_like(vertices)
    degree = np.zeros(len(vertices))
    normal = np.zeros_like(vertices)
    vectors = area_vectors(vertices, facets)
    for k in range(3):
        np.add.at(total, facets[:, k], vertices[facets[:, (k + 1) % 3]])
        np.add.at(degree, facets[:, k], 1.0)
        np.add.at(normal, facets[:, k], vectors)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    move = total / degree[:, None] - vertices
    move -= (move * normal).sum(axis=1, keepdims=True) * normal
    return mesh._replace(vertices=project(vertices + move))


def sinter_packing():
    """Sintered spheres on a jittered lattice: a porous volume element."""
    packing = Packing()
    mesh = packing.contour(0.12)
    mesh = mesh._replace(vertices=packing.project(mesh.vertices))
    mesh = isotropic_remesh(mesh, 0.155, packing.project)

    def project(_v, point):
        return tuple(packing.project(np.array([point]), 3)[0])

    return orient(polish(orient(mesh), project))


# --------------------------------------------------------------------------
# Check and output
# --------------------------------------------------------------------------

# name: (function, shells, smallest and largest number of facets)
ASSETS = {
    "bearing_cap_14k": (bearing_cap_14k, 1, 13500, 14500),
    "bearing_cap_52k": (bearing_cap_52k, 1, 50000, 54000),
    "cylinder": (cylinder, 1, 5500, 6500),
    "cube": (cube, 1, 4500, 5500),
    "knee_femoral": (knee_femoral, 1, 10000, 16000),
    "knee_tibial": (knee_tibial, 1, 10000, 16000),
    "pipe_with_holes": (pipe_with_holes, 1, 12000, 16000),
    "wing_in_box": (wing_in_box, 1, 14000, 20000),
    "sinter_packing": (sinter_packing, 1, 25000, 35000),
    "hollow_box": (hollow_box, 2, 3000, 5000),
    "l_bracket": (l_bracket, 1, 500, 1500),
}


def rounded(mesh):
    """Remove the noise of CAD projections: planes become exactly plane.

    Six decimals are about single precision; + 0.0 turns -0.0 into 0.0, which
    readers that weld by bits tell apart.
    """
    return mesh._replace(vertices=np.round(mesh.vertices, 6) + 0.0)


def check(name, mesh):
    """Assert what the readers of the file rely on; print the measures."""
    _, shells, fewest, most = ASSETS[name]
    # Judge the surface as it is in the file, in single precision.
    vertices = mesh.vertices.astype(np.float32)
    assert len(np.unique(vertices, axis=0)) == len(vertices), \
        "distinct vertices became equal in single precision"
    assert len(np.unique(mesh.facets)) == len(vertices), "unused vertex"
    vertices = vertices.astype(float)
    directed = np.concatenate([mesh.facets[:, [0, 1]], mesh.facets[:, [1, 2]],
                               mesh.facets[:, [2, 0]]])
    assert len(np.unique(directed, axis=0)) == len(directed), \
        "two facets use an edge in the same direction"
    assert {tuple(e) for e in directed.tolist()} \
        == {(v, u) for u, v in directed.tolist()}, "open edge"
    _, shell = flood_shells(mesh.facets)
    volumes = sorted((signed_volume(vertices, mesh.facets[shell == s])
                      for s in range(shell.max() + 1)), reverse=True)
    assert len(volumes) == shells, "%d shells" % len(volumes)
    assert volumes[0] > 0.0 and all(v < 0.0 for v in volumes[1:]), volumes
    angles = facet_angles(vertices, mesh.facets)
    area = np.linalg.norm(area_vectors(vertices, mesh.facets), axis=1).sum()
    ends = vertices[directed]
    edge = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
    genus = shells - (len(vertices) - len(mesh.facets) // 2) / 2
    print("%-16s facets %6d  shells %d  genus %2d  min angle %5.2f  mean min"
          " angle %5.2f  edge %.4g  area %.6g  volume %.6g" % (
              name, len(mesh.facets), shells, genus, angles.min(),
              angles.min(axis=1).mean(), edge, area, sum(volumes)), flush=True)
    assert fewest <= len(mesh.facets) <= most, "%d facets" % len(mesh.facets)
    assert angles.min() > 25.0, "badly shaped facet"


def write_stl(name, mesh, directory):
    """Binary STL; the same mesh always gives the same bytes."""
    # The header must not begin with "solid": readers take this for text.
    header = ("kerf " + name).encode("ascii").ljust(80, b"\0")
    record = np.zeros(len(mesh.facets), dtype=[
        ("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
    normal = area_vectors(mesh.vertices, mesh.facets)
    record["normal"] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    record["corners"] = mesh.vertices.astype(np.float32)[mesh.facets]
    with open(os.path.join(directory, name + ".stl"), "wb") as stream:
        stream.write(header)
        stream.write(np.uint32(len(mesh.facets)).astype("<u4").tobytes())
        stream.write(record.tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="assets to make (default: all)")
    parser.add_argument("--out", default=os.path.dirname(
        os.path.abspath(__file__)), metavar="DIR",
        help="directory of the results (default: that of this script)")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(ASSETS)
    if unknown:
        parser.error("unknown: " + " ".join(sorted(unknown)))
    gmsh.initialize()
    for name in arguments.names or ASSETS:
        start = time.perf_counter()
        mesh = rounded(ASSETS[name][0]())
        check(name, mesh)
        write_stl(name, mesh, arguments.out)
        print("%-16s %.1f s" % ("", time.perf_counter() - start), flush=True)
    gmsh.finalize()
    return 0


if __name__ == "__main__":
    sys.exit(main())
