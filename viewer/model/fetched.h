// What is asked for of a document is fetched in the background, and kept in a bounded memory.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "viewer/model/background.h"
#include "viewer/model/part_files.h"
#include "viewer/model/shown.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Returns what is in memory, or nullptr, and then fetches it: Session::poll() says when it is there. The least
/// recently used leave the memory.
class Fetched {
 public:
    Fetched(Background& background, Shown& shown) : background_(background), shown_(shown) {}

    /// The closed surface of a node: of a trace by its cuts, of a run folder from the surfaces of its parts.
    /// not_remeshed: where Document::remeshed, the surface as the file has it, repaired. not_repaired:
    /// Document::unrepaired.
    std::shared_ptr<const NodeSurface> surface(NodeId node);
    /// The closed surface of a part of the run folder.
    std::shared_ptr<const NodeSurface> part_surface(NodeId part);
    /// The deviation of the facets of a surface that was given here, or the size at its vertices; nullptr, too, where
    /// the surface was neither remeshed nor repaired, or no size was asked for. What was repaired deviates from the
    /// file, what was remeshed from what it was before.
    std::shared_ptr<const SurfaceValues> values_on(const std::shared_ptr<const NodeSurface>& surface, ColorBy color);
    /// The tetrahedra of a part of the run folder.
    std::shared_ptr<const PartCells> cells(NodeId part);
    /// A measure of every cell of a part. `color` must be a measure, `kind` (1 at an interface, else 0),
    /// or `origin` (the number of the CellOrigin).
    std::shared_ptr<const std::vector<float>> cell_values(NodeId part, ColorBy color);
    /// The same for the cells behind the facets of a part's surface; reads no more than these values of the file where
    /// it holds them.
    std::shared_ptr<const std::vector<float>> facet_values(NodeId part, ColorBy color);
    /// The `count` worst cells of the run by a measure, worst first: the smallest angle and shape, else the largest.
    std::shared_ptr<const std::vector<WorstCell>> worst_cells(ColorBy color, std::size_t count);
    /// What the solution that is open has found in a part, in the case of this number.
    std::shared_ptr<const PartSolution> solution(NodeId part, std::size_t number);
    /// Something that was asked for is being fetched.
    bool pending() const { return !fetching_.empty(); }

    // What follows is for the other parts of a session.

    /// What was asked for so long ago may leave the memory. Once a frame.
    void next_frame();
    /// What is under way is of a tree or of files that are there no more; what is in memory stays.
    void restart();
    /// Nothing stays but the document.
    void forget();
    /// It is made anew when it is asked for.
    void drop(const Store::Key& key);
    /// The nodes are those of a trace. Vertices and facets have other numbers there than in a run folder.
    void use_trace(std::shared_ptr<const Trace> trace);
    /// The surfaces of all nodes of the trace, if there is one, as far as there is room.
    void prefetch_surfaces();

 private:
    // What a work has made, and what runs when it is kept; may be empty.
    template <class T>
    struct Made {
        T value;
        Loader::Completion also;
        Made(T made, Loader::Completion then = {}) : value(std::move(made)), also(std::move(then)) {}
    };
    template <class T, class Make>
    std::shared_ptr<const T> fetch(const Store::Key& key, Make make);
    template <class T>
    std::shared_ptr<const T> kept(const Store::Key& key);
    template <class Read>
    std::shared_ptr<const std::vector<float>> values(Store::Kind kind, NodeId part, ColorBy color, Read read);
    std::shared_ptr<const NodeSurface> compared_with(const std::shared_ptr<const NodeSurface>& surface,
                                                     const std::shared_ptr<const NodeSurface>& whole);
    Loader::Completion fill_row(NodeId node, const Surface& surface);
    bool is_meshed(NodeId part) const;
    PartSource source_of(NodeId part) const;

    Background& background_;
    Shown& shown_;
    bool asked_ = false;  // something was, in this frame
    bool told_of_full_store_ = false;
    std::set<Store::Key> fetching_, failed_;
};

}  // namespace kerf::view
