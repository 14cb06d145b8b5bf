// A run folder, or the folder of a solution on one, which then gives the values of its parts. Parts are loaded one at a
// time, without the interpreter's lock, when Python asks for them; names of patches and regions are those of the whole
// run, so that numbers mean the same in all parts. The commands on folders (verify, quality, export, merge) are the
// functions of the command line, whose JSON and text are returned as they are.
#include <pybind11/stl.h>

#include "base/parallel/processors.h"
#include "files/export/merged_file.h"
#include "files/part/run_parts.h"
#include "files/part/solution_parts.h"
#include "files/quality/compared_quality.h"
#include "kerf/progress_listener.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/options.h"
#include "python/surface_object.h"
#include "python/values.h"
#include "run/run/export_run.h"
#include "run/run/verify_folder.h"

namespace kerf::python {

namespace py = pybind11;

// A finished run, or a solution on one.
struct RunObject {
    explicit RunObject(const std::string& of)
        : folder(of),
          solution(find_solution_folder(folder).value_or("")),
          mesh(solution.empty() ? folder : mesh_of_solution(solution)),
          parts(std::make_unique<RunParts>(mesh, solution)) {}

    std::string folder;    // as it was given
    std::string solution;  // empty: no solution
    std::string mesh;
    std::unique_ptr<PartSource> parts;
};

namespace {

std::shared_ptr<RunObject> open_run(const std::string& folder) {
    const py::gil_scoped_release released;
    return std::make_shared<RunObject>(folder);
}

// Returns number(part) of all parts.
template <class Number>
auto of_parts(const RunObject& run, Number number) {
    py::array_t<std::invoke_result_t<Number, const PartExtent&>> numbers(std::ssize(run.parts->outline().parts));
    auto* to = numbers.mutable_data();
    for (const PartExtent& part : run.parts->outline().parts) *to++ = number(part);
    return numbers;
}

std::int64_t tetrahedra_count(const RunObject& run) {
    std::int64_t count = 0;
    for (const PartExtent& part : run.parts->outline().parts) count += part.tets;
    return count;
}

std::shared_ptr<Part> load_part_of(const RunObject& run, std::size_t index) {
    const py::gil_scoped_release released;
    auto part = std::make_shared<Part>(run.parts->load(PartIndex(index)));
    part->patch_names = run.parts->outline().patch_names;  // numbers in the part's arrays are rows of these names
    part->region_names = run.parts->outline().region_names;
    return part;
}

py::dict verify(const std::string& folder, const py::object& input, bool without_input) {
    Watch watch{py::none()};
    VerifyOptions options;
    options.without_input = without_input;
    options.is_cancelled = watch.is_cancelled();
    if (py::isinstance<SurfaceObject>(input))
        options.surface = &input.cast<SurfaceObject&>().surface.input();
    else if (!input.is_none())
        options.input = input.cast<std::string>();
    const FolderVerification found = without_lock(watch, [&] { return verify_folder(folder, options); });
    py::dict result;
    result["json"] = to_json(found, folder, options);
    result["text"] = to_text(found, folder, options);
    return result;
}

py::dict quality(const std::string& path) {
    std::string json, text;
    {
        const py::gil_scoped_release released;
        const ComparedQuality measured = compare_quality(path);
        json = to_json(measured, {});
        text = to_text(measured, QualityDetail::all);
    }
    py::dict result;
    result["json"] = json;
    result["text"] = text;
    return result;
}

std::vector<std::string> export_parts(const std::string& folder, const std::string& formats, const std::string& output,
                                      std::int32_t into, const std::string& fields, bool msh_ascii,
                                      const std::vector<std::string>& patch_types, bool split_regions, int order,
                                      std::int32_t workers, const py::object& progress) {
    const int all = static_cast<int>(std::max<std::size_t>(1, allowed_processors().size()));
    const ExportRequest request{.folder = folder,
                                .formats = formats,
                                .output = output,
                                .into = into,
                                .fields = fields,
                                .msh_ascii = msh_ascii,
                                .patch_types = patch_types,
                                .threads = workers > 0 ? workers : all,
                                .split_regions = split_regions,
                                .order = order};
    Watch watch(progress);
    const Progress told = watch.progress();
    const IsCancelled is_cancelled = watch.is_cancelled();
    ProgressListener listener(told, is_cancelled);
    SingleRank alone;
    const ExportSummary summary = without_lock(watch, [&] { return export_run(request, alone, &listener); });
    std::vector<std::string> files;
    for (const RunFile& file : summary.files) files.push_back(summary.folder + "/" + file.path);
    return files;
}

void merge(const std::string& folder, const std::string& output, const std::string& msh_version, bool msh_ascii,
           int order) {
    Watch watch{py::none()};
    const MergeRequest request{.folder = folder,
                               .output = output,
                               .options = {msh_version},
                               .msh_ascii = msh_ascii,
                               .is_cancelled = watch.is_cancelled(),
                               .order = order};
    without_lock(watch, [&] { merge_run(request); });
}

}  // namespace

void register_run(py::module_& module) {
    py::class_<RunObject, std::shared_ptr<RunObject>>(module, "Run")
        .def(py::init(&open_run), py::arg("folder"))
        .def_readonly("folder", &RunObject::folder, "Absolute path.")
        .def_readonly("mesh_folder", &RunObject::mesh,
                      "That of the mesh on which a solution stands; of a run `folder`.")
        .def_property_readonly(
            "order", [](const RunObject& self) { return self.parts->outline().order; },
            "Of the cells: 1 or 2. Of a solution that of the solution.")
        .def_property_readonly(
            "points_count", [](const RunObject& self) { return self.parts->outline().nodes(); },
            "Of the whole mesh: one that several parts have counts once. Of order 2 with the nodes on edges.")
        .def_property_readonly("tetrahedra_count", &tetrahedra_count, "Of all parts.")
        .def_property_readonly(
            "patch_names", [](const RunObject& self) { return self.parts->outline().patch_names; },
            "Names of the patches, in the order of their numbers.")
        .def_property_readonly(
            "region_names", [](const RunObject& self) { return self.parts->outline().region_names; },
            "Empty if there is one region.")
        .def_readonly("_solution", &RunObject::solution)
        .def_property_readonly("_numbers",
                               [](const RunObject& self) {
                                   return of_parts(self, [](const PartExtent& part) { return part.id.value(); });
                               })
        .def_property_readonly(
            "_tetrahedra",
            [](const RunObject& self) { return of_parts(self, [](const PartExtent& part) { return part.tets; }); })
        .def("_load", &load_part_of, py::arg("index"));
    module.def("verify", &verify, py::arg("folder"), py::arg("input"), py::arg("without_input"));
    module.def("quality", &quality, py::arg("path"));
    module.def("export", &export_parts, py::arg("folder"), py::arg("formats"), py::arg("output"), py::arg("into"),
               py::arg("fields"), py::arg("msh_ascii"), py::arg("patch_types"), py::arg("split_regions"),
               py::arg("order"), py::arg("workers"), py::arg("progress"));
    module.def("merge", &merge, py::arg("folder"), py::arg("output"), py::arg("msh_version"), py::arg("msh_ascii"),
               py::arg("order"));
    module.def("has_merged_format", [](const std::string& path) { return find_merged_format(path) != nullptr; });
}

}  // namespace kerf::python
