// The function that is minimised is f(x) = |s(x) - p|^2 / 2 over a box of parameters x, s the surface or curve. Its
// Hessian is the metric, s_i . s_j, plus off . s_ij with off = s(x) - p; the second term makes it indefinite far from
// the minimum, and then the metric alone is used, which always goes down (Gauss and Newton's step). A parameter at a
// bound whose gradient points outwards is held for the step. Steps are halved until the value falls. The start decides
// which minimum is found: callers take it from the nearest facet. Formulas of elementary surfaces need no start.
#include "files/cad/inside/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <ElSLib.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>
#include <gp_Torus.hxx>

namespace kerf::cad {

namespace {

constexpr int most_newton_steps = 30;
constexpr int most_halvings = 12;
constexpr double newton_precision = 1e-14;  // of a step, as a share of the range of parameters

Vec3 vector_of(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
Vec3 vector_of(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }

// Returns the nearest point of a surface that has a formula for the parameters of a point.
template <class Elementary>
Vec3 nearest_on(const Elementary& surface, const Vec3& p) {
    double u = 0, v = 0;
    ElSLib::Parameters(surface, gp_Pnt(p.x(), p.y(), p.z()), u, v);
    return vector_of(ElSLib::Value(u, v, surface));
}

// Minimises half the squared distance to p over a box of parameters by Newton's steps. `evaluate(x)` returns value,
// gradient and Hessian; steps must go down, and end at the bounds of the box that they would cross.
template <int n, class Evaluate>
Eigen::Matrix<double, n, 1> minimise(Eigen::Matrix<double, n, 1> x, const Eigen::Matrix<double, n, 1>& low,
                                     const Eigen::Matrix<double, n, 1>& high, const Evaluate& evaluate) {
    using Vector = Eigen::Matrix<double, n, 1>;
    x = x.cwiseMax(low).cwiseMin(high);
    auto now = evaluate(x);
    for (int step = 0; step < most_newton_steps; ++step) {
        auto hessian = now.hessian;
        Vector gradient = now.gradient;
        for (int i = 0; i < n; ++i) {
            const bool leaves = (x[i] <= low[i] && gradient[i] > 0) || (x[i] >= high[i] && gradient[i] < 0);
            if (!leaves) continue;
            hessian.row(i).setZero();
            hessian.col(i).setZero();
            hessian(i, i) = 1;
            gradient[i] = 0;
        }
        if (Eigen::LLT<decltype(hessian)>(hessian).info() != Eigen::Success) {
            // Away from the bottom of the valley the Hessian is replaced by its part without curvature, damped where
            // parameters are degenerate.
            hessian = now.metric;
            hessian.diagonal().array() += 1e-9 * now.metric.trace() + std::numeric_limits<double>::min();
        }
        Vector move = -Eigen::LLT<decltype(hessian)>(hessian).solve(gradient);
        bool is_better = false;
        for (int halving = 0; halving < most_halvings && !is_better; ++halving, move /= 2) {
            const Vector next = (x + move).cwiseMax(low).cwiseMin(high);
            if ((next - x).norm() <= newton_precision * (high - low).norm()) return x;
            const auto there = evaluate(next);
            is_better = there.value < now.value;
            if (!is_better) continue;
            x = next;
            now = there;
        }
        if (!is_better) break;
    }
    return x;
}

template <int n>
struct SquaredDistance {
    double value;
    Eigen::Matrix<double, n, 1> gradient;
    Eigen::Matrix<double, n, n> hessian, metric;
};

// Bounds a parameter, which may be endless.
double bounded(double t) { return std::clamp(t, -1e100, 1e100); }

}  // namespace

Vec3 NearestOnFace::find(const Vec3& p, double u, double v) const {
    switch (surface_.GetType()) {
        case GeomAbs_Plane:
            return nearest_on(surface_.Plane(), p);
        case GeomAbs_Cylinder:
            return nearest_on(surface_.Cylinder(), p);
        case GeomAbs_Cone:
            return nearest_on(surface_.Cone(), p);
        case GeomAbs_Sphere:
            return nearest_on(surface_.Sphere(), p);
        case GeomAbs_Torus:
            return nearest_on(surface_.Torus(), p);
        default:
            return iterate(p, u, v);
    }
}

Vec3 NearestOnFace::iterate(const Vec3& p, double u, double v) const {
    const Vec2 low(bounded(surface_.FirstUParameter()), bounded(surface_.FirstVParameter()));
    const Vec2 high(bounded(surface_.LastUParameter()), bounded(surface_.LastVParameter()));
    const Vec2 found = minimise<2>(Vec2(u, v), low, high, [&](const Vec2& x) {
        gp_Pnt point;
        gp_Vec du, dv, duu, dvv, duv;
        surface_.D2(x[0], x[1], point, du, dv, duu, dvv, duv);
        const Vec3 off = vector_of(point) - p, a = vector_of(du), b = vector_of(dv);
        SquaredDistance<2> d;
        d.value = off.squaredNorm() / 2;
        d.gradient = Vec2(off.dot(a), off.dot(b));
        d.metric << a.dot(a), a.dot(b), a.dot(b), b.dot(b);
        const double uv = off.dot(vector_of(duv));
        d.hessian = d.metric;
        d.hessian(0, 0) += off.dot(vector_of(duu));
        d.hessian(1, 1) += off.dot(vector_of(dvv));
        d.hessian(0, 1) += uv;
        d.hessian(1, 0) += uv;
        return d;
    });
    return vector_of(surface_.Value(found[0], found[1]));
}

Vec3 NearestOnEdge::at(double t) const { return vector_of(curve_.Value(t)); }

Vec3 NearestOnEdge::find(const Vec3& p, double t) const {
    using Number = Eigen::Matrix<double, 1, 1>;
    const Number found = minimise<1>(Number(t), Number(first()), Number(last()), [&](const Number& x) {
        gp_Pnt point;
        gp_Vec d1, d2;
        curve_.D2(x[0], point, d1, d2);
        const Vec3 off = vector_of(point) - p, along = vector_of(d1);
        SquaredDistance<1> d;
        d.value = off.squaredNorm() / 2;
        d.gradient = Number(off.dot(along));
        d.metric = Number(along.dot(along));
        d.hessian = Number(along.dot(along) + off.dot(vector_of(d2)));
        return d;
    });
    return at(found[0]);
}

}  // namespace kerf::cad
