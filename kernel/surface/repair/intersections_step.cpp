// All facets are divided where they cross (surface/arrange/arrangement.h); then the facets that bound the inside stay
// (surface/arrange/hull.h), by winding numbers (Jacobson et al. 2013, jacobson2013). Shells are turned outwards before
// (surface/arrange/shell_turning.h), because winding numbers are meaningless for shells that are turned at random.
// There are two other ways: facets that part regions named elsewhere are divided only, and all pieces stay; bodies that
// are to be regions become that by their cells (surface/repair/inside/body_regions.h).
//
// A "piece" is a facet of the arrangement, its parent the facet of the soup that it is of; `fate_` is per piece,
// `turned_` per facet. The soup is not changed where nothing crosses and nothing goes, nor where more area would be
// lost as bounding nothing than is kept: then the surface is open, and its inside unknown.
#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/arrange/arrangement.h"
#include "surface/arrange/divided_soup.h"
#include "surface/arrange/hull.h"
#include "surface/arrange/shell_turning.h"
#include "surface/repair/inside/body_regions.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

bool is_kept(HullFate fate) { return fate == HullFate::stays || fate == HullFate::turns; }

class CrossingResolver {
 public:
    CrossingResolver(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report) {}

    void run() {
        const bool is_finite =
            std::all_of(soup_.vertices.begin(), soup_.vertices.end(), [](const Vec3& p) { return p.allFinite(); });
        if (!is_finite) return refuse("it has coordinates that are not finite; clean first", {});
        if (const std::optional<RepairPlace> far_out = find_far_out())
            return refuse("doubles as large as a coordinate there are coarser than most facets; leave these facets out",
                          *far_out);
        if (keeps_all()) return divide_walls();
        turned_ = find_turned_facets(soup_.vertices, soup_.facets, request_.check_cancelled);
        Soup turned_soup = soup_;
        for (std::size_t f = 0; f < turned_.size(); ++f)
            if (turned_[f]) std::swap(turned_soup.facets[f][1], turned_soup.facets[f][2]);
        pieces_ = arrange(turned_soup.vertices, turned_soup.facets, request_.check_cancelled);
        if (request_.bodies == BodyRepair::regions && become_regions(std::move(turned_soup))) return;
        fate_ = find_hull(pieces_.vertices, pieces_.facets, request_.check_cancelled);
        if (request_.voids_are_parity) keep_shells();
        const bool is_clean =
            pieces_.rounds == 0 && pieces_.dropped_facets == 0 && std::all_of(fate_.begin(), fate_.end(), is_kept);
        if (is_clean || !is_mostly_bound()) return;
        tell_crossings();
        tell_left_out();
        tell_turned();
        tell_unresolved();
        put();
    }

 private:
    void refuse(const char* reason, const std::optional<RepairPlace>& place) {
        RepairAction refused{"surface", "surfaces"};
        refused.refused_because = reason;
        refused.changes_surface = false;
        if (place)
            refused.add(*place);
        else
            refused.count = 1;
        report_.actions.push_back(std::move(refused));
    }
    // Returns the corner with the largest coordinate, if doubles next to it are farther apart than half of the facets
    // are long. Rounding would lose the pieces of those facets, and exact points there have fractions of many digits.
    std::optional<RepairPlace> find_far_out() const {
        const auto size_of = [](const Vec3& p) { return p.cwiseAbs().maxCoeff(); };
        std::vector<double> lengths;
        RepairPlace place;
        for (std::int32_t f = 0; f < count_of(soup_.facets); ++f) {
            lengths.push_back(box_around(soup_.vertices, soup_.facets[f]).sizes().maxCoeff());
            for (const std::int32_t v : soup_.facets[f])
                if (size_of(soup_.vertices[v]) > size_of(place.where)) place = {soup_.vertices[v], {f}};
        }
        if (place.facets.empty()) return {};
        const auto middle = lengths.begin() + lengths.size() / 2;
        std::nth_element(lengths.begin(), middle, lengths.end());
        if (*middle >= std::numeric_limits<double>::epsilon() * size_of(place.where)) return {};
        place.facets = soup_.file_facets(place.facets);
        return place;
    }
    Vec3 centroid(std::size_t piece) const {
        const auto& [a, b, c] = pieces_.facets[piece];
        return (pieces_.vertices[a] + pieces_.vertices[b] + pieces_.vertices[c]) / 3;
    }
    std::vector<std::int32_t> in_file(std::vector<std::int32_t> pieces) const {
        for (std::int32_t& f : pieces) f = pieces_.parent[f];
        std::sort(pieces.begin(), pieces.end());
        pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
        return soup_.file_facets(pieces);
    }

    // Whether the facets part regions that are not made of bodies here.
    bool keeps_all() const {
        if (request_.bodies == BodyRepair::unite) return false;
        if (request_.bodies == BodyRepair::regions && !closed_patches(soup_).names.empty()) return false;
        return request_.are_walls || (has_ordinary_facets(soup_) && is_of_touching_bodies(soup_));
    }
    // All pieces stay, copies too: which regions they part is told by their cells.
    void divide_walls() {
        pieces_ = arrange(soup_.vertices, soup_.facets, request_.check_cancelled);
        if (pieces_.rounds == 0) return;
        tell_crossings();
        tell_unresolved();
        const std::vector<char> all(pieces_.facets.size(), 1), none(pieces_.facets.size(), 0);
        take_divided_facets(soup_, std::move(pieces_), all, none);
        drop_unused_vertices(soup_);
    }

    // Makes each body a region. False if there is one body alone, or the facets bound no regions.
    bool become_regions(Soup divided) {
        GivenBodies bodies = find_bodies(divided, request_.check_cancelled);
        if (bodies.names.size() < 2) return false;
        std::vector<std::int32_t> of_pieces;
        for (const std::int32_t parent : pieces_.parent) of_pieces.push_back(bodies.of_facet[parent]);
        bodies.of_facet = std::move(of_pieces);
        const std::vector<char> all(pieces_.facets.size(), 1), none(pieces_.facets.size(), 0);
        take_divided_facets(divided, pieces_, all, none);
        std::optional<BodyRegions> regions = make_regions(divided, bodies, request_.check_cancelled);
        if (!regions) {
            RepairAction refused{"surface", "surfaces", "", 1, {}, "its facets part no regions; bodies are united"};
            refused.changes_surface = false;
            report_.actions.push_back(std::move(refused));
            return false;
        }
        tell_crossings();
        for (RepairAction* action : {&regions->made, &regions->overlaps, &regions->hidden})
            report_.actions.push_back(std::move(*action));
        tell_unresolved();
        soup_ = std::move(divided);
        drop_unused_vertices(soup_);
        return true;
    }

    // Whether more of the surface bounds something than nothing, by area.
    bool is_mostly_bound() {
        double bounding = 0, loose = 0;
        for (std::size_t f = 0; f < fate_.size(); ++f) {
            const double area = triangle_area(pieces_.vertices, pieces_.facets[f]);
            if (is_kept(fate_[f])) bounding += area;
            if (fate_[f] == HullFate::outside) loose += area;
        }
        if (loose < bounding) return true;
        RepairAction refused{"surface", "surfaces", "",
                             1,         {},         "most of it bounds nothing, since it is open; kerf wrap closes it"};
        refused.changes_surface = false;
        report_.actions.push_back(std::move(refused));
        return false;
    }

    // Reports crossings; their places are the new vertices, with the facets that meet there.
    void tell_crossings() {
        RepairAction resolved{"crossing resolved", "crossings resolved"};
        const auto first_new = count_of(soup_.vertices);
        const std::size_t most = std::min(RepairAction::most_places, pieces_.vertices.size() - soup_.vertices.size());
        std::vector<std::vector<std::int32_t>> at(most);
        for (std::int32_t f = 0; f < count_of(pieces_.facets); ++f)
            for (const std::int32_t v : pieces_.facets[f])
                if (v >= first_new && v - first_new < std::ssize(at)) at[v - first_new].push_back(f);
        for (std::size_t i = 0; i < most; ++i)
            if (!at[i].empty()) resolved.places.push_back({pieces_.vertices[first_new + i], in_file(at[i])});
        resolved.count = pieces_.crossing_pairs - std::ssize(pieces_.unresolved);
        report_.actions.push_back(std::move(resolved));
    }

    // Pieces of one fate that go and hang together.
    struct LeftOut {
        std::vector<std::int32_t> facets;
        bool is_apart;  // nothing at its edges stays
    };
    std::vector<LeftOut> find_left_out() const {
        UnionFind joined(fate_.size());
        std::vector<char> has_kept_neighbour(fate_.size(), 0);
        EdgeCorners(pieces_.facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> at) {
            const bool is_any_kept =
                std::any_of(at.begin(), at.end(), [&](const auto& c) { return is_kept(fate_[c.corner / 3]); });
            for (const auto& c : at) {
                const std::int32_t f = c.corner / 3;
                if (is_any_kept) has_kept_neighbour[f] = 1;
                for (const auto& d : at)
                    if (d.corner < c.corner && fate_[d.corner / 3] == fate_[f]) joined.join(d.corner / 3, f);
            }
        });
        const Components components = joined.take();
        std::vector<LeftOut> of(components.count, LeftOut{{}, true});
        for (std::int32_t f = 0; f < count_of(fate_); ++f) {
            if (is_kept(fate_[f])) continue;
            LeftOut& own = of[components.of[f]];
            own.facets.push_back(f);
            if (has_kept_neighbour[f]) own.is_apart = false;
        }
        std::erase_if(of, [](const LeftOut& own) { return own.facets.empty(); });
        return of;
    }

    // Keeps shells within others: parity tells their meaning.
    void keep_shells() {
        for (const LeftOut& own : find_left_out())
            if (own.is_apart && fate_[own.facets.front()] == HullFate::inside)
                for (const std::int32_t f : own.facets) fate_[f] = HullFate::stays;
    }

    void tell_left_out() {
        RepairAction inner{"inner piece left out", "inner pieces left out", "area"};
        RepairAction shells{"shell inside of another left out", "shells inside of others left out", "area"};
        RepairAction loose{"piece that bounds nothing left out", "pieces that bound nothing left out", "area"};
        RepairAction copies{"piece that is there twice left out", "pieces that are there twice left out", "area"};
        shells.is_loss = loose.is_loss = true;
        for (const auto& [own, is_apart] : find_left_out()) {
            const HullFate fate = fate_[own.front()];
            RepairAction& action = fate == HullFate::copy      ? copies
                                   : fate == HullFate::outside ? loose
                                   : is_apart                  ? shells
                                                               : inner;
            action.add(place_of(own));
        }
        for (RepairAction* action : {&inner, &shells, &loose, &copies}) report_.actions.push_back(std::move(*action));
    }

    // Returns the place of the largest facet, with the area of all.
    RepairPlace place_of(const std::vector<std::int32_t>& pieces) const {
        constexpr std::size_t most_facets_told = 16;
        RepairPlace place;
        double largest = -1;
        for (const std::int32_t f : pieces) {
            const double area = triangle_area(pieces_.vertices, pieces_.facets[f]);
            place.measure += area;
            if (area <= largest) continue;
            largest = area;
            place.where = centroid(f);
        }
        place.facets = in_file({pieces.begin(), pieces.begin() + std::min(pieces.size(), most_facets_told)});
        return place;
    }

    void tell_turned() {
        RepairAction outwards{"facet turned outwards", "facets turned outwards"};
        std::int32_t last = -1;
        for (std::int32_t f = 0; f < count_of(fate_); ++f) {
            const std::int32_t parent = pieces_.parent[f];
            if (!is_kept(fate_[f]) || (fate_[f] == HullFate::turns) == (turned_[parent] != 0) || parent == last)
                continue;
            last = parent;
            outwards.add({centroid(f), in_file({f})});
        }
        report_.actions.push_back(std::move(outwards));
    }

    void tell_unresolved() {
        RepairAction left{"crossing", "crossings", "", 0, {}, "rounding to doubles makes the pieces cross again"};
        for (const UnresolvedCrossing& crossing : pieces_.unresolved)
            left.add({crossing.where, in_file({crossing.facets.begin(), crossing.facets.end()})});
        report_.actions.push_back(std::move(left));
    }

    void put() {
        std::vector<char> keep, turn;
        for (const HullFate fate : fate_) {
            keep.push_back(is_kept(fate));
            turn.push_back(fate == HullFate::turns);
        }
        take_divided_facets(soup_, std::move(pieces_), keep, turn);
        drop_unused_vertices(soup_);
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    std::vector<char> turned_;  // facets of the soup
    Arrangement pieces_;
    std::vector<HullFate> fate_;
};

}  // namespace

void intersections_step(Soup& soup, const StepRequest& request, StepReport& report) {
    CrossingResolver(soup, request, report).run();
}

}  // namespace kerf
