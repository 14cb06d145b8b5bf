// Data of a document that are fetched in the background when they are asked for, and kept in a bounded memory.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "viewer/model/inside/background.h"
#include "viewer/model/inside/part_files.h"
#include "viewer/model/inside/shown.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Each query returns a value that is in memory, or else nullptr, and then has the value fetched: Session::poll() says
/// when it is there. The least recently used values leave the memory.
class Fetched {
 public:
    Fetched(Background& background, Shown& shown) : background_(background), shown_(shown) {}

    /// Returns the closed surface of a node, made by the cuts of a trace or joined from the surfaces of the parts of a
    /// run folder. For not_remeshed it is the surface as the file has it, repaired, where Document::remeshed; for
    /// not_repaired that of Document::unrepaired.
    std::shared_ptr<const NodeSurface> surface(NodeId node);
    /// Returns whether a node is a part of the run folder whose file could be read, as far as it was tried.
    bool has_part_surface(NodeId node) const;
    /// Returns the closed surface of a part of the run folder.
    std::shared_ptr<const NodeSurface> part_surface(NodeId part);
    /// Returns the deviation of the facets of a surface that this class has returned, or the size at its vertices;
    /// nullptr, too, where the surface was neither remeshed nor repaired, or no size was asked for. A repaired surface
    /// deviates from that of the file, a remeshed one from the surface before remeshing.
    std::shared_ptr<const SurfaceValues> values_on(const std::shared_ptr<const NodeSurface>& surface, ColorBy color);
    /// Returns the tetrahedra of a part of the run folder.
    std::shared_ptr<const PartCells> cells(NodeId part);
    /// Returns a value of every cell of a part. `color` must be a measure, `kind` (1 at an interface, else 0),
    /// or `origin` (the number of the CellOrigin).
    std::shared_ptr<const std::vector<float>> cell_values(NodeId part, ColorBy color);
    /// Returns the value, as cell_values() has it, of the cell behind every facet of a part's surface. Where the file
    /// holds the values, no more than these is read.
    std::shared_ptr<const std::vector<float>> facet_values(NodeId part, ColorBy color);
    /// Returns the `count` worst cells of the run by a measure, worst first. The smallest angles and shapes are the
    /// worst, but the largest values of other measures.
    std::shared_ptr<const std::vector<WorstCell>> worst_cells(ColorBy color, std::size_t count);
    /// Returns the values of the open solution in a part, for the case of this number.
    std::shared_ptr<const PartSolution> solution(NodeId part, std::size_t number);
    /// Returns whether something that was asked for is being fetched.
    bool pending() const { return !fetching_.empty(); }

    // The functions below are for the other parts of a session.

    /// Begins a frame: values that were asked for neither in it nor in the frame before may leave the memory.
    void next_frame();
    /// Drops the fetches under way, because they belong to a tree or files that are there no more; values in memory
    /// stay.
    void restart();
    /// Drops everything but the document.
    void forget();
    /// Drops a value, which is made anew when it is asked for.
    void drop(const Store::Key& key);
    /// Takes nodes and their surfaces from a trace from now on. Surfaces in memory are dropped, because vertices and
    /// facets have other numbers in a trace than in a run folder.
    void use_trace(std::shared_ptr<const Trace> trace);
    /// Fetches the surfaces of all nodes of the trace, if there is one, as far as there is room.
    void prefetch_surfaces();

 private:
    // The value that a work has made, and a function, perhaps empty, that runs once the value is kept.
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
    bool asked_ = false;  // something was asked for in this frame
    bool told_of_full_store_ = false;
    std::set<Store::Key> fetching_, failed_;
};

}  // namespace kerf::view
