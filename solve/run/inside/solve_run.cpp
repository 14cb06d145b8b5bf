// The order of the stages: read the case and the parts, number the nodes, put the case on them, assemble, solve each
// case and recover its stresses, add up combinations, write. All ranks go through all stages. Work that one rank may
// fail at alone, as reading or writing its files, is done in_agreement(), so that all throw alike. The mesh, the case
// and the result folder are checked before PETSc starts. The stresses of a combination are recovered from the sum of
// the displacements, since von Mises stresses and errors do not add up. The result is written beside its place and gets
// that place at the end (files/io/run_folder.h); if a case does not converge there is none.
#include "solve/run/inside/solve_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "base/core/stopwatch.h"
#include "base/parallel/process_memory.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"
#include "files/io/output_file.h"
#include "files/io/run_folder.h"
#include "files/io/text_file.h"
#include "files/part/run_parts.h"
#include "files/part/second_order_parts.h"
#include "run/run/edge_numbering.h"
#include "run/run/shared_folder.h"
#include "solve/equations/elastic_problem.h"
#include "solve/equations/error_sizes.h"
#include "solve/run/inside/result_files.h"

namespace kerf {

namespace {

std::string way_out(const SolverOptions& solver, const SolveOutcome& outcome) {
    if (outcome.is_of_rounding)
        return fmt::format(
            "The rest is rounding (backward error {:.0e}), which a body so slender, or so soft beside others, "
            "multiplies. "
            "Take rtol = {:.0e}.",
            outcome.backward_error, std::pow(10, std::ceil(std::log10(outcome.residual))));
    return fmt::format(
        "{}Try preconditioner = \"{}\", a larger max_iterations or rtol, or a mesh with better cells "
        "(kerf quality).",
        solver.petsc.empty() ? ""
                             : fmt::format("The case tells PETSc '{}', which may end it sooner: leave "
                                           "that out. ",
                                           solver.petsc),
        solver.preconditioner == "multigrid" ? "icc" : "multigrid");
}

// Throws for results that are not finite: each number of a case may be finite, and their products not.
[[noreturn]] void throw_not_finite(const std::string& case_name) {
    throw Error(ErrorCode::usage,
                fmt::format("Displacements or stresses{} are larger than numbers can be. Look for numbers of the case "
                            "that are far too large or too small, and for units that do not go together.",
                            case_name.empty() ? "" : fmt::format(" in case '{}'", case_name)));
}

class SolveStages {
 public:
    SolveStages(const SolveRequest& request, MpiRanks& ranks, SolveListener* listener)
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
    // Tells of the parts of this rank, where ranks do not wait for each other.
    void tell_part(const char* stage, std::size_t done, std::size_t total) {
        if (!listener_) return;
        if (listener_->cancelled()) throw Error(ErrorCode::cancelled, "Interrupted; nothing was written.");
        if (is_root()) listener_->on_progress(stage, done, total);
    }
    void read_request();
    void open_folder();
    FeSpace make_space();
    void solve_cases();
    void find_all_modes();
    std::vector<PartValues> values_of(std::size_t p) const {
        return modes_.empty() ? values_of_part(problem_, solutions_, p) : values_of_part(problem_, modes_, p);
    }
    void solve_case(LinearSystem& system, std::size_t number);
    void combine(std::size_t number);
    void finish_case(std::size_t number);
    void require_finite() const;
    void require_no_reaction(std::size_t number) const;
    void write();
    void write_tables();
    void write_sizes_of_next();
    void finish();

    MpiRanks& ranks_;
    SolveListener* listener_;
    SolveReport report_;
    Stopwatch whole_, stage_;
    std::unique_ptr<RunParts> parts_;
    MeshOutline outline_;  // of the order of the elements
    std::optional<RunFolder> folder_;
    std::optional<FeSpace> space_;
    ElasticProblem problem_;
    std::vector<CaseSolution> solutions_;
    std::vector<Mode> modes_;
};

void SolveStages::read_request() {
    in_agreement(ranks_, [&] {
        const SolveRequest& request = report_.request;
        report_.wanted = read_case(request.case_file);
        if (request.modes == 0) require_effect(report_.wanted, request.case_file);
        report_.wanted.may_float = request.modes > 0;
        parts_ = std::make_unique<RunParts>(request.folder);
        const std::int64_t parts = std::ssize(parts_->outline().parts);
        if (parts < ranks_.size())
            throw Error(
                ErrorCode::usage,
                fmt::format("{} ranks are more than the {} parts of {}, of which each rank takes whole ones. Start "
                            "fewer ranks, or mesh into more parts.",
                            ranks_.size(), parts, request.folder));
        refuse_file_name("--output", request.output);
        if (lies_inside(request.output, request.folder) || lies_inside(request.folder, request.output))
            throw Error(ErrorCode::usage,
                        fmt::format("--output is {}, which holds the mesh or lies in it: {}. Choose another folder.",
                                    request.output, request.folder));
        refuse_to_overwrite(request.case_file, "--output", request.output);
    });
    const MeshOutline& outline = parts_->outline();
    int& order = report_.wanted.solver.order;
    if (order == 0) order = outline.order;
    order = report_.request.order.value_or(order);
    report_.parts = std::ssize(outline.parts);
    report_.tets = outline.tets();
    report_.vertices = outline.vertices;
}

// Opens the result folder, where nothing but an older solution may be replaced.
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
            const auto json = parse_json_or_null(read_file(old));
            if (!json.is_object() || !json.contains("solve"))
                throw Error(ErrorCode::io, fmt::format("{} holds another run than a solution. Move it away, or choose "
                                                       "another folder.",
                                                       output));
        }
        return RunFolder::create(output);
    }));
}

// Parts get nodes on straight edges where elements need them, and lose theirs where they do not.
FeSpace SolveStages::make_space() {
    const int order = report_.wanted.solver.order;
    std::optional<SecondOrderParts> with_nodes;
    if (order > parts_->outline().order) with_nodes.emplace(*parts_, number_edges_together(ranks_, *parts_, listener_));
    const PartSource& source = with_nodes ? static_cast<const PartSource&>(*with_nodes) : *parts_;
    outline_ = source.outline();
    outline_.order = order;
    if (order == 1) outline_.edge_nodes = 0;
    const std::vector<PartIndex> first = first_parts_of_ranks(outline_, ranks_.size());
    const int r = ranks_.rank();
    std::vector<Part> own = in_agreement(ranks_, [&] {
        std::vector<Part> parts;
        for (const PartIndex index : IdRange(first[r], first[r + 1])) {
            tell_part("read", parts.size(), first[r + 1].value() - first[r].value());
            parts.push_back(source.load(index));
            if (order == 1) parts.back().edge_nodes = {};
        }
        return parts;
    });
    report_.seconds.read = stage_.lap();
    progress("number", 0, 0);
    FeSpace space(ranks_, outline_, first, std::move(own), order);
    report_.seconds.number = stage_.lap();
    return space;
}

void SolveStages::solve_case(LinearSystem& system, std::size_t number) {
    CaseReport& of_case = report_.cases.emplace_back();
    CaseSolution& solution = solutions_.emplace_back();
    of_case.name = solution.name = problem_.cases[number].name;
    of_case.outcome =
        system.solve(problem_.cases[number].forces, solution.displacement, [this](int iteration, double residual) {
            if (listener_ && is_root()) listener_->on_iteration(iteration, residual, report_.wanted.solver.rtol);
        });
    report_.seconds.solve += of_case.outcome.solve_seconds;
    stage_.lap();
    if (of_case.outcome.reason == "DIVERGED_NANORINF") throw_not_finite(of_case.name);
    if (!of_case.outcome.converged)
        throw Error(ErrorCode::convergence,
                    fmt::format("The solver has not reached the tolerance {:g}{}: {} after {} iterations, residual "
                                "{:.3g}. {}",
                                report_.wanted.solver.rtol,
                                of_case.name.empty() ? "" : fmt::format(" in case '{}'", of_case.name),
                                of_case.outcome.reason, of_case.outcome.iterations, of_case.outcome.residual,
                                way_out(report_.wanted.solver, of_case.outcome)));
    if (problem_.relief.is_needed()) problem_.relief.remove_motions(problem_, solution.displacement);
    finish_case(number);
}

// Adds up cases with factors.
void SolveStages::combine(std::size_t number) {
    CaseReport& of_case = report_.cases.emplace_back();
    CaseSolution& solution = solutions_.emplace_back();
    of_case.name = solution.name = problem_.cases[number].name;
    of_case.outcome.converged = true;
    of_case.outcome.reason = "sum of cases";
    solution.displacement.assign(3 * space_->node_count(), 0);
    for (const auto& [of, factor] : problem_.cases[number].factors) {
        for (std::size_t dof = 0; dof < solution.displacement.size(); ++dof)
            solution.displacement[dof] += factor * solutions_[of].displacement[dof];
        const SolveOutcome& outcome = report_.cases[of].outcome;
        of_case.outcome.residual = std::max(of_case.outcome.residual, outcome.residual);
        of_case.outcome.backward_error = std::max(of_case.outcome.backward_error, outcome.backward_error);
    }
    finish_case(number);
}

void SolveStages::finish_case(std::size_t number) {
    progress("recover", number, problem_.cases.size());
    CaseSolution& solution = solutions_.back();
    solution.stress = recover_stress(problem_, solution.displacement, number);
    report_case(problem_, solution, number, parts_->outline().region_names, report_.cases.back());
    require_finite();
    if (problem_.relief.is_needed()) require_no_reaction(number);
    report_.seconds.recover += stage_.lap();
}

void SolveStages::require_finite() const {
    const CaseReport& of_case = report_.cases.back();
    bool is_finite = std::isfinite(of_case.norms.solution) && std::isfinite(of_case.norms.error);
    for (const double value : solutions_.back().displacement) is_finite = is_finite && std::isfinite(value);
    if (ranks_.all_reduce(std::int64_t{is_finite ? 0 : 1}, Reduction::sum) > 0) throw_not_finite(of_case.name);
}

// Throws if the support that fixes free bodies reacts: where inertia balances the loads it feels nothing but residuals
// of the equations.
void SolveStages::require_no_reaction(std::size_t number) const {
    std::array<double, 2> sums = {0, problem_.cases[number].load_sum};  // of the squares and of the sizes of forces
    for (const double force : problem_.cases[number].forces) sums[0] += force * force;
    ranks_.all_reduce(std::span<double>(sums), Reduction::sum);
    const double rounding = 1e-9 * sums[1];
    const double allowed = 10 * report_.wanted.solver.rtol * std::sqrt(3 * report_.nodes * sums[0]) + rounding;
    const double reaction = report_.cases.back().reactions.back().force.norm();
    if (reaction > allowed)
        throw Error(ErrorCode::internal,
                    fmt::format("Inertia does not balance the loads: the points that fix the body react with {:.3g}, "
                                "where {:.3g} at most is allowed.",
                                reaction, allowed));
}

void SolveStages::write() {
    const VtuLayout layout = layout_for(outline_, {});
    const std::vector<RunFile> own = in_agreement(ranks_, [&] {
        std::vector<RunFile> files;
        for (std::size_t p = 0; p < space_->parts().size(); ++p) {
            tell_part("write", p, space_->parts().size());
            const Part& part = space_->parts()[p];
            const std::string file = folder_->part_file(part.id);
            folder_->make_room({part.id});
            const FileHash hash = write_part(file, part, layout, values_of(p));
            files.push_back({"parts/" + part_file_name(part.id),
                             static_cast<std::int64_t>(std::filesystem::file_size(file)), hash_text(hash)});
        }
        return files;
    });
    report_.files = gather_items(ranks_, own);
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        std::vector<std::string> pieces;
        for (const PartExtent& part : outline_.parts) pieces.push_back("parts/" + part_file_name(part.id));
        // The arrays of any part will do.
        write_pvtu(folder_->file("mesh.pvtu"), pieces, layout, values_of(0));
        report_.files.push_back(describe_file(folder_->partial_path(), "mesh.pvtu"));
        if (modes_.empty()) return;
        write_text_file(folder_->file(modes_file), to_csv(modes_));
        report_.files.push_back(describe_file(folder_->partial_path(), modes_file));
    });
    if (modes_.empty()) write_tables();
    write_sizes_of_next();
    sort_files(report_.files);
    report_.seconds.write = stage_.lap();
}

void SolveStages::write_tables() {
    in_agreement(ranks_, [&] {
        if (!is_root()) return;
        write_text_file(folder_->file(results_file), results_csv(report_.cases));
        write_text_file(folder_->file(reactions_file), reactions_csv(report_.cases, report_.reacting));
        for (const char* file : {results_file, reactions_file})
            report_.files.push_back(describe_file(folder_->partial_path(), file));
    });
}

void SolveStages::write_sizes_of_next() {
    const std::optional<double> target = report_.request.target_error;
    if (!target || !modes_.empty() || report_.relative_error() <= *target) return;
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
    std::array<double*, 9> seconds = {&report_.seconds.read,     &report_.seconds.number,  &report_.seconds.conditions,
                                      &report_.seconds.assemble, &report_.seconds.setup,   &report_.seconds.solve,
                                      &report_.seconds.modes,    &report_.seconds.recover, &report_.seconds.write};
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

void SolveStages::solve_cases() {
    progress("assemble", 0, 0);
    {
        LinearSystem system(problem_, report_.wanted.solver);
        report_.seconds.assemble = stage_.lap();
        progress("setup", 0, 0);
        report_.seconds.setup = system.set_up();
        for (std::size_t i = 0; i < problem_.cases.size(); ++i) {
            if (!problem_.cases[i].factors.empty()) continue;
            progress("solve", i, problem_.cases.size());
            solve_case(system, i);
        }
    }
    for (std::size_t i = 0; i < problem_.cases.size(); ++i)
        if (!problem_.cases[i].factors.empty()) combine(i);
}

void SolveStages::find_all_modes() {
    progress("modes", 0, static_cast<std::size_t>(report_.request.modes));
    int most = 0;  // residuals that are measured anew may be above the tolerance again
    FoundModes found = find_modes(problem_, report_.request.modes, [this, &most](int, int so_many) {
        most = std::max(most, so_many);
        if (listener_ && is_root())
            listener_->on_progress("modes", static_cast<std::size_t>(most),
                                   static_cast<std::size_t>(report_.request.modes));
    });
    modes_ = std::move(found.modes);
    report_.mode_iterations = found.iterations;
    for (const Mode& mode : modes_)
        report_.modes.push_back({mode.frequency, mode.is_rigid, mode.residual, {}, mode.displacement});
    report_.seconds.modes = stage_.lap();
}

SolveReport SolveStages::run() {
    read_request();  // refusals come before any progress
    progress("read", 0, 0);
    space_.emplace(make_space());
    progress("conditions", 0, 0);
    problem_ = make_problem(*space_, parts_->outline(), report_.wanted);
    report_.nodes = space_->total_rows();
    for (std::size_t s = 0; s < problem_.supports.size(); ++s)
        report_.reacting.push_back({problem_.supports[s], problem_.places[s]});
    for (std::int32_t dof = 0; dof < 3 * space_->owned_count(); ++dof) report_.held += problem_.is_held(dof) ? 1 : 0;
    report_.held = ranks_.all_reduce(report_.held, Reduction::sum);
    open_folder();
    report_.seconds.conditions = stage_.lap();
    if (listener_ && is_root()) listener_->on_equations(3 * report_.nodes - report_.held);
    const PetscSession petsc(ranks_, report_.wanted.solver.petsc);
    if (report_.request.modes > 0)
        find_all_modes();
    else
        solve_cases();
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

SolveReport solve_run(const SolveRequest& request, MpiRanks& ranks, SolveListener* listener) {
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
