// The ladder. Planes come in their order: first those between bodies, then for each direction the bisection and its
// steps, within the load window, at last those outside of it. Each plane gets rounds of local repair (plane_trial.h)
// until a cut is good, or, once there is a fair one, until some rounds in a row have bettered nothing; the best of the
// valid but soft cuts is kept and taken when a few planes have given nothing better. Two budgets for all planes of a
// node bound the time: steps of the minimum cuts, and places where interfaces have met the surface. Both count work,
// not seconds, so that the result is the same on every machine.
#include "cut/cut/bisect.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "base/core/check.h"
#include "base/core/stopwatch.h"
#include "cut/cut/inside/interface.h"
#include "cut/cut/inside/plane.h"
#include "cut/cut/inside/plane_trial.h"
#include "surface/complex/touching.h"

namespace kerf {

namespace {

constexpr double least_goodness = 0.02;         // worse cuts make tetrahedra that are of no use
constexpr std::int32_t planes_before_soft = 3;  // tried before a soft cut is good enough
constexpr std::int32_t soft_rounds = 6;         // of local repair of a valid cut
constexpr std::int32_t vain_rounds = 4;         // in a row that better nothing of the plane, if there is a fair cut
constexpr double fair_goodness = 0.5;

// Bound of the steps of all minimum cuts of a node: well-shaped surfaces rarely need a hundredth of it, slivers would
// take minutes. It halves from level to level, so that the levels together take no more than twice the first, and does
// not grow with surfaces of millions of facets, whose bands do not.
std::int64_t flow_step_budget(NodeId node, std::int32_t facets) {
    constexpr std::int64_t most_steps = 2'000'000'000;
    return 5'000'000 + (std::min(3'000 * static_cast<std::int64_t>(facets), most_steps) >> level_of(node));
}

// Bound of the places of all tries of a node where an interface met the surface, a few of each try not counted. A plane
// through hundreds of voids meets all of them that bulge through it: repairs do not end, and the next plane is no
// better.
constexpr std::int64_t ordinary_collisions = 64, most_collisions = 3'000;

std::int64_t extra_collisions(const Attempt& attempt) {
    if (attempt.record.refusal != Refusal::intersection) return 0;
    return std::max<std::int64_t>(0, std::ssize(attempt.failed) - ordinary_collisions);
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
    const Array<Vertex, char> copied_;
    const MassProperties& mass_;
    NodeId node_;
    const CutPlace& place_;
    const CutOptions& options_;
    bool record_;
    std::int64_t step_budget_, collision_budget_ = most_collisions;
    std::unique_ptr<Attempt> best_;
    double best_goodness_ = least_goodness;
};

bool Ladder::try_plane(const PlaneCandidate& candidate, std::vector<CutTry>& tries) {
    PlaneTrial trial(surface_, copied_, candidate, node_, options_, record_, step_budget_);
    const std::int32_t rounds = options_.contour == ContourMethod::min_cut ? options_.repairs : 0;
    double best_of_plane = 0;
    for (std::int32_t repair = 0, soft = 0, vain = 0; repair <= rounds && soft < soft_rounds; ++repair) {
        options_.check_cancelled();
        auto attempt = std::make_unique<Attempt>(trial.attempt(repair));
        collision_budget_ -= extra_collisions(*attempt);
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
        vain = value > best_of_plane ? 0 : vain + 1;
        best_of_plane = std::max(best_of_plane, value);
        if (!more || collision_budget_ <= 0 || (best_goodness_ >= fair_goodness && vain >= vain_rounds)) return false;
    }
    return false;
}

std::unique_ptr<Attempt> Ladder::climb(std::vector<CutTry>& tries) {
    std::vector<Vec3> directions = cut_directions(surface_, mass_, options_);
    KERF_CHECK(place_.axis >= 0 && place_.axis < count_of(directions));
    std::rotate(directions.begin(), directions.begin() + place_.axis, directions.begin() + place_.axis + 1);
    std::vector<PlaneSequence> sequences;
    for (std::int32_t axis = 0; axis < count_of(directions); ++axis)
        sequences.emplace_back(surface_, mass_, directions[axis], axis, place_.fraction, options_);
    for (const PlaneSequence& sequence : sequences)
        if (const std::optional<PlaneCandidate> between = sequence.between_bodies())
            if (try_plane(*between, tries)) return std::move(best_);
    std::int32_t planes = 0;
    for (const bool inside : {true, false})
        for (PlaneSequence& sequence : sequences)
            for (std::size_t i = 0; const PlaneCandidate* candidate = sequence.at(i); ++i) {
                if (candidate->inside_load_window != inside) continue;
                if (step_budget_ <= 0 || collision_budget_ <= 0 || (best_ && planes >= planes_before_soft))
                    return std::move(best_);
                ++planes;
                if (try_plane(*candidate, tries)) return std::move(best_);
            }
    return std::move(best_);
}

}  // namespace

Bisection bisect(const Surface& surface, const MassProperties& mass, NodeId node, const CutPlace& place,
                 const CutOptions& options, bool record) {
    KERF_CHECK(surface.facet_count() > 0 && node >= root_node);
    KERF_CHECK(place.fraction > 0 && place.fraction < 1);
    const Stopwatch stopwatch;
    Bisection result;
    Cut& cut = result.cut;
    cut.node = node;
    cut.method = options.contour;
    cut.place = place;
    const std::unique_ptr<Attempt> accepted = Ladder(surface, mass, node, place, options, record).climb(cut.tries);
    if (accepted) {
        cut.hash = accepted->hash;
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
