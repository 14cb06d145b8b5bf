// Points in tetrahedra and triangles whose weighted values add up to integrals.
#pragma once

#include <array>

namespace kerf {

/// A place as weights of the corners, which add up to 1.
using Barycentric = std::array<double, 4>;
using BarycentricOfTriangle = std::array<double, 3>;

/// A point of a rule. Weights add up to 1: the sum of weighted values is the mean.
template <class Place>
struct WeightedPlace {
    Place place;
    double weight;
};
using TetPoint = WeightedPlace<Barycentric>;
using TrianglePoint = WeightedPlace<BarycentricOfTriangle>;

namespace quadrature {

inline constexpr double inner = 0.13819660112501051518, outer = 1 - 3 * inner;

/// The rule for integrands that are constant.
inline constexpr std::array<TetPoint, 1> one_point = {{{{outer, inner, inner, inner}, 1}}};

/// A rule that is exact for polynomials of degree 2.
inline constexpr std::array<TetPoint, 4> four_points = {{{{outer, inner, inner, inner}, 0.25},
                                                         {{inner, outer, inner, inner}, 0.25},
                                                         {{inner, inner, outer, inner}, 0.25},
                                                         {{inner, inner, inner, outer}, 0.25}}};

namespace of_fourteen {
inline constexpr double a = 0.31088591926330060980, a4 = 1 - 3 * a, a_weight = 0.11268792571801585080;
inline constexpr double b = 0.092735250310891226402, b4 = 1 - 3 * b, b_weight = 0.073493043116361949544;
inline constexpr double c = 0.045503704125649649492, c2 = 0.5 - c, c_weight = 0.042546020777081466438;
}  // namespace of_fourteen

/// A rule that is exact for polynomials of degree 5; all points are inside, with positive weights (walkington2000).
inline constexpr std::array<TetPoint, 14> fourteen_points = [] {
    using namespace of_fourteen;
    return std::array<TetPoint, 14>{{{{a4, a, a, a}, a_weight},
                                     {{a, a4, a, a}, a_weight},
                                     {{a, a, a4, a}, a_weight},
                                     {{a, a, a, a4}, a_weight},
                                     {{b4, b, b, b}, b_weight},
                                     {{b, b4, b, b}, b_weight},
                                     {{b, b, b4, b}, b_weight},
                                     {{b, b, b, b4}, b_weight},
                                     {{c, c, c2, c2}, c_weight},
                                     {{c, c2, c, c2}, c_weight},
                                     {{c, c2, c2, c}, c_weight},
                                     {{c2, c, c, c2}, c_weight},
                                     {{c2, c, c2, c}, c_weight},
                                     {{c2, c2, c, c}, c_weight}}};
}();

namespace of_six {
inline constexpr double a = 0.44594849091596488632, a3 = 1 - 2 * a, a_weight = 0.22338158967801146570;
inline constexpr double b = 0.091576213509770743460, b3 = 1 - 2 * b, b_weight = 0.10995174365532186764;
}  // namespace of_six

/// A rule that is exact for polynomials of degree 4 on a triangle (dunavant1985).
inline constexpr std::array<TrianglePoint, 6> six_points = [] {
    using namespace of_six;
    return std::array<TrianglePoint, 6>{{{{a3, a, a}, a_weight},
                                         {{a, a3, a}, a_weight},
                                         {{a, a, a3}, a_weight},
                                         {{b3, b, b}, b_weight},
                                         {{b, b3, b}, b_weight},
                                         {{b, b, b3}, b_weight}}};
}();

}  // namespace quadrature

}  // namespace kerf
