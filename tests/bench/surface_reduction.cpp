#include "bench/surface_reduction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "support/facet_height.h"
#include "support/shapes.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/diagnosis/orientation.h"

namespace kerf::bench {

namespace {

bool is_valid(const Soup& soup) {
    const Diagnosis diagnosis = diagnose(soup);
    return std::all_of(diagnosis.defects.begin(), diagnosis.defects.end(),
                       [](const Defect& defect) { return defect.severity == Severity::warning; });
}

constexpr double usual_height = 1e-2;  // of facets, over their longest edges

class Reduction {
 public:
    Reduction(Soup soup, const std::function<bool(const SurfaceArrays&)>& is_wanted)
        : soup_(std::move(soup)),
          is_wanted_(is_wanted),
          least_height_(std::min(usual_height, test::least_relative_height(soup_.vertices, soup_.facets))) {}

    Soup run() {
        while (leave_out_a_shell()) {
        }
        while (collapse_some()) {
        }
        round_coordinates();
        return std::move(soup_);
    }

 private:
    bool accept(Soup candidate) {
        drop_unused_vertices(candidate);
        candidate.vertex_number.clear();
        if (test::least_relative_height(candidate.vertices, candidate.facets) < least_height_) return false;
        if (candidate.facets.empty() || !is_valid(candidate) || !is_wanted_(test::to_arrays(candidate))) return false;
        soup_ = std::move(candidate);
        return true;
    }

    bool leave_out_a_shell() {
        const ConsistentFacets shells = make_consistent(soup_.facets);
        for (std::int32_t shell = 0; shell < shells.shell_count && shells.shell_count > 1; ++shell) {
            Soup candidate = soup_;
            std::vector<char> is_dropped;
            for (const std::int32_t of_facet : shells.shell) is_dropped.push_back(of_facet == shell);
            drop_facets(candidate, is_dropped);
            if (accept(std::move(candidate))) return true;
        }
        return false;
    }

    // Every vertex moved onto one of its neighbours.
    bool collapse_some() {
        bool is_changed = false;
        for (std::size_t v = 0; v < soup_.vertices.size();) {
            if (collapse(static_cast<std::int32_t>(v)))
                is_changed = true;
            else
                ++v;
        }
        return is_changed;
    }
    bool collapse(std::int32_t from) {
        std::vector<std::int32_t> targets;
        for (const Triangle& t : soup_.facets)
            for (int i = 0; i < 3; ++i)
                if (t[i] == from) targets.push_back(t[(i + 1) % 3]);
        std::sort(targets.begin(), targets.end());
        return std::any_of(targets.begin(), targets.end(), [&](std::int32_t to) {
            Soup candidate = soup_;
            std::vector<char> is_dropped;
            for (Triangle& t : candidate.facets) {
                std::replace(t.begin(), t.end(), from, to);
                is_dropped.push_back(t[0] == t[1] || t[1] == t[2] || t[2] == t[0]);
            }
            drop_facets(candidate, is_dropped);
            return accept(std::move(candidate));
        });
    }

    void round_coordinates() {
        double largest = 0;
        for (const Vec3& p : soup_.vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
        const double unit = std::pow(10, std::ceil(std::log10(largest)));
        for (double digits = 10; digits < 1e12; digits *= 10) {
            Soup candidate = soup_;
            for (Vec3& p : candidate.vertices)
                for (double& x : p) x = std::round(x / unit * digits) / digits;
            if (accept(std::move(candidate))) return;
        }
    }

    Soup soup_;
    const std::function<bool(const SurfaceArrays&)>& is_wanted_;
    double least_height_;
};

}  // namespace

SurfaceArrays reduced(const SurfaceArrays& surface, const std::function<bool(const SurfaceArrays&)>& is_wanted) {
    Soup soup{surface.vertices, surface.facets, std::vector<std::int32_t>(surface.facets.size(), 0), {"surface"}};
    return test::to_arrays(Reduction(std::move(soup), is_wanted).run());
}

}  // namespace kerf::bench
