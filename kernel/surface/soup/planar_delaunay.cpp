// A thin layer over CGAL's constrained Delaunay triangulation, which keeps its headers, slow to compile, out of those
// of Kerf. The predicates are exact; circumcentres are rounded. Each CGAL vertex has the first number of its point as
// its info, each face whether it is inside; edges of the user are constraints. Crossing constraints are refused by an
// exception of CGAL, which becomes `false`. Handles of faces leave this source as void pointers and are valid until the
// next insertion, because insertions may delete faces.
#include "surface/soup/planar_delaunay.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "base/core/ids.h"

namespace kerf {

namespace {

using PlanarKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PlanarPoint = PlanarKernel::Point_2;
using PlanarVertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, PlanarKernel>;
using PlanarFaceBase =  // whether it is inside
    CGAL::Triangulation_face_base_with_info_2<bool, PlanarKernel,
                                              CGAL::Constrained_triangulation_face_base_2<PlanarKernel>>;
using PlanarCdt =
    CGAL::Constrained_Delaunay_triangulation_2<PlanarKernel,
                                               CGAL::Triangulation_data_structure_2<PlanarVertexBase, PlanarFaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using PlanarVertex = PlanarCdt::Vertex_handle;
using PlanarFace = PlanarCdt::Face_handle;

PlanarPoint to_point(const Vec2& p) { return {p.x(), p.y()}; }

void* pointer_of(PlanarFace face) { return &*face; }
PlanarFace face_of(void* pointer) {
    return PlanarCdt::Triangulation_data_structure::Face_range::s_iterator_to(*static_cast<PlanarCdt::Face*>(pointer));
}

Triangle corners_of(PlanarFace face) {
    return {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
}

}  // namespace

struct PlanarDelaunay::Cdt {
    PlanarCdt cdt;
    std::vector<PlanarVertex> vertices;
    PlanarFace hint;

    // Marks a face and all that can be reached from it without crossing an edge as outside; stops at faces that are
    // outside.
    void mark_outside_from(PlanarFace start) {
        std::vector<PlanarFace> stack = {start};
        while (!stack.empty()) {
            const PlanarFace face = stack.back();
            stack.pop_back();
            if (!face->info()) continue;
            face->info() = false;
            for (int i = 0; i < 3; ++i)
                if (!face->is_constrained(i)) stack.push_back(face->neighbor(i));
        }
    }
    std::int32_t add(PlanarVertex vertex) {
        vertices.push_back(vertex);
        return count_of(vertices) - 1;
    }
};

PlanarDelaunay::PlanarDelaunay() : cdt_(std::make_unique<Cdt>()) {}
PlanarDelaunay::~PlanarDelaunay() = default;

std::int32_t PlanarDelaunay::insert(const Vec2& point) {
    const std::size_t before = cdt_->cdt.number_of_vertices();
    const PlanarVertex vertex = cdt_->cdt.insert(to_point(point), cdt_->hint);
    cdt_->hint = vertex->face();
    const std::int32_t number = cdt_->add(vertex);
    if (cdt_->cdt.number_of_vertices() > before) vertex->info() = number;
    return number;
}

bool PlanarDelaunay::insert_edge(std::int32_t from, std::int32_t to) {
    const PlanarVertex a = cdt_->vertices[from], b = cdt_->vertices[to];
    if (a == b) return true;
    try {
        cdt_->cdt.insert_constraint(a, b);
    } catch (const PlanarCdt::Intersection_of_constraints_exception&) {
        return false;
    }
    return true;
}

std::int32_t PlanarDelaunay::first_number(std::int32_t number) const { return cdt_->vertices[number]->info(); }

bool PlanarDelaunay::has_triangles() const { return cdt_->cdt.dimension() == 2; }

void PlanarDelaunay::mark_by_parity() {
    enum { unknown = -1 };
    CGAL::Unique_hash_map<PlanarFace, int> depth(unknown);
    std::vector<PlanarFace> stack = {cdt_->cdt.infinite_face()};
    depth[stack[0]] = 0;
    while (!stack.empty()) {
        const PlanarFace face = stack.back();
        stack.pop_back();
        face->info() = depth[face] % 2 == 1;
        for (int i = 0; i < 3; ++i) {
            const PlanarFace next = face->neighbor(i);
            if (depth[next] != unknown) continue;
            depth[next] = depth[face] + (face->is_constrained(i) ? 1 : 0);
            stack.push_back(next);
        }
    }
}

void PlanarDelaunay::mark_enclosed() {
    for (const PlanarFace face : cdt_->cdt.all_face_handles()) face->info() = true;
    cdt_->mark_outside_from(cdt_->cdt.infinite_face());
}

bool PlanarDelaunay::mark_hole(const Vec2& point) {
    PlanarCdt::Locate_type type = PlanarCdt::FACE;
    int i = 0;
    const PlanarFace face = cdt_->cdt.locate(to_point(point), type, i);
    if (type == PlanarCdt::VERTEX || (type == PlanarCdt::EDGE && face->is_constrained(i))) return false;
    if (type == PlanarCdt::FACE || type == PlanarCdt::EDGE) cdt_->mark_outside_from(face);
    return true;
}

std::vector<Triangle> PlanarDelaunay::triangles() const {
    std::vector<Triangle> found;
    for (const PlanarFace face : cdt_->cdt.finite_face_handles())
        if (face->info()) found.push_back(corners_of(face));
    return found;
}

std::vector<Triangle> PlanarDelaunay::triangles_around(std::int32_t number) const {
    std::vector<Triangle> found;
    PlanarCdt::Face_circulator face = cdt_->cdt.incident_faces(cdt_->vertices[number]), end = face;
    do
        if (face->info()) found.push_back(corners_of(face));
    while (++face != end);
    return found;
}

std::optional<PlanarDelaunay::Face> PlanarDelaunay::find(const Triangle& corners) const {
    const auto& v = cdt_->vertices;
    PlanarFace face;
    if (!cdt_->cdt.is_face(v[corners[0]], v[corners[1]], v[corners[2]], face)) return {};
    return Face{corners_of(face), pointer_of(face)};
}

bool PlanarDelaunay::has_border(std::int32_t from, std::int32_t to) const {
    const PlanarVertex a = cdt_->vertices[from], b = cdt_->vertices[to];
    PlanarFace face;
    int i = 0;
    if (!cdt_->cdt.is_edge(a, b, face, i)) return false;
    if (face->vertex(PlanarCdt::ccw(i)) != a) std::tie(face, i) = cdt_->cdt.mirror_edge({face, i});
    return face->info() && !face->neighbor(i)->info();
}

std::optional<PlanarDelaunay::Place> PlanarDelaunay::find_place(const Vec2& point, const Face* start) const {
    PlanarCdt::Locate_type type = PlanarCdt::FACE;
    int index = 0;
    const PlanarFace hint = start ? face_of(start->handle) : PlanarFace();
    const PlanarFace face = cdt_->cdt.locate(to_point(point), type, index, hint);
    if ((type != PlanarCdt::FACE && type != PlanarCdt::EDGE) || cdt_->cdt.is_infinite(face) || !face->info()) return {};
    if (type == PlanarCdt::EDGE && face->is_constrained(index)) return {};
    return Place{pointer_of(face), type, index};
}

void PlanarDelaunay::find_cavity(const Vec2& point, const Place& place, std::vector<Side>& sides) const {
    std::vector<PlanarFace> faces;
    cdt_->cdt.get_conflicts(to_point(point), std::back_inserter(faces), face_of(place.face));
    sides.clear();
    for (const PlanarFace face : faces)
        for (int i = 0; i < 3; ++i)
            sides.push_back({face->vertex(PlanarCdt::ccw(i))->info(), face->vertex(PlanarCdt::cw(i))->info(),
                             face->is_constrained(i)});
}

std::int32_t PlanarDelaunay::insert(const Vec2& point, const Place& place) {
    const auto type = static_cast<PlanarCdt::Locate_type>(place.type);
    const PlanarVertex vertex = cdt_->cdt.insert(to_point(point), type, face_of(place.face), place.index);
    vertex->info() = cdt_->add(vertex);
    PlanarCdt::Face_circulator face = cdt_->cdt.incident_faces(vertex), end = face;
    do face->info() = true;
    while (++face != end);
    return vertex->info();
}

Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c) {
    const PlanarPoint centre = CGAL::circumcenter(to_point(a), to_point(b), to_point(c));
    return {centre.x(), centre.y()};
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    return CGAL::do_intersect(PlanarKernel::Segment_2(to_point(a), to_point(b)),
                              PlanarKernel::Segment_2(to_point(c), to_point(d)));
}

bool segments_overlap(const Vec2& end, const Vec2& a, const Vec2& b) {
    const PlanarPoint shared = to_point(end), p = to_point(a), q = to_point(b);
    return p == q || (CGAL::collinear(p, shared, q) && !CGAL::collinear_are_ordered_along_line(p, shared, q));
}

int planar_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    return CGAL::orientation(to_point(a), to_point(b), to_point(c));
}

}  // namespace kerf
