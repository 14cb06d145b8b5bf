#include "support/edge_flips.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "support/facet_height.h"

namespace kerf::test {

namespace {

class EdgeFlips {
 public:
    EdgeFlips(Soup& soup, SeededNumbers& random) : soup_(soup), random_(random) {
        for (std::size_t f = 0; f < soup.facets.size(); ++f) enter(f);
    }
    void flip(int tries) {
        for (int k = 0; k < tries; ++k) {
            const std::size_t facet = random_.bits() % soup_.facets.size();
            flip_edge(facet, random_.integer(0, 2));
        }
    }

 private:
    void enter(std::size_t f) {
        const Triangle& t = soup_.facets[f];
        for (int i = 0; i < 3; ++i) facet_at_[{t[i], t[(i + 1) % 3]}] = f;
    }
    Vec3 normal(const Triangle& t) const {
        const auto& p = soup_.vertices;
        return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    }
    void flip_edge(std::size_t f, int i) {
        const Triangle t = soup_.facets[f];
        const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        const std::size_t g = facet_at_.at({b, a});
        const Triangle other = soup_.facets[g];
        const std::int32_t d = *std::find_if(other.begin(), other.end(), [&](auto v) { return v != a && v != b; });
        if (facet_at_.count({c, d}) || facet_at_.count({d, c})) return;
        const Triangle first = {a, d, c}, second = {d, b, c};
        const Vec3 mean = normal(t) + normal(other);
        const double least = 0.9 * mean.norm();
        if (!(normal(first).dot(mean) > least) || !(normal(second).dot(mean) > least)) return;
        constexpr double least_height = 1e-3;
        if (std::min(relative_height(soup_.vertices, first), relative_height(soup_.vertices, second)) < least_height)
            return;
        facet_at_.erase({a, b});
        facet_at_.erase({b, a});
        soup_.facets[f] = first;
        soup_.facets[g] = second;
        enter(f);
        enter(g);
    }

    Soup& soup_;
    SeededNumbers& random_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> facet_at_;
};

}  // namespace

Soup with_flips(Soup soup, double share, SeededNumbers& random) {
    EdgeFlips(soup, random).flip(static_cast<int>(share * static_cast<double>(soup.facets.size())));
    return soup;
}

}  // namespace kerf::test
