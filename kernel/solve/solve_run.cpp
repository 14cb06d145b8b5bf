#include "solve/solve_run.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/stopwatch.h"
#include "io/file_bytes.h"
#include "io/output_file.h"
#include "io/run_folder.h"
#include "io/text_file.h"
#include "parallel/process_memory.h"
#include "part/run_parts.h"
#include "run/shared_folder.h"
#include "solve/elastic_problem.h"
#include "solve/error_sizes.h"
#include "solve/result_files.h"

namespace kerf {

namespace {

std::string way_out(const SolverOptions& solver) {
    return fmt::format(
        "{}Try preconditioner = \"{}\", a larger max_iterations or rtol, or a mesh with better cells "
        "(kerf quality).",
        solver.petsc.empty() ? ""
                             : fmt::format("The case tells PETSc '{}', which may end it sooner: leave "
                                           "that out. ",
                                           solver.petsc),
        solver.preconditioner == "gamg" ? "icc" : "gamg");
}

class SolveStages {
 public:
    SolveStages(const SolveRequest& request, MpiRanks& ranks, RunListener* listener)
        : ranks_(ranks), listener_(listener) {
        report_.request = request;
        report_.ranks = ranks.size();
    }

    SolveReport run();

 private:
    bool is_root() const { return ranks_.rank() == 0; }
    void progress(const char* stage, std::size_t done, std::size_t total) {
        const bool is_cancelled = listener_ && listener_->cancelled();
        if (listener_ && is_root()) listener_->on_progress(stage, done, total);
        in_agreement(ranks_, [&] {
            if (is_cancelled) throw Error(ErrorCode::cancelled, "Interrupted; nothing was written.");
        });
    }
    // Of the parts of this rank, where ranks do not wait for each other.
    void tell_part(const char* stage, std::size_t done, std::size_t total) {
        if (!listener_) return;
        if (listener_->cancelled()) throw Error(ErrorCode::cancelled, "Interrupted; nothing was written.");
        if (is_root()) listener_->on_progress(stage, done, total);
    }
    void read_request();
    void open_folder();
    FeSpace make_space();
    void solve_case(LinearSystem& system, std::size_t number);
    void report_case(std::size_t number, CaseReport& of_case);
    Extreme largest(double value, const Vec3& place) const;
    std::vector<RegionResult> results_of_regions(const StressField& field, const HeldForces& reactions) const;
    void write();
    void write_sizes_of_next();
    void finish();

    MpiRanks& ranks_;
    RunListener* listener_;
    SolveReport report_;
    Stopwatch whole_, stage_;
    std::unique_ptr<RunParts> parts_;
    std::optional<RunFolder> folder_;
    std::optional<FeSpace> space_;
    ElasticProblem problem_;
    std::vector<CaseSolution> solutions_;
};

void SolveStages::read_request() {
    in_agreement(ranks_, [&] {
        const SolveRequest& request = report_.request;
        report_.wanted = read_case(request.case_file);
        parts_ = std::make_unique<RunParts>(request.folder);
        const std::int64_t parts = std::ssize(parts_->outline().parts);
        if (parts < ranks_.size())
            throw Error(
                ErrorCode::usage,
                fmt::format("{} ranks are more than the {} parts of {}, of which each rank takes whole ones. Start "
                            "fewer ranks, or mesh into more parts.",
                            ranks_.size(), parts, request.folder));
        if (lies_inside(request.output, request.folder) || lies_inside(request.folder, request.output))
            throw Error(ErrorCode::usage,
                        fmt::format("--output is {}, which holds the mesh or lies in it: {}. Choose another folder.",
                                    request.output, request.folder));
        refuse_to_overwrite(request.case_file, "--output", request.output);
    });
    const MeshOutline& outline = parts_->outline();
    report_.parts = std::ssize(outline.parts);
    report_.tets = outline.tets();
    report_.vertices = outline.vertices;
}

// Nothing but an older solution is replaced.
void SolveStages::open_folder() {
    const std::string& output = report_.request.output;
    folder_.emplace(open_together(ranks_, [&] {
        std::error_code ignored;
        if (const std::string saved = RunFolder::saved_run_file(output); std::filesystem::exists(saved, ignored))
            throw Error(ErrorCode::io,
                        fmt::format("{} is that of an unfinished mesh. Finish it with kerf mesh --resume "
                                    "{}, or choose another folder.",
                                    saved, output));
        const std::string old = output + "/report.json";
        if (std::filesystem::exists(old, ignored)) {
            const auto json = nlohmann::json::parse(read_file(old), nullptr, false);
            if (!json.is_object() || !json.contains("solve"))
                throw Error(ErrorCode::io, fmt::format("{} holds another run than a solution. Move it away, or choose "
                                                       "another folder.",
                                                       output));
        }
        return RunFolder::create(output);
    }));
}

FeSpace SolveStages::make_space() {
    const MeshOutline& outline = parts_->outline();
    const std::vector<PartIndex> first = first_parts_of_ranks(outline, ranks_.size());
    const int r = ranks_.rank();
    std::vector<Part> own = in_agreement(ranks_, [&] {
        std::vector<Part> parts;
        for (const PartIndex index : IdRange(first[r], first[r + 1])) {
            tell_part("read", parts.size(), first[r + 1].value() - first[r].value());
            parts.push_back(parts_->load(index));
        }
        return parts;
    });
    report_.seconds.read = stage_.lap();
    progress("number", 0, 0);
    FeSpace space(ranks_, outline, first, std::move(own), report_.wanted.solver.order);
    report_.seconds.number = stage_.lap();
    return space;
}

Extreme SolveStages::largest(double value, const Vec3& place) const {
    std::array<double, 4> most{value, place.x(), place.y(), place.z()};
    for (const std::array<double, 4>& of_rank : all_gather(ranks_, most))
        if (of_rank[0] > most[0]) most = of_rank;
    return {most[0], Vec3(most[1], most[2], most[3])};
}

// A part lies in one region.
std::vector<RegionResult> SolveStages::results_of_regions(const StressField& field, const HeldForces& reactions) const {
    const std::vector<std::string>& names = parts_->outline().region_names;
    std::vector<RegionResult> results(names.size());
    std::vector<double> energies(names.size(), 0);
    for (std::size_t p = 0; p < space_->parts().size() && !names.empty(); ++p) {
        const Part& part = space_->parts()[p];
        const std::size_t region = space_->region_of(p);
        energies[region] += field.parts[p].energy;
        for (std::size_t v = 0; v < field.parts[p].at_vertex.size(); ++v) {
            const double stress = von_mises(field.parts[p].at_vertex[v]);
            if (stress > results[region].von_mises.value) results[region].von_mises = {stress, part.mesh.vertices[v]};
        }
    }
    ranks_.all_reduce(std::span(energies), Reduction::sum);
    for (std::size_t r = 0; r < names.size(); ++r) {
        const Extreme& own = results[r].von_mises;
        results[r] = {names[r], energies[r], largest(own.value, own.place), {}};
        for (std::size_t s = 0; s < reactions.supports(); ++s) results[r].reactions.push_back(reactions.of(s, r));
    }
    return results;
}

void SolveStages::report_case(std::size_t number, CaseReport& of_case) {
    const CaseSolution& solution = solutions_.back();
    const std::vector<double>& forces = problem_.forces[number];
    for (std::size_t dof = 0; dof < forces.size(); ++dof) of_case.load[dof % 3] += forces[dof];
    ranks_.all_reduce(std::span(of_case.load.data(), 3), Reduction::sum);
    const HeldForces held = reactions(problem_, solution.displacement, problem_.held_forces[number]);
    for (std::size_t s = 0; s < held.supports(); ++s) of_case.reactions.push_back(held.of(s));
    Vec3 sum = of_case.load;
    double scale = of_case.load.norm();
    for (const Vec3& reaction : of_case.reactions) {
        sum += reaction;
        scale = std::max(scale, reaction.norm());
    }
    of_case.imbalance = scale > 0 ? sum.norm() / scale : 0;
    of_case.norms = solution.stress.norms;
    double most = -1, most_stress = -1;
    Vec3 place = Vec3::Zero(), place_of_stress = Vec3::Zero();
    for (std::int32_t n = 0; n < space_->owned_count(); ++n) {
        const double length = Eigen::Map<const Vec3>(&solution.displacement[3 * n]).norm();
        if (length > most) {
            most = length;
            place = space_->points()[n];
        }
    }
    for (std::size_t p = 0; p < space_->parts().size(); ++p)
        for (std::size_t v = 0; v < solution.stress.parts[p].at_vertex.size(); ++v) {
            const double stress = von_mises(solution.stress.parts[p].at_vertex[v]);
            if (stress > most_stress) {
                most_stress = stress;
                place_of_stress = space_->parts()[p].mesh.vertices[v];
            }
        }
    of_case.displacement = largest(most, place);
    of_case.von_mises = largest(most_stress, place_of_stress);
    of_case.regions = results_of_regions(solution.stress, held);
}

void SolveStages::solve_case(LinearSystem& system, std::size_t number) {
    CaseReport& of_case = report_.cases.emplace_back();
    CaseSolution& solution = solutions_.emplace_back();
    of_case.name = solution.name = problem_.cases[number];
    of_case.outcome =
        system.solve(problem_.forces[number], solution.displacement, [this](int iteration, double residual) {
            if (listener_ && is_root()) listener_->on_iteration(iteration, residual, report_.wanted.solver.rtol);
        });
    report_.seconds.setup += of_case.outcome.setup_seconds;
    report_.seconds.solve += of_case.outcome.solve_seconds;
    stage_.lap();
    if (!of_case.outcome.converged)
        throw Error(
            ErrorCode::convergence,
            fmt::format("The solver has not reached the tolerance {:g}{}: {} after {} iterations, residual "
                        "{:.3g}. {}",
                        report_.wanted.solver.rtol,
                        of_case.name.empty() ? "" : fmt::format(" in case '{}'", of_case.name), of_case.outcome.reason,
                        of_case.outcome.iterations, of_case.outcome.residual, way_out(report_.wanted.solver)));
    progress("recover", number, problem_.cases.size());
    solution.stress = recover_stress(problem_, solution.displacement);
    report_case(number, of_case);
    report_.seconds.recover += stage_.lap();
}

void SolveStages::write() {
    const VtuLayout layout = layout_for(parts_->outline(), {});
    const std::vector<RunFile> own = in_agreement(ranks_, [&] {
        std::vector<RunFile> files;
        for (std::size_t p = 0; p < space_->parts().size(); ++p) {
            tell_part("write", p, space_->parts().size());
            const Part& part = space_->parts()[p];
            const std::string file = folder_->part_file(part.id);
            const FileHash hash = write_part(file, part, layout, values_of_part(problem_, solutions_, p));
            files.push_back({"parts/" + part_file_name(part.id),
                             static_cast<std::int64_t>(std::filesystem::file_size(file)), hash_text(hash)});
        }
        return files;
    });
    report_.files = gather_items(ranks_, own);
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        std::vector<std::string> pieces;
        for (const PartExtent& part : parts_->outline().parts) pieces.push_back("parts/" + part_file_name(part.id));
        // Its arrays are those of any part.
        write_pvtu(folder_->file("mesh.pvtu"), pieces, layout, values_of_part(problem_, solutions_, 0));
        report_.files.push_back(describe_file(folder_->partial_path(), "mesh.pvtu"));
    });
    write_sizes_of_next();
    sort_files(report_.files);
    report_.seconds.write = stage_.lap();
}

void SolveStages::write_sizes_of_next() {
    const std::optional<double> target = report_.request.target_error;
    if (!target || report_.relative_error() <= *target) return;
    report_.wanted_of_next = error_of_next_mesh(report_.relative_error(), *target, space_->order());
    std::vector<const StressField*> fields;
    for (const CaseSolution& solution : solutions_) fields.push_back(&solution.stress);
    const SizedMesh sizes = sizes_for_error(*space_, fields, report_.wanted_of_next, ranks_);
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        write_sizes(folder_->file(size_field_file), sizes);
        report_.files.push_back(describe_file(folder_->partial_path(), size_field_file));
    });
}

void SolveStages::finish() {
    std::array<double*, 8> seconds = {&report_.seconds.read,     &report_.seconds.number, &report_.seconds.conditions,
                                      &report_.seconds.assemble, &report_.seconds.setup,  &report_.seconds.solve,
                                      &report_.seconds.recover,  &report_.seconds.write};
    for (double* value : seconds) *value = ranks_.all_reduce(*value, Reduction::largest);
    for (const std::int64_t bytes : all_gather(ranks_, own_peak_rss_bytes())) report_.peak_rss_bytes += bytes;
    report_.seconds.wall = whole_.lap();
    if (!is_root()) folder_.reset();
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        write_text_file(folder_->file("report.json"), to_json(report_));
        folder_->commit(true);
    });
}

SolveReport SolveStages::run() {
    progress("read", 0, 0);
    read_request();
    space_.emplace(make_space());
    problem_ = make_problem(*space_, parts_->outline(), report_.wanted);
    report_.nodes = space_->total_rows();
    report_.supports = problem_.supports;
    for (std::int32_t dof = 0; dof < 3 * space_->owned_count(); ++dof) report_.held += problem_.is_held(dof) ? 1 : 0;
    report_.held = ranks_.all_reduce(report_.held, Reduction::sum);
    open_folder();
    report_.seconds.conditions = stage_.lap();
    progress("assemble", 0, 0);
    {
        const PetscSession petsc(ranks_, report_.wanted.solver.petsc);
        LinearSystem system(problem_, report_.wanted.solver);
        report_.seconds.assemble = stage_.lap();
        for (std::size_t i = 0; i < problem_.cases.size(); ++i) {
            progress("solve", i, problem_.cases.size());
            solve_case(system, i);
        }
    }
    progress("write", 0, 0);
    write();
    finish();
    return std::move(report_);
}

}  // namespace

double SolveReport::relative_error() const {
    double largest = 0;
    for (const CaseReport& of_case : cases) largest = std::max(largest, of_case.norms.relative());
    return largest;
}

SolveReport solve_run(const SolveRequest& request, MpiRanks& ranks, RunListener* listener) {
    return SolveStages(request, ranks, listener).run();
}

std::vector<PatchSummary> list_patches(const std::string& folder, MpiRanks& ranks) {
    std::unique_ptr<RunParts> parts;
    std::vector<PartIndex> first;
    std::vector<Part> own = in_agreement(ranks, [&] {
        parts = std::make_unique<RunParts>(folder);
        first = first_parts_of_ranks(parts->outline(), ranks.size());
        std::vector<Part> surfaces;
        const int r = ranks.rank();
        for (const PartIndex index : IdRange(first[r], first[r + 1]))
            surfaces.push_back(parts->load_only(index, PartContent::surface));
        return surfaces;
    });
    const FeSpace space(ranks, parts->outline(), first, std::move(own), 1);
    return SurfaceSelector(space, parts->outline().patch_names).summaries();
}

}  // namespace kerf
