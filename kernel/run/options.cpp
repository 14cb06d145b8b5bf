#include "run/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "export/format.h"
#include "io/output_file.h"
#include "io/run_folder.h"
#include "part/vtu_writer.h"
#include "volume/meshers.h"

namespace kerf {

namespace {

constexpr std::int32_t most_workers = 4096;
constexpr std::int64_t most_memory_mb = std::int64_t{1} << 40;
constexpr std::int64_t bytes_per_interface_point = 500;

template <class Enum>
OptionField::Choice choice(Enum& value, std::vector<std::string> names, int first = 0) {
    return {std::move(names), [&value, first] { return static_cast<int>(value) - first; },
            [&value, first](int i) { value = static_cast<Enum>(i + first); }};
}

void require(bool good, const std::string& option, const std::string& range, double value) {
    if (!good) throw Error(ErrorCode::usage, fmt::format("--{} is {}, but it must be {}.", option, value, range));
}

template <class T>
std::string text_of(const T* value) {
    return fmt::format("{}", *value);
}
std::string text_of(const OptionField::List items) { return join_items(*items); }
std::string text_of(const OptionField::Choice& choice) { return choice.names[static_cast<std::size_t>(choice.get())]; }

// False if the text is no such value: numbers that are not finite, or too small or too large for their type, are none.
template <class Number>
bool assign(Number* value, const std::string& text) {
    Number number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(static_cast<double>(number))) return false;
    *value = number;
    return true;
}
bool assign(bool* value, const std::string& text) {
    *value = text == "true";
    return *value || text == "false";
}
bool assign(std::string* value, const std::string& text) {
    *value = text;
    return true;
}
bool assign(OptionField::List items, const std::string& text) {
    *items = split_items(text);
    return true;
}
bool assign(const OptionField::Choice& choice, const std::string& text) {
    const auto found = std::find(choice.names.begin(), choice.names.end(), text);
    if (found == choice.names.end()) return false;
    choice.set(static_cast<int>(found - choice.names.begin()));
    return true;
}

}  // namespace

std::string join_items(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) {
        if (item.empty()) continue;
        if (!text.empty()) text += ';';
        for (const char c : item) {
            if (c == ';' || c == '\\') text += '\\';
            text += c;
        }
    }
    return text;
}

std::vector<std::string> split_items(const std::string& text) {
    std::vector<std::string> items(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ';')
            items.emplace_back();
        else
            items.back() += text[i] == '\\' && i + 1 < text.size() ? text[++i] : text[i];
    }
    std::erase(items, "");
    return items;
}

std::string OptionField::text() const {
    return std::visit([](const auto& place) { return text_of(place); }, value);
}

void OptionField::set_text(const std::string& text) const {
    if (!std::visit([&](const auto& place) { return assign(place, text); }, value))
        throw Error(ErrorCode::usage, fmt::format("'{}' is no value of --{}. {}", text, name, help));
}

void RunOptions::resolve(int cores_of_rank) {
    input_options.check();
    require(workers >= 0 && workers <= most_workers, "workers",
            fmt::format("0 (share of the processors) to {}", most_workers), workers);
    if (workers == 0) workers = std::max(1, cores_of_rank);
    require(decompose.parts >= 0, "parts", "1 or more", decompose.parts);
    decompose.threads = workers;  // they have nothing to do yet
    sizes.check();
    check_mesher_options(mesher);
    require(timeout_seconds >= 0 && std::isfinite(timeout_seconds), "timeout", "0 (none) or more seconds",
            timeout_seconds);
    require(memory_mb >= 0 && memory_mb <= most_memory_mb, "memory",
            fmt::format("0 (unlimited) to {} MB", most_memory_mb), static_cast<double>(memory_mb));
    require(attempts >= 1, "attempts", "1 or more", attempts);
    if (decompose.facets == FacetPolicy::keep && decompose.cut.contour == ContourMethod::straight)
        throw Error(ErrorCode::usage, "--contour straight splits facets, and --surface keep forbids it. Drop one.");
    if (formats.empty()) formats = "vtu";
    parse_formats(formats);
    if (fields.empty()) fields = "min-dihedral";
    parse_cell_fields(fields);
    parse_patch_types(patch_types);
    check_files();
    sizes.max_volume = sizes.constant_max_volume();
    if (!sizes.field_file.empty()) sizes.field_file = std::filesystem::absolute(sizes.field_file).string();
    use_sizes(SizeField(sizes.max_volume));
    if (memory_mb > 0) decompose.cut.max_interface_points = (memory_mb << 20) / bytes_per_interface_point;
}

// Cuts, forecasts and the mesher obey this field, and loads weigh it as the mesher does.
void RunOptions::use_sizes(const SizeField& field) {
    decompose.cut.size = decompose.cut.load.size = mesher.size = field;
    decompose.cut.load.volume_weight = find_mesher(mesher.name).forecast.volume_weight;
}

// Before any work, for all that can be known of the files by then.
void RunOptions::check_files() const {
    const std::vector<std::string> folders =
        dry_run || output.empty() ? std::vector<std::string>() : RunFolder::folders_of(output);
    const auto is_in_the_way = [&](const std::string& file) {
        return std::any_of(folders.begin(), folders.end(),
                           [&](const std::string& folder) { return lies_inside(file, folder); });
    };
    if (is_in_the_way(input))
        throw Error(ErrorCode::io,
                    fmt::format("The input {} lies in the output folder {}, which is replaced as a whole "
                                "when the run ends. Choose another output folder.",
                                input, output));
    for (const auto& [option, file] : {std::pair("--trace", &trace_file), std::pair("--events", &events_file),
                                       std::pair("--report", &report_file)}) {
        if (file->empty() || file->starts_with("fd:")) continue;
        if (is_in_the_way(*file))
            throw Error(ErrorCode::usage, fmt::format("{} is {}, which lies in the output folder {}. That is replaced "
                                                      "as a whole when the run ends, so choose a place outside of it.",
                                                      option, *file, output));
        refuse_to_overwrite(input, option, *file);
        require_writable(option, *file);
    }
}

void InputOptions::check() const {
    require(scale > 0 && std::isfinite(scale), "scale", "positive and finite", scale);
    require(weld_tolerance >= 0 && std::isfinite(weld_tolerance), "weld", "0 (only equal vertices) or positive",
            weld_tolerance);
    require(fill_hole_edges >= 0, "fill-holes", "0 (none) or more edges", fill_hole_edges);
    require(feature_angle_deg >= 0 && feature_angle_deg < 180, "feature-angle", "0 (none) or below 180 degrees",
            feature_angle_deg);
    require(cad.solid >= 0, "solid", "0 (all) or the number of one", cad.solid);
    require(cad.deflection == 0 || (cad.deflection >= 1e-7 && cad.deflection <= 0.1), "cad-deflection",
            "0 (by the volume) or from 1e-7 to 0.1", cad.deflection);
    require(optimisation_sweeps >= 0, "optimise-surface", "0 (keep it) or more sweeps", optimisation_sweeps);
}

std::vector<OptionField> input_option_fields(InputOptions& o) {
    return {
        {"scale", "", option_group::input, "F",
         "Multiply all coordinates by this as they are read, as 0.001 from mm to m. Default 1.", &o.scale},
        {"weld", "", option_group::input, "TOL",
         "Merge vertices closer than this, in units of the input. Default 0: only equal ones.", &o.weld_tolerance},
        {"fill-holes", "", option_group::input, "N", "Fill open loops of at most so many edges. Default 0: none.",
         &o.fill_hole_edges},
        {"keep-largest", "", option_group::input, "", "Keep only the connected component of the largest area.",
         &o.keep_largest},
        {"voids", "", option_group::input, "",
         "A shell inside another and turned like it: refused, or by parity a void. Default as-given.",
         choice(o.voids, {"as-given", "parity"})},
        {"feature-angle", "", option_group::input, "DEG",
         "Degrees between facets above which an edge bounds patches, if the file has none. Default 0: one patch.",
         &o.feature_angle_deg},
        {"solid", "", option_group::input, "N", "CAD files: only this solid, counted from 1. Default 0: all.",
         &o.cad.solid},
        {"unite", "", option_group::input, "", "CAD files: join solids that touch or overlap.", &o.cad.unite},
        {"unit", "", option_group::input, "", "CAD files: unit into which lengths are converted. Default mm.",
         choice(o.cad.unit, length_unit_names())},
        {"cad-deflection", "", option_group::input, "D",
         "CAD files: distance of chords from curves as a share of the diagonal. Default 0: by the volume, to 1e-4.",
         &o.cad.deflection},
        {"optimise-surface", "", option_group::input, "N",
         "Sweeps that slide vertices off the feature edges to better places first. Default 0: the surface is kept.",
         &o.optimisation_sweeps},
    };
}

std::vector<OptionField> size_option_fields(SizeOptions& o) {
    return {
        {"size", "", option_group::sizes, "H",
         "Wanted edge length inside, in units of the input. Default: as the surface.", &o.size},
        {"max-volume", "", option_group::sizes, "V", "Largest volume of a tetrahedron, instead of --size.",
         &o.max_volume},
        {"size-in", "", option_group::sizes, "SHAPE=H",
         "Edge length H in box:x0,y0,z0,x1,y1,z1=H, sphere:x,y,z,r=H or cylinder:x0,y0,z0,x1,y1,z1,r=H. Repeatable.",
         &o.inside},
        {"size-on", "", option_group::sizes, "NAME=H", "Edge length H on a patch of the input, as NAME=H. Repeatable.",
         &o.on},
        {"size-near", "", option_group::sizes, "NAME=H:D",
         "Edge length H up to the distance D from a patch, as NAME=H:D. Repeatable.", &o.near},
        {"growth", "", option_group::sizes, "G",
         "Growth of edge lengths per distance; if given, from the edges of the surface, too. Default 0: 0.3 from "
         "others.",
         &o.growth},
        {"size-field", "", option_group::sizes, "FILE",
         "Mesh of tetrahedra, .vtu or .msh, with the edge length as a scalar at its nodes.", &o.field_file},
        {"chord-error", "", option_group::sizes, "D",
         "Finer where the surface is curved: distance of edges from it, units of the input.", &o.chord_error},
        {"segments-per-turn", "", option_group::sizes, "N",
         "Finer where the surface is curved: edges of a full circle.", &o.segments_per_turn},
        {"cells-across", "", option_group::sizes, "N", "Finer where walls are thin: cells from one side to the other.",
         &o.cells_across},
    };
}

OptionField::Choice mesher_choice(std::string& name) {
    const auto get = [&name] {
        const std::vector<std::string> names = mesher_names();
        return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    return {mesher_names(), get, [&name](int i) { name = mesher_names()[static_cast<std::size_t>(i)]; }};
}

// What is done to the surface, from nothing to most.
OptionField::Choice surface_choice(RunOptions& o) {
    const auto get = [&o] {
        if (o.remeshing == Remeshing::of_cad_files) return 4;
        if (o.remeshing == Remeshing::where_slivers_spoil_cells) return 3;
        if (o.remeshing == Remeshing::always) return 2;
        return o.decompose.facets == FacetPolicy::keep ? 0 : 1;
    };
    const auto set = [&o](int value) {
        o.decompose.facets = value == 0 ? FacetPolicy::keep : FacetPolicy::split;
        o.remeshing = value == 2   ? Remeshing::always
                      : value == 3 ? Remeshing::where_slivers_spoil_cells
                      : value == 4 ? Remeshing::of_cad_files
                                   : Remeshing::never;
    };
    return {{"keep", "split", "remesh", "auto", "by-file"}, get, set};
}

std::vector<OptionField> option_fields(RunOptions& o) {
    CutOptions& cut = o.decompose.cut;
    std::vector<OptionField> fields = {
        {"parts", "n", option_group::cuts, "K",
         "Number of parts K >= 1. Default: 4 for each worker, or what --memory asks for.", &o.decompose.parts},
        {"radius-edge", "", option_group::meshing, "Q",
         "Bound of circumradius over shortest edge; 0: no refinement. Default 1.4.", &o.mesher.radius_edge},
        {"cut", "", option_group::cuts, "",
         "Where planes lie: across the principal axis, or a coordinate axis. Default inertia.",
         choice(cut.criterion, {"inertia", "volume", "equidistant"})},
        {"axis", "", option_group::cuts, "", "Coordinate axis across which to cut. Default: chosen by --cut.",
         choice(cut.axis, {"auto", "x", "y", "z"}, -1)},
        {"balance", "", option_group::expert, "", "What the halves of a cut have alike. Default work.",
         choice(cut.load.balance, {"nodes", "faces", "volume", "inertia", "work"})},
        {"contour", "", option_group::expert, "",
         "How contours are found: minimum cut, crossed edges, or split facets. Default min-cut.",
         choice(cut.contour, {"min-cut", "edges", "straight"})},
        {"surface", "", option_group::input, "",
         "keep every facet; split some where no contour of edges exists; remesh all within --deviation; auto: remesh "
         "where slivers would spoil the cells; by-file: remesh CAD files, split others. Default by-file.",
         surface_choice(o)},
        {"deviation", "", option_group::input, "D",
         "Largest distance of a remeshed surface from the input, in its units, or with % of its diagonal. Default "
         "0.002%.",
         &o.deviation},
        {"mesher", "", option_group::meshing, "",
         "What fills the parts: auto, the default, takes lattice, unless --tetgen is given.",
         mesher_choice(o.mesher.name)},
        {"improve", "", option_group::meshing, "",
         "Better cells in place of the worst; not with --tetgen. Default true: --no-improve keeps them.",
         &o.mesher.improve},
        {"workers", "", option_group::running, "W",
         "Mesher processes of each rank. Default: its share of the processors that it may use.", &o.workers, false},
        {"timeout", "", option_group::running, "S",
         "Seconds for one attempt at one part; 0: none. A part that took longer is marked in the report. Default 600.",
         &o.timeout_seconds, false},
        {"memory", "", option_group::running, "MB",
         "Memory of one worker in MB, by which K is chosen, too; 0: unlimited. Default 0.", &o.memory_mb, false},
        {"attempts", "", option_group::expert, "N",
         "Attempts at a part, at most: with other orders, tolerances, weaker bounds. Default 10.", &o.attempts},
        {"tetgen", "", option_group::expert, "SWITCHES",
         "Expert: TetGen switches instead of q and a (p, Y are always on).", &o.mesher.tetgen.switches},
        {"format", "", option_group::output, "LIST",
         "Formats of the result, with commas between; kerf export --help lists them. Default vtu.", &o.formats, false},
        {"fields", "", option_group::output, "LIST",
         "Qualities of each cell in vtu files, with commas between: min-dihedral, max-dihedral, radius-edge, aspect, "
         "shape; or all, or none. Default min-dihedral.",
         &o.fields, false},
        {"patch-type", "", option_group::output, "NAME=TYPE",
         "OpenFOAM's type of a patch: patch (default), wall, symmetry, symmetryPlane. Repeatable.", &o.patch_types,
         false},
        {"reference", "", option_group::output, "",
         "Mesh the whole in one piece, too, and compare: comparison.svg, and a table with -v.", &o.reference, false},
        {"stl", "", option_group::output, "", "Write the closed surface of every part as binary STL, too.", &o.stl,
         false},
        {"report", "", option_group::output, "FILE", "Write the report to this file too.", &o.report_file, false},
        {"events", "", option_group::running, "FILE",
         "Write progress as one JSON object per line to this file, or to fd:N.", &o.events_file, false},
        {"trace", "", option_group::expert, "FILE", "Write every cut with its stages and refused tries to this file.",
         &o.trace_file, false},
    };
    const std::vector<OptionField> of_sizes = size_option_fields(o.sizes);
    fields.insert(fields.begin() + 1, of_sizes.begin(), of_sizes.end());
    const std::vector<OptionField> of_input = input_option_fields(o.input_options);
    fields.insert(fields.end(), of_input.begin(), of_input.end());
    return fields;
}

std::vector<OptionText> option_texts(RunOptions options, bool shapes_parts_only) {
    std::vector<OptionText> texts;
    for (const OptionField& field : option_fields(options))
        if (field.shapes_parts || !shapes_parts_only) texts.push_back({field.name, field.text()});
    return texts;
}

void set_options(RunOptions& options, const std::vector<OptionText>& texts, const std::string& source) {
    const std::vector<OptionField> fields = option_fields(options);
    for (const OptionText& option : texts) {
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const OptionField& f) { return f.name == option.name; });
        if (field == fields.end())
            throw Error(ErrorCode::usage, fmt::format("{} has the option --{}, which this version of Kerf does not "
                                                      "know. Use the version that wrote it.",
                                                      source, option.name));
        field->set_text(option.text);
    }
}

}  // namespace kerf
