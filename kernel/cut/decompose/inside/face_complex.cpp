// A part's surface is read out of the complex, cut by itself, and the result is written back: the pieces of a split
// facet take its place, so that both owners of an interface facet hold the same pieces. Faces of other parts that only
// share a crossed edge get the same vertex on it. The faces at a vertex form a list in `at_vertex_`, from the last one
// to earlier ones; entries stay when a face is split, so that a listed face may no longer have the vertex.
#include "cut/decompose/inside/face_complex.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "surface/complex/touching.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// A vertex or facet of one leaf; sorting brings equal keys together.
struct KeyedItem {
    Key key;
    std::int32_t leaf, index;
    bool operator<(const KeyedItem& o) const { return std::tie(key, leaf, index) < std::tie(o.key, o.leaf, o.index); }
};

template <class KeysOf>
std::vector<KeyedItem> sorted_items(const std::vector<Leaf>& leaves, KeysOf keys_of) {
    std::vector<KeyedItem> items;
    for (std::int32_t i = 0; i < count_of(leaves); ++i) {
        const std::vector<Key>& keys = keys_of(leaves[i].surface);
        for (std::int32_t j = 0; j < count_of(keys); ++j) items.push_back({keys[j], i, j});
    }
    std::sort(items.begin(), items.end());
    return items;
}

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

}  // namespace

FaceComplex::FaceComplex(const std::vector<Leaf>& leaves) {
    std::vector<std::vector<std::int32_t>> number(leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        number[i].resize(leaves[i].surface.vertices.size());
        touches_ |= has_edge_of_many(leaves[i].surface.facets);  // double edges, without copies of a vertex
    }
    std::int32_t last_leaf = -1;
    for (const KeyedItem& v : sorted_items(
             leaves, [](const SurfaceArrays& s) -> auto& { return s.vertex_key; })) {
        if (vertex_key_.empty() || vertex_key_.back() != v.key) {
            points_.push_back(leaves[v.leaf].surface.vertices[v.index]);
            vertex_key_.push_back(v.key);
        } else {
            touches_ |= v.leaf == last_leaf;
        }
        last_leaf = v.leaf;
        number[v.leaf][v.index] = count_of(vertex_key_) - 1;
    }
    is_new_.assign(points_.size(), 0);
    for (const KeyedItem& f : sorted_items(
             leaves, [](const SurfaceArrays& s) -> auto& { return s.facet_key; })) {
        const Leaf& leaf = leaves[f.leaf];
        if (!faces_.empty() && faces_.back().key == f.key) {
            faces_.back().owner[1] = leaf.id;
            continue;
        }
        const Triangle& t = leaf.surface.facets[f.index];
        faces_.push_back({{number[f.leaf][t[0]], number[f.leaf][t[1]], number[f.leaf][t[2]]},
                          {leaf.id, no_node},
                          f.key,
                          leaf.surface.patch[f.index]});
    }
    index_faces();
}

void FaceComplex::index_faces() {
    faces_of_.clear();
    at_vertex_.clear();
    last_at_vertex_.assign(points_.size(), -1);
    for (std::int32_t f = 0; f < count_of(faces_); ++f) list_face(f);
}

// Adds a face to the lists of its parts and vertices; it must be the last face.
void FaceComplex::list_face(std::int32_t face) {
    for (const NodeId part : faces_[face].owner)
        if (part != no_node) faces_of_[part].push_back(face);
    for (const std::int32_t v : faces_[face].corners) {
        at_vertex_.push_back({face, last_at_vertex_[v]});
        last_at_vertex_[v] = count_of(at_vertex_) - 1;
    }
}

void FaceComplex::add_face(const ComplexFace& face) {
    faces_.push_back(face);
    list_face(count_of(faces_) - 1);
}

// Puts a face in the place of another one with the same owners; with other owners, the caller mends faces_of_.
void FaceComplex::replace_face(std::int32_t at, const ComplexFace& face) {
    const Triangle before = std::exchange(faces_[at], face).corners;
    for (const std::int32_t v : face.corners) {
        if (std::find(before.begin(), before.end(), v) != before.end()) continue;
        at_vertex_.push_back({at, last_at_vertex_[v]});
        last_at_vertex_[v] = count_of(at_vertex_) - 1;
    }
}

// Returns the faces at some of these vertices, ascending, and perhaps faces that were there before they were split.
std::vector<std::int32_t> FaceComplex::faces_at(std::vector<std::int32_t> vertices) const {
    const auto make_unique = [](std::vector<std::int32_t>& items) {
        std::sort(items.begin(), items.end());
        items.erase(std::unique(items.begin(), items.end()), items.end());
    };
    make_unique(vertices);
    std::vector<std::int32_t> faces;
    for (const std::int32_t v : vertices)
        for (std::int32_t i = last_at_vertex_[v]; i >= 0; i = at_vertex_[i].earlier)
            faces.push_back(at_vertex_[i].face);
    make_unique(faces);
    return faces;
}

FaceComplex::Part FaceComplex::part(NodeId id) const {
    KERF_CHECK(faces_of_.contains(id));
    Part part;
    part.face.assign(faces_of_.at(id).begin(), faces_of_.at(id).end());
    number_in_part_.resize(points_.size(), -1);
    for (const std::int32_t f : part.face) {
        const ComplexFace& face = faces_[f];
        Triangle t = face.owner[0] == id ? face.corners : turned(face.corners);
        for (std::int32_t& v : t) {
            std::int32_t& number = number_in_part_[v];
            if (number < 0) {
                number = count_of(part.vertex);
                part.vertex.push_back(v);
                part.arrays.vertices.push_back(points_[v]);
                part.arrays.vertex_key.push_back(vertex_key_[v]);
            }
            v = number;
        }
        part.arrays.facets.push_back(t);
        part.arrays.facet_key.push_back(face.key);
        part.arrays.patch.push_back(face.patch);
        part.untested.push_back(face.untested[face.owner[0] == id ? 0 : 1]);
    }
    for (const std::int32_t v : part.vertex) number_in_part_[v] = -1;
    if (!touches_) return part;
    SeparatedSurface separated = separate_touching(std::move(part.arrays));
    part.arrays = std::move(separated.arrays);
    for (std::size_t copy = part.vertex.size(); copy < separated.original.size(); ++copy)
        part.vertex.push_back(std::int32_t{part.vertex[separated.original[copy]]});
    return part;
}

std::int32_t FaceComplex::add_point(const Vec3& point, NodeId cut) {
    const std::int32_t vertex = vertex_count();
    points_.push_back(point);
    vertex_key_.push_back(make_key(cut, vertex));  // until assign_keys()
    is_new_.push_back(1);
    last_at_vertex_.push_back(-1);
    return vertex;
}

void FaceComplex::note_division(const ComplexFace& face) {
    if (face.divided || face.cap != no_node || !is_of_input(face.key)) return;
    const Triangle& t = face.corners;
    divided_facets_.push_back({key_index(face.key), {points_[t[0]], points_[t[1]], points_[t[2]]}, face.owner[0], {}});
}

void FaceComplex::divide(NodeId id, const Part& whole, const StraightCut& cut) {
    const PlaneSplit& split = cut.split;
    KERF_CHECK(cut.cut.node == id && count_of(whole.face) == split.parent.back().value() + 1);
    const std::array<NodeId, 2> children = children_of(id);
    Array<Vertex, std::int32_t> vertex = whole.vertex;
    for (std::size_t i = vertex.size(); i < split.arrays.vertices.size(); ++i)
        vertex.push_back(add_point(split.arrays.vertices[i], id));
    std::vector<SplitEdge> edges;
    for (const SplitEdge& e : split.edges) edges.push_back({vertex[e.below], vertex[e.above], vertex[e.vertex]});
    split_others(id, std::move(edges));

    for (std::size_t i = 0, end = 0; i < split.parent.size(); i = end) {
        while (end < split.parent.size() && split.parent[end] == split.parent[i]) ++end;
        ComplexFace face = faces_[whole.face[split.parent[i]]];
        const std::size_t own = face.owner[0] == id ? 0 : 1;
        if (end - i > 1) {
            note_division(face);
            face.divided = true;
            face.untested[1 - own] = 1;
        }
        face.untested[own] = 0;
        for (std::size_t piece = i; piece < end; ++piece) {
            const Triangle& t = split.arrays.facets[piece];
            face.corners = {vertex[t[0]], vertex[t[1]], vertex[t[2]]};
            if (own == 1) face.corners = turned(face.corners);
            face.owner[own] = children[split.side[piece] == Side::above ? 1 : 0];
            if (piece > i) {
                add_face(face);
                continue;
            }
            const std::int32_t at = whole.face[split.parent[i]];
            replace_face(at, face);
            faces_of_[face.owner[own]].push_back(at);
        }
    }
    faces_of_.erase(id);
    for (const NodeId child : children) std::sort(faces_of_[child].begin(), faces_of_[child].end());
    planes_.emplace_back(id, cut.cut.plane);
    const Interface& cap = cut.cut.interface;
    for (const Triangle& t : cap.triangles) {
        const auto corner = [&](int i) { return vertex[cap.contour[t[i]]]; };
        add_face({{corner(0), corner(1), corner(2)}, children, make_key(id, 0), -1, id});
    }
}

void FaceComplex::split_others(NodeId id, std::vector<SplitEdge> edges) {
    const auto ends = [](const SplitEdge& e) { return undirected(e.below, e.above); };
    std::sort(edges.begin(), edges.end(), [&](auto& a, auto& b) { return ends(a) < ends(b); });
    std::vector<std::int32_t> below;
    for (const SplitEdge& e : edges) below.push_back(e.below);
    const auto vertex_on = [&](std::int32_t a, std::int32_t b) {
        const auto it = std::lower_bound(edges.begin(), edges.end(), undirected(a, b),
                                         [&](const SplitEdge& e, const UndirectedEdge& key) { return ends(e) < key; });
        return it != edges.end() && ends(*it) == undirected(a, b) ? it->vertex : -1;
    };
    for (const std::int32_t f : faces_at(std::move(below))) {
        if (faces_[f].bounds(id)) continue;
        ComplexFace face = faces_[f];
        const Triangle t = face.corners;
        const TrianglePieces pieces =
            split_triangle(t, {vertex_on(t[0], t[1]), vertex_on(t[1], t[2]), vertex_on(t[2], t[0])}, points_);
        if (pieces.count == 1) continue;
        note_division(face);
        face.divided = true;
        face.untested = {1, 1};
        for (int i = 0; i < pieces.count; ++i) {
            face.corners = pieces.pieces[i];
            if (i == 0)
                replace_face(f, face);
            else
                add_face(face);
        }
    }
}

const Plane& FaceComplex::plane(NodeId cut) const {
    const auto found = std::find_if(planes_.begin(), planes_.end(), [&](const auto& p) { return p.first == cut; });
    KERF_CHECK(found != planes_.end());
    return found->second;
}

void FaceComplex::replace_caps(const std::vector<ComplexFace>& caps) {
    std::erase_if(faces_, [](const ComplexFace& face) { return face.cap != no_node; });
    faces_.insert(faces_.end(), caps.begin(), caps.end());
    index_faces();
}

Contacts FaceComplex::find_contacts() const {
    std::vector<Triangle> outer;
    for (const ComplexFace& face : faces_)
        if (face.owner[1] == no_node) outer.push_back(face.corners);
    return kerf::find_contacts(outer, vertex_key_);
}

std::vector<std::pair<NodeId, std::int32_t>> FaceComplex::assign_keys() {
    std::map<NodeId, std::int32_t> vertices, caps;
    std::vector<char> used(points_.size(), 0);
    for (ComplexFace& face : faces_) {
        for (std::int32_t v : face.corners) used[v] = 1;
        if (face.cap != no_node) face.key = make_key(face.cap, caps[face.cap]++);
    }
    for (std::size_t v = 0; v < points_.size(); ++v)
        if (is_new_[v] && used[v]) {
            const NodeId cut = key_node(vertex_key_[v]);
            vertex_key_[v] = make_key(cut, vertices[cut]++);
        }
    return {vertices.begin(), vertices.end()};
}

}  // namespace kerf
