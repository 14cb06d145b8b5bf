// to_text() is a list of lines, each a label and a text; a line whose text is empty is left out, so that each function
// returns "" where it has nothing to say. ReportDetail::brief leaves out all that is alike for most inputs, and keeps
// what is special to this one: repairs, retries, forced cells among the worst hundredth, bounds that were asked for and
// missed. JSON is another file (report_json.cpp) over the same RunReport.
#include "run/report/report.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/core/words.h"
#include "run/report/inside/exceeded_bounds.h"
#include "run/report/inside/sharp_places.h"
#include "surface/repair/repair_step.h"

namespace kerf {

bool RunVerification::all_hold() const {
    const auto holds = [&](const RunLaw& law) { return this->*law.count == 0; };
    return volume_rel_error <= volume_rel_bound && std::all_of(run_laws.begin(), run_laws.end(), holds);
}

namespace {

std::string strategies_text(const std::vector<TreeNode>& nodes) {
    std::map<CutStrategy, int> counts;
    int cuts = 0;
    for (const TreeNode& node : nodes)
        if (node.cut_tried) {
            ++counts[node.strategy];
            ++cuts;
        }
    std::string text = fmt::format("{} cut{}", cuts, cuts == 1 ? "" : "s");
    for (const auto& [strategy, count] : counts) text += fmt::format(", {} {}", count, in_words(name(strategy)));
    return text;
}

// Returns "part 13: tolerance 1e-06; part 14: another order of the vertices; and 2 more", of the parts that were filled
// and for which text_of() is not empty.
std::string first_parts_text(const RunReport& report, const std::function<std::string(const PartReport&)>& text_of) {
    constexpr std::size_t limit = 3;
    std::vector<std::string> all;
    for (const PartReport& part : report.parts)
        if (const std::string text = part.result.code == 0 ? text_of(part) : ""; !text.empty())
            all.push_back(fmt::format("part {}: {}", part.id.value(), text));
    const auto end = all.begin() + std::min(limit, all.size());
    const std::string more = all.size() > limit ? fmt::format("; and {} more", all.size() - limit) : "";
    return fmt::format("{}{}", fmt::join(all.begin(), end, "; "), more);
}

std::string fallbacks_text(const RunReport& report) {
    return first_parts_text(report, [](const PartReport& part) { return part.fallback; });
}

// Returns how many parts TetGen had to fill for Kerf's own mesher, and the reasons.
std::string tetgen_text(const RunReport& report) {
    const MesherChoices& asked = report.request.mesher;
    if (report.mesh.parts_by_tetgen == 0 || asked.name == "tetgen" || !asked.tetgen.switches.empty()) return "";
    const auto reason_of = [](const PartReport& part) {
        const PartResult& result = part.result;
        if (!result.is_by_tetgen()) return std::string();
        std::string text = result.reason.empty() && !part.failures.empty() ? part.failures.front() : result.reason;
        if (text.ends_with('.')) text.pop_back();
        return text;
    };
    return fmt::format("has filled {} of {} parts, slower, since Kerf's own mesher has failed: {}",
                       report.mesh.parts_by_tetgen, report.parts.size(), first_parts_text(report, reason_of));
}

// "7 core and shell, 1 shell alone".
std::string ways_text(const RunReport& report) {
    std::string text;
    for (const auto& [way, parts] : report.mesh.parts_by_way)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(parts), way);
    return text;
}

std::string recovery_text(const FacetRecoveryCounts& recovery) {
    if (recovery.missing == 0) return "";
    std::string text = fmt::format("{} facets that were not Delaunay: {} by flips", grouped(recovery.missing),
                                   grouped(recovery.by_flips));
    if (recovery.split > 0) text += fmt::format(", {} split for a while", grouped(recovery.split));
    if (recovery.added_vertices > 0)
        text += fmt::format("; {} vertices added inside", grouped(recovery.added_vertices));
    return text;
}

// Returns the parts that were repeated because workers were killed, and those that may differ because they were too
// slow.
std::string disturbances_text(const RunReport& report) {
    const auto count = [&](auto is_so) { return std::count_if(report.parts.begin(), report.parts.end(), is_so); };
    const auto killed = count([](const PartReport& part) { return !part.interruption.empty(); });
    const auto late = count([](const PartReport& part) { return part.timed_out; });
    std::string text;
    if (killed > 0) text = fmt::format("{} part{} again after the worker was killed", killed, killed == 1 ? "" : "s");
    if (late > 0)
        text += fmt::format("{}{} part{} after a time-out, whose bytes may differ from an undisturbed run",
                            text.empty() ? "" : "; ", late, late == 1 ? "" : "s");
    return text;
}

// The mesh of the whole in one piece, to be read beside that of the parts.
std::string reference_text(const RunReport& report) {
    const PartOutcome& whole = report.reference->outcome;
    if (whole.result.code) return "the whole could not be meshed in one piece: " + whole.result.message;
    const Distribution& dihedral = whole.result.quality.all.measures[0];
    return fmt::format("{} tetrahedra in one piece in {:.2f} s; dihedral min {:.1f}, 1 % {:.1f}, median {:.1f} deg",
                       grouped(whole.result.tets), whole.seconds, dihedral.min(), dihedral.percentile(0.01),
                       dihedral.percentile(0.5));
}

std::string improvement_text(const RunReport& report) {
    const ImprovedAngles angles(report.mesh.improvement, report.mesh.quality);
    return fmt::format("dihedral 1 % {:.1f} -> {:.1f}, min {:.1f} -> {:.1f} deg; {:.2f} s in all workers",
                       angles.p1_before_deg, angles.p1_after_deg, angles.min_before_deg, angles.min_after_deg,
                       report.mesh.improve_seconds);
}

// Returns the cells that the surface forces to be sharp, where these are of interest: always, or among the worst
// hundredth.
std::string forced_text(const ForcedDistributions& angles, bool always) {
    const Distribution &forced = angles.forced, &others = angles.unforced;
    if (forced.count() == 0 || (!always && others.count() > 0 && others.percentile(0.01) < forced.min())) return "";
    const std::string text = fmt::format("by the surface: {} cell{}, dihedral min {:.1f} deg", grouped(forced.count()),
                                         forced.count() == 1 ? "" : "s", forced.min());
    if (others.count() == 0) return text;
    return text + fmt::format("; others min {:.1f}, 1 % {:.1f}", others.min(), others.percentile(0.01));
}

// Returns bounds that were missed. Briefly, the usual ratio is left out, which cells at sharp places exceed in every
// mesh; a bound of volumes stays, which only those have who ask for it.
std::vector<ExceededBound> told_bounds(const RunReport& report, bool all) {
    std::vector<ExceededBound> bounds = exceeded_bounds(report);
    if (!all)
        std::erase_if(bounds, [](const ExceededBound& each) {
            return std::string_view(each.option) == "radius-edge" && each.bound == MesherChoices().radius_edge;
        });
    return bounds;
}

// The seconds of stages and workers.
std::string time_text(const RunReport& report) {
    const StageSeconds& s = report.seconds;
    std::string text = fmt::format("{:.2f} s: read {:.2f}, decompose {:.2f}", s.wall, s.read, s.decompose);
    if (!report.request.volume) return text;
    const WorkerSeconds& w = report.worker_seconds;
    text += fmt::format(
        ", prepare {:.2f}, mesh {:.2f} (mesher {:.2f}, verify {:.2f}, store {:.2f}, start {:.2f}, idle {:.2f})",
        s.prepare, s.mesh, w.mesher, w.verify, w.store, w.start, w.idle);
    if (report.curve) text += fmt::format(", curve {:.2f}", s.curve);
    return text + fmt::format(", write {:.2f}, hash {:.2f}", s.write, s.hash);
}

std::string division_text(const InputRemeshing& done) {
    return fmt::format("{} of {} facets, which are coarser than the sizes (--surface keep forbids it)",
                       grouped(done.facets_before - done.facets_kept), grouped(done.facets_before));
}

// Shares of something by their reasons, without those below a hundredth.
std::string reasons_text(double curved, double features, double walls, const char* way_out) {
    constexpr double told_share = 0.01;
    std::vector<std::string> reasons;
    const auto add = [&](double share, const std::string& reason) {
        if (share >= told_share) reasons.push_back(fmt::format("{:.0f} % {}", 100 * share, reason));
    };
    add(curved, fmt::format("because it is curved{}", way_out));
    add(features, "in strips between features");
    add(walls, "at thin walls");
    return fmt::format("{}", fmt::join(reasons, ", "));
}

// Returns the reasons other than the size for short edges, and the way to change that.
std::string finer_text(const FinerShares& finer) {
    const std::string reasons =
        reasons_text(finer.bound, finer.features, finer.walls, " (a larger --deviation allows longer edges)");
    if (reasons.empty()) return "";
    return fmt::format("; finer than asked for on {:.0f} % of the area: {}", 100 * finer.sum(), reasons);
}

// Returns what makes many facets of few where no size does, and the way to fewer.
std::string many_text(const InputRemeshing& done) {
    constexpr double many = 4;  // times as many as before
    const FacetsByReason& by = done.facets_by;
    const auto facets = static_cast<double>(by.asked + by.bound + by.features + by.walls);
    const double times = facets / static_cast<double>(std::max<std::int64_t>(1, done.facets_before));
    const auto share = [&](std::int64_t count) { return static_cast<double>(count) / facets; };
    if (times <= many || done.finer.sum() > 0 || share(by.asked) > 0.5) return "";
    return fmt::format("; {:.1f} times as many facets, {}: --fineness coarse or a larger --deviation makes fewer",
                       times, reasons_text(share(by.bound), share(by.features), share(by.walls), ""));
}

}  // namespace

std::string repairs_text(const TidyCounts& tidied, const RepairReport& ladder, const OrientationReport& turned) {
    std::string text;
    const auto add = [&](std::int64_t count, const char* what) {
        if (count) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(count), what);
    };
    add(tidied.dropped_facets, "superfluous facets dropped");
    add(turned.facets_flipped, "facets turned");
    add(turned.shells_flipped, "shells turned");
    add(ladder.done_by(RepairKind::merge), "vertices merged");
    add(ladder.done_by(RepairKind::largest), "facets of smaller components removed");
    add(ladder.done_by(RepairKind::span), "holes filled");
    return text;
}

std::string remeshing_text(const InputRemeshing& done) {
    if (done.only_divided) return "divided: " + division_text(done);
    const std::string kept = done.facets_kept > 0 ? fmt::format(", {} of them kept", grouped(done.facets_kept)) : "";
    return fmt::format(
        "from {} facets{}; smallest angle {:.3g} deg from {:.3g}, 1 % {:.3g} from {:.3g}; largest distances {:.2g} and "
        "{:.2g} of {:.2g}{}{}",
        grouped(done.facets_before), kept, done.angles.smallest, done.angles_before.smallest, done.angles.first_percent,
        done.angles_before.first_percent, done.distance_to_input, done.distance_from_input, done.deviation,
        finer_text(done.finer), many_text(done));
}

namespace {

// Sums over all cuts, and the smallest angle.
struct InterfaceTotals {
    double section_area = 0, area = 0, angle_deg = 180;
};

InterfaceTotals interface_totals(const std::vector<TreeNode>& nodes) {
    InterfaceTotals totals;
    for (const TreeNode& node : nodes) {
        totals.section_area += node.section_area;
        totals.area += node.interface_area;
        if (node.cut_made) totals.angle_deg = std::min(totals.angle_deg, node.quality.angle_deg);
    }
    return totals;
}

class ReportLines {
 public:
    void add(const char* label, const std::string& value) {
        if (!value.empty()) text_ += fmt::format("{:<11} {}\n", label, value);
    }
    // Adds a line that users ought to see wherever the text itself is not shown.
    void add_note(const char* label, const std::string& value) {
        add(label, value);
        if (!value.empty())
            notes_.push_back(label == std::string_view("note") ? value : fmt::format("{}: {}", label, value));
    }
    const std::string& text() const { return text_; }
    const std::vector<std::string>& notes() const { return notes_; }

 private:
    std::string text_;
    std::vector<std::string> notes_;
};

// Returns the regions, the largest first; of many, the others as a number.
std::string regions_text(const RunReport& report) {
    const Input& input = report.input;
    if (input.regions.empty()) return "";
    constexpr std::size_t most = 6;
    Array<RegionIndex, std::int64_t> tets(input.regions.size(), 0);
    for (const PartReport& part : report.parts) tets[part.region] += part.result.tets;
    std::vector<RegionIndex> order;
    for (const RegionIndex r : tets.ids()) order.push_back(r);
    std::stable_sort(order.begin(), order.end(), [&](RegionIndex a, RegionIndex b) {
        return std::pair(tets[a], input.regions[a].volume) > std::pair(tets[b], input.regions[b].volume);
    });
    std::string text = fmt::format("{}:", order.size());
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i) {
        const RegionIndex r = order[i];
        text += fmt::format("{} {} ", i > 0 ? "," : "", input.complex.region_names()[r.value()]);
        text += tets[r] > 0 ? grouped(tets[r]) : fmt::format("(volume {:.4g})", input.regions[r].volume);
    }
    return order.size() > most ? text + fmt::format(" and {} more", order.size() - most) : text;
}

std::string air_text(const Enclosure& enclosure) {
    return fmt::format("box from ({:.4g}) to ({:.4g}), edges {:.3g} on its faces; bodies take {:.6g} of it",
                       fmt::join(enclosure.box.min(), ", "), fmt::join(enclosure.box.max(), ", "), enclosure.edge,
                       enclosure.body_volume);
}

// Adds what was done to the surface before it was cut.
void add_changes(ReportLines& lines, const Input& input) {
    lines.add_note("repaired", repairs_text(input.tidied, input.ladder, input.orientation));
    for (const StepReport& step : input.ladder.steps)
        for (const RepairAction& action : step.actions)
            lines.add_note("repair", fmt::format("{}: {}", name(step.kind), to_text(action)));
    if (input.wrapped) lines.add_note("wrapped", to_text(*input.wrapped));
    if (input.enclosure) lines.add("air", air_text(*input.enclosure));
    for (const std::string& note : input.notes) lines.add_note("note", note);
    if (input.moved_vertices > 0)
        lines.add_note("optimised", fmt::format("{} vertices moved by {:.3g} at most", grouped(input.moved_vertices),
                                                input.largest_move));
    if (input.remeshed && input.remeshed->only_divided) lines.add_note("divided", division_text(*input.remeshed));
    if (input.remeshed && !input.remeshed->only_divided) lines.add_note("remeshed", remeshing_text(*input.remeshed));
}

void add_input(ReportLines& lines, const RunReport& report, bool all) {
    const Input& input = report.input;
    const std::string facets = grouped(input.facets), of_file = grouped(facets_of_file(input));
    const bool has_others = input.remeshed || input.wrapped;
    if (all)
        lines.add("input", fmt::format("{}: {} facets, {} shell{}, genus {}, volume {:.6g}", input.path, of_file,
                                       input.components, input.components == 1 ? "" : "s", input.genus, input.volume));
    if (has_others) lines.add("facets", fmt::format("{} of the file, {} of the mesh's surface", of_file, facets));
    add_changes(lines, input);
}

void add_cuts(ReportLines& lines, const RunReport& report) {
    lines.add("parts", fmt::format("{} of {} wanted; {}", report.parts.size(), report.request.parts,
                                   strategies_text(report.cut.nodes)));
    if (report.cut.split_facets > 0)
        lines.add("split", fmt::format("{} facets, where no contour of edges exists (--surface keep forbids it)",
                                       grouped(report.cut.split_facets)));
    const InterfaceTotals totals = interface_totals(report.cut.nodes);
    if (totals.section_area > 0)
        lines.add("interfaces", fmt::format("area {:.6g}, {:.3f} of the plane sections; smallest angle {:.1f} deg",
                                            totals.area, totals.area / totals.section_area, totals.angle_deg));
}

void add_way(ReportLines& lines, const RunReport& report) {
    lines.add_note("TetGen", tetgen_text(report));
    lines.add_note("retried", fallbacks_text(report));
    lines.add_note("disturbed", disturbances_text(report));
    const auto resumed = std::count_if(report.parts.begin(), report.parts.end(), std::mem_fn(&PartReport::resumed));
    if (resumed > 0) lines.add_note("continued", fmt::format("{} parts were finished by an interrupted run", resumed));
}

std::string curve_text(const CurveReport& curve) {
    std::string text =
        fmt::format("{} of {} edges of the surface, {} straightened; {} cells, scaled Jacobian at least {:.3f}",
                    grouped(curve.curved_edges), grouped(curve.surface_edges), grouped(curve.straightened_edges),
                    grouped(curve.curved_cells), curve.worst_scaled_jacobian);
    if (curve.moved_nodes > 0) text += fmt::format("; {} nodes inside were moved", grouped(curve.moved_nodes));
    return text;
}

// Tells by how much a number of cells that was asked for was missed, where that is more than is promised.
std::string missed_text(const RunReport& report) {
    constexpr double promised = 0.15;
    const FoundSize& found = *report.found_size;
    const double ratio =
        static_cast<double>(report.mesh.tets) / static_cast<double>(std::max<std::int64_t>(1, found.cells));
    if (std::abs(ratio - 1) <= promised) return "";
    return fmt::format("; {:.0f} % {} than asked for: the forecast errs on such a shape, ask for {} to come nearer",
                       100 * std::abs(ratio - 1), ratio > 1 ? "more" : "fewer",
                       short_number(std::clamp(static_cast<double>(found.cells) / ratio, 1.0, 1e12)));
}

// Returns whether edges are much shorter than asked for, or longer than their bounds.
bool misses_sizes(const RunReport& report) {
    constexpr double much_shorter = 0.9;
    const SizeRatios& ratios = report.mesh.sizes;
    const SizeOptions& sizes = report.request.sizes;
    if (ratios.empty()) return false;
    return sizes.meaning == SizeMeaning::bound ? ratios.share_from(1 / sizes.mean_over_size()) > 0
                                               : ratios.mean() <= much_shorter;
}

// Returns how long edges are beside what was asked for, and why they are shorter if they are by much.
std::string mean_size_text(const RunReport& report) {
    const SizeRatios& ratios = report.mesh.sizes;
    const SizeOptions& sizes = report.request.sizes;
    const bool is_length_wanted = sizes.size.number() > 0 || sizes.depends_on_place();
    if (ratios.empty() || !is_length_wanted) return "";
    const double mean = ratios.mean(), longer = ratios.share_from(1 / sizes.mean_over_size());
    if (sizes.meaning == SizeMeaning::bound)
        return fmt::format("{:.2g} % of the edges are longer than the bounds", 100 * longer);
    std::string text = fmt::format("edges have {:.2f} of the wanted length on average", mean);
    if (!misses_sizes(report)) return text;
    if (const double size = sizes.size.number(); size > report.input.diagonal)
        return text + fmt::format("; {:.4g} is longer than the whole body ({:.4g}): is its unit another one?", size,
                                  report.input.diagonal);
    const bool is_remeshed = report.input.remeshed && !report.input.remeshed->only_divided;
    return text + (is_remeshed ? "; the shape needs shorter ones (fewer with a larger --deviation)"
                               : "; facets of the file are finer (--surface remesh makes them as wanted)");
}

// Returns lines on the shapes that have sizes of their own.
std::string cells_in_solids_text(const RunReport& report) {
    constexpr std::size_t most = 5;
    const std::vector<std::string> solids = report.size.solids();
    const std::vector<std::int64_t>& cells = report.mesh.sizes.cells_in_solids;
    std::string text;
    for (std::size_t i = 0; i < std::min({most, solids.size(), cells.size()}); ++i)
        text += fmt::format("{}{} tetrahedra in {}", text.empty() ? "" : fmt::format("\n{:<11} ", ""),
                            grouped(cells[i]), solids[i]);
    return text;
}

// Tells shapes with sizes of their own that have no cell.
void add_empty_solids(ReportLines& lines, const RunReport& report) {
    const std::vector<std::string> solids = report.size.solids();
    const std::vector<std::int64_t>& cells = report.mesh.sizes.cells_in_solids;
    for (std::size_t i = 0; i < std::min(solids.size(), cells.size()); ++i)
        if (cells[i] == 0) lines.add_note("note", fmt::format("No cell lies in {} of --size-in.", solids[i]));
}

void add_mesh(ReportLines& lines, const RunReport& report, bool all) {
    const std::string parts =
        all ? "" : fmt::format(", {} part{}", report.parts.size(), report.parts.size() == 1 ? "" : "s");
    const std::string nodes =
        report.mesh.nodes > 0 ? fmt::format(", {} nodes of order 2", grouped(report.mesh.nodes)) : std::string();
    lines.add("mesh", fmt::format("{} tetrahedra, {} vertices{}{}", grouped(report.mesh.tets),
                                  grouped(report.mesh.vertices), nodes, parts));
    lines.add("regions", regions_text(report));
    if (report.found_size) {
        const std::string missed = missed_text(report);
        const std::string text = found_size_text(*report.found_size) + missed;
        missed.empty() ? lines.add("cells", text) : lines.add_note("cells", text);
    }
    if (all) lines.add("filled", ways_text(report));
    if (all) lines.add("recovered", recovery_text(report.mesh.recovery));
    if (all && !report.mesh.improvement.is_empty()) lines.add("improved", improvement_text(report));
    if (misses_sizes(report))
        lines.add_note("sizes", mean_size_text(report));
    else
        lines.add("sizes", mean_size_text(report));
    if (all && !report.mesh.sizes.empty())
        lines.add("", size_text(report.mesh.sizes, report.input.patch_names, !report.size.is_constant()));
    if (all) lines.add("", cells_in_solids_text(report));
    add_empty_solids(lines, report);
    if (report.mesh.quality.all.measures.empty()) return;  // nothing was measured
    const Distribution& dihedral = report.mesh.quality.all.measures[0];
    const Distribution& ratio = report.mesh.quality.all.measures[2];
    lines.add("quality", fmt::format("dihedral min {:.1f}, 1 % {:.1f}, median {:.1f} deg; radius-edge max {:.2f}",
                                     dihedral.min(), dihedral.percentile(0.01), dihedral.percentile(0.5), ratio.max()));
    lines.add_note("forced", forced_text(report.mesh.quality.angles, all));
    for (const SharpPlace& place : sharp_places(report)) lines.add_note("sharp", sharp_text(place));
    lines.add_note("bounds", exceeded_text(told_bounds(report, all)));
    if (report.curve) lines.add("curved", curve_text(*report.curve));
}

std::string volume_text(const RunReport& report) {
    const Input& input = report.input;
    const double before = volume_before_remeshing(input);
    const double volume = input.volume + (report.curve ? report.curve->volume_gain : 0);
    const bool is_as_read = input.ladder.steps.empty() && !input.ladder.changed() && !input.wrapped;
    const char* of = input.enclosure ? "the box without bodies" : is_as_read ? "the file" : "the repaired surface";
    // Flat facets are a matter of how a CAD file was read, not of its body.
    if (report.curve && input.is_cad)
        return fmt::format("{:.7g} with its curved cells; the flat facets that it began with have {:.7g}", volume,
                           before);
    if (volume == before) return fmt::format("{:.7g}, as {} has it", volume, of);
    return fmt::format("{:.7g}; {} has {:.7g}, difference {:+.1e}", volume, of, before,
                       (volume - before) / input.reference_volume(before)) +
           (input.enclosure ? " of the bodies" : "");
}

std::string ranks_text(const RunReport& report) {
    return fmt::format("{} rank{} x {} worker{}", report.ranks, report.ranks == 1 ? "" : "s",
                       report.request.workers.count, report.request.workers.count == 1 ? "" : "s");
}

std::string processes_text(const RunReport& report) {
    return fmt::format("{}, imbalance {:.2f}, peak memory {} MB", ranks_text(report), report.imbalance,
                       report.peak_rss_bytes >> 20);
}

ReportLines lines_of(const RunReport& report, bool all) {
    const bool meshed = report.request.volume;
    ReportLines lines;
    add_input(lines, report, all);
    if (all || !meshed) add_cuts(lines, report);
    add_way(lines, report);
    if (meshed) add_mesh(lines, report, all);
    if (report.reference) lines.add("reference", reference_text(report));
    lines.add("time", all ? time_text(report) : fmt::format("{:.2f} s on {}", report.seconds.wall, ranks_text(report)));
    if (all) lines.add("processes", processes_text(report));
    lines.add("volume", volume_text(report));
    lines.add("verified",
              fmt::format("{}; volume error {:.1e}", report.verification.passed ? "yes, every law holds" : "NO",
                          report.verification.volume_rel_error));
    if (all) lines.add("mesh hash", report.mesh.hash);
    return lines;
}

}  // namespace

std::string to_text(const RunReport& report, ReportDetail detail) {
    return lines_of(report, detail == ReportDetail::all).text();
}

std::vector<std::string> notes_of(const RunReport& report) { return lines_of(report, false).notes(); }

std::vector<std::string> notes_of(const Input& input) {
    ReportLines lines;
    add_changes(lines, input);
    return lines.notes();
}

}  // namespace kerf
