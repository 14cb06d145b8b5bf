// Facets that bound nothing go, in this order: facets with a repeated vertex or without finite coordinates; facets
// without area (surface/repair/inside/flat_facets.h), whose neighbours are divided at their vertices so that nothing
// opens; copies (surface/repair/inside/facet_copies.h), which come last because the pieces of those neighbours may be
// such. Bodies that share facets are united where their winding numbers tell how
// (surface/repair/inside/covered_facets.h); where these bodies also cross, or are to be regions, that is left to a
// later step, if there is one.
#include <algorithm>
#include <utility>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "surface/repair/inside/covered_facets.h"
#include "surface/repair/inside/facet_copies.h"
#include "surface/repair/inside/flat_facets.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

class Cleaning {
 public:
    Cleaning(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report) {}

    void run() {
        accept_unfit();
        drop_undefined();
        drop_flat();
        drop_copies();
        if (report_.changed()) drop_unused_vertices(soup_);
    }

 private:
    void drop_copies() {
        if (has_walls(soup_, request_)) return;  // of which there may be two facets in one place
        SurplusCopies surplus = find_surplus_copies(soup_.facets, unites());
        if (surplus.copies.empty() && surplus.folds.empty()) return;
        const std::vector<std::int32_t> inside = take_out_closed(surplus);
        std::vector<char> drop(soup_.facets.size(), 0);
        mark(surplus.copies, {"copy of a facet removed", "copies of facets removed"}, drop);
        mark(surplus.folds, {"facet folded upon another removed", "facets folded upon each other removed"}, drop);
        mark(inside,
             {"facet inside of bodies that share others removed", "facets inside of bodies that share others removed"},
             drop);
        drop_facets(soup_, drop);
    }
    // Unites closed bodies that have facets in common, as their winding numbers tell. Bodies that cross as well, or are
    // to be regions, are left to the step that divides them, if it is asked for. Returns the facets inside of the
    // union.
    std::vector<std::int32_t> take_out_closed(SurplusCopies& surplus) const {
        if (!unites() && !request_.is_divided_later) return {};
        CoveredFacets covered = find_covered_facets(soup_.vertices, soup_.facets, request_.check_cancelled);
        const auto is_of_others = [&](std::int32_t f) {
            return (unites() && covered.is_told[f] != 0) || (request_.is_divided_later && covered.is_closed[f] != 0);
        };
        std::erase_if(surplus.copies, is_of_others);
        std::erase_if(surplus.folds, is_of_others);
        if (!unites()) return {};
        insert_sorted(covered.copies, surplus.copies);
        insert_sorted(covered.folds, surplus.folds);
        return std::move(covered.inside);
    }
    static void insert_sorted(const std::vector<std::int32_t>& more, std::vector<std::int32_t>& all) {
        const auto middle = all.insert(all.end(), more.begin(), more.end());
        std::inplace_merge(all.begin(), middle, all.end());
    }
    bool unites() const { return request_.bodies != BodyRepair::regions; }

    // Says that all of them are removed; a facet without a finite corner has no place.
    void mark(const std::vector<std::int32_t>& facets, RepairAction action, std::vector<char>& drop) {
        for (const std::int32_t f : facets) {
            RepairPlace place{.facets = soup_.file_facets({f})};
            for (const std::int32_t v : soup_.facets[f])
                if (soup_.vertices[v].allFinite()) place.where = soup_.vertices[v];
            action.add(std::move(place));
            drop[f] = 1;
        }
        report_.actions.push_back(std::move(action));
    }
    // Takes the triangles of a face as the surface where they are not quite the face that the file describes.
    void accept_unfit() {
        RepairAction accepted{"warped face taken as its triangles", "warped faces taken as their triangles"};
        for (const std::int32_t polygon : soup_.unfit_polygons) {
            const auto facet = std::lower_bound(soup_.polygon.begin(), soup_.polygon.end(), polygon);
            if (facet == soup_.polygon.end() || *facet != polygon) continue;
            const Triangle& t = soup_.facets[facet - soup_.polygon.begin()];
            accepted.add({soup_.vertices[t[0]], {polygon}});
        }
        soup_.unfit_polygons.clear();
        report_.actions.push_back(std::move(accepted));
    }
    void drop_undefined() {
        std::vector<std::int32_t> infinite, repeated;
        for (std::int32_t f = 0; f < count_of(soup_.facets); ++f) {
            const auto [a, b, c] = soup_.facets[f];
            if (!soup_.vertices[a].allFinite() || !soup_.vertices[b].allFinite() || !soup_.vertices[c].allFinite())
                infinite.push_back(f);
            else if (has_repeated_vertex(soup_.facets[f]))
                repeated.push_back(f);
        }
        std::vector<char> drop(soup_.facets.size(), 0);
        mark(infinite, {"facet without finite coordinates removed", "facets without finite coordinates removed"}, drop);
        mark(repeated, {"facet with a repeated vertex removed", "facets with a repeated vertex removed"}, drop);
        drop_facets(soup_, drop);
    }
    void drop_flat() {
        FlatFacets flat = find_flat_facets(soup_.vertices, soup_.facets);
        if (flat.facets.empty()) return;
        std::vector<char> drop(soup_.facets.size(), 0);
        mark(flat.facets, {"facet without area removed", "facets without area removed"}, drop);
        RepairAction divided{"neighbour divided instead", "neighbours divided instead"};
        std::vector<char> is_divided(soup_.facets.size(), 0);
        for (const SidePoint& point : flat.points)
            if (!std::exchange(is_divided[point.corner / 3], char{1}))
                divided.add({soup_.vertices[point.vertex], soup_.file_facets({point.corner / 3})});
        report_.actions.push_back(std::move(divided));
        std::vector<std::int32_t> new_number(drop.size());  // without the flat facets
        for (std::size_t f = 0, kept = 0; f < drop.size(); kept += drop[f++] == 0) new_number[f] = kept;
        drop_facets(soup_, drop);
        for (SidePoint& point : flat.points) point.corner = 3 * new_number[point.corner / 3] + point.corner % 3;
        divide_at(soup_, std::move(flat.points));
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
};

}  // namespace

void clean_step(Soup& soup, const StepRequest& request, StepReport& report) { Cleaning(soup, request, report).run(); }

}  // namespace kerf
