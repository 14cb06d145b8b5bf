// Defects that no other step could mend are cut out, so that the holes can be filled anew. In round r of renewing each
// defect loses its facets and r - 1 rings of facets around them, the smallest defects first, as long as no more than a
// quarter of the surface goes. Small open pieces that no step before has closed go before facets are divided at
// crossings and in the last round, unless they are much of the surface together: then they are what it is made of. The
// caller fills the holes, and takes a round back that was of no use (surface/repair/repair.cpp).
#include <algorithm>
#include <utility>

#include "base/geometry/triangle.h"
#include "surface/repair/inside/remaining_defects.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

// Shares of the area of the surface, but for the rim.
constexpr double largest_share_to_renew = 0.25;
constexpr double largest_share_of_loose = 0.005;  // of an open piece that may go as a whole
constexpr double largest_share_of_all_loose = 0.25;
constexpr double largest_share_of_a_rim = 0.1;  // open edges of a nearly closed piece, over its facets

class SurfaceRenewal {
 public:
    SurfaceRenewal(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report), drop_(soup.facets.size(), 0) {}

    void run() {
        const double area = total_area(std::vector<char>(soup_.facets.size(), 1));
        if (request_.round > 0) take_out_defects(largest_share_to_renew * area);
        if (request_.round == 0 || request_.is_last_round) drop_loose_pieces(area);
        if (std::find(drop_.begin(), drop_.end(), 1) != drop_.end()) {
            drop_facets(soup_, drop_);
            drop_unused_vertices(soup_);
        }
        for (RepairAction* action : {&removed_, &too_large_, &loose_}) report_.actions.push_back(std::move(*action));
    }

 private:
    double total_area(const std::vector<char>& chosen) const {
        double area = 0;
        for (std::size_t f = 0; f < chosen.size(); ++f)
            if (chosen[f] != 0) area += triangle_area(soup_.vertices, soup_.facets[f]);
        return area;
    }
    // Takes out defects with the least area first, as long as there is room; then rings of facets around them, as long
    // as there is.
    void take_out_defects(double largest_area) {
        std::vector<std::pair<double, RemainingDefect>> defects;
        for (RemainingDefect& defect : find_remaining_defects(soup_, request_.amount)) {
            double area = 0;
            for (const std::int32_t f : defect.facets) area += triangle_area(soup_.vertices, soup_.facets[f]);
            defects.emplace_back(area, std::move(defect));
        }
        std::stable_sort(defects.begin(), defects.end(),
                         [](const auto& one, const auto& two) { return one.first < two.first; });
        double taken = 0;
        for (const auto& [area, defect] : defects) {
            const RepairPlace place = {defect.where, soup_.file_facets({defect.facets.front()}), 0};
            double more = 0;
            for (const std::int32_t f : defect.facets)
                if (drop_[f] == 0) more += triangle_area(soup_.vertices, soup_.facets[f]);
            (taken + more > largest_area ? too_large_ : removed_).add(place);
            if (taken + more > largest_area) continue;
            taken += more;
            for (const std::int32_t f : defect.facets) drop_[f] = 1;
        }
        for (int ring = 1; ring < request_.round; ++ring) {
            const std::vector<char> before = drop_;
            grow();
            if (total_area(drop_) > largest_area) drop_ = before;
        }
    }
    // Adds all facets that share a vertex with one that goes.
    void grow() {
        std::vector<char> is_near(soup_.vertices.size(), 0);
        for (std::size_t f = 0; f < drop_.size(); ++f)
            if (drop_[f] != 0)
                for (const std::int32_t v : soup_.facets[f]) is_near[v] = 1;
        for (std::size_t f = 0; f < drop_.size(); ++f)
            for (const std::int32_t v : soup_.facets[f]) drop_[f] |= is_near[v];
    }
    // Drops pieces that are open, small beside the whole, and not closed by a step before. Where they are much of the
    // surface together, the surface is made of them, and they stay.
    void drop_loose_pieces(double area_of_all) {
        std::vector<std::pair<double, std::vector<std::int32_t>>> loose;
        double sum = 0;
        const Rims rims = find_rims(soup_.facets);
        for (std::vector<std::int32_t>& piece : rims.facets_of_pieces()) {
            const RimPiece& edges = rims.pieces[rims.piece_of[piece.front()]];
            double area = 0;
            for (const std::int32_t f : piece) area += triangle_area(soup_.vertices, soup_.facets[f]);
            const bool is_mostly_closed = edges.open_edges < largest_share_of_a_rim * edges.facets;
            if (edges.is_closed() || area > largest_share_of_loose * area_of_all || is_mostly_closed) continue;
            sum += area;
            loose.emplace_back(area, std::move(piece));
        }
        if (sum > largest_share_of_all_loose * area_of_all) return;
        loose_.is_loss = true;
        for (const auto& [area, piece] : loose) {
            for (const std::int32_t f : piece) drop_[f] = 1;
            loose_.add({soup_.vertices[soup_.facets[piece.front()][0]], soup_.file_facets({piece.front()}), area});
        }
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    std::vector<char> drop_;
    RepairAction removed_{"defect taken out with its facets", "defects taken out with their facets"};
    RepairAction too_large_{"defect", "defects", "", 0, {}, "more than a quarter of the surface would go"};
    RepairAction loose_{"loose piece removed", "loose pieces removed", "area"};
};

}  // namespace

void renew_step(Soup& soup, const StepRequest& request, StepReport& report) {
    SurfaceRenewal(soup, request, report).run();
}

}  // namespace kerf
