// Cells are drawn as faces of the chosen ones (cell_shapes.h), in layers of their own: `cells`, the `section` of a
// smooth clip plane, a `wall` of backs behind shrunk cells, through whose gaps the far side of the body is seen and not
// the ground, and the selected cell. The colours of all of these come from one CellColors, which holds the values alive
// that its choice has spans of. Geometry is cached by a key with all that it depends on, but for its source: the
// solution, the values or the cells, in this order. A selected cell is added only if no layer shows it; then all layers
// of triangles that are there become translucent, so that it comes after all other cells. Where patches share colours,
// the values of faces are colours, and the numbers of patches are found by making the faces again with these.
#include <algorithm>
#include <cmath>

#include "viewer/scene/inside/part_layers.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

Fill fill_of_values(ColorBy color) { return is_kind(color) ? Fill::categories : Fill::scale; }

// Returns false if data that the colours need are not there yet.
bool CellLayers::find_colors(const std::shared_ptr<const PartCells>& cells, const NodeSurface& surface,
                             CellColors& colors) {
    const ColorBy color = context_.state.coloring.by;
    const bool needs_values = context_.needs_values();
    if (needs_values) colors.values = context_.session.fetched().cell_values(cells->part, color);
    colors.solved = SolvedNodes(context_, sink_, cells->part, cells->vertices, cells->edges);
    const SolvedNodes& solved = colors.solved;
    if ((needs_values && !colors.values) || (context_.needs_solution() && !solved.found)) return false;
    colors.patches = context_.patch_values(surface);
    colors.source = solved.found    ? std::shared_ptr<const void>(solved.found)
                    : colors.values ? std::shared_ptr<const void>(colors.values)
                                    : cells;
    const bool shows_error = solved.found && color == ColorBy::error;
    colors.fill = needs_values ? fill_of_values(color) : colors.patches.empty() ? Fill::plain : Fill::categories;
    if (shows_error || !solved.at_vertices.empty()) colors.fill = Fill::scale;
    CellChoice& choice = colors.choice;
    choice.places = solved.moved;
    choice.edges = solved.drawn(cells->edges);
    choice.vertex_value = solved.at_vertices;
    if (colors.values) choice.value = *colors.values;
    if (shows_error) choice.value = solved.found->error_of_tet;
    return true;
}

std::shared_ptr<Geometry> CellLayers::colored_faces(const PartCells& cells, const NodeSurface& surface,
                                                    std::span<const float> patches, const CellColors& colors) const {
    std::vector<std::array<float, 4>> of_faces;
    if (!patches.empty()) of_faces = face_values(cells, surface, patches);
    CellChoice choice = colors.choice;
    choice.face_value = of_faces;
    return cell_faces(cells, context_.frame, choice);
}

// Returns nullptr if there are no such faces.
Layer* CellLayers::add_faces(LayerKind kind, const std::string& chosen, const PartCells& cells,
                             const NodeSurface& surface, CellColors& colors) {
    const std::string key =
        fmt::format("{} of {} {} {}", static_cast<int>(kind), cells.part.value(), context_.value_key(), chosen);
    const auto faces =
        context_.cache.get(key, colors.source, [&] { return colored_faces(cells, surface, colors.patches, colors); });
    if (faces->corners.empty()) return nullptr;
    Layer& layer = sink_.add(kind, faces, context_.color_of(cells.part), cells.part, context_.offset_of(cells.part));
    layer.smooth = faces->has_normals;
    layer.fill = colors.fill;
    layer.clipped = context_.side && context_.state.clip.style == ClipStyle::smooth;
    number_cells(layer, cells, surface, colors);
    return &layer;
}

void CellLayers::add_section(const PartCells& cells, const CellColors& colors) {
    const std::string key = fmt::format("section {} {} {}", cells.part.value(), context_.value_key(),
                                        context_.clip_key(context_.state.explosion.shrink));
    const auto sections =
        context_.cache.get(key, colors.source, [&] { return cell_sections(cells, context_.frame, colors.choice); });
    if (sections->corners.empty()) return;
    Layer& layer = sink_.add(LayerKind::section, sections, context_.color_of(cells.part), cells.part,
                             context_.offset_of(cells.part));
    layer.smooth = false;
    layer.fill = colors.patches.empty() ? colors.fill : Fill::plain;
    layer.clipped = false;
}

// The values of a layer of cells are numbers of patches, unless these share few colours.
void CellLayers::number_cells(Layer& layer, const PartCells& cells, const NodeSurface& surface,
                              const CellColors& colors) const {
    if (!context_.shows_patches()) return;
    std::shared_ptr<const Geometry> numbered = layer.geometry;
    if (!context_.palette_of_patch.empty()) {
        std::vector<float> numbers;
        for (const std::int32_t patch : surface.patch) numbers.push_back(patch < 0 ? std::nanf("") : patch);
        numbered = colored_faces(cells, surface, numbers, colors);
    }
    auto patches = std::make_shared<std::vector<std::int32_t>>();
    patches->reserve(numbered->triangle_count());
    for (std::size_t i = 0; i < numbered->corners.size(); i += 3) {
        const float value = numbered->corners[i].value;
        patches->push_back(std::isnan(value) ? -1 : static_cast<std::int32_t>(std::lround(value)));
    }
    layer.patch = std::move(patches);
}

bool CellLayers::add(NodeId part, const NodeSurface& surface) {
    const ViewState& state = context_.state;
    const auto& ring = context_.ring;
    const auto cells = context_.session.fetched().cells(part);
    CellColors colors;
    if (!cells || !find_colors(cells, surface, colors)) return false;
    CellChoice& choice = colors.choice;
    if (context_.has_filter()) choice.filter = state.coloring.filter;
    choice.side = context_.side ? &*context_.side : nullptr;
    choice.style = state.clip.style;
    std::vector<char> is_shared;  // vertices with the cell in the middle of a ring
    if (ring) {
        for (const std::int64_t number : cells->vertex_number)
            is_shared.push_back(std::find(ring->begin(), ring->end(), number) != ring->end());
        choice.wanted = [&](std::size_t t) {
            const Tetrahedron& tet = cells->tets[t];
            return std::any_of(tet.begin(), tet.end(), [&](std::int32_t v) { return is_shared[v] != 0; });
        };
    }
    if (state.explosion.shrink > 0)  // through the gaps the far side of the body is seen, and not the ground behind it
        if (Layer* wall = add_faces(LayerKind::wall, context_.clip_key(0), *cells, surface, colors)) {
            wall->backs_only = true;
            wall->edges = false;
        }
    choice.shrink = state.explosion.shrink;
    add_faces(LayerKind::cells, context_.clip_key(state.explosion.shrink), *cells, surface, colors);
    if (context_.side && state.clip.style == ClipStyle::smooth) add_section(*cells, colors);
    return true;
}

// Whether a cell is seen from somewhere: at the surface, unless that is the wall of a void, or drawn as a cell.
bool CellLayers::is_seen(const PartCells& cells, const NodeSurface& part, const NodeSurface* shown,
                         std::int32_t cell) const {
    for (const Layer& layer : sink_.layers()) {
        if (layer.backs_only || layer.owner != cells.part) continue;
        const auto& element = layer.geometry->element;
        if (layer.kind != LayerKind::part) {
            if (std::find(element.begin(), element.end(), cell) != element.end()) return true;
        } else if (context_.state.explosion.amount > 0) {
            const auto& tets = cells.tet_at_facet;
            if (std::find(tets.begin(), tets.end(), cell) != tets.end()) return true;
        } else if (shown && direction_to_cell(cells, part, *shown, cell, Vec3::UnitZ())) {
            return true;
        }
    }
    return false;
}

void CellLayers::add_selected(const NodeSurface* shown) {
    const ViewState& state = context_.state;
    const Selection& s = state.selection;
    if (s.kind != Selection::Kind::cell || !lies_below(s.owner, state.node) || !context_.is_shown(s.owner)) return;
    const auto cells = sink_.awaited(context_.session.fetched().cells(s.owner));
    const auto surface = sink_.awaited(context_.session.fetched().part_surface(s.owner));
    const std::size_t index = s.index;
    if (!cells || !surface || s.index < 0 || index >= cells->tets.size()) return;
    if (is_seen(*cells, *surface, shown, s.index)) return;
    CellColors colors;
    if (!sink_.awaited(find_colors(cells, *surface, colors))) return;
    Vec3 center = Vec3::Zero();
    for (const std::int32_t v : cells->tets[index]) center += cells->vertices[v] / 4;
    if (context_.has_filter() && colors.values) {
        const double value = (*colors.values)[index];
        if (value < state.coloring.filter->low || value > state.coloring.filter->high) return;
    }
    if (context_.side && context_.side->distance(center) > 0) return;
    for (Layer& layer : sink_.layers())
        if (!layer.geometry->corners.empty() && !layer.backs_only) {
            layer.opacity = context_.ring ? glass_opacity : context_opacity;
            layer.edges = layer.edges && context_.ring;
            layer.two_sided = true;
        }
    colors.choice.wanted = [&](std::size_t t) { return t == index; };
    add_faces(LayerKind::selected_cell, std::to_string(s.index), *cells, *surface, colors);
}

}  // namespace kerf::view
