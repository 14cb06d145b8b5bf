// The tree of cuts in memory (kerf/cut_tree.h). Nodes, cuts and parts are references into one CutTree, which each of
// them keeps alive, and their points and contours are views of its memory. Matrices are copied element by element, so
// that row and column mean the same as in the kernel: `principal_axes` has the axes as columns here, and as rows in
// python/surface.cpp.
#include <pybind11/stl.h>

#include "kerf/cut_tree.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/pickling.h"
#include "python/surface_object.h"
#include "run/report/tree_text.h"

namespace kerf::python {

namespace py = pybind11;

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

// Returns a property whose array shares the memory of a member of T, or of the result of a function of it.
template <class T, class Get>
auto shared(Get get) {
    return [get](const py::object& self) { return view_of(std::invoke(get, self.cast<T&>()), self); };
}

// Returns a list of items that keep their owner alive.
template <class T>
py::list list_of(const std::vector<T>& items, py::handle owner) {
    py::list list;
    for (const T& item : items) list.append(py::cast(&item, py::return_value_policy::reference_internal, owner));
    return list;
}

py::list loops_of(const py::object& self) {
    py::list loops;
    for (const std::vector<Vec3>& loop : self.cast<RecordedCut&>().contour) loops.append(view_of(loop, self));
    return loops;
}

py::dict stages_of(const py::object& self) {
    const RecordedStages& stages = self.cast<RecordedCut&>().stages;
    py::dict result;
    result["crossed_edges"] = view_of(stages.crossed_edges, self);
    result["hanging_edges_removed"] = view_of(stages.hanging_edges_removed, self);
    result["closed_loops"] = view_of(stages.closed_loops, self);
    result["multiple_paths_removed"] = view_of(stages.multiple_paths_removed, self);
    result["smoothed"] = view_of(stages.smoothed, self);
    return result;
}

void register_cuts(py::module_& module) {
    py::class_<RecordedTry>(module, "CutTry")
        .def_property_readonly("point", shared<RecordedTry>([](const auto& t) -> auto& { return t.what.plane.origin; }))
        .def_property_readonly("normal",
                               shared<RecordedTry>([](const auto& t) -> auto& { return t.what.plane.normal; }))
        .def_property_readonly("method", [](const RecordedTry& self) { return name(self.what.method); })
        .def_property_readonly("axis", [](const RecordedTry& self) { return self.what.axis; })
        .def_property_readonly("step", [](const RecordedTry& self) { return self.what.step; })
        .def_property_readonly("repair", [](const RecordedTry& self) { return self.what.repair; })
        .def_property_readonly("refusal", [](const RecordedTry& self) { return name(self.what.refusal); })
        .def_property_readonly("places", shared<RecordedTry>([](const auto& t) -> auto& { return t.what.places; }))
        .def_property_readonly("contour", shared<RecordedTry>(&RecordedTry::contour));
    py::class_<RecordedCut>(module, "Cut")
        .def_property_readonly("contour", &loops_of)
        .def_property_readonly("stages", &stages_of)
        .def_property_readonly("tries",
                               [](const py::object& self) { return list_of(self.cast<RecordedCut&>().tries, self); });
}

void register_nodes(py::module_& module) {
    py::class_<TreeNode>(module, "TreeNode")
        .def_readonly("id", &TreeNode::id)
        .def_readonly("wanted_parts", &TreeNode::leaves)
        .def_readonly("regions", &TreeNode::regions)
        .def_property_readonly("region", [](const TreeNode& self) { return self.region.value(); })
        .def_readonly("vertices", &TreeNode::vertices)
        .def_readonly("facets", &TreeNode::facets)
        .def_property_readonly("is_divided", &TreeNode::is_divided)
        .def_readonly("cut_made", &TreeNode::cut_made)
        .def_property_readonly("volume", [](const TreeNode& self) { return self.mass.volume; })
        .def_property_readonly("area", [](const TreeNode& self) { return self.mass.area; })
        .def_property_readonly("centroid", shared<TreeNode>([](const auto& n) -> auto& { return n.mass.centroid; }))
        .def_property_readonly("inertia", [](const TreeNode& self) { return copy_of(self.mass.inertia); })
        .def_property_readonly("principal_moments",
                               shared<TreeNode>([](const auto& n) -> auto& { return n.mass.eigenvalues; }))
        .def_property_readonly("principal_axes", [](const TreeNode& self) { return copy_of(self.mass.axes); })
        .def_property_readonly("point", shared<TreeNode>([](const auto& n) -> auto& { return n.plane.origin; }))
        .def_property_readonly("normal", shared<TreeNode>([](const auto& n) -> auto& { return n.plane.normal; }))
        .def_property_readonly("method", [](const TreeNode& self) { return name(self.method); })
        .def_property_readonly("strategy", [](const TreeNode& self) { return name(self.strategy); })
        .def_readonly("contour_edges", &TreeNode::contour_edges)
        .def_readonly("contour_length", &TreeNode::contour_length)
        .def_readonly("max_deviation", &TreeNode::max_deviation)
        .def_property_readonly("load_fraction", [](const TreeNode& self) { return self.place.fraction; })
        .def_property_readonly("axis", [](const TreeNode& self) { return self.place.axis; })
        .def_property_readonly("section_gain", [](const TreeNode& self) { return self.place.section_gain; })
        .def_readonly("section_area", &TreeNode::section_area)
        .def_readonly("interface_area", &TreeNode::interface_area)
        .def_property_readonly("min_angle_deg", [](const TreeNode& self) { return self.quality.angle_deg; })
        .def_property_readonly("min_dihedral_deg", [](const TreeNode& self) { return self.quality.dihedral_deg; })
        .def_property_readonly("min_gap_rel", [](const TreeNode& self) { return self.quality.gap_rel; })
        .def_readonly("seconds", &TreeNode::seconds);
}

void register_parts(py::module_& module) {
    const auto array = [](auto get) {
        return [get](const py::object& self) { return view(get(self.cast<PartJob&>()), self); };
    };
    py::class_<PartJob>(module, "PartSurface")
        .def(pickled_as_bytes<PartJob>())
        .def_readonly("id", &PartJob::part)
        .def_property_readonly("region", [](const PartJob& self) { return self.region.value(); })
        .def_property_readonly("points", shared<PartJob>([](const auto& p) -> auto& { return p.surface.vertices; }))
        .def_property_readonly("triangles", array([](const PartJob& p) -> auto& { return p.surface.facets; }))
        .def_property_readonly("patches", array([](const PartJob& p) -> auto& { return p.surface.patch; }))
        .def_property_readonly("facet_keys", array([](const PartJob& p) -> auto& { return p.surface.facet_key; }))
        .def_property_readonly("neighbours", array([](const PartJob& p) -> auto& { return p.neighbour; }))
        .def_property_readonly("global_ids", array([](const PartJob& p) -> auto& { return p.boundary_id; }))
        .def_property_readonly("names", [](const PartJob& self) { return self.patch_names.filled(); });
}

std::shared_ptr<CutTree> decompose(const SurfaceObject& surface, const py::object& sizes, const py::object& progress,
                                   const std::string& programs, const py::kwargs& options) {
    Watch watch(progress);
    const MeshOptions wanted = mesh_options(sizes, programs, options, watch);
    return without_lock(watch, [&] { return std::make_shared<CutTree>(cut_to_tree(surface.surface, wanted)); });
}

const RecordedCut* cut_of(const CutTree& tree, NodeId node) {
    const auto found = tree.cuts.find(node);
    return found == tree.cuts.end() ? nullptr : &found->second;
}

}  // namespace

void register_tree(py::module_& module) {
    register_cuts(module);
    register_nodes(module);
    register_parts(module);
    py::class_<CutTree, std::shared_ptr<CutTree>>(module, "Tree")
        .def_property_readonly("nodes",
                               [](const py::object& self) { return list_of(self.cast<CutTree&>().nodes, self); })
        .def_property_readonly("parts",
                               [](const py::object& self) { return list_of(self.cast<CutTree&>().parts, self); })
        .def("cut", &cut_of, py::arg("node"), py::return_value_policy::reference_internal)
        .def_readonly("patch_names", &CutTree::patch_names)
        .def_readonly("region_names", &CutTree::region_names)
        .def(
            "text", [](const CutTree& self, bool every_node) { return tree_text(self.nodes, every_node); },
            py::arg("every_node"));
    module.def("decompose", &decompose, py::arg("of"), py::arg("sizes"), py::arg("progress"), py::arg("programs"));
}

}  // namespace kerf::python
