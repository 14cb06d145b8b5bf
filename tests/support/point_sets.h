// Points to triangulate, and what holds of every triangulation.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "base/core/types.h"

namespace kerf {
class SpatialTriangulation;
}

namespace kerf::test {

struct PointSet {
    std::string name;
    std::vector<Vec3> points;
};

/// In the unit cube; equal for equal states of `random`.
std::vector<Vec3> random_points(std::mt19937& random, std::size_t count);
/// Corners of n^3 cubes of this edge, and their centres if `is_centred`.
std::vector<Vec3> lattice(int n, double edge, bool is_centred);
/// Points in general and in every special position: lattices, spheres, planes, lines, duplicates, all scales. Those
/// whose name begins with "flat" have no cells.
std::vector<PointSet> point_sets();

/// The four points of each cell that is no ghost, sorted: equal lists are equal sets of cells.
using CellPoints = std::array<std::array<double, 3>, 4>;
std::vector<CellPoints> sorted_cells(const SpatialTriangulation& triangulation);
CellPoints sorted_corners(const std::array<Vec3, 4>& corners);

/// Expects cells of positive orientation, ghosts outside of them alone, symmetric links between cells that share a
/// face, and a cell at every vertex that has one.
void expect_valid(const SpatialTriangulation& triangulation);
/// Expects empty spheres, by predicates of others, and a convex hull.
void expect_delaunay(const SpatialTriangulation& triangulation);

}  // namespace kerf::test
