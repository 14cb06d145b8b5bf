// How SceneBuilder makes a scene: only for the files of this folder.
#pragma once

#include <map>
#include <set>

#include <fmt/format.h>

#include "viewer/model/shown_parts.h"
#include "viewer/model/surface_values.h"
#include "viewer/model/timeline.h"
#include "viewer/scene/arrows.h"
#include "viewer/scene/cell_shapes.h"
#include "viewer/scene/colors.h"
#include "viewer/scene/scene_builder.h"

namespace kerf::view {

/// Halves of a cut: not the colour of interfaces.
inline Color half_color(NodeId half) { return category_color(half % 2 == 0 ? 0 : 2); }

inline constexpr float contour_pixels = 3.5f, thin_pixels = 1.5f, feature_pixels = 2.2f, place_pixels = 9;

inline constexpr float context_opacity = 0.22f, glass_opacity = 0.3f;

/// One scene under construction. Its layers come from several files: cut_layers, part_layers, region_layers,
/// defect_layers, legend.
class SceneBuild {
 public:
    SceneBuild(const ViewState& state, Session& session, GeometryCache& cache)
        : state_(state),
          session_(session),
          document_(session.document()),
          cache_(cache),
          colors_(scene_colors(state.theme)) {}

    BuiltScene run();

 private:
    // Nodes on edges as they are drawn: where they move, and their values.
    struct NodesOnEdges {
        std::vector<Vec3> moved;
        std::vector<float> value;

        DrawnEdges drawn(const EdgePoints& edges) const {
            return {moved.empty() ? std::span<const Vec3>(edges.places) : moved, edges.places, value};
        }
    };

    // What the colours of cells are made from, and the choice that looks at it; it stays where it is.
    struct CellColors {
        CellColors() = default;
        CellColors(const CellColors&) = delete;
        CellColors& operator=(const CellColors&) = delete;

        std::shared_ptr<const std::vector<float>> values;
        std::shared_ptr<const PartSolution> solution;
        std::vector<Vec3> moved;
        std::vector<float> at_vertices, patches;
        NodesOnEdges edges;
        std::shared_ptr<const void> source;
        Fill fill = Fill::plain;
        CellChoice choice;
    };

    // Which facets of a part's surface are drawn where not all are: walls alone, or those of a region of glass.
    struct PartFacets {
        bool all = true;
        bool outer = true;          // what no other part lies behind
        std::set<NodeId> left_out;  // parts, of which those in front are not drawn

        bool wants(const NodeSurface& surface, std::int32_t facet) const {
            const std::int32_t neighbour = surface.neighbour[static_cast<std::size_t>(facet)];
            return neighbour < 0 ? outer : !left_out.contains(neighbour);
        }
        std::string key() const {
            return all ? "" : fmt::format(" {}without {}", outer ? "" : "outer, ", fmt::join(left_out, " "));
        }
    };

    Layer& add(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color, NodeId owner = 0,
               const Vec3& offset = Vec3::Zero());
    Layer& add_lines(LayerKind kind, const std::vector<std::array<Vec3, 2>>& ends, const Color& color, float pixels);
    void add_points(LayerKind kind, const std::vector<Vec3>& places, const Color& color, float pixels);
    Layer* add_surface(LayerKind kind, const std::shared_ptr<const NodeSurface>& surface, NodeId owner,
                       const Color& color, const Color& interface_color, const Vec3& offset);
    void add_node(const std::shared_ptr<const NodeSurface>& surface);
    void add_file_surface(NodeId which);
    void add_features(const std::shared_ptr<const NodeSurface>& surface, NodeId owner, const Vec3& offset);
    void add_context();
    void add_defects(const CheckedSoup* found);
    void add_axes(const TreeRow& row);
    void add_plane(const Plane& plane);
    void add_try(const CutTry& attempt, const NodeSurface& surface);
    void add_collisions(const CutTry& attempt);
    void add_stage(const Cut& cut, const NodeSurface& surface);
    Layer* add_contour(const Cut& cut, const NodeSurface& surface);
    void add_halves(const NodeSurface* parent);
    bool needs_solution() const {
        return document_.solution && (is_of_solution(state_.color) || state_.deform != 0 || state_.vectors);
    }
    // What was found in a part; null if nobody asks for it, or while it is being fetched.
    std::shared_ptr<const PartSolution> solution_of(NodeId part);
    std::vector<Vec3> moved_places(const std::vector<Vec3>& vertices, const PartSolution* solution) const;
    NodesOnEdges nodes_on_edges(const EdgePoints& edges, const PartSolution* solution) const;
    std::vector<float> values_at_vertices(std::size_t count, const PartSolution* solution) const;
    std::string solution_key() const {
        return needs_solution() ? fmt::format(" case {} deform {}", state_.load_case, state_.drawn_deformation()) : "";
    }
    std::size_t triangles_seen(const Layer& layer) const;
    void add_isolines();
    void add_vectors();
    void add_arrows(const NodeSurface& surface, const PartSolution& solution, const Vec3& offset,
                    std::vector<Arrow>& arrows) const;
    void extend_by_motion(const NodeSurface& surface, const PartSolution* solution, const Vec3& offset);
    void add_tetrahedra(const std::shared_ptr<const NodeSurface>& surface);
    void add_parts();
    void add_part_surfaces();
    void add_part(NodeId part);
    void add_part_facets(NodeId part, const std::shared_ptr<const NodeSurface>& surface, const PartFacets& chosen,
                         const std::vector<Vec3>& moved, const std::shared_ptr<const PartSolution>& solution);
    PartFacets chosen_facets(NodeId part, const NodeSurface& surface) const;
    bool is_met(NodeId part, NodeId neighbour) const;
    void make_glass(Layer& layer) const;
    void explain_regions();
    Color drawn_color_of(NodeId part) const;
    bool add_cells(NodeId part, const NodeSurface& surface, const Vec3& offset);
    bool find_cell_colors(const std::shared_ptr<const PartCells>& cells, const NodeSurface& surface,
                          CellColors& colors);
    Layer* add_faces(LayerKind kind, const std::string& chosen, const PartCells& cells, const NodeSurface& surface,
                     const Vec3& offset, CellColors& colors);
    void add_section(const PartCells& cells, const Vec3& offset, const CellColors& colors);
    void add_outline(NodeId owner, const std::shared_ptr<const NodeSurface>& surface, const Vec3& offset);
    void show_selected_cell(const NodeSurface* shown);
    bool is_seen(const PartCells& cells, const NodeSurface& part, const NodeSurface* shown, std::int32_t cell) const;
    void add_selection();
    void set_colors();
    void set_range(const ValueRange& range);
    void set_range_of_values();
    template <class Visit>
    void for_drawn_values(Visit visit) const;
    ValueRange range_of_most_values(const ValueRange& all);
    void mark_extremes();
    void set_legend();
    std::string legend_title() const;
    std::vector<NodeId> drawn_parts() const;
    std::set<int> drawn_categories() const;
    void explain(const std::string& text, const Color& color, LegendEntry::Mark mark = LegendEntry::Mark::area);
    void explain_layer(const Layer* layer, const std::string& text, const Color& color);
    void explain_layer(LayerKind kind, const std::string& text, const Color& color) {
        explain_layer(built_.scene.find(kind), text, color);
    }
    void explain_origins();
    void explain_patches();
    void explain_parts();
    void explain_coloring();
    void explain_axes();
    void explain_interfaces();

    bool is_shown(NodeId node) const { return shows_node(state_, document_, node); }
    bool shows_parts() const { return view::shows_parts(step_.stage); }
    // Colours follow from numbers, for which there is a scale.
    bool shows_values() const {
        const bool is_of_cells = is_measure(state_.color) || (is_of_solution(state_.color) && document_.solution);
        return is_of_surface(state_.color) || (is_of_cells && step_.stage == Stage::tetrahedra);
    }
    std::shared_ptr<const SurfaceValues> values_on(const std::shared_ptr<const NodeSurface>& surface);
    void color_facets(const NodeSurface& surface, const SurfaceValues* values, const std::vector<float>& patches,
                      FacetChoice& choice) const;
    bool has_filter() const { return state_.filter && is_measure(state_.color) && !ring_; }
    bool needs_values() const { return is_measure(state_.color) || is_kind(state_.color); }
    Vec3 offset_of(NodeId part, NodeId root) const;
    Color color_of(NodeId part) const;
    Color color_of(Stage stage) const;
    Fill fill_of_values() const { return is_kind(state_.color) ? Fill::categories : Fill::scale; }
    std::string clip_key(double shrink) const;
    std::string value_key() const {
        const bool is_plain = !needs_values() && !is_of_solution(state_.color) && state_.color != ColorBy::patch;
        return (is_plain ? "plain" : name(state_.color)) + solution_key();
    }
    const char* shading_key() const { return state_.shading == Shading::smooth ? "smooth" : "flat"; }
    // By a body of which nothing is cut away.
    void extend(Eigen::AlignedBox3d box, const Vec3& offset = Vec3::Zero()) {
        if (!box.isEmpty()) built_.box.extend(box.translate(offset));
    }
    // By the facets of one that the clip plane may cut.
    void extend_by_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Vec3& offset) {
        extend(box_of(vertices), offset);
        if (!side_) return;
        Eigen::AlignedBox3d left = box_of_shown(vertices, facets, *side_, state_.clip.style);
        if (!left.isEmpty()) built_.left.extend(left.translate(offset));
    }
    std::array<float, 3> move_of(const Vec3& offset) const {
        const Eigen::Vector3f move = (offset * built_.frame.scale).cast<float>();
        return {move.x(), move.y(), move.z()};
    }
    std::vector<float> patch_values(const NodeSurface& surface) const;
    bool numbers_patches() const { return state_.numbers && state_.color == ColorBy::patch; }
    void number_facets(Layer& layer, const NodeSurface& surface) const;
    void number_cells(Layer& layer, const PartCells& cells, const NodeSurface& surface, const CellColors& colors) const;
    Color patch_color(std::size_t patch) const;
    void set_patch_palette();
    bool has_patch_colors() const {
        return state_.color == ColorBy::patch && !document_.patch_colours.empty() &&
               document_.patch_colours.size() == document_.patch_names.size();
    }

    const ViewState& state_;
    Session& session_;
    const Document& document_;
    GeometryCache& cache_;
    const SceneColors colors_;
    BuiltScene built_;
    std::optional<ShownSide> side_;
    std::optional<std::array<std::int64_t, 4>> ring_;  // global numbers of the cell whose neighbours are shown
    std::map<NodeId, std::size_t> part_order_;
    std::vector<float> palette_of_patch_;  // where colours are those of the file
    std::vector<Vec3> moves_of_regions_;   // where these are pulled apart
    Step step_;
};

}  // namespace kerf::view
