// Attempts at a cut along one plane: contour, interface, judgement, local repair.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "cut/cut/inside/acceptance.h"
#include "cut/cut/inside/band.h"
#include "cut/cut/inside/contour_layout.h"
#include "cut/cut/inside/interface.h"
#include "cut/cut/inside/plane.h"

namespace kerf {

/// The result of one try. It has no labels, as those of facets off the band follow from the plane.
struct Attempt {
    CutTry record;
    Array<Facet, Side> side;  ///< set by complete(), with a listener
    std::vector<std::vector<Vertex>> loops;
    Interface interface;
    ContourStages stages;
    double section_area = 0;
    std::array<Surface, 2> halves;
    FileHash hash = {0, 0};      ///< set by complete()
    std::vector<Vertex> failed;  ///< vertices at which the attempt failed

    bool valid() const { return record.refusal == Refusal::none || record.refusal == Refusal::soft; }
};

/// Returns the smallest measure over its threshold; 1 and more is good.
double goodness(const InterfaceQuality& quality, const CutOptions& options);

/// One plane and its rounds of local repair.
class PlaneTrial {
 public:
    /// `copied` are the copied_vertices() of the surface, `step_budget` is that of the minimum cuts of all planes. All
    /// arguments must outlive the trial. O(#V + #F).
    PlaneTrial(const Surface& surface, const Array<Vertex, char>& copied, const PlaneCandidate& candidate, NodeId node,
               const CutOptions& options, bool record, std::int64_t& step_budget)
        : surface_(surface),
          copied_(copied),
          candidate_(candidate),
          node_(node),
          options_(options),
          record_(record),
          step_budget_(step_budget),
          band_(make_band(surface, candidate.plane)),
          side_(band_.majority),
          penalty_(band_.facets.size(), 1),
          hits_(band_.vertices.size(), 0) {}

    /// Finds a contour and its interface, and judges it; makes no halves.
    Attempt attempt(std::int32_t repair);
    /// Builds the halves of the last attempt, if it is valid, or refuses it.
    void complete(Attempt& attempt) const;
    /// Makes facets at the places where the attempt failed more expensive. Returns false if there is nothing to repair.
    bool learn(const Attempt& attempt);

 private:
    void refuse(Attempt& attempt, Refusal refusal, std::vector<Vertex> vertices) const;
    bool label_facets(Attempt& attempt);
    FileHash hash_of(const Attempt& attempt) const;
    bool find_contour(Attempt& attempt);
    struct Spanned {
        Interface interface;
        Verdict verdict;
    };
    Spanned judge(Interface interface) const;
    Spanned better(Spanned first, Spanned second) const;
    Spanned span(const Attempt& attempt, ContourLayout layout, const std::atomic<bool>& is_settled) const;
    void span_interface(Attempt& attempt) const;
    void raise_penalty();

    const Surface& surface_;
    const Array<Vertex, char>& copied_;  // vertices with a copy, or empty
    const PlaneCandidate& candidate_;
    NodeId node_;
    const CutOptions& options_;
    bool record_;
    std::int64_t& step_budget_;  // shared by the minimum cuts of all planes
    Band band_;
    Array<Facet, Side> side_;              // labels of the last attempt
    std::vector<double> penalty_;          // per band facet
    std::vector<std::int32_t> hits_;       // per band vertex
    std::vector<std::size_t> bad_facets_;  // of the band, around the places of the last failure
    double penalty_factor_ = 1;
    std::vector<SurfaceEdge> last_contour_;
    std::vector<std::vector<Vertex>> last_loops_;
    std::vector<Vertex> last_failed_;
    int stalled_ = 0;  // rounds that ended like the one before
};

}  // namespace kerf
