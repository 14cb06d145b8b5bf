// A hit is a facet or a cell of an owner, which is a node or a part, and becomes a selection by the mode: a facet, the
// cell behind it, or the nearest of its vertices. Numbers of a selection are those of the surface that surface_of()
// returns, or those of the cells of the part; vertices inside of a part come after the vertices of its surface, so that
// both share one numbering. Every query may find that its data are still being fetched; it returns nothing then, and is
// asked again in the next frame. Neighbours of a facet, and facets around a vertex, are found by a search through the
// whole surface, which is done for the one thing that is selected.
#include "viewer/scene/selection.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/geometry/angles.h"
#include "fill/mesh/quality.h"
#include "fill/mesh/tet_mesh.h"
#include "viewer/model/line_of_sight.h"
#include "viewer/model/shown_parts.h"

namespace kerf::view {

namespace {

std::string number_text(std::int64_t number) { return number < 0 ? "new" : fmt::format("{}", number); }

template <class Indices>
std::int32_t nearest_vertex(const std::vector<Vec3>& vertices, const Indices& corners, const Vec3& point) {
    return *std::min_element(corners.begin(), corners.end(), [&](std::int32_t a, std::int32_t b) {
        return (vertices[a] - point).squaredNorm() < (vertices[b] - point).squaredNorm();
    });
}

// Facets that share two vertices with one.
std::vector<std::int32_t> neighbours_of(const NodeSurface& surface, std::size_t facet) {
    std::vector<std::int32_t> found;
    const Triangle& own = surface.facets[facet];
    for (std::int32_t f = 0; f < count_of(surface.facets); ++f) {
        const Triangle& t = surface.facets[f];
        const auto shared = std::count_if(
            t.begin(), t.end(), [&](std::int32_t v) { return std::find(own.begin(), own.end(), v) != own.end(); });
        if (shared == 2) found.push_back(f);
    }
    return found;
}

bool is_leaf(const Document& document, NodeId node) {
    const TreeRow* row = document.tree.find(node);
    return row && row->leaf();
}

// Names the region of a node, where there are several.
std::string in_region(const Document& document, NodeId node) {
    const std::string* region = region_of(document, node);
    return region ? fmt::format(" in region '{}'", *region) : "";
}

std::string owner_text(const Document& document, NodeId owner) {
    if (owner == not_remeshed) return "the surface before remeshing";
    if (owner == not_repaired) return "the surface before repairs";
    return fmt::format("{} {}{}", is_leaf(document, owner) ? "part" : "node", owner.value(),
                       in_region(document, owner));
}

// The surface to which the numbers of facets belong.
const char* numbered_surface(const Document& document, NodeId owner) {
    if (document.remeshed && owner > not_remeshed) return "remeshed surface";
    return document.unrepaired && owner != not_repaired ? "repaired surface" : "input";
}

std::string vertex_line(const char* label, std::int32_t index, std::int64_t number, const Vec3& p) {
    return fmt::format("{} {}, global {}\n{}\n", label, index, number_text(number), place_text(p));
}

std::string describe_facet(Session& session, const NodeSurface& surface, NodeId owner, std::size_t facet) {
    const Document& document = session.document();
    std::string text = fmt::format("facet {} of {}\n", facet, owner_text(document, owner));
    const std::int32_t number = surface.facet_number.empty() ? -1 : surface.facet_number[facet];
    const NodeId interface = surface.interface_of.empty() ? no_node : surface.interface_of[facet];
    if (number >= 0) text += fmt::format("facet {} of the {}\n", number, numbered_surface(document, owner));
    if (interface > no_node) text += fmt::format("interface of the cut of node {}\n", interface.value());
    if (!surface.neighbour.empty() && surface.neighbour[facet].is_valid())
        text += fmt::format("part {} behind it{}\n", surface.neighbour[facet].value(),
                            in_region(document, surface.neighbour[facet]));
    const std::int32_t patch = surface.patch.empty() ? -1 : surface.patch[facet];
    if (patch >= 0 && patch < count_of(document.patch_names))
        text += fmt::format("patch '{}'\n", document.patch_names[patch]);
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t v = surface.facets[facet][k];
        p[k] = surface.vertices[v];
        text += vertex_line("vertex", v, surface.vertex_number.empty() ? v : surface.vertex_number[v], p[k]);
    }
    text += fmt::format("area {:.6g}, smallest angle {:.2f} deg\n", (p[1] - p[0]).cross(p[2] - p[0]).norm() / 2,
                        smallest_angle_degrees(p));
    return text + fmt::format("neighbours {}\n", fmt::join(neighbours_of(surface, facet), ", "));
}

std::string describe_vertex(const NodeSurface& surface, const std::string& owner, std::int32_t vertex) {
    std::string text = fmt::format("vertex {} of {}\n", vertex, owner);
    if (!surface.vertex_number.empty())
        text += fmt::format("global number {}\n", number_text(surface.vertex_number[vertex]));
    text += place_text(surface.vertices[vertex]) + "\n";
    std::vector<std::size_t> facets;
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        if (std::find(surface.facets[f].begin(), surface.facets[f].end(), vertex) != surface.facets[f].end())
            facets.push_back(f);
    return text + fmt::format("{} facets around it: {}\n", facets.size(), fmt::join(facets, ", "));
}

std::string describe_cell(const Document& document, const PartCells& cells, std::size_t cell) {
    std::string text = fmt::format("cell {} of {}\n", cell, owner_text(document, cells.part));
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t v = cells.tets[cell][k];
        p[k] = cells.vertices[v];
        text += vertex_line("vertex", v, cells.vertex_number[v], p[k]);
    }
    std::vector<std::string> neighbours;
    for (const CellId n : cells.neighbours[cell])
        neighbours.push_back(n.is_valid() ? std::to_string(n.value()) : "boundary");
    text += fmt::format("neighbours {}\n", fmt::join(neighbours, ", "));
    text += cells.at_interface[cell] ? "at an interface\n" : "inside of the part\n";
    if (cells.core_tets > 0)
        text += origin_of(cell, cells.core_tets) == CellOrigin::core ? "of the core\n" : "of the shell\n";
    const TetQuality q = tet_quality(p[0], p[1], p[2], p[3]);
    return text + fmt::format(
                      "dihedral angles {:.2f} to {:.2f} deg\nradius-edge {:.4g}, aspect {:.4g}, shape "
                      "{:.4g}\nvolume {:.6g}, edges {:.6g} to {:.6g}\n",
                      q.min_dihedral_deg, q.max_dihedral_deg, q.radius_edge, q.aspect, q.shape, q.volume, q.min_edge,
                      q.max_edge);
}

// The solution at vertices of a part, as means over them, a fact a line; empty if there is none, or it is not there
// yet.
std::string describe_solution(Session& session, NodeId part, int load_case, std::span<const std::int32_t> vertices) {
    if (!session.document().solution) return "";
    const auto found = session.fetched().solution(part, load_case);
    if (!found) return "";
    Vec3 displacement = Vec3::Zero();
    std::array<double, 6> stress = {};
    double von_mises = 0;
    const bool is_mode = found->stress.empty();
    const double share = 1.0 / vertices.size();
    for (const std::int32_t vertex : vertices) {
        const std::size_t v = vertex;
        if (v >= found->displacement.size()) return "";
        displacement += share * found->displacement[v];
        if (is_mode) continue;
        von_mises += share * found->von_mises[v];
        for (std::size_t i = 0; i < stress.size(); ++i) stress[i] += share * found->stress[v][i];
    }
    const std::string moved = fmt::format("displacement ({:.6g}, {:.6g}, {:.6g}), {:.6g} long\n", displacement.x(),
                                          displacement.y(), displacement.z(), displacement.norm());
    if (is_mode) return moved;
    const auto& [xx, yy, zz, xy, yz, xz] = stress;
    return moved + fmt::format(
                       "von Mises {:.6g}\nstress XX {:.6g}, YY {:.6g}, ZZ {:.6g}, XY {:.6g}, YZ {:.6g}, XZ "
                       "{:.6g}\n",
                       von_mises, xx, yy, zz, xy, yz, xz);
}

}  // namespace

std::shared_ptr<const NodeSurface> surface_of(Session& session, NodeId owner) {
    Fetched& fetched = session.fetched();
    return fetched.has_part_surface(owner) ? fetched.part_surface(owner) : fetched.surface(owner);
}

std::optional<Selection> select(Session& session, const Hit& hit, PickMode mode) {
    Selection s;
    s.owner = hit.owner;
    s.index = hit.element;
    s.place = hit.point;
    s.kind = hit.is_cell ? Selection::Kind::cell : Selection::Kind::facet;
    const bool has_cells = is_leaf(session.document(), hit.owner) && !session.document().folder.empty();
    if (!hit.is_cell && mode == PickMode::cell && has_cells) {
        const auto cells = session.fetched().cells(hit.owner);
        if (!cells) return std::nullopt;
        if (hit.element >= 0 && hit.element < count_of(cells->tet_at_facet)) {
            s.kind = Selection::Kind::cell;
            s.index = cells->tet_at_facet[hit.element];
        }
    }
    if (mode == PickMode::vertex) {
        if (hit.is_cell) {
            const auto cells = session.fetched().cells(hit.owner);
            if (!cells) return std::nullopt;
            s.index = nearest_vertex(cells->vertices, cells->tets[hit.element], hit.point);
        } else {
            const auto surface = surface_of(session, hit.owner);
            if (!surface) return std::nullopt;
            s.index = nearest_vertex(surface->vertices, surface->facets[hit.element], hit.point);
        }
        s.kind = Selection::Kind::vertex;
    }
    return s;
}

namespace {

// The selected defect; nullptr if there is none of this number.
const Defect* defect_of(const Document& document, const Selection& s) {
    if (s.kind != Selection::Kind::defect || !document.checked) return nullptr;
    const auto& defects = document.checked->diagnosis.defects;
    const std::size_t index = s.index;
    return index < defects.size() ? &defects[index] : nullptr;
}

std::string describe_defect(const Document& document, const Selection& s) {
    const Defect* defect = defect_of(document, s);
    if (!defect) return "";
    return fmt::format("{} {}\n{}\nto do: {}\n", name(defect->severity), name(defect->kind),
                       place(*defect, document.checked->soup), advice(*defect));
}

std::string describe_mesh(Session& session, const Selection& s) {
    if (s.kind == Selection::Kind::none) return "";
    if (s.kind == Selection::Kind::place) return place_text(s.place) + "\n";
    if (s.kind == Selection::Kind::defect) return describe_defect(session.document(), s);
    const std::size_t index = s.index;
    if (s.kind == Selection::Kind::cell) {
        const auto cells = session.fetched().cells(s.owner);
        return cells && index < cells->tets.size() ? describe_cell(session.document(), *cells, index) : "";
    }
    const auto surface = surface_of(session, s.owner);
    if (!surface) return "";
    if (s.kind == Selection::Kind::facet)
        return index < surface->facets.size() ? describe_facet(session, *surface, s.owner, index) : "";
    if (index < surface->vertices.size())
        return describe_vertex(*surface, owner_text(session.document(), s.owner), s.index);
    // Vertices inside of a part come after those of its surface.
    const auto cells = session.fetched().cells(s.owner);
    if (!cells || index >= cells->vertices.size()) return "";
    return fmt::format("vertex {} of part {}, inside of it\nglobal number {}\n{}\n", index, s.owner.value(),
                       cells->vertex_number[index], place_text(cells->vertices[index]));
}

std::vector<std::int32_t> vertices_of(Session& session, const Selection& s) {
    const std::size_t index = s.index;
    if (s.kind == Selection::Kind::vertex) return {s.index};
    if (s.kind == Selection::Kind::cell)
        if (const auto cells = session.fetched().cells(s.owner); cells && index < cells->tets.size())
            return {cells->tets[index].begin(), cells->tets[index].end()};
    if (s.kind == Selection::Kind::facet)
        if (const auto surface = surface_of(session, s.owner); surface && index < surface->facets.size())
            return {surface->facets[index].begin(), surface->facets[index].end()};
    return {};
}

}  // namespace

std::string describe_selection(Session& session, const Selection& s, int load_case) {
    std::string text = describe_mesh(session, s);
    if (text.empty() || !is_leaf(session.document(), s.owner)) return text;
    const std::vector<std::int32_t> vertices = vertices_of(session, s);
    if (vertices.empty()) return text;
    return text + describe_solution(session, s.owner, load_case, vertices);
}

std::vector<Vec3> selected_points(Session& session, const Selection& s) {
    std::vector<Vec3> points;
    if (s.kind == Selection::Kind::place) return {s.place};
    if (s.kind == Selection::Kind::defect) {
        for (const auto& [from, to] : selected_edges(session, s)) points.insert(points.end(), {from, to});
        if (points.empty()) points.push_back(s.place);
        return points;
    }
    const std::vector<std::int32_t> vertices = vertices_of(session, s);
    const bool is_cell = s.kind == Selection::Kind::cell;
    const auto surface = is_cell || vertices.empty() ? nullptr : surface_of(session, s.owner);
    for (const std::int32_t vertex : vertices) {
        const std::size_t v = vertex;
        if (surface && v < surface->vertices.size())
            points.push_back(surface->vertices[v]);
        else if (const auto cells = is_cell || surface ? session.fetched().cells(s.owner) : nullptr;
                 cells && v < cells->vertices.size())
            points.push_back(cells->vertices[v]);
    }
    return points;
}

std::vector<std::array<Vec3, 2>> selected_edges(Session& session, const Selection& s) {
    std::vector<std::array<Vec3, 2>> edges;
    if (s.kind != Selection::Kind::defect) {
        const std::vector<Vec3> corners = selected_points(session, s);
        for (std::size_t i = 0; i < corners.size(); ++i)
            for (std::size_t j = i + 1; j < corners.size(); ++j) edges.push_back({corners[i], corners[j]});
        return edges;
    }
    const Defect* defect = defect_of(session.document(), s);
    if (!defect) return edges;
    const Soup& soup = session.document().checked->soup;
    std::set<UndirectedEdge> numbers;
    for (const std::int32_t f : defect->facets) {
        const Triangle& t = soup.facets[f];
        for (std::size_t k = 0; k < 3; ++k) numbers.insert(undirected(t[k], t[(k + 1) % 3]));
    }
    for (const UndirectedEdge& edge : numbers) {
        const Vec3& a = soup.vertices[edge[0]];
        const Vec3& b = soup.vertices[edge[1]];
        if (a.allFinite() && b.allFinite()) edges.push_back({a, b});
    }
    return edges;
}

std::optional<Vec3> direction_to_cell(const PartCells& cells, const NodeSurface& part, const NodeSurface& shown,
                                      std::int32_t cell, const Vec3& present) {
    for (std::int32_t f = 0; f < std::ssize(part.facets); ++f) {
        if (cells.tet_at_facet[f] != cell || part.is_interface(f)) continue;
        Vec3 middle = Vec3::Zero();
        double size = 0;
        for (const std::int32_t v : part.facets[f]) {
            const Vec3& corner = part.vertices[v];
            middle += corner / 3;
            size = std::max(size, (corner - part.vertices[part.facets[f][0]]).norm());
        }
        const Vec3 outward = mean_normal(part.vertices, part.facets, {f});
        if (const auto found = direction_to_eye(shown.vertices, shown.facets, middle, 1e-3 * size, outward, present))
            return found;
    }
    return std::nullopt;
}

std::optional<std::array<std::int64_t, 4>> selected_cell(Session& session, const Selection& s) {
    if (s.kind != Selection::Kind::cell) return std::nullopt;
    const auto cells = session.fetched().cells(s.owner);
    const std::size_t index = s.index;
    if (!cells || index >= cells->tets.size()) return std::nullopt;
    std::array<std::int64_t, 4> numbers = {};
    for (std::size_t k = 0; k < 4; ++k) numbers[k] = cells->vertex_number[cells->tets[index][k]];
    return numbers;
}

}  // namespace kerf::view
