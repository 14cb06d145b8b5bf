// The tetrahedra: boundaries of parts as long as these are all one sees, cells where one looks into them.
#include "viewer/scene/scene_build.h"
#include "viewer/scene/selection.h"

#include <algorithm>
#include <cmath>

namespace kerf::view {

void SceneBuild::add_parts() {
    for (const NodeId part : document_.tree.parts_below(state_.node)) {
        const TreeRow* row = document_.tree.find(part);
        if (is_shown(part) && row->state == NodeState::done) add_part(part);
    }
}

namespace {

bool touches(const NodeSurface& surface, const std::array<std::int64_t, 4>& numbers) {
    return std::any_of(surface.vertex_number.begin(), surface.vertex_number.end(), [&](std::int64_t number) {
        return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
    });
}

}  // namespace

void SceneBuild::add_part(NodeId part) {
    const auto surface = session_.part_surface(part);
    if (!surface) {
        built_.pending = true;
        return;
    }
    const Vec3 offset = offset_of(part, state_.node);
    const auto solution = solution_of(part);
    const std::vector<Vec3> moved = moved_places(surface->vertices, solution.get());
    const Eigen::AlignedBox3d box = box_of(moved.empty() ? surface->vertices : moved);
    if (ring_ && !touches(*surface, *ring_) && part != state_.selection.owner) return;
    const PartFacets chosen = ring_ ? PartFacets() : chosen_facets(part, *surface);
    bool by_cells = state_.shrink > 0 || has_filter() || ring_;
    if (side_) {
        const double middle = side_->distance(box.center());
        const double half = side_->normal.cwiseAbs().dot(box.sizes()) / 2;
        if (middle - half > 0 || (state_.clip.style == ClipStyle::layer && middle + half < 0)) return;
        by_cells |= middle + half > 0;
    }
    extend_by_facets(moved.empty() ? surface->vertices : moved, surface->facets, offset);
    extend_by_motion(*surface, solution.get(), offset);
    by_cells &= chosen.all;
    if (by_cells && add_cells(part, *surface, offset)) return;
    if (by_cells) built_.pending = true;
    add_part_facets(part, surface, chosen, moved, solution);
}

void SceneBuild::add_part_facets(NodeId part, const std::shared_ptr<const NodeSurface>& surface,
                                 const PartFacets& chosen, const std::vector<Vec3>& moved,
                                 const std::shared_ptr<const PartSolution>& solution) {
    std::shared_ptr<const std::vector<float>> values;
    if (needs_values()) {
        values = session_.facet_values(part, state_.color);
        built_.pending |= !values;
    }
    FacetChoice choice;
    choice.smooth = state_.shading == Shading::smooth;
    const std::vector<float> patches = patch_values(*surface);
    const auto on_surface = values_on(surface);
    color_facets(*surface, on_surface.get(), patches, choice);
    if (values) choice.value = *values;
    const std::vector<float> at_vertices = values_at_vertices(surface->vertices.size(), solution.get());
    const bool shows_error = solution && state_.color == ColorBy::error;
    if (!at_vertices.empty()) choice.vertex_value = at_vertices;
    if (shows_error) choice.value = solution->error_at_facet;
    choice.places = moved;
    const NodesOnEdges edges = nodes_on_edges(surface->edges, solution.get());
    choice.edges = edges.drawn(surface->edges);
    extend(box_of(edges.moved.empty() ? surface->edges.places : edges.moved), offset_of(part, state_.node));
    if (!chosen.all) choice.wanted = [&](std::int32_t f) { return chosen.wants(*surface, f); };
    const std::shared_ptr<const void> source = solution     ? std::shared_ptr<const void>(solution)
                                               : values     ? std::shared_ptr<const void>(values)
                                               : on_surface ? std::shared_ptr<const void>(on_surface)
                                                            : surface;
    const bool is_colored = values || on_surface || !patches.empty() || !at_vertices.empty() || shows_error;
    const std::string key = fmt::format("part {} {} {}{}{}", part, shading_key(),
                                        is_colored ? name(state_.color) : "plain", solution_key(), chosen.key());
    const auto geometry = cache_.get(key, source, [&] { return facet_triangles(*surface, built_.frame, choice); });
    if (geometry->corners.empty()) return;
    Layer& layer = add(LayerKind::part, geometry, color_of(part), part, offset_of(part, state_.node));
    layer.closed = chosen.all;
    layer.two_sided = !chosen.all;
    if (is_glass(state_, document_, part)) make_glass(layer);
    if (values) layer.fill = fill_of_values();
    if (on_surface || shows_error || !at_vertices.empty()) layer.fill = Fill::scale;
    if (!patches.empty()) layer.fill = Fill::categories;
    layer.smooth |= geometry->has_normals;
    number_facets(layer, *surface);
}

// Of a run without cells.
void SceneBuild::add_part_surfaces() {
    for (const NodeId part : document_.tree.parts_below(state_.node)) {
        if (!is_shown(part)) continue;
        const auto surface = session_.part_surface(part);
        built_.pending |= !surface;
        const Color color = color_of(part);
        const Vec3 offset = offset_of(part, state_.node);
        if (surface && add_surface(LayerKind::part, surface, part, color, color, offset))
            add_features(surface, part, offset);
    }
}

// The values of a layer of cells are numbers of patches, unless these share few colours.
void SceneBuild::number_cells(Layer& layer, const PartCells& cells, const NodeSurface& surface,
                              const CellColors& colors) const {
    if (!numbers_patches()) return;
    std::shared_ptr<const Geometry> numbered = layer.geometry;
    if (!palette_of_patch_.empty()) {
        std::vector<float> numbers;
        for (const std::int32_t patch : surface.patch)
            numbers.push_back(patch < 0 ? std::nanf("") : static_cast<float>(patch));
        const std::vector<std::array<float, 4>> of_faces = face_values(cells, surface, numbers);
        CellChoice choice = colors.choice;
        choice.face_value = of_faces;
        numbered = cell_faces(cells, built_.frame, choice);
    }
    auto patches = std::make_shared<std::vector<std::int32_t>>();
    patches->reserve(numbered->triangle_count());
    for (std::size_t i = 0; i < numbered->corners.size(); i += 3) {
        const float value = numbered->corners[i].value;
        patches->push_back(std::isnan(value) ? -1 : static_cast<std::int32_t>(std::lround(value)));
    }
    layer.patch = std::move(patches);
}

// False if what the colours need is not there yet.
bool SceneBuild::find_cell_colors(const std::shared_ptr<const PartCells>& cells, const NodeSurface& surface,
                                  CellColors& colors) {
    if (needs_values()) colors.values = session_.cell_values(cells->part, state_.color);
    colors.solution = solution_of(cells->part);
    if ((needs_values() && !colors.values) || (needs_solution() && !colors.solution)) return false;
    colors.moved = moved_places(cells->vertices, colors.solution.get());
    colors.at_vertices = values_at_vertices(cells->vertices.size(), colors.solution.get());
    colors.patches = patch_values(surface);
    colors.source = colors.solution ? std::shared_ptr<const void>(colors.solution)
                    : colors.values ? std::shared_ptr<const void>(colors.values)
                                    : cells;
    const bool shows_error = colors.solution && state_.color == ColorBy::error;
    colors.fill = needs_values() ? fill_of_values() : colors.patches.empty() ? Fill::plain : Fill::categories;
    if (shows_error || !colors.at_vertices.empty()) colors.fill = Fill::scale;
    CellChoice& choice = colors.choice;
    choice.places = colors.moved;
    colors.edges = nodes_on_edges(cells->edges, colors.solution.get());
    choice.edges = colors.edges.drawn(cells->edges);
    choice.vertex_value = colors.at_vertices;
    if (colors.values) choice.value = *colors.values;
    if (shows_error) choice.value = colors.solution->error_of_tet;
    return true;
}

// nullptr if there are none.
Layer* SceneBuild::add_faces(LayerKind kind, const std::string& chosen, const PartCells& cells,
                             const NodeSurface& surface, const Vec3& offset, CellColors& colors) {
    const auto faces = cache_.get(
        fmt::format("{} of {} {} {}", static_cast<int>(kind), cells.part, value_key(), chosen), colors.source, [&] {
            std::vector<std::array<float, 4>> of_faces;
            if (!colors.patches.empty()) of_faces = face_values(cells, surface, colors.patches);
            CellChoice choice = colors.choice;
            choice.face_value = of_faces;
            return cell_faces(cells, built_.frame, choice);
        });
    if (faces->corners.empty()) return nullptr;
    Layer& layer = add(kind, faces, color_of(cells.part), cells.part, offset);
    layer.smooth = faces->has_normals;
    layer.fill = colors.fill;
    layer.clipped = side_ && state_.clip.style == ClipStyle::smooth;
    number_cells(layer, cells, surface, colors);
    return &layer;
}

void SceneBuild::add_section(const PartCells& cells, const Vec3& offset, const CellColors& colors) {
    const auto sections = cache_.get(fmt::format("section {} {} {}", cells.part, value_key(), clip_key(state_.shrink)),
                                     colors.source, [&] { return cell_sections(cells, built_.frame, colors.choice); });
    if (sections->corners.empty()) return;
    Layer& layer = add(LayerKind::section, sections, color_of(cells.part), cells.part, offset);
    layer.smooth = false;
    layer.fill = colors.patches.empty() ? colors.fill : Fill::plain;
    layer.clipped = false;
}

// Faces of chosen cells, and their sections; false if the cells are not there yet.
bool SceneBuild::add_cells(NodeId part, const NodeSurface& surface, const Vec3& offset) {
    const auto cells = session_.cells(part);
    CellColors colors;
    if (!cells || !find_cell_colors(cells, surface, colors)) return false;
    CellChoice& choice = colors.choice;
    if (has_filter()) choice.filter = state_.filter;
    choice.side = side_ ? &*side_ : nullptr;
    choice.style = state_.clip.style;
    std::vector<char> is_shared;  // vertices with the cell in the middle of a ring
    if (ring_) {
        for (const std::int64_t number : cells->vertex_number)
            is_shared.push_back(std::find(ring_->begin(), ring_->end(), number) != ring_->end());
        choice.wanted = [&](std::size_t t) {
            const Tetrahedron& tet = cells->tets[t];
            return std::any_of(tet.begin(), tet.end(),
                               [&](std::int32_t v) { return is_shared[static_cast<std::size_t>(v)] != 0; });
        };
    }
    if (state_.shrink > 0)  // through the gaps one sees the far side of the body, and not what lies behind it
        if (Layer* wall = add_faces(LayerKind::wall, clip_key(0), *cells, surface, offset, colors)) {
            wall->backs_only = true;
            wall->edges = false;
        }
    choice.shrink = state_.shrink;
    add_faces(LayerKind::cells, clip_key(state_.shrink), *cells, surface, offset, colors);
    if (side_ && state_.clip.style == ClipStyle::smooth) add_section(*cells, offset, colors);
    return true;
}

void SceneBuild::add_tetrahedra(const std::shared_ptr<const NodeSurface>& surface) {
    const bool wants_ring = state_.neighbours && state_.selection.kind == Selection::Kind::cell;
    if (wants_ring) ring_ = selected_cell(session_, state_.selection);
    built_.pending |= wants_ring && !ring_;
    add_parts();
    show_selected_cell(surface.get());
    if (!ring_ && !has_filter()) return;
    if (state_.explode > 0) {
        for (const NodeId part : document_.tree.parts_below(state_.node))
            if (const auto own = is_shown(part) ? session_.part_surface(part) : nullptr)
                add_outline(part, own, offset_of(part, state_.node));
    } else if (surface) {
        add_outline(state_.node, surface, Vec3::Zero());
    }
}

// Where the cells that are left lie: sharp edges, and the far side as glass, which covers no cell.
void SceneBuild::add_outline(NodeId owner, const std::shared_ptr<const NodeSurface>& surface, const Vec3& offset) {
    extend(box_of(surface->vertices), offset);
    const auto lines = cache_.get(fmt::format("features of {}", owner), surface,
                                  [&] { return segments(feature_edges(*surface), built_.frame); });
    if (!lines->segments.empty()) {
        Layer& layer = add(LayerKind::outline, lines, colors_.feature, owner, offset);
        layer.pixels = thin_pixels;
        layer.clipped = false;
    }
    FacetChoice choice;
    choice.smooth = true;
    const auto facets = cache_.get(fmt::format("glass of {}", owner), surface,
                                   [&] { return facet_triangles(*surface, built_.frame, choice); });
    Layer& layer = add(LayerKind::glass, facets, colors_.context, owner, offset);
    layer.opacity = context_opacity;
    layer.edges = layer.clipped = false;
    layer.front_share = 0;
    layer.smooth = layer.two_sided = true;
}

// From somewhere: a cell at the surface, unless that is the wall of a void, and whatever is drawn as a cell.
bool SceneBuild::is_seen(const PartCells& cells, const NodeSurface& part, const NodeSurface* shown,
                         std::int32_t cell) const {
    for (const Layer& layer : built_.scene.layers) {
        if (layer.backs_only || layer.owner != cells.part) continue;
        const auto& element = layer.geometry->element;
        if (layer.kind != LayerKind::part) {
            if (std::find(element.begin(), element.end(), cell) != element.end()) return true;
        } else if (state_.explode > 0) {
            const auto& tets = cells.tet_at_facet;
            if (std::find(tets.begin(), tets.end(), cell) != tets.end()) return true;
        } else if (shown && direction_to_cell(cells, part, *shown, cell, Vec3::UnitZ())) {
            return true;
        }
    }
    return false;
}

// A selected cell that lies inside is seen through the others. What clip plane or filter have taken away stays away.
void SceneBuild::show_selected_cell(const NodeSurface* shown) {
    const Selection& s = state_.selection;
    if (s.kind != Selection::Kind::cell || !lies_below(s.owner, state_.node) || !is_shown(s.owner)) return;
    const auto cells = session_.cells(s.owner);
    const auto surface = session_.part_surface(s.owner);
    built_.pending |= !cells || !surface;
    if (!cells || !surface || s.index < 0 || static_cast<std::size_t>(s.index) >= cells->tets.size()) return;
    if (is_seen(*cells, *surface, shown, s.index)) return;
    CellColors colors;
    if (!find_cell_colors(cells, *surface, colors)) {
        built_.pending = true;
        return;
    }
    Vec3 center = Vec3::Zero();
    for (const std::int32_t v : cells->tets[static_cast<std::size_t>(s.index)])
        center += cells->vertices[static_cast<std::size_t>(v)] / 4;
    const auto index = static_cast<std::size_t>(s.index);
    if (has_filter() && colors.values) {
        const double value = (*colors.values)[index];
        if (value < state_.filter->low || value > state_.filter->high) return;
    }
    if (side_ && side_->distance(center) > 0) return;
    for (Layer& layer : built_.scene.layers)
        if (!layer.geometry->corners.empty() && !layer.backs_only) {
            layer.opacity = ring_ ? glass_opacity : context_opacity;
            layer.edges = layer.edges && ring_;
            layer.two_sided = true;
        }
    colors.choice.wanted = [&](std::size_t t) { return t == index; };
    add_faces(LayerKind::selected_cell, fmt::format("{} of {}", s.index, s.owner), *cells, *surface,
              offset_of(s.owner, state_.node), colors);
}

}  // namespace kerf::view
