#include "surface/wrap/inside/alpha_wrap.h"

#include <array>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "base/core/cancellation.h"
#include "base/core/ids.h"

namespace kerf {

namespace {

using WrapKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using WrapMesh = CGAL::Surface_mesh<WrapKernel::Point_3>;
using WrapOracle = CGAL::Alpha_wraps_3::internal::Triangle_soup_oracle<WrapKernel>;
using WrapBuilder = CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<WrapOracle>;

/// Asks whether the work is still wanted.
class WrapVisitor : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor {
 public:
    explicit WrapVisitor(const std::function<void()>& check_cancelled) : check_cancelled_(check_cancelled) {}

    template <class Wrapper, class Gate>
    void before_facet_treatment(const Wrapper& /*wrapper*/, const Gate& /*gate*/) {
        constexpr std::size_t some = 64;  // gates take long
        check_cancelled_.at(some * step_++);
    }

 private:
    CancellationCheck check_cancelled_;
    std::size_t step_ = 0;
};

}  // namespace

TriangleSet alpha_wrap(const TriangleSet& input, double radius, double offset,
                       const std::function<void()>& check_cancelled) {
    std::vector<WrapKernel::Point_3> points;
    points.reserve(input.vertices.size());
    for (const Vec3& p : input.vertices) points.emplace_back(p.x(), p.y(), p.z());
    const std::vector<Triangle>& facets = input.facets;

    WrapOracle oracle(radius, WrapKernel());
    oracle.add_triangle_soup(points, facets, CGAL::parameters::default_values());
    WrapBuilder builder(oracle);
    WrapMesh mesh;
    WrapVisitor visitor(check_cancelled);
    builder(radius, offset, mesh, CGAL::parameters::visitor(std::ref(visitor)));

    TriangleSet wrap;
    wrap.vertices.reserve(mesh.number_of_vertices());
    wrap.facets.reserve(mesh.number_of_faces());
    std::vector<std::int32_t> number(mesh.num_vertices(), -1);
    for (const auto v : mesh.vertices()) {
        number[v] = count_of(wrap.vertices);
        const WrapKernel::Point_3& p = mesh.point(v);
        wrap.vertices.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto f : mesh.faces()) {
        Triangle corners{};
        int i = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[i++] = number[v];
        wrap.facets.push_back(corners);
    }
    return wrap;
}

}  // namespace kerf
