// Two vectors at once, for formulas that treat both alike.
//
// Processors of 64 bits add, multiply and divide two doubles as fast as one. The result is the same on every machine,
// and the same as for each vector alone.
#pragma once

#include "base/core/types.h"

namespace kerf {

/// Two numbers; operators act on each.
using Pair = double __attribute__((vector_size(16)));

inline Pair both(double x) { return Pair{x, x}; }
inline Pair swapped(Pair p) { return __builtin_shufflevector(p, p, 1, 0); }
/// Returns the first numbers of p and q.
inline Pair firsts(Pair p, Pair q) { return __builtin_shufflevector(p, q, 0, 2); }
/// Returns the second numbers of p and q.
inline Pair seconds(Pair p, Pair q) { return __builtin_shufflevector(p, q, 1, 3); }
inline Pair absolute(Pair p) { return p < 0 ? -p : p; }
/// Returns the smaller number at each place; that of p if that of q is not a number.
inline Pair smallest(Pair p, Pair q) { return q < p ? q : p; }
inline Pair largest(Pair p, Pair q) { return p < q ? q : p; }
inline double smallest_of(Pair p) { return p[1] < p[0] ? p[1] : p[0]; }
inline double largest_of(Pair p) { return p[0] < p[1] ? p[1] : p[0]; }

/// Two vectors; operators and functions act on each.
struct VectorPair {
    Pair x, y, z;

    VectorPair(Pair xs, Pair ys, Pair zs) : x(xs), y(ys), z(zs) {}
    VectorPair(const Vec3& p, const Vec3& q) : x{p[0], q[0]}, y{p[1], q[1]}, z{p[2], q[2]} {}

    VectorPair operator+(const VectorPair& o) const { return {x + o.x, y + o.y, z + o.z}; }
    VectorPair operator-(const VectorPair& o) const { return {x - o.x, y - o.y, z - o.z}; }
    VectorPair cross(const VectorPair& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
    Pair dot(const VectorPair& o) const { return x * o.x + y * o.y + z * o.z; }
    Pair squared_norm() const { return dot(*this); }
};

inline VectorPair operator*(Pair s, const VectorPair& p) { return {s * p.x, s * p.y, s * p.z}; }
inline VectorPair swapped(const VectorPair& p) { return {swapped(p.x), swapped(p.y), swapped(p.z)}; }
inline VectorPair firsts(const VectorPair& p, const VectorPair& q) {
    return {firsts(p.x, q.x), firsts(p.y, q.y), firsts(p.z, q.z)};
}
inline VectorPair seconds(const VectorPair& p, const VectorPair& q) {
    return {seconds(p.x, q.x), seconds(p.y, q.y), seconds(p.z, q.z)};
}

}  // namespace kerf
