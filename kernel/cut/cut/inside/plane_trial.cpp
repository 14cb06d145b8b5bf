// Moving the plane helps little when a contour has several trouble spots, because each new plane has its own. So the
// spots are repaired one by one on the same plane first: the facets around a failed vertex get a penalty (`penalty_`,
// the factor of their edges in the minimum cut), and the next contour goes around them; the penalty rises until the
// contour moves.
// Each contour is spanned over its projection, and where that is not good over its unfolding, too; an interface that is
// merely soft is smoothed in space; the better one is kept (`Spanned`). The labels `side_` are of the last attempt
// alone, so complete() must follow attempt() before the next one. The cost of an attempt is proportional to the band
// and the interface, but for the halves of a valid one.
#include "cut/cut/inside/plane_trial.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <span>

#include "base/core/hash.h"
#include "base/core/threads.h"
#include "cut/cut/inside/contour.h"
#include "cut/cut/inside/interface_smoothing.h"
#include "cut/cut/inside/labels.h"
#include "cut/cut/inside/shell_placement.h"
#include "cut/cut/split.h"

namespace kerf {

namespace {

constexpr int max_stalled = 2;  // rounds of repair that change nothing
constexpr int max_raises = 4;   // of the penalties, until the contour moves

double penalty_factor(Refusal refusal) {
    switch (refusal) {
        case Refusal::crossing_projection:
        case Refusal::nesting:
        case Refusal::pinched_contour:
            return 4;
        case Refusal::soft:
            return 2;
        default:
            return 3;
    }
}

// 0 if the interface is not valid; 1 and more if it is good.
double rating(const Verdict& verdict, const CutOptions& options) {
    if (verdict.refusal == Refusal::none) return 1;
    return verdict.refusal == Refusal::soft ? goodness(verdict.quality, options) : 0;
}

bool divides(const Array<Facet, Side>& side) {
    return std::adjacent_find(side.begin(), side.end(), std::not_equal_to<>()) != side.end();
}

}  // namespace

double goodness(const InterfaceQuality& quality, const CutOptions& options) {
    return std::min({quality.dihedral_deg / options.good_dihedral_deg, quality.angle_deg / options.good_angle_deg,
                     quality.gap_rel / options.good_gap_rel});
}

void PlaneTrial::refuse(Attempt& attempt, Refusal refusal, std::vector<Vertex> vertices) const {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    attempt.record.refusal = refusal;
    attempt.failed = std::move(vertices);
    for (const Vertex v : attempt.failed) attempt.record.places.push_back(surface_.point(v));
}

// False if the minimum cut was not found.
bool PlaneTrial::label_facets(Attempt& attempt) {
    for (const Facet f : band_.facets) side_[f] = band_.majority[f];
    if (record_) {
        attempt.stages.crossed_edges = crossed_edges(surface_, band_);
        attempt.stages.hanging_edges_removed = contour_edges(surface_, band_, side_);
    }
    if (options_.contour == ContourMethod::min_cut &&
        !minimum_cut_labels(surface_, band_, penalty_, side_, step_budget_))
        return false;
    clean_labels(surface_, band_, side_, record_ ? &attempt.stages : nullptr);
    return true;
}

bool PlaneTrial::find_contour(Attempt& attempt) {
    std::vector<SurfaceEdge> edges;
    for (int raise = 0; raise <= max_raises; ++raise) {
        if (!label_facets(attempt)) {
            refuse(attempt, Refusal::flow_limit, {});
            return false;
        }
        edges = contour_edges(surface_, band_, side_);
        if (edges != last_contour_ || bad_facets_.empty()) break;
        raise_penalty();  // the failed places are not expensive enough yet
    }
    last_contour_ = edges;
    if (record_) attempt.stages.smoothed = attempt.record.contour = edges;
    ContourLoops contour = trace_loops(surface_, edges, copied_);
    if (edges.empty() && !divides(side_)) refuse(attempt, Refusal::empty_side, {});
    if (!contour.pinched.empty()) refuse(attempt, Refusal::pinched_contour, contour.pinched);
    attempt.loops = std::move(contour.loops);
    return attempt.record.refusal == Refusal::none;
}

PlaneTrial::Spanned PlaneTrial::judge(Interface interface) const {
    Verdict verdict = judge_interface(surface_, band_, interface, options_);
    return {std::move(interface), std::move(verdict)};
}

// Once another one has been accepted, the result is not wanted any more.
PlaneTrial::Spanned PlaneTrial::span(const Attempt& attempt, ContourLayout layout,
                                     const std::atomic<bool>& is_settled) const {
    if (is_settled) return {};
    InterfaceAttempt built = build_interface(surface_, band_, side_, attempt.loops, hits_, options_, layout);
    if (built.refusal != Refusal::none) return {{}, {built.refusal, std::move(built.failed), {}}};
    if (is_settled) return {};
    Spanned spanned = judge(std::move(built.interface));
    if (spanned.verdict.refusal != Refusal::soft || is_settled) return spanned;
    Interface smoothed = spanned.interface;
    smooth_interface(surface_, options_, smoothed);
    return better(std::move(spanned), judge(std::move(smoothed)));
}

// The first unless the second is better.
PlaneTrial::Spanned PlaneTrial::better(Spanned first, Spanned second) const {
    return rating(second.verdict, options_) > rating(first.verdict, options_) ? std::move(second) : std::move(first);
}

void PlaneTrial::span_interface(Attempt& attempt) const {
    constexpr std::array layouts = {ContourLayout::projected, ContourLayout::unfolded};
    std::array<Spanned, layouts.size()> both;
    std::atomic<bool> is_settled = false;
    for_each_on_threads(layouts.size(), [&](std::size_t i) {
        both[i] = span(attempt, layouts[i], is_settled);
        if (i == 0 && both[i].verdict.refusal == Refusal::none) is_settled = true;
    });
    Spanned spanned = std::move(both[0]);
    if (spanned.verdict.refusal != Refusal::none) spanned = better(std::move(spanned), std::move(both[1]));
    attempt.interface = std::move(spanned.interface);
    attempt.record.quality = spanned.verdict.quality;
    if (record_) attempt.record.collisions = std::move(spanned.verdict.collisions);
    if (spanned.verdict.refusal != Refusal::none)
        refuse(attempt, spanned.verdict.refusal, std::move(spanned.verdict.failed));
}

void PlaneTrial::complete(Attempt& attempt) const {
    const auto refuse_half = [&](Refusal refusal, const Vec3& place) {
        attempt.record.refusal = refusal;
        attempt.record.places = {place};
    };
    const HeightSpan shared = shared_heights(band_, side_, attempt.interface);
    const bool in_doubt = may_misplace_shells(surface_, band_, side_, shared);
    std::array<Half, 2> halves = split(surface_, side_, attempt.interface, node_);
    std::array<std::optional<ManifoldDefect>, 2> defect;
    std::array<Vertex, 2> misplaced = {Vertex::none(), Vertex::none()};
    for_each_on_threads(halves.size(), [&](std::size_t i) {
        options_.check_cancelled();
        auto built = Surface::build(std::move(halves[i].arrays), std::move(halves[i].partner));
        if (auto* found = std::get_if<ManifoldDefect>(&built)) {
            defect[i] = std::move(*found);
            return;
        }
        attempt.halves[i] = std::move(std::get<Surface>(built));
        if (in_doubt) misplaced[i] = find_misplaced_shell(attempt.halves[i], band_.plane, shared);
    });
    for (std::size_t i = 0; i < halves.size() && attempt.valid(); ++i)
        if (defect[i])
            refuse_half(Refusal::not_manifold, defect[i]->where);
        else if (misplaced[i].is_valid())
            refuse_half(Refusal::misplaced_shell, attempt.halves[i].point(misplaced[i]));
    if (!attempt.valid()) return;
    attempt.hash = hash_of(attempt);
    if (record_) attempt.side = side_;
}

FileHash PlaneTrial::hash_of(const Attempt& attempt) const {
    Hasher hasher;
    hasher.add(std::span<const Side>(side_));
    hasher.add(std::span<const Vertex>(attempt.interface.contour));
    hasher.add(std::span<const Vec3>(attempt.interface.points));
    hasher.add(std::span<const Triangle>(attempt.interface.triangles));
    return hasher.digest();
}

Attempt PlaneTrial::attempt(std::int32_t repair) {
    Attempt attempt;
    attempt.record.plane = candidate_.plane;
    attempt.record.method = options_.contour;
    attempt.record.axis = candidate_.axis;
    attempt.record.step = candidate_.step;
    attempt.record.repair = repair;
    attempt.section_area = band_.section_area;
    // Between shells that lie apart a plane divides the body without touching it.
    if (find_contour(attempt) && !attempt.loops.empty()) span_interface(attempt);
    return attempt;
}

bool PlaneTrial::learn(const Attempt& attempt) {
    if (attempt.failed.empty()) return false;
    stalled_ = attempt.loops == last_loops_ && attempt.failed == last_failed_ ? stalled_ + 1 : 0;
    if (stalled_ == max_stalled) return false;
    last_loops_ = attempt.loops;
    last_failed_ = attempt.failed;
    const bool is_hit = attempt.record.refusal == Refusal::intersection || attempt.record.refusal == Refusal::soft;
    std::vector<char> bad(band_.vertices.size(), 0);
    for (const Vertex v : attempt.failed) {
        const std::int32_t i = band_.vertex_index_of[v];
        if (i < 0) continue;
        bad[i] = 1;
        hits_[i] += is_hit;
    }
    const auto is_bad = [&](Vertex v) { return bad[band_.vertex_index_of[v]] != 0; };
    penalty_factor_ = penalty_factor(attempt.record.refusal);
    bad_facets_.clear();
    for (std::size_t i = 0; i < band_.facets.size(); ++i) {
        const auto t = surface_.corners(band_.facets[i]);
        if (std::any_of(t.begin(), t.end(), is_bad)) bad_facets_.push_back(i);
    }
    raise_penalty();
    return !bad_facets_.empty();
}

void PlaneTrial::raise_penalty() {
    for (const std::size_t i : bad_facets_) penalty_[i] *= penalty_factor_;
}

}  // namespace kerf
