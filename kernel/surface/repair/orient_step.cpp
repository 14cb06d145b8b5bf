// Facets are made to agree over edges of two; a shell is what hangs together over such edges. Where only edges of more
// facets close a shell, the cells around these tell which side of a facet is the outside (turn_by_cells()). Then each
// shell that nothing encloses is turned outwards as a whole, with all shells inside of it, so that a void stays one.
// Closed shells are nested by locate_shells(); open ones with an inside are nested by winding numbers, since a body may
// have a hole. An open shell has an inside if it is full: the volume between it and the middle of its rim, over its
// area to the power of 3/2, is then not small. One-sided shells have no right answer, and stay as they came unless
// turning makes more facets agree.
#include <algorithm>
#include <cmath>

#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/arrange/winding_number.h"
#include "surface/diagnosis/orientation.h"
#include "surface/regions/cells.h"
#include "surface/repair/inside/rims.h"
#include "surface/repair/repair_step.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double least_fullness = 0.03;  // of an open shell that has an inside; a ball has 0.094

class Orienting {
 public:
    Orienting(Soup& soup, const StepRequest& request, StepReport& report)
        : soup_(soup), request_(request), report_(report) {
        for (std::int32_t f = 0; f < count_of(soup.facets); ++f)
            if (is_ordinary(soup.vertices, soup.facets[f])) number_.push_back(f);
        for (const std::int32_t f : number_) facets_.push_back(soup.facets[f]);
    }

    void run() {
        if (facets_.empty() || (facets_.size() == soup_.facets.size() && has_walls(soup_, request_))) return;
        new_ = make_consistent(facets_);
        restore_one_sided();
        request_.check_cancelled();
        rims_ = find_rims(facets_);
        is_hull_.assign(facets_.size(), 1);
        turn_by_cells();
        request_.check_cancelled();
        turn_shells_outwards();
        say();
        for (std::size_t i = 0; i < number_.size(); ++i) soup_.facets[number_[i]] = new_.facets[i];
    }

 private:
    void restore_one_sided();
    void turn_by_cells();
    void turn_piece_by_cells(const std::vector<std::int32_t>& piece);
    void turn_shells_outwards();
    std::vector<std::int32_t> find_roots(std::vector<double>& fullness) const;
    std::vector<double> find_fullness() const;
    std::vector<double> find_what_is_around(const std::vector<double>& fullness) const;
    void turn_shells(const std::vector<char>& is_turned);
    void say();
    RepairPlace place(std::int32_t facet) const {
        return {soup_.vertices[facets_[facet][0]], soup_.file_facets({number_[facet]})};
    }

    Soup& soup_;
    const StepRequest& request_;
    StepReport& report_;
    std::vector<std::int32_t> number_;  // in the soup, of the ordinary facets
    std::vector<Triangle> facets_;      // as they came
    ConsistentFacets new_;
    Rims rims_;
    std::vector<char> is_one_sided_;  // per shell
    std::vector<char> is_hull_;       // has the outside of its piece on one side
    RepairAction shells_turned_{"shell turned outwards", "shells turned outwards"};
};

// Facets of a one-sided shell cannot all agree: they stay as they came where that is no worse.
void Orienting::restore_one_sided() {
    is_one_sided_.assign(new_.shell_count, 0);
    for (const std::int32_t f : new_.contradictions) is_one_sided_[new_.shell[f]] = 1;
    if (new_.contradictions.empty()) return;
    std::vector<std::int64_t> gain(is_one_sided_.size(), 0);
    const std::vector<std::int32_t> partner = edge_partners(facets_);
    const auto is_turned = [&](std::int32_t corner) { return facets_[corner / 3] != new_.facets[corner / 3]; };
    for (std::int32_t c = 0; c < count_of(partner); ++c) {
        if (partner[c] < c || !is_one_sided_[new_.shell[c / 3]]) continue;
        if (is_turned(c) == is_turned(partner[c])) continue;
        gain[new_.shell[c / 3]] += start_vertex(facets_, c) == start_vertex(facets_, partner[c]) ? 1 : -1;
    }
    for (std::size_t f = 0; f < facets_.size(); ++f)
        if (is_one_sided_[new_.shell[f]] && gain[new_.shell[f]] <= 0) new_.facets[f] = facets_[f];
}

// A piece that hangs together over edges of more than two facets, and has no open edge, is one shell from here on.
void Orienting::turn_by_cells() {
    const std::vector<std::vector<std::int32_t>> pieces = rims_.facets_of_pieces();
    std::vector<std::int32_t> new_shell(new_.shell.size(), -1);
    std::vector<char> is_one_sided;
    std::int32_t count = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (!rims_.pieces[p].is_closed() || rims_.pieces[p].edges_of_many == 0) continue;
        turn_piece_by_cells(pieces[p]);
    }
    // Numbered by smallest facet again.
    std::vector<std::int32_t> of_piece(pieces.size(), -1), of_shell(new_.shell_count, -1);
    for (std::size_t f = 0; f < new_.shell.size(); ++f) {
        const std::int32_t p = rims_.piece_of[f];
        const bool is_one = rims_.pieces[p].is_closed() && rims_.pieces[p].edges_of_many > 0;
        std::int32_t& number = is_one ? of_piece[p] : of_shell[new_.shell[f]];
        if (number < 0) {
            number = count++;
            is_one_sided.push_back(!is_one && is_one_sided_[new_.shell[f]]);
        }
        new_shell[f] = number;
    }
    new_.shell = std::move(new_shell);
    is_one_sided_ = std::move(is_one_sided);
    new_.shell_count = count;
}

// The outside stays on the side where most of the area has it: a void is a void though its facets are torn.
void Orienting::turn_piece_by_cells(const std::vector<std::int32_t>& piece) {
    std::vector<Triangle> facets;
    for (const std::int32_t f : piece) facets.push_back(new_.facets[f]);
    const CompactFacets compact = make_compact(soup_.vertices, facets);
    const auto cells = find_cells(compact.vertices, compact.facets);
    if (!cells) return;
    double outward = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const CellSides& sides = cells->sides[i];
        is_hull_[piece[i]] = (sides.front < 0) != (sides.back < 0);
        if (!is_hull_[piece[i]]) continue;
        const double area =
            triangle_area(compact.vertices[compact.facets[i][0]], compact.vertices[compact.facets[i][1]],
                          compact.vertices[compact.facets[i][2]]);
        outward += sides.front < 0 ? area : -area;
    }
    for (std::size_t i = 0; i < piece.size(); ++i)
        if (is_hull_[piece[i]] && (cells->sides[i].front < 0) != (outward >= 0)) turn(new_.facets[piece[i]]);
}

// Turns shells that nothing encloses outwards, and shells inside of them with them: a void stays one, though it or the
// shell around it may have a hole.
void Orienting::turn_shells_outwards() {
    std::vector<double> fullness = find_fullness();
    const auto has_inside = [](double full) { return std::abs(full) > least_fullness; };
    const bool all_closed = std::none_of(fullness.begin(), fullness.end(), has_inside);
    const std::vector<std::int32_t> roots = find_roots(fullness);
    if (std::none_of(fullness.begin(), fullness.end(), [](double full) { return full < -least_fullness; })) return;
    const std::vector<double> around =
        all_closed ? std::vector<double>(fullness.size(), 0) : find_what_is_around(fullness);
    std::vector<char> is_turned(fullness.size(), 0);
    for (std::size_t s = 0; s < fullness.size(); ++s)
        if (has_inside(fullness[s])) is_turned[s] = around[s] < -0.5 || (around[s] <= 0.5 && fullness[s] < 0);
    for (std::size_t s = 0; s < fullness.size(); ++s)
        if (roots[s] >= 0) is_turned[s] = is_turned[roots[s]];
    turn_shells(is_turned);
}

// Returns for each closed shell the outermost closed one around it, maybe itself; -1 for others. Sets the fullness of
// outermost shells to 1 or -1, unless they touch another.
std::vector<std::int32_t> Orienting::find_roots(std::vector<double>& fullness) const {
    std::vector<std::int32_t> number(fullness.size(), -1), shell, roots(fullness.size(), -1);
    ConsistentFacets closed;
    for (std::size_t f = 0; f < new_.facets.size(); ++f) {
        const std::int32_t s = new_.shell[f];
        if (!rims_.pieces[rims_.piece_of[f]].is_closed() || !is_hull_[f]) continue;
        if (number[s] < 0) {
            number[s] = closed.shell_count++;
            shell.push_back(s);
        }
        closed.facets.push_back(new_.facets[f]);
        closed.shell.push_back(number[s]);
    }
    if (closed.facets.empty()) return roots;
    const std::vector<ShellPlace> places = locate_shells(soup_.vertices, closed);
    for (std::int32_t i = 0; i < count_of(places); ++i) {
        std::int32_t root = i;
        while (places[root].parent >= 0) root = places[root].parent;
        roots[shell[i]] = shell[root];
        if (places[root].touches < 0) fullness[shell[root]] = places[root].outward ? 1 : -1;
    }
    return roots;
}

// Returns the fullness of open shells: the volume between a shell and the middle of its rim, which for one that is
// nearly closed is nearly its own, over its area to the power of 3/2; 0 for closed and one-sided shells.
std::vector<double> Orienting::find_fullness() const {
    struct Open {
        Vec3 middle = Vec3::Zero();
        std::int64_t rim_vertices = 0;
        double volume = 0, area = 0;
    };
    std::vector<Open> shells(new_.shell_count);
    for (std::size_t c = 0; c < 3 * new_.facets.size(); ++c)
        if (rims_.is_open[c]) {
            Open& open = shells[new_.shell[c / 3]];
            open.middle += soup_.vertices[facets_[c / 3][c % 3]];
            ++open.rim_vertices;
        }
    for (Open& open : shells)
        if (open.rim_vertices > 0) open.middle /= open.rim_vertices;
    for (std::size_t f = 0; f < new_.facets.size(); ++f) {
        Open& open = shells[new_.shell[f]];
        const Vec3 area = area_vector(soup_.vertices, new_.facets[f]);
        open.volume += area.dot(soup_.vertices[new_.facets[f][0]] - open.middle) / 3;
        open.area += area.norm();
    }
    std::vector<double> fullness(shells.size(), 0);
    for (std::size_t s = 0; s < shells.size(); ++s)
        if (shells[s].rim_vertices > 0 && !is_one_sided_[s] && shells[s].area > 0)
            fullness[s] = shells[s].volume / std::pow(shells[s].area, 1.5);
    return fullness;
}

// Returns the winding number of other facets around each shell with an inside, at some of its facets.
std::vector<double> Orienting::find_what_is_around(const std::vector<double>& fullness) const {
    constexpr std::size_t most_samples = 64;
    std::vector<std::vector<std::int32_t>> facets_of(fullness.size());
    for (std::int32_t f = 0; f < count_of(new_.facets); ++f)
        if (std::abs(fullness[new_.shell[f]]) > least_fullness) facets_of[new_.shell[f]].push_back(f);
    const WindingNumber winding(soup_.vertices, new_.facets);
    std::vector<double> around(fullness.size(), 0);
    for (std::size_t s = 0; s < fullness.size(); ++s) {
        const std::vector<std::int32_t>& own = facets_of[s];
        const std::size_t step = (own.size() + most_samples - 1) / most_samples;
        double area = 0, sum = 0;
        for (std::size_t i = 0; i < own.size(); i += step) {
            const double weight = area_vector(soup_.vertices, new_.facets[own[i]]).norm();
            area += weight;
            sum += weight * (winding.beside(own[i]) - (fullness[s] > 0 ? 0.5 : -0.5));
        }
        if (area > 0) around[s] = sum / area;
    }
    return around;
}

void Orienting::turn_shells(const std::vector<char>& is_turned) {
    std::vector<char> is_said(is_turned.size(), 0);
    for (std::int32_t f = 0; f < count_of(new_.facets); ++f) {
        const std::int32_t s = new_.shell[f];
        if (!is_turned[s]) continue;
        turn(new_.facets[f]);
        if (!std::exchange(is_said[s], char{1})) shells_turned_.add(place(f));
    }
}

void Orienting::say() {
    RepairAction turned{"facet turned", "facets turned"}, one_sided{"one-sided shell", "one-sided shells"};
    for (std::int32_t f = 0; f < count_of(facets_); ++f)
        if (facets_[f] != new_.facets[f]) turned.add(place(f));
    for (const std::int32_t f : new_.contradictions) one_sided.add(place(f));
    one_sided.refused_because = "like a Moebius strip it has no inside, however its facets are turned";
    for (RepairAction* action : {&turned, &shells_turned_, &one_sided}) report_.actions.push_back(std::move(*action));
}

}  // namespace

void orient_step(Soup& soup, const StepRequest& request, StepReport& report) { Orienting(soup, request, report).run(); }

}  // namespace kerf
