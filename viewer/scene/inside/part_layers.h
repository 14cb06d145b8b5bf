// The layers of tetrahedra: boundaries of parts where nothing else is seen of them, cells where one looks into them.
#pragma once

#include "viewer/scene/inside/cell_shapes.h"
#include "viewer/scene/inside/solution_layers.h"
#include "viewer/scene/inside/surface_layers.h"

namespace kerf::view {

/// Returns the fill for a colouring by values of cells.
Fill fill_of_values(ColorBy color);

/// Adds the cells of parts into which one looks.
class CellLayers {
 public:
    CellLayers(const SceneContext& context, LayerSink& sink) : context_(context), sink_(sink) {}

    /// Adds faces of chosen cells, and their sections; returns false if the cells are not there yet.
    bool add(NodeId part, const NodeSurface& surface);
    /// Adds a selected cell that lies inside, and makes the layers before translucent, so that it is seen through them.
    /// A cell that clip plane or filter have taken away is not added. `shown` is the surface of the node, or null.
    void add_selected(const NodeSurface* shown);

 private:
    // The data from which the colours of cells are made, and the choice with views of them; neither copied nor moved.
    struct CellColors {
        CellColors() = default;
        CellColors(const CellColors&) = delete;
        CellColors& operator=(const CellColors&) = delete;

        std::shared_ptr<const std::vector<float>> values;
        SolvedNodes solved;
        std::vector<float> patches;
        std::shared_ptr<const void> source;
        Fill fill = Fill::plain;
        CellChoice choice;
    };

    bool find_colors(const std::shared_ptr<const PartCells>& cells, const NodeSurface& surface, CellColors& colors);
    std::shared_ptr<Geometry> colored_faces(const PartCells& cells, const NodeSurface& surface,
                                            std::span<const float> patches, const CellColors& colors) const;
    Layer* add_faces(LayerKind kind, const std::string& chosen, const PartCells& cells, const NodeSurface& surface,
                     CellColors& colors);
    void add_section(const PartCells& cells, const CellColors& colors);
    void number_cells(Layer& layer, const PartCells& cells, const NodeSurface& surface, const CellColors& colors) const;
    bool is_seen(const PartCells& cells, const NodeSurface& part, const NodeSurface* shown, std::int32_t cell) const;

    const SceneContext& context_;
    LayerSink& sink_;
};

/// Adds the layers of parts that have been meshed.
class PartLayers {
 public:
    PartLayers(const SceneContext& context, LayerSink& sink) : context_(context), sink_(sink), cells_(context, sink) {}

    /// Adds the parts below the node of the view; `surface` is that of the node, or null while it is being fetched.
    void add(const std::shared_ptr<const NodeSurface>& surface);

 private:
    void add_part(NodeId part);
    void add_facets(NodeId part, const std::shared_ptr<const NodeSurface>& surface, const PartFacets& chosen,
                    const SolvedNodes& solved);
    void add_outline(NodeId owner, const std::shared_ptr<const NodeSurface>& surface, const Vec3& offset);
    void mark_inside(std::size_t part_count);
    void extend_by_motion(const NodeSurface& surface, const PartSolution* solution, const Vec3& offset);

    const SceneContext& context_;
    LayerSink& sink_;
    CellLayers cells_;
};

}  // namespace kerf::view
