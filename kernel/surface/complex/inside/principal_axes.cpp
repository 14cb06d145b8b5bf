#include "surface/complex/inside/principal_axes.h"

#include <cmath>

#include <Eigen/Geometry>

#include "base/geometry/symmetric_axes.h"

namespace kerf {

namespace {

constexpr double tie = 1e-3;  // relative difference of moments, and angle in rad, that count as equal

void make_largest_component_positive(Eigen::Ref<Vec3> axis) {
    Eigen::Index largest = 0;
    axis.cwiseAbs().maxCoeff(&largest);
    if (axis[largest] < 0) axis = -axis;
}

// Replaces the basis of an eigenspace (columns first .. first + dimension - 1) by the projections of the coordinate
// axes that lie closest to it, made orthogonal in the order x, y, z.
void align_eigenspace(Eigen::Matrix3d& axes, int first, int dimension) {
    const Eigen::MatrixXd space = axes.middleCols(first, dimension);
    int found = 0;
    for (int pass = 0; pass < 2 && found < dimension; ++pass)
        for (int i = 0; i < 3 && found < dimension; ++i) {
            const Vec3 unit = Vec3::Unit(i);
            Vec3 projected = space * (space.transpose() * unit);
            for (int j = 0; j < found; ++j) projected -= projected.dot(axes.col(first + j)) * axes.col(first + j);
            const double least = pass == 0 ? 1 - tie : tie;  // first those in the space, then whatever spans the rest
            if (projected.norm() < least) continue;
            axes.col(first + found++) = projected.normalized();
        }
}

void break_ties(const Vec3& moments, Eigen::Matrix3d& axes) {
    const double scale = moments[2] > 0 ? moments[2] : 1;
    for (int first = 0; first < 3;) {
        int end = first + 1;
        while (end < 3 && moments[end] - moments[first] <= tie * scale) ++end;
        if (end - first > 1) align_eigenspace(axes, first, end - first);
        first = end;
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            if (axes.col(i).cross(Vec3::Unit(j)).norm() < tie) axes.col(i) = Vec3::Unit(j);
        make_largest_component_positive(axes.col(i));
    }
}

}  // namespace

PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia) {
    const SymmetricAxes axes = symmetric_axes(inertia);
    PrincipalAxes principal{axes.values, axes.vectors};
    break_ties(principal.moments, principal.axes);
    return principal;
}

}  // namespace kerf
