// What no other step could mend goes, with the facets around it, so that the hole that it leaves can be filled anew.
#include <algorithm>

#include "geometry/triangle.h"
#include "repair/remaining_defects.h"
#include "repair/repair_step.h"
#include "repair/rims.h"

namespace kerf {

namespace {

constexpr double largest_share_to_renew = 0.05;  // of the area of the surface
constexpr double largest_share_of_loose = 0.02;  // of that, too: of an open piece that may go as a whole
constexpr double largest_share_of_a_rim = 0.1;   // of the facets of its piece

class SurfaceRenewal {
 public:
    SurfaceRenewal(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report), drop_(soup.facets.size(), 0) {}

    void run() {
        const double area = total_area(std::vector<char>(soup_.facets.size(), 1));
        for (const RemainingDefect& defect : find_remaining_defects(soup_, request_.amount)) {
            for (const std::int32_t f : defect.facets) drop_[f] = 1;
            removed_.add({defect.where, soup_.file_facets({defect.facets.front()}), 0});
        }
        for (int ring = 0; ring < request_.round; ++ring) grow();
        if (removed_.count > 0 && total_area(drop_) > largest_share_to_renew * area) {
            removed_.refused_because = "more than a twentieth of the surface would go; kerf wrap closes it";
            report_.actions.push_back(std::move(removed_));
            return;
        }
        if (request_.is_last_round) drop_loose_pieces(largest_share_of_loose * area);
        if (removed_.count + loose_.count == 0) return;
        drop_facets(soup_, drop_);
        drop_unused_vertices(soup_);
        for (RepairAction* action : {&removed_, &loose_}) report_.actions.push_back(std::move(*action));
    }

 private:
    double total_area(const std::vector<char>& chosen) const {
        double area = 0;
        for (std::size_t f = 0; f < chosen.size(); ++f)
            if (chosen[f] != 0) area += triangle_area(soup_.vertices, soup_.facets[f]);
        return area;
    }
    // By all facets that share a vertex with one that goes.
    void grow() {
        std::vector<char> is_near(soup_.vertices.size(), 0);
        for (std::size_t f = 0; f < drop_.size(); ++f)
            if (drop_[f] != 0)
                for (const std::int32_t v : soup_.facets[f]) is_near[v] = 1;
        for (std::size_t f = 0; f < drop_.size(); ++f)
            for (const std::int32_t v : soup_.facets[f]) drop_[f] |= is_near[v];
    }
    // Pieces that are open, small, and were not closed in all rounds before.
    void drop_loose_pieces(double largest_area) {
        const Rims rims = find_rims(soup_.facets);
        for (const std::vector<std::int32_t>& piece : rims.facets_of_pieces()) {
            const RimPiece& edges = rims.pieces[rims.piece_of[piece.front()]];
            double area = 0;
            for (const std::int32_t f : piece) area += triangle_area(soup_.vertices, soup_.facets[f]);
            const bool is_mostly_closed =
                static_cast<double>(edges.open_edges) < largest_share_of_a_rim * static_cast<double>(edges.facets);
            if (edges.is_closed() || area > largest_area || is_mostly_closed) continue;
            for (const std::int32_t f : piece) drop_[f] = 1;
            loose_.add({soup_.vertices[soup_.facets[piece.front()][0]], soup_.file_facets({piece.front()}), area});
        }
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    std::vector<char> drop_;
    RepairAction removed_{"defect taken out with its facets", "defects taken out with their facets"};
    RepairAction loose_{"loose piece removed", "loose pieces removed", "area"};
};

}  // namespace

void renew_step(Soup& soup, const StepRequest& request, StepReport& report) {
    SurfaceRenewal(soup, request, report).run();
}

}  // namespace kerf
