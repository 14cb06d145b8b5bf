// The facts that all makers of layers share; only for the files of this folder.
#pragma once

#include <map>

#include <fmt/format.h>

#include "viewer/model/shown_parts.h"
#include "viewer/model/timeline.h"
#include "viewer/scene/inside/colors.h"
#include "viewer/scene/inside/shapes.h"
#include "viewer/scene/scene_builder.h"

namespace kerf::view {

/// Returns the numbers of nodes as text, for keys of the cache.
template <class Nodes>
std::string numbers_text(const Nodes& nodes) {
    std::string text;
    for (const NodeId node : nodes) text += std::to_string(node.value()) + ' ';
    return text;
}

/// Returns the colour of a half of a cut, which is not that of interfaces.
inline Color half_color(NodeId half) { return category_color(side_of(half) == 0 ? 0 : 2); }

inline constexpr float contour_pixels = 3.5f, thin_pixels = 1.5f, feature_pixels = 2.2f, place_pixels = 9;

inline constexpr float context_opacity = 0.22f, glass_opacity = 0.3f;

/// The state of the view, the document, and the facts that follow from both for one scene. It changes no more once the
/// first layer is made.
class SceneContext {
 public:
    SceneContext(const ViewState& shown, Session& source, GeometryCache& geometry);

    bool is_shown(NodeId node) const { return shows_node(state, document, node); }
    bool shows_parts() const { return view::shows_parts(step.stage); }
    /// Returns whether colours follow from numbers, for which there is a scale.
    bool shows_values() const;
    bool has_filter() const { return state.coloring.filter && is_measure(state.coloring.by) && !ring; }
    bool needs_values() const { return is_measure(state.coloring.by) || is_kind(state.coloring.by); }
    bool needs_solution() const;
    bool shows_patches() const { return state.coloring.by == ColorBy::patch; }
    /// Returns the offset of a part or half of the shown node, in coordinates of the file.
    Vec3 offset_of(NodeId part) const;
    Color color_of(NodeId part) const;
    Color patch_color(std::size_t patch) const;
    /// Returns the values of facets coloured by patches, as Fill::categories wants them; empty for other colourings.
    std::vector<float> patch_values(const NodeSurface& surface) const;
    std::shared_ptr<const Geometry> feature_lines(const std::shared_ptr<const NodeSurface>& surface,
                                                  NodeId owner) const;
    // Keys of geometry in the cache, which differ where the geometry does.
    std::string clip_key(double shrink) const;
    std::string solution_key() const;
    std::string value_key() const;
    const char* shading_key() const { return state.look.shading == Shading::smooth ? "smooth" : "flat"; }

    const ViewState& state;
    Session& session;
    const Document& document;
    GeometryCache& cache;
    const SceneColors colors;
    const Frame frame;
    Step step;
    std::optional<ShownSide> side;
    std::optional<std::array<std::int64_t, 4>> ring;  ///< global numbers of the cell whose neighbours are shown
    std::vector<Color> palette;
    std::vector<float> palette_of_patch;  ///< index in the palette by patch; empty unless colours are those of the file

 private:
    void set_patch_palette();
    bool has_patch_colors() const;

    std::map<NodeId, std::int32_t> part_order_;
    Array<RegionIndex, Vec3> moves_of_regions_;  // moves of regions, where these are pulled apart
};

}  // namespace kerf::view
