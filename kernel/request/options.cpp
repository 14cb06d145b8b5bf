#include "request/options.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "export/format.h"
#include "io/run_folder.h"
#include "part/vtu_writer.h"
#include "volume/meshers.h"

namespace kerf {

namespace {

constexpr std::int64_t bytes_per_interface_point = 500;

template <class Enum>
OptionField::Choice choice(Enum& value, std::vector<std::string> names, int first = 0) {
    return {std::move(names), [&value, first] { return static_cast<int>(value) - first; },
            [&value, first](int i) { value = static_cast<Enum>(i + first); }};
}

template <class T>
std::string text_of(const T* value) {
    return fmt::format("{}", *value);
}
std::string text_of(const Length* length) { return length->text(); }
std::string text_of(const OptionField::List items) { return join_items(*items); }
std::string text_of(const OptionField::Choice& choice) { return choice.names[static_cast<std::size_t>(choice.get())]; }

// Sets the value. Throws Error(usage) for a text that is none.
template <class Number>
void assign(Number* value, const std::string& text, const OptionField& field) {
    *value = parse_number<Number>(field.name, text, field.range);
}
void assign(Length* value, const std::string& text, const OptionField& field) {
    *value = parse_length(field.name, text, field.range);
}
void assign(bool* value, const std::string& text, const OptionField& field) {
    if (text != "true" && text != "false")
        throw Error(ErrorCode::usage, fmt::format("--{} is '{}', but it must be true or false.", field.name, text));
    *value = text == "true";
}
void assign(std::string* value, const std::string& text, const OptionField&) { *value = text; }
void assign(OptionField::List items, const std::string& text, const OptionField&) { *items = split_items(text); }
void assign(const OptionField::Choice& choice, const std::string& text, const OptionField& field) {
    const auto found = std::find(choice.names.begin(), choice.names.end(), text);
    if (found == choice.names.end())
        throw Error(ErrorCode::usage, fmt::format("--{} is '{}', but it must be one of {}.", field.name, text,
                                                  fmt::join(choice.names, ", ")));
    choice.set(static_cast<int>(found - choice.names.begin()));
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
    std::visit([&](const auto& place) { assign(place, text, *this); }, value);
}

void OptionField::check() const {
    const auto check_value = [&](const auto& place) {
        using Value = std::decay_t<decltype(place)>;
        if constexpr (std::is_same_v<Value, Length*>)
            require_in(range, name, place->number());
        else if constexpr (std::is_same_v<Value, double*> || std::is_same_v<Value, std::int32_t*> ||
                           std::is_same_v<Value, std::int64_t*>)
            require_in(range, name, static_cast<double>(*place));
    };
    std::visit(check_value, value);
}

bool OptionField::is_number() const {
    return std::holds_alternative<std::int32_t*>(value) || std::holds_alternative<std::int64_t*>(value) ||
           std::holds_alternative<double*>(value) || std::holds_alternative<Length*>(value);
}

void RunOptions::resolve(int cores_of_rank) {
    for (const OptionField& field : option_fields(*this)) field.check();
    if (workers == 0) workers = std::max(1, cores_of_rank);
    decompose.threads = workers;  // they have nothing to do yet
    sizes.check();
    check_mesher_options(mesher);
    if (decompose.facets == FacetPolicy::keep && decompose.cut.contour == ContourMethod::straight)
        throw Error(ErrorCode::usage, "--contour straight splits facets, and --surface keep forbids it. Drop one.");
    if (formats.empty()) formats = "vtu";
    parse_formats(formats);
    if (fields.empty()) fields = "min-dihedral";
    parse_cell_fields(fields);
    parse_patch_types(patch_types);
    check_files();
    if (!sizes.field_file.empty()) sizes.field_file = std::filesystem::absolute(sizes.field_file).string();
    if (!sizes.size.is_percent()) use_constant_size();
    if (memory_mb > 0) decompose.cut.max_interface_points = (memory_mb << 20) / bytes_per_interface_point;
}

void RunOptions::resolve_lengths(double diagonal) {
    const bool has_percentage = sizes.size.is_percent();
    deviation = deviation.of(diagonal);
    sizes.resolve_lengths(diagonal);
    sizes.check();
    if (has_percentage) use_constant_size();
}

void RunOptions::use_constant_size() {
    sizes.max_volume = sizes.constant_max_volume();
    use_sizes(SizeField(sizes.max_volume));
}

// Cuts, forecasts and the mesher obey this field, and loads weigh it as the mesher does.
void RunOptions::use_sizes(const SizeField& field) {
    decompose.cut.size = decompose.cut.load.size = mesher.size = field;
    decompose.cut.load.volume_weight = find_mesher(mesher.name).forecast.volume_weight;
}

std::vector<NamedPath> RunOptions::output_files() const {
    return {{"--trace", trace_file}, {"--events", events_file}, {"--report", report_file}};
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
    for (const auto& [option, file] : output_files()) {
        if (file.empty() || file.starts_with("fd:")) continue;
        if (is_in_the_way(file))
            throw Error(ErrorCode::usage, fmt::format("{} is {}, which lies in the output folder {}. That is replaced "
                                                      "as a whole when the run ends, so choose a place outside of it.",
                                                      option, file, output));
        refuse_to_overwrite(input, option, file);
        refuse_to_overwrite(sizes.field_file, option, file);
        require_writable(option, file);
    }
    refuse_same_outputs(output_files());
}

void InputOptions::check() const {
    InputOptions copy = *this;
    for (const OptionField& field : input_option_fields(copy)) field.check();
}

std::vector<OptionField> input_option_fields(InputOptions& o) {
    return {
        {"scale",
         "",
         option_group::input,
         "F",
         "Multiply all coordinates by this as they are read, as 0.001 from mm to m. Default 1.",
         &o.scale,
         true,
         {"a positive number", 0, std::numeric_limits<double>::infinity(), false, true}},
        {"weld",
         "",
         option_group::input,
         "TOL",
         "Merge vertices closer than this, in units of the input, or with % of its diagonal. Default 0: only equal "
         "ones.",
         &o.weld_tolerance,
         true,
         {"0 (only equal vertices) or a positive length in units of the input, or with % of its diagonal", 0}},
        {"fill-holes",
         "",
         option_group::input,
         "N",
         "Fill open loops of at most so many edges. Default 0: none.",
         &o.fill_hole_edges,
         true,
         {"a whole number, 0 (none) or more edges", 0}},
        {"keep-largest", "", option_group::input, "", "Keep only the connected component of the largest area.",
         &o.keep_largest},
        {"voids", "", option_group::input, "",
         "A shell inside another and turned like it: refused, or by parity a void. Default as-given.",
         choice(o.voids, {"as-given", "parity"})},
        {"feature-angle",
         "",
         option_group::input,
         "DEG",
         "Degrees between facets above which an edge bounds patches, if the file has none. Default 0: one patch.",
         &o.feature_angle_deg,
         true,
         {"0 (none), or below 180 degrees", 0, 180, true, true}},
        {"solid",
         "",
         option_group::input,
         "N",
         "CAD files: only this solid, counted from 1. Default 0: all.",
         &o.cad.solid,
         true,
         {"a whole number, 0 (all) or that of one", 0}},
        {"unite", "", option_group::input, "", "CAD files: join solids that touch or overlap.", &o.cad.unite},
        {"unit", "", option_group::input, "", "CAD files: unit into which lengths are converted. Default mm.",
         choice(o.cad.unit, length_unit_names())},
        {"cad-deflection",
         "",
         option_group::input,
         "D",
         "CAD files: distance of chords from curves as a share of the diagonal. Default 0: by the volume, to 1e-4.",
         &o.cad.deflection,
         true,
         {"0 (by the volume), or from 1e-7 to 0.1 of the diagonal", 1e-7, 0.1, true}},
        {"optimise-surface",
         "",
         option_group::input,
         "N",
         "Sweeps that slide vertices off the feature edges to better places first. Default 0: the surface is kept.",
         &o.optimisation_sweeps,
         true,
         {"a whole number, 0 (keep it) or more sweeps", 0}},
    };
}

std::vector<OptionField> size_option_fields(SizeOptions& o) {
    return {
        {"size", "", option_group::sizes, "H",
         "Wanted edge length inside, in units of the input, or with % of the diagonal of its bounding box. Default: as "
         "the surface.",
         &o.size, true, size_range::length},
        {"max-volume", "", option_group::sizes, "V", "Largest volume of a tetrahedron, instead of --size.",
         &o.max_volume, true, size_range::max_volume},
        {"size-in", "", option_group::sizes, "SHAPE=H",
         "Edge length H, as of --size, in box:x0,y0,z0,x1,y1,z1=H, sphere:x,y,z,r=H or cylinder:x0,y0,z0,x1,y1,z1,r=H. "
         "Repeatable.",
         &o.inside},
        {"size-on", "", option_group::sizes, "NAME=H",
         "Edge length H on a patch of the input, as NAME=H, or with % NAME=2%. Repeatable.", &o.on},
        {"size-near", "", option_group::sizes, "NAME=H:D",
         "Edge length H up to the distance D from a patch, as NAME=H:D. Repeatable.", &o.near},
        {"growth", "", option_group::sizes, "G",
         "Growth of edge lengths per distance; if given, from the edges of the surface, too. Default 0: 0.3 from "
         "others.",
         &o.growth, true, size_range::growth},
        {"size-field", "", option_group::sizes, "FILE",
         "Mesh of tetrahedra, .vtu or .msh, with the edge length as a scalar at its nodes.", &o.field_file},
        {"chord-error", "", option_group::sizes, "D",
         "Finer where the surface is curved: distance of edges from it, in units of the input, or with % of its "
         "diagonal.",
         &o.chord_error, true, size_range::length},
        {"segments-per-turn", "", option_group::sizes, "N",
         "Finer where the surface is curved: edges of a full circle.", &o.segments_per_turn, true,
         size_range::segments_per_turn},
        {"cells-across", "", option_group::sizes, "N", "Finer where walls are thin: cells from one side to the other.",
         &o.cells_across, true, size_range::cells_across},
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
        {"parts",
         "n",
         option_group::cuts,
         "K",
         "Number of parts K >= 1. Default: 4 for each worker, or what --memory asks for.",
         &o.decompose.parts,
         true,
         {"a whole number, 1 or more, at most 2147483647", 1, 2147483647, true}},
        {"radius-edge", "", option_group::meshing, "Q",
         "Bound of circumradius over shortest edge; 0: no refinement. Default 1.4.", &o.mesher.radius_edge, true,
         radius_edge_range},
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
         &o.deviation, true, deviation_range},
        {"mesher", "", option_group::meshing, "",
         "What fills the parts: auto, the default, takes lattice, unless --tetgen is given.",
         mesher_choice(o.mesher.name)},
        {"improve", "", option_group::meshing, "",
         "Better cells in place of the worst; not with --tetgen. Default true: --no-improve keeps them.",
         &o.mesher.improve},
        {"workers",
         "",
         option_group::running,
         "W",
         "Mesher processes of each rank. Default: its share of the processors that it may use.",
         &o.workers,
         false,
         {"a whole number, 0 (share of the processors) to 4096", 0, 4096}},
        {"timeout",
         "",
         option_group::running,
         "S",
         "Seconds for one attempt at one part; 0: none. A part that took longer is marked in the report. Default 600.",
         &o.timeout_seconds,
         false,
         {"0 (none), or 0.001 to 1e9 seconds", 1e-3, 1e9, true}},
        {"memory",
         "",
         option_group::running,
         "MB",
         "Memory of one worker in MB, by which K is chosen, too; 0: unlimited. Default 0.",
         &o.memory_mb,
         false,
         {"a whole number, 0 (unlimited) to 1099511627776 MB", 0, 0x1p40}},
        {"attempts",
         "",
         option_group::expert,
         "N",
         "Attempts at a part, at most: with other orders, tolerances, weaker bounds. Default 10.",
         &o.attempts,
         true,
         {"a whole number, 1 or more", 1}},
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
