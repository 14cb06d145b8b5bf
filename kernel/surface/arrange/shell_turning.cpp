// Shells, which hang together over edges of two facets, are made consistent (surface/diagnosis/orientation.h). The sign
// of its volume tells whether a closed shell points outwards. How other facets wind around it is measured, because
// shells may cross and none need lie inside of another as a whole: the winding number at up to 64 of its facets, by
// area, less the 1/2 or -1/2 that the shell has on itself. Above 1/2 the shell lies in a body and stays; below -1/2 it
// lies in a shell that is inside out, and is turned with that; in between it is turned if it points inwards. If all
// closed shells point outwards nothing is measured.
#include "surface/arrange/shell_turning.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "surface/arrange/winding_number.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/orientation.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

class ShellTurner {
 public:
    ShellTurner(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                const std::function<void()>& check_cancelled)
        : vertices_(vertices),
          consistent_(make_consistent(facets)),
          facets_of_(consistent_.shell_count),
          check_cancelled_(check_cancelled) {
        for (std::int32_t f = 0; f < count_of(facets); ++f) facets_of_[consistent_.shell[f]].push_back(f);
    }

    /// Returns for each facet whether it is to be turned.
    std::vector<char> run() {
        std::vector<char> to_turn(consistent_.facets.size(), 0);
        for (const std::int32_t f : consistent_.turned) to_turn[f] = 1;
        const std::vector<char> is_open = find_open_shells();
        std::vector<char> is_out(consistent_.shell_count, 1);
        for (std::int32_t shell = 0; shell < consistent_.shell_count; ++shell)
            if (!is_open[shell]) is_out[shell] = is_outward(vertices_, facets_of(shell));
        if (std::find(is_out.begin(), is_out.end(), char{0}) == is_out.end()) return to_turn;
        check_cancelled_();
        const WindingNumber winding(vertices_, consistent_.facets);
        for (std::int32_t shell = 0; shell < consistent_.shell_count; ++shell) {
            if (is_open[shell] || !is_wrong(shell, is_out[shell] != 0, winding)) continue;
            for (const std::int32_t f : facets_of_[shell]) to_turn[f] ^= 1;
        }
        return to_turn;
    }

 private:
    // Marks shells of which an edge is passed in one direction more often than in the other, and one-sided ones.
    std::vector<char> find_open_shells() const {
        std::vector<char> is_open(consistent_.shell_count, 0);
        for (const std::int32_t f : consistent_.contradictions) is_open[consistent_.shell[f]] = 1;
        std::vector<std::pair<std::int32_t, std::int32_t>> passes;  // shell, direction
        EdgeCorners(consistent_.facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> at) {
            passes.clear();
            for (const auto& c : at)
                passes.emplace_back(consistent_.shell[c.corner / 3],
                                    start_vertex(consistent_.facets, c.corner) == low ? 1 : -1);
            std::sort(passes.begin(), passes.end());
            for (std::size_t i = 0, j = 0; i < passes.size(); i = j) {
                std::int32_t sum = 0;
                for (; j < passes.size() && passes[j].first == passes[i].first; ++j) sum += passes[j].second;
                if (sum != 0) is_open[passes[i].first] = 1;
            }
        });
        return is_open;
    }

    std::vector<Triangle> facets_of(std::int32_t shell) const {
        std::vector<Triangle> facets;
        for (const std::int32_t f : facets_of_[shell]) facets.push_back(consistent_.facets[f]);
        return facets;
    }

    bool is_wrong(std::int32_t shell, bool is_out, const WindingNumber& winding) {
        constexpr std::size_t most_samples = 64;
        check_cancelled_();
        const std::vector<std::int32_t>& own = facets_of_[shell];
        const double of_shell = is_out ? 0.5 : -0.5;  // winding number of the shell on itself
        const std::size_t step = (own.size() + most_samples - 1) / most_samples;
        double area = 0, around = 0;  // winding number of the others around it, times area
        for (std::size_t i = 0; i < own.size(); i += step) {
            const double weight = triangle_area(vertices_, consistent_.facets[own[i]]);
            area += weight;
            around += weight * (winding.beside(own[i]) - of_shell);
        }
        if (around > 0.5 * area) return false;
        return around < -0.5 * area || !is_out;
    }

    const std::vector<Vec3>& vertices_;
    ConsistentFacets consistent_;
    std::vector<std::vector<std::int32_t>> facets_of_;  // of shells
    const std::function<void()>& check_cancelled_;
};

}  // namespace

std::vector<char> find_turned_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                     const std::function<void()>& check_cancelled) {
    std::vector<Triangle> proper;
    std::vector<std::size_t> number;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (has_repeated_vertex(facets[f])) continue;
        proper.push_back(facets[f]);
        number.push_back(f);
    }
    const std::vector<char> of_proper = ShellTurner(vertices, proper, check_cancelled).run();
    std::vector<char> to_turn(facets.size(), 0);
    for (std::size_t i = 0; i < number.size(); ++i) to_turn[number[i]] = of_proper[i];
    return to_turn;
}

}  // namespace kerf
