// The tree of cuts in memory (kerf/cut_tree.h). Nodes, attempts at cuts and parts point into one CutTree, which each of
// them keeps alive, and their points and contours are views of its memory. kerf/tree.py adds the ways from a node to
// others, and from a part to a Surface, by the members with an underscore. What is said of a cut is None where none was
// made: made_cut(). Matrices are copied element by element, so that row and column mean the same as in the kernel:
// `principal_axes` has the axes as columns here, and as rows in python/surface.cpp.
#include <optional>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "kerf/cut_tree.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/pickling.h"
#include "python/surface_object.h"
#include "python/values.h"
#include "run/report/tree_text.h"

namespace kerf::python {

namespace py = pybind11;

// The value of a kerf.TreeNode.
struct NodeObject {
    std::shared_ptr<CutTree> tree;  // has the others
    TreeNode* node;
    RecordedCut* cut;  // null: none was tried
};

namespace {

py::array_t<double> view_of(const std::vector<Vec3>& points, py::handle owner) { return view(points, owner); }
py::array_t<double> view_of(const std::vector<EdgeEnds>& segments, py::handle owner) {
    return view(segments.empty() ? nullptr : segments.front().front().data(), {std::ssize(segments), 2, 3}, owner);
}
py::array_t<double> view_of(const Vec3& vector, py::handle owner) { return view(vector.data(), {3}, owner); }

// Returns a copy whose rows and columns are those of the matrix, which Eigen stores by columns.
py::array_t<double> copy_of(const Eigen::Matrix3d& matrix) {
    py::array_t<double> result({3, 3});
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) result.mutable_at(row, column) = matrix(row, column);
    return result;
}

// Returns a getter whose array shares the memory of a member of T, or of the result of a function of it.
template <class T, class Get>
auto shared(Get get) {
    return [get](const py::object& self) { return view_of(std::invoke(get, self.cast<T&>()), self); };
}
template <class Get>
auto shared_of_node(Get get) {
    return shared<NodeObject>([get](const NodeObject& self) -> auto& { return std::invoke(get, *self.node); });
}

// Returns a getter of a member of a node, or of the result of a function of it.
template <class Get>
auto of_node(Get get) {
    return [get](const NodeObject& self) { return std::invoke(get, *self.node); };
}
// The same, but None where no cut was made.
template <class Get>
auto made_cut(Get get) {
    return [get](const NodeObject& self) {
        using Value = std::decay_t<decltype(std::invoke(get, *self.node))>;
        return self.node->cut_made ? std::optional<Value>(std::invoke(get, *self.node)) : std::nullopt;
    };
}

py::object plane_of(const Vec3& origin, const Vec3& normal, const py::object& owner) {
    return py::module_::import("kerf.records").attr("Plane")(view_of(origin, owner), view_of(normal, owner));
}

py::object plane_of_node(const py::object& self) {
    const TreeNode& node = *self.cast<NodeObject&>().node;
    return node.cut_made ? plane_of(node.plane.origin, node.plane.normal, self) : py::none();
}

py::list loops_of(const py::object& self) {
    py::list loops;
    if (const RecordedCut* cut = self.cast<NodeObject&>().cut)
        for (const std::vector<Vec3>& loop : cut->contour) loops.append(view_of(loop, self));
    return loops;
}

py::dict stages_of(const py::object& self) {
    const auto& [tree, node, cut] = self.cast<NodeObject&>();
    py::dict result;
    if (!cut || !node->cut_made || node->method == ContourMethod::straight) return result;
    result["crossed_edges"] = view_of(cut->stages.crossed_edges, self);
    result["hanging_edges_removed"] = view_of(cut->stages.hanging_edges_removed, self);
    result["closed_loops"] = view_of(cut->stages.closed_loops, self);
    result["multiple_paths_removed"] = view_of(cut->stages.multiple_paths_removed, self);
    result["smoothed"] = view_of(cut->stages.smoothed, self);
    return result;
}

py::list tries_of(const NodeObject& self) {
    py::list tries;
    if (self.cut)
        for (RecordedTry& each : self.cut->tries) tries.append(std::shared_ptr<RecordedTry>(self.tree, &each));
    return tries;
}

std::string text_of_try(const RecordedTry& self) {
    return fmt::format("<kerf.CutTry: {}, refusal {}>", name(self.what.method), name(self.what.refusal));
}

void register_tries(py::module_& module) {
    py::class_<RecordedTry, std::shared_ptr<RecordedTry>>(module, "CutTry", "One attempt at a cut.")
        .def_property_readonly(
            "plane",
            [](const py::object& self) {
                const auto& plane = self.cast<RecordedTry&>().what.plane;
                return plane_of(plane.origin, plane.normal, self);
            },
            "At which it was tried.")
        .def_property_readonly(
            "method", [](const RecordedTry& self) { return name(self.what.method); },
            "By which its contour was sought: \"min-cut\", \"edges\" or \"straight\".")
        .def_property_readonly(
            "refusal", [](const RecordedTry& self) { return name(self.what.refusal); },
            "Why it was refused: \"none\" if it was accepted; \"soft\": valid, but an angle or gap is below its\n"
            "threshold; else \"empty-side\", \"flow-limit\", \"pinched-contour\", \"crossing-projection\", "
            "\"nesting\",\n"
            "\"chord\", \"intersection\", \"not-manifold\", \"misplaced-shell\" or \"coincident-vertices\".")
        .def_property_readonly(
            "axis", [](const RecordedTry& self) { return self.what.axis; },
            "Rank of the direction, 0 is tried first; of a straight cut the coordinate axis.")
        .def_property_readonly(
            "step", [](const RecordedTry& self) { return self.what.step; },
            "Along the axis, 0 where the load is shared as wanted; of a straight cut the rank of the plane.")
        .def_property_readonly(
            "repair", [](const RecordedTry& self) { return self.what.repair; },
            "Round of local repair on the same plane.")
        .def_property_readonly("places", shared<RecordedTry>([](const auto& t) -> auto& { return t.what.places; }),
                               "(n, 3) float64: where it failed.")
        .def_property_readonly("contour", shared<RecordedTry>(&RecordedTry::contour),
                               "(n, 2, 3) float64: ends of the edges of its contour, the half below on their left.")
        .def("__repr__", &text_of_try);
}

using NodeClass = py::class_<NodeObject>;

void add_place_of_node(NodeClass& type) {
    type.def_property_readonly("id", of_node([](const TreeNode& node) { return node.id.value(); }),
                               "1 is the whole; the halves below and above the cut of i are 2 i and 2 i + 1.")
        .def_property_readonly(
            "level", [](const NodeObject& self) { return level_of(self.node->id); }, "0 of the whole.")
        .def_property_readonly(
            "is_part", [](const NodeObject& self) { return !self.node->is_divided(); }, "Whether nothing divides it.")
        .def_property_readonly("was_cut", of_node(&TreeNode::cut_made),
                               "False of parts, and of nodes that hold several regions, which are divided without a\n"
                               "cut.")
        .def_property_readonly("regions", of_node(&TreeNode::regions), "How many are in it.")
        .def_property_readonly(
            "region",
            [](const NodeObject& self) {
                return self.node->regions == 1 ? std::optional(self.node->region.value()) : std::nullopt;
            },
            "Row of Tree.region_names, 0 if there is one region; None if there are several in it.");
}

void add_surface_of_node(NodeClass& type) {
    type.def_property_readonly("points", of_node(&TreeNode::vertices), "Number of points of its surface.")
        .def_property_readonly("triangles", of_node(&TreeNode::facets), "Number of triangles of its surface.")
        .def_property_readonly("volume", of_node([](const TreeNode& node) { return node.mass.volume; }), "Enclosed.")
        .def_property_readonly("area", of_node([](const TreeNode& node) { return node.mass.area; }), "Of its surface.")
        .def_property_readonly(
            "centroid", shared_of_node([](const TreeNode& node) -> auto& { return node.mass.centroid; }),
            "(3,) float64: of the points of the surface, each with the mass 1; 0 where several regions are in it.")
        .def_property_readonly("inertia", of_node([](const TreeNode& node) { return copy_of(node.mass.inertia); }),
                               "(3, 3) float64: of the same points about their centroid, by which planes are chosen.")
        .def_property_readonly(
            "principal_moments", shared_of_node([](const TreeNode& node) -> auto& { return node.mass.eigenvalues; }),
            "(3,) float64: eigenvalues of `inertia`, ascending: the first axis is the long direction.")
        .def_property_readonly("principal_axes", of_node([](const TreeNode& node) { return copy_of(node.mass.axes); }),
                               "(3, 3) float64: their unit vectors as columns.");
}

void add_cut_of_node(NodeClass& type) {
    type.def_property_readonly("plane", &plane_of_node, "Of the cut.")
        .def_property_readonly("contour", &loops_of,
                               "Closed loops on the surface along which it was cut, (n, 3) float64 each: the half\n"
                               "below is on the left.")
        .def_property_readonly(
            "stages", &stages_of,
            "The contour at each stage of its making: crossed_edges, hanging_edges_removed, closed_loops,\n"
            "multiple_paths_removed and smoothed, as (n, 2, 3) float64: ends of edges. Empty of straight cuts.")
        .def_property_readonly(
            "tries", &tries_of,
            "All attempts, the accepted one last: what the others were refused for says why a cut is soft or straight.")
        .def_property_readonly(
            "method", made_cut([](const TreeNode& node) { return std::string(name(node.method)); }),
            "How the contour was found: \"min-cut\": minimum cut of the facet graph in a band around the plane,\n"
            "\"edges\": majority of the corners, \"straight\": facets were split at a coordinate plane.")
        .def_property_readonly(
            "strategy",
            [](const NodeObject& self) {
                return self.cut ? std::optional<std::string>(name(self.node->strategy)) : std::nullopt;
            },
            "By which the cut was accepted: \"first-try\", \"local-repair\", \"plane-step\", \"other-axis\", "
            "\"soft\",\n"
            "\"straight\"; \"whole\": none was, so that a part stayed whole; None if none was tried.");
}

void add_measures_of_cut(NodeClass& type) {
    type.def_property_readonly("load_fraction", made_cut([](const TreeNode& node) { return node.place.fraction; }),
                               "Share of the predicted work below the first plane.")
        .def_property_readonly("axis", made_cut([](const TreeNode& node) { return node.place.axis; }),
                               "Rank of the direction of the first plane in the order of preference.")
        .def_property_readonly(
            "section_gain", made_cut([](const TreeNode& node) { return node.place.section_gain; }),
            "Share of the section's area that this place saves against halves across the first direction; estimate.")
        .def_property_readonly("section_area", made_cut(&TreeNode::section_area), "Of the surface with the plane.")
        .def_property_readonly("interface_area", made_cut(&TreeNode::interface_area), "Of the triangulated cap.")
        .def_property_readonly("contour_length", made_cut(&TreeNode::contour_length), "Of all loops of the contour.")
        .def_property_readonly("max_deviation", made_cut(&TreeNode::max_deviation),
                               "Largest distance of a point of the contour from the plane.")
        .def_property_readonly("min_angle", made_cut([](const TreeNode& node) { return node.quality.angle_deg; }),
                               "Smallest angle of a triangle of the interface.")
        .def_property_readonly("min_dihedral", made_cut([](const TreeNode& node) { return node.quality.dihedral_deg; }),
                               "Smallest angle between interface and surface along the contour.")
        .def_property_readonly("min_gap", made_cut([](const TreeNode& node) { return node.quality.gap_rel; }),
                               "Smallest distance between interface and surface off the contour, beside the edges\n"
                               "there.")
        .def_property_readonly("seconds", made_cut(&TreeNode::seconds),
                               "Wall clock of the cut: the only number here that differs between runs.");
}

void register_part_surfaces(py::module_& module) {
    const auto array = [](auto get) {
        return [get](const py::object& self) { return view(get(self.cast<PartJob&>()), self); };
    };
    py::class_<PartJob, std::shared_ptr<PartJob>>(module, "PartSurface")
        .def(sharing<PartJob>(), py::arg("other"))
        .def(pickled_as_bytes<PartJob>())
        .def_property_readonly("points", shared<PartJob>([](const auto& p) -> auto& { return p.surface.vertices; }),
                               "(n, 3) float64.")
        .def_property_readonly("triangles", array([](const PartJob& p) -> auto& { return p.surface.facets; }),
                               "(m, 3) int32: corners, counter-clockwise seen from outside of the part.")
        .def_property_readonly("patches", array([](const PartJob& p) -> auto& { return p.surface.patch; }),
                               "(m,) int32: rows of `names`, -1 on interfaces.")
        .def_property_readonly(
            "names", [](const PartJob& self) { return self.patch_names.filled(); },
            "Of the patches of the surface that was cut.")
        .def_property_readonly(
            "neighbours", array([](const PartJob& p) -> auto& { return p.neighbour; }),
            "(m,) int32: the part on the other side of each triangle, -1: outside. Walls of regions have one, too.")
        .def_property_readonly("global_ids", array([](const PartJob& p) -> auto& { return p.boundary_id; }),
                               "(n,) int64: of each point among those of all parts; the same in every part that has\n"
                               "it.")
        .def_property_readonly("_facet_keys", array([](const PartJob& p) -> auto& { return p.surface.facet_key; }))
        .def_property_readonly("_id", [](const PartJob& self) { return self.part.value(); })
        .def_property_readonly("_region", [](const PartJob& self) { return self.region.value(); });
}

py::list nodes_of(const std::shared_ptr<CutTree>& tree) {
    py::list nodes;
    for (TreeNode& node : tree->nodes) {
        const auto cut = tree->cuts.find(node.id);
        nodes.append(NodeObject{tree, &node, cut == tree->cuts.end() ? nullptr : &cut->second});
    }
    return nodes;
}

py::list part_surfaces_of(const std::shared_ptr<CutTree>& tree) {
    py::list parts;
    for (PartJob& part : tree->parts) parts.append(std::shared_ptr<PartJob>(tree, &part));
    return parts;
}

std::shared_ptr<CutTree> decompose(const SurfaceObject& surface, const py::object& sizes, const py::object& progress,
                                   const std::string& programs, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    return without_lock(watch, [&] { return std::make_shared<CutTree>(cut_to_tree(surface.surface, wanted)); });
}

}  // namespace

void register_tree(py::module_& module) {
    register_tries(module);
    NodeClass node(module, "TreeNode");
    node.def(py::init<const NodeObject&>(), py::arg("other"));
    add_place_of_node(node);
    add_surface_of_node(node);
    add_cut_of_node(node);
    add_measures_of_cut(node);
    register_part_surfaces(module);
    py::class_<CutTree, std::shared_ptr<CutTree>>(module, "Tree")
        .def(sharing<CutTree>(), py::arg("other"))
        .def_readonly("patch_names", &CutTree::patch_names,
                      "Names of the patches of the surface, in the order of their numbers.")
        .def_readonly("region_names", &CutTree::region_names, "Empty if there is one region.")
        .def_property_readonly("_all_nodes", &nodes_of)
        .def_property_readonly("_part_surfaces", &part_surfaces_of)
        .def(
            "_text", [](const CutTree& self, bool every_node) { return tree_text(self.nodes, every_node); },
            py::arg("every_node"));
    module.def("decompose", &decompose, py::arg("of"), py::arg("sizes"), py::arg("progress"), py::arg("programs"));
}

}  // namespace kerf::python
