#include "remesh/inspection.h"

#include "surface/intersections.h"
#include "surface/nearness.h"

namespace kerf {

namespace {

constexpr double first_bound = 0.2, step_of_bound = 1.25;  // of the deviation; of the one before
constexpr int most_divisions_of_inspection = 100'000;      // of a facet, to see that it is near the other surface

class Inspection {
 public:
    Inspection(const SurfaceArrays& input, const TriangleTree& input_tree, const RemeshOptions& options)
        : input_(input),
          input_tree_(input_tree),
          deviation_(options.deviation),
          poll_(options.poll),
          refused_(input.facets.size(), 0) {}

    std::vector<char> run(const SurfaceArrays& result, RemeshReport& report) {
        for (const auto& [f, g] : find_self_intersections(result.vertices, result.facets))
            for (const std::int32_t facet : {f, g}) refuse_around(result, facet);
        Side to_input{Nearness(input_tree_, input_.facets), first_bound * deviation_};
        for (const Triangle& t : result.facets)
            if (!is_near(result.vertices, t, to_input))
                for_each_sample(result.vertices, t, [&](const Vec3& p) { refused_[input_tree_.closest(p).facet] = 1; });
        const TriangleTree tree(result.vertices, result.facets);
        Side from_input{Nearness(tree, result.facets), first_bound * deviation_};
        for (std::size_t f = 0; f < input_.facets.size(); ++f)
            if (!is_near(input_.vertices, input_.facets[f], from_input)) refused_[f] = 1;
        report.distance_to_input = to_input.nearness.directed_distance();
        report.distance_from_input = from_input.nearness.directed_distance();
        return std::move(refused_);
    }

 private:
    // One of the surfaces, and what the facets of the other are known to be near.
    struct Side {
        Nearness nearness;
        double bound;            // that does for all so far
        std::int32_t last = -1;  // facet of this side that the last one is near
    };

    bool is_near(const std::vector<Vec3>& vertices, const Triangle& t, Side& side) const {
        if (poll_) poll_();
        const auto holds = [&] {
            return side.nearness.holds(
                {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, side.bound, [&](std::int32_t) { return side.bound; },
                most_divisions_of_inspection, side.last);
        };
        for (; !holds(); side.bound = std::min(deviation_, step_of_bound * side.bound))
            if (side.bound == deviation_) return false;
        return true;
    }
    void refuse_around(const SurfaceArrays& result, std::int32_t facet) {
        for_each_sample(result.vertices, result.facets[facet], [&](const Vec3& p) {
            input_tree_.any_within(p, deviation_, [&](std::int32_t near, double) {
                refused_[near] = 1;
                return false;
            });
        });
    }

    const SurfaceArrays& input_;
    const TriangleTree& input_tree_;
    double deviation_;
    const std::function<void()>& poll_;
    std::vector<char> refused_;
};

}  // namespace

std::vector<char> inspect(const SurfaceArrays& input, const TriangleTree& tree, const RemeshOptions& options,
                          const SurfaceArrays& result, RemeshReport& report) {
    return Inspection(input, tree, options).run(result, report);
}

}  // namespace kerf
