// Moving the plane helps little when a contour has several trouble spots, because each new plane has its own. So the
// spots are repaired one by one on the same plane first: the facets around a failed vertex become expensive, and the
// next minimum cut goes around them.
#include "cut/bisect.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <memory>

#include <Eigen/Geometry>

#include "core/check.h"
#include "core/stopwatch.h"
#include "cut/acceptance.h"
#include "cut/contour.h"
#include "cut/interface.h"
#include "cut/interface_smoothing.h"
#include "cut/labels.h"
#include "cut/plane.h"
#include "cut/split.h"
#include "surface/touching.h"

namespace kerf {

namespace {

constexpr double least_goodness = 0.02;         // worse cuts make tetrahedra that are of no use
constexpr std::int32_t planes_before_soft = 3;  // tried before a soft cut is good enough
constexpr std::int32_t soft_rounds = 6;         // of local repair of a valid cut
constexpr int max_stalled = 2;                  // rounds of repair that change nothing
constexpr int max_raises = 4;                   // of the penalties, until the contour moves

// Bound of the steps of all minimum cuts of a node: well-shaped surfaces rarely need a hundredth of it, slivers would
// take minutes. It halves from level to level, so that the levels together take no more than twice the first.
std::int64_t flow_step_budget(NodeId node, std::int32_t facets) {
    const int level = std::bit_width(static_cast<std::uint32_t>(node)) - 1;
    return 5'000'000 + (3'000 * static_cast<std::int64_t>(facets) >> level);
}

// All that one try produced.
struct Attempt {
    CutTry record;
    std::vector<Side> side;
    std::vector<std::vector<std::int32_t>> loops;
    Interface interface;
    ContourStages stages;
    double section_area = 0;
    std::array<Surface, 2> halves;
    std::vector<std::int32_t> failed;  // vertices

    bool valid() const { return record.refusal == Refusal::none || record.refusal == Refusal::soft; }
};

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

// The smallest measure over its threshold: 1 and more is good.
double goodness(const InterfaceQuality& quality, const CutOptions& options) {
    return std::min({quality.dihedral_deg / options.good_dihedral_deg, quality.angle_deg / options.good_angle_deg,
                     quality.gap_rel / options.good_gap_rel});
}

// 0 if the interface is not valid; 1 and more if it is good.
double rating(const Verdict& verdict, const CutOptions& options) {
    if (verdict.refusal == Refusal::none) return 1;
    return verdict.refusal == Refusal::soft ? goodness(verdict.quality, options) : 0;
}

bool divides(const std::vector<Side>& side) {
    return std::adjacent_find(side.begin(), side.end(), std::not_equal_to<>()) != side.end();
}

// One plane and its rounds of local repair.
class PlaneTrial {
 public:
    PlaneTrial(const Surface& surface, const std::vector<char>& copied, const PlaneCandidate& candidate, NodeId node,
               const CutOptions& options, bool record, std::int64_t& step_budget)
        : surface_(surface),
          copied_(copied),
          candidate_(candidate),
          node_(node),
          options_(options),
          record_(record),
          step_budget_(step_budget),
          band_(make_band(surface, candidate.plane)),
          majority_(majority_labels(surface, band_)),
          penalty_(band_.facets.size(), 1),
          hits_(surface.vertex_count(), 0) {}

    // A contour and its interface, judged; without the halves.
    Attempt attempt(std::int32_t repair);
    // Builds the halves of a valid attempt, or refuses it.
    void complete(Attempt& attempt) const;
    // Makes the places where the attempt failed expensive. False if there is nothing to repair.
    bool learn(const Attempt& attempt);

 private:
    void refuse(Attempt& attempt, Refusal refusal, std::vector<std::int32_t> vertices) const;
    bool label_facets(Attempt& attempt);
    bool find_contour(Attempt& attempt);
    struct Spanned {
        Interface interface;
        Verdict verdict;
    };
    Spanned judge(Interface interface) const;
    Spanned better(Spanned first, Spanned second) const;
    Spanned span(const Attempt& attempt, ContourLayout layout) const;
    void span_interface(Attempt& attempt) const;
    void raise_penalty();

    const Surface& surface_;
    const std::vector<char>& copied_;  // vertices, or none
    const PlaneCandidate& candidate_;
    NodeId node_;
    const CutOptions& options_;
    bool record_;
    std::int64_t& step_budget_;  // of the minimum cuts of all planes
    Band band_;
    std::vector<Side> majority_;           // labels that every round starts from
    std::vector<double> penalty_;          // per band facet
    std::vector<std::int32_t> hits_;       // per vertex
    std::vector<std::size_t> bad_facets_;  // of the band, around the places of the last failure
    double penalty_factor_ = 1;
    std::vector<SurfaceEdge> last_contour_;
    std::vector<std::vector<std::int32_t>> last_loops_;
    std::vector<std::int32_t> last_failed_;
    int stalled_ = 0;  // rounds that ended as the one before
};

void PlaneTrial::refuse(Attempt& attempt, Refusal refusal, std::vector<std::int32_t> vertices) const {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    attempt.record.refusal = refusal;
    attempt.failed = std::move(vertices);
    for (std::int32_t v : attempt.failed) attempt.record.places.push_back(surface_.point(v));
}

// False if the minimum cut was not found.
bool PlaneTrial::label_facets(Attempt& attempt) {
    attempt.side = majority_;
    if (record_) {
        attempt.stages.crossed_edges = crossed_edges(surface_, band_);
        attempt.stages.hanging_edges_removed = contour_edges(surface_, band_, attempt.side);
    }
    if (options_.contour == ContourMethod::min_cut &&
        !minimum_cut_labels(surface_, band_, penalty_, attempt.side, step_budget_))
        return false;
    clean_labels(surface_, band_, attempt.side, record_ ? &attempt.stages : nullptr);
    return true;
}

bool PlaneTrial::find_contour(Attempt& attempt) {
    std::vector<SurfaceEdge> edges;
    for (int raise = 0; raise <= max_raises; ++raise) {
        if (!label_facets(attempt)) {
            refuse(attempt, Refusal::flow_limit, {});
            return false;
        }
        edges = contour_edges(surface_, band_, attempt.side);
        if (edges != last_contour_ || bad_facets_.empty()) break;
        raise_penalty();  // the failed places are not expensive enough yet
    }
    last_contour_ = edges;
    if (record_) attempt.stages.smoothed = attempt.record.contour = edges;
    ContourLoops contour = trace_loops(surface_, edges, copied_);
    if (edges.empty() && !divides(attempt.side)) refuse(attempt, Refusal::empty_side, {});
    if (!contour.pinched.empty()) refuse(attempt, Refusal::pinched_contour, contour.pinched);
    attempt.loops = std::move(contour.loops);
    return attempt.record.refusal == Refusal::none;
}

PlaneTrial::Spanned PlaneTrial::judge(Interface interface) const {
    Verdict verdict = judge_interface(surface_, band_, interface, options_);
    return {std::move(interface), std::move(verdict)};
}

PlaneTrial::Spanned PlaneTrial::span(const Attempt& attempt, ContourLayout layout) const {
    InterfaceAttempt built = build_interface(surface_, band_, attempt.side, attempt.loops, hits_, options_, layout);
    if (built.refusal != Refusal::none) return {{}, {built.refusal, std::move(built.failed), {}}};
    Spanned spanned = judge(std::move(built.interface));
    if (spanned.verdict.refusal != Refusal::soft) return spanned;
    Interface smoothed = spanned.interface;
    smooth_interface(surface_, options_, smoothed);
    return better(std::move(spanned), judge(std::move(smoothed)));
}

// The first unless the second is better.
PlaneTrial::Spanned PlaneTrial::better(Spanned first, Spanned second) const {
    return rating(second.verdict, options_) > rating(first.verdict, options_) ? std::move(second) : std::move(first);
}

void PlaneTrial::span_interface(Attempt& attempt) const {
    Spanned spanned = span(attempt, ContourLayout::projected);
    if (spanned.verdict.refusal != Refusal::none)
        spanned = better(std::move(spanned), span(attempt, ContourLayout::unfolded));
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
    std::array<Half, 2> halves = split(surface_, attempt.side, attempt.interface, node_);
    for (std::size_t i = 0; i < halves.size() && attempt.valid(); ++i) {
        options_.check_cancelled();
        auto built = Surface::build(std::move(halves[i].arrays), std::move(halves[i].partner));
        if (const auto* defect = std::get_if<ManifoldDefect>(&built)) {
            refuse_half(Refusal::not_manifold, defect->where);
            continue;
        }
        attempt.halves[i] = std::move(std::get<Surface>(built));
        const std::int32_t misplaced = find_misplaced_shell(attempt.halves[i]);
        if (misplaced >= 0) refuse_half(Refusal::misplaced_shell, attempt.halves[i].point(misplaced));
    }
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
    std::vector<char> bad(surface_.vertex_count(), 0);
    for (std::int32_t v : attempt.failed) bad[v] = 1;
    if (attempt.record.refusal == Refusal::intersection || attempt.record.refusal == Refusal::soft)
        for (std::int32_t v : attempt.failed) ++hits_[v];
    penalty_factor_ = penalty_factor(attempt.record.refusal);
    bad_facets_.clear();
    for (std::size_t i = 0; i < band_.facets.size(); ++i) {
        const Triangle t = surface_.vertices(band_.facets[i]);
        if (bad[t[0]] || bad[t[1]] || bad[t[2]]) bad_facets_.push_back(i);
    }
    raise_penalty();
    return !bad_facets_.empty();
}

void PlaneTrial::raise_penalty() {
    for (const std::size_t i : bad_facets_) penalty_[i] *= penalty_factor_;
}

FileHash hash_of(const Attempt& attempt) {
    Hasher hasher;
    hasher.add(std::span<const Side>(attempt.side));
    hasher.add(std::span<const std::int32_t>(attempt.interface.contour));
    hasher.add(std::span<const Vec3>(attempt.interface.points));
    hasher.add(std::span<const Triangle>(attempt.interface.triangles));
    return hasher.digest();
}

CutStrategy strategy_of(const CutTry& record) {
    if (record.refusal == Refusal::soft) return CutStrategy::soft;
    if (record.axis > 0) return CutStrategy::other_axis;
    if (record.step != 0) return CutStrategy::plane_step;
    return record.repair > 0 ? CutStrategy::local_repair : CutStrategy::first_try;
}

// Walks the ladder and keeps the best soft cut on the way.
class Ladder {
 public:
    Ladder(const Surface& surface, const MassProperties& mass, NodeId node, const CutPlace& place,
           const CutOptions& options, bool record)
        : surface_(surface),
          copied_(copied_vertices(surface)),
          mass_(mass),
          node_(node),
          place_(place),
          options_(options),
          record_(record),
          step_budget_(flow_step_budget(node, surface.facet_count())) {}

    // The accepted attempt, or none. All tries are appended to `tries`.
    std::unique_ptr<Attempt> climb(std::vector<CutTry>& tries);

 private:
    // True if the plane gave a good cut, which then is best_.
    bool try_plane(const PlaneCandidate& candidate, std::vector<CutTry>& tries);

    const Surface& surface_;
    const std::vector<char> copied_;
    const MassProperties& mass_;
    NodeId node_;
    const CutPlace& place_;
    const CutOptions& options_;
    bool record_;
    std::int64_t step_budget_;
    std::unique_ptr<Attempt> best_;
    double best_goodness_ = least_goodness;
};

bool Ladder::try_plane(const PlaneCandidate& candidate, std::vector<CutTry>& tries) {
    PlaneTrial trial(surface_, copied_, candidate, node_, options_, record_, step_budget_);
    const std::int32_t rounds = options_.contour == ContourMethod::min_cut ? options_.repairs : 0;
    for (std::int32_t repair = 0, soft = 0; repair <= rounds && soft < soft_rounds; ++repair) {
        options_.check_cancelled();
        auto attempt = std::make_unique<Attempt>(trial.attempt(repair));
        const double value = attempt->valid() ? goodness(attempt->record.quality, options_) : 0;
        const bool wanted = attempt->record.refusal == Refusal::none || value > best_goodness_;
        if (attempt->valid() && wanted) trial.complete(*attempt);
        tries.push_back(attempt->record);
        if (attempt->record.refusal == Refusal::none) {
            best_ = std::move(attempt);
            return true;
        }
        const bool more = trial.learn(*attempt);
        if (attempt->valid()) {
            ++soft;
            if (wanted) {
                best_goodness_ = value;
                best_ = std::move(attempt);
            }
        }
        if (!more) return false;
    }
    return false;
}

std::unique_ptr<Attempt> Ladder::climb(std::vector<CutTry>& tries) {
    std::vector<Vec3> directions = cut_directions(surface_, mass_, options_);
    KERF_CHECK(place_.axis >= 0 && static_cast<std::size_t>(place_.axis) < directions.size());
    std::rotate(directions.begin(), directions.begin() + place_.axis, directions.begin() + place_.axis + 1);
    std::vector<PlaneSequence> sequences;
    for (std::size_t axis = 0; axis < directions.size(); ++axis)
        sequences.emplace_back(surface_, mass_, directions[axis], static_cast<std::int32_t>(axis), place_.fraction,
                               options_);
    std::int32_t planes = 0;
    for (const bool inside : {true, false})
        for (PlaneSequence& sequence : sequences)
            for (std::size_t i = 0; const PlaneCandidate* candidate = sequence.at(i); ++i) {
                if (candidate->inside_load_window != inside) continue;
                if (step_budget_ <= 0 || (best_ && planes >= planes_before_soft)) return std::move(best_);
                ++planes;
                if (try_plane(*candidate, tries)) return std::move(best_);
            }
    return std::move(best_);
}

}  // namespace

Bisection bisect(const Surface& surface, const MassProperties& mass, NodeId node, const CutPlace& place,
                 const CutOptions& options, bool record) {
    KERF_CHECK(surface.facet_count() > 0 && node >= 1);
    KERF_CHECK(place.fraction > 0 && place.fraction < 1);
    const Stopwatch stopwatch;
    Bisection result;
    Cut& cut = result.cut;
    cut.node = node;
    cut.method = options.contour;
    cut.place = place;
    const std::unique_ptr<Attempt> accepted = Ladder(surface, mass, node, place, options, record).climb(cut.tries);
    if (accepted) {
        cut.hash = hash_of(*accepted);
        cut.strategy = strategy_of(accepted->record);
        cut.plane = accepted->record.plane;
        cut.quality = accepted->record.quality;
        cut.section_area = accepted->section_area;
        cut.interface = std::move(accepted->interface);
        cut.interface_area = interface_area(cut.interface);
        cut.loops = std::move(accepted->loops);
        describe_contour(surface, cut);
        if (record) {
            cut.side = std::move(accepted->side);
            cut.stages = std::move(accepted->stages);
        }
        result.halves = std::move(accepted->halves);
    }
    cut.seconds = stopwatch.seconds();
    return result;
}

}  // namespace kerf
