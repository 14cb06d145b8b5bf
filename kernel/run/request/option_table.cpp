// The tables of the options: a row says where the value of an option lives in any set of options, by a function from
// the set to a pointer or a choice. One table belongs to each struct of options (input, sizes, run), and
// option_fields() joins them; command line, help, manual, completion, config files, reports, saved runs and the
// viewer's panel are made of these rows alone. Names and the order of rows are seen by users, and texts of values are
// kept in saved runs, so that a renamed option makes runs of older versions impossible to continue. `shapes_parts`
// decides whether a changed value lets finished parts of an interrupted run count.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "base/core/error.h"
#include "fill/volume/meshers.h"
#include "run/request/run_request.h"

namespace kerf {

namespace {

/// A row of a table, which OptionField is made of.
template <class Options>
struct OptionRow {
    const char *name, *short_name, *group, *value_name, *help;
    OptionField::Value (*value)(Options&);
    bool shapes_parts = true;
    NumberRange range = {};
};

template <class Options, std::size_t count>
void append_fields(std::vector<OptionField>& fields, const OptionRow<Options> (&rows)[count], Options& options) {
    for (const OptionRow<Options>& row : rows)
        fields.push_back({row.name, row.short_name, row.group, row.value_name, row.help, row.value(options),
                          row.shapes_parts, row.range});
}

/// The member of a member, and so on.
template <auto... path, class Options>
OptionField::Value place(Options& options) {
    return &(options.*....*path);
}

template <class Enum>
OptionField::Choice choice(Enum& value, std::vector<std::string> names, int first = 0) {
    return {std::move(names), [&value, first] { return static_cast<int>(value) - first; },
            [&value, first](int i) { value = static_cast<Enum>(i + first); }};
}

OptionField::Choice mesher_choice(std::string& name) {
    const auto get = [&name] {
        const std::vector<std::string> names = mesher_names();
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    return {mesher_names(), get, [&name](int i) { name = mesher_names()[i]; }};
}

// The choice of the change of the surface, from none to most, which sets three options together.
OptionField::Choice surface_choice(RunRequest& o) {
    const auto get = [&o] {
        if (o.input_options.wrap) return 4;
        if (o.remeshing == Remeshing::where_needed) return 3;
        if (o.remeshing == Remeshing::always) return 2;
        return o.facets == FacetPolicy::keep ? 0 : 1;
    };
    const auto set = [&o](int value) {
        o.facets = value == 0 ? FacetPolicy::keep : FacetPolicy::split;
        o.input_options.wrap = value == 4;
        o.remeshing = value == 2 || value == 4 ? Remeshing::always
                      : value == 3             ? Remeshing::where_needed
                                               : Remeshing::never;
    };
    return {{"keep", "split", "remesh", "auto", "wrap"}, get, set};
}

constexpr NumberRange length_or_none = {
    "0 (none) or a positive length in units of the input, or with % of its diagonal", 0};

constexpr OptionRow<InputOptions> input_rows[] = {
    {"scale",
     "",
     option_group::input,
     "F",
     "Multiply all coordinates by this as they are read, as 0.001 from mm to m. Default 1.",
     place<&InputOptions::scale>,
     true,
     {"a positive number", 0, std::numeric_limits<double>::infinity(), false, true}},
    {"weld",
     "",
     option_group::input,
     "TOL",
     "Merge vertices closer than this, in units of the input, or with % of its diagonal. Default 0: only equal "
     "ones.",
     place<&InputOptions::repairs, &RepairOptions::weld_tolerance>,
     true,
     {"0 (only equal vertices) or a positive length in units of the input, or with % of its diagonal", 0}},
    {"fill-holes",
     "",
     option_group::input,
     "N",
     "Fill open loops of at most so many edges. Default 0: none.",
     place<&InputOptions::repairs, &RepairOptions::fill_hole_edges>,
     true,
     {"a whole number, 0 (none) or more edges", 0}},
    {"repair", "", option_group::input, "LEVEL",
     "Repair the surface: exact (points move only to part what touches), near (within a bound), full (crossings, too), "
     "or steps by name, as weld,stitch,holes=200. Default none.",
     place<&InputOptions::repairs, &RepairOptions::plan>},
    {"gap", "", option_group::input, "G",
     "Wrap the surface, whatever it is, in one that is closed: openings narrower than this are, too. A length, or with "
     "% of the diagonal. Default of --surface wrap: 2%.",
     place<&InputOptions::wrapping, &WrapOptions::gap>, true, length_or_none},
    {"offset",
     "",
     option_group::input,
     "D",
     "Of a wrap: sheets become walls of up to twice this thickness. A length, or with % of the diagonal. Default an "
     "eighth of the gap.",
     place<&InputOptions::wrapping, &WrapOptions::offset>,
     true,
     {"0 (an eighth of the gap) or a positive length in units of the input, or with % of its diagonal", 0}},
    {"cap", "", option_group::input, "",
     "Close large openings by patches of their own, cap_1, cap_2, ..., as inlets and outlets.",
     place<&InputOptions::repairs, &RepairOptions::cap>},
    {"thicken", "", option_group::input, "T",
     "Make open sheets walls of this thickness, in units of the input, or with % of its diagonal. Default 0: none.",
     place<&InputOptions::repairs, &RepairOptions::thicken>, true, length_or_none},
    {"keep-largest", "", option_group::input, "", "Keep only the connected component of the largest area.",
     place<&InputOptions::repairs, &RepairOptions::keep_largest>},
    {"voids", "", option_group::input, "",
     "A shell inside another one, turned the same way, may be a void or a second body: as-given refuses it, parity "
     "takes it for a void. Default as-given.",
     [](InputOptions& o) -> OptionField::Value {
         return choice(o.voids, {"as-given", "parity"});
     }},
    {"with", "", option_group::input, "FILE",
     "Another file, whose bodies are meshed with those of INPUT; as several INPUTs. Repeatable.",
     place<&InputOptions::more_files>},
    {"fill-voids", "", option_group::input, "", "Voids of bodies are regions, too: void_1, void_2, ...",
     place<&InputOptions::fill_voids>},
    {"region", "", option_group::input, "NAME=x,y,z",
     "The facets are walls, and the region in which this point lies has this name; units after --scale. Repeatable.",
     place<&InputOptions::regions>},
    {"hole", "", option_group::input, "NAME",
     "Leave a region empty: the others are meshed around it; * in NAME stands for any characters. Repeatable.",
     place<&InputOptions::holes>},
    {"box", "", option_group::air, "BOX",
     "Mesh the air in a box around the body, not the body: x0,y0,z0,x1,y1,z1, or UPSTREAM,SIDES,DOWNSTREAM, distances "
     "in multiples of its longest side, as 3,3,8. Patches: inlet, outlet, ground, side_y_min, ...",
     place<&InputOptions::air, &EnclosureOptions::box>},
    {"box-size", "", option_group::air, "H",
     "Edge length on the faces of the box, and largest one of cells. A length, or with % of the diagonal of the body. "
     "Default: a twentieth of the box's longest side.",
     place<&InputOptions::air, &EnclosureOptions::edge>, true, air_edge_range},
    {"wind", "", option_group::air, "", "Direction of the flow, from inlet to outlet. Default x.",
     [](InputOptions& o) -> OptionField::Value {
         return choice(o.air.wind, {"x", "-x", "y", "-y", "z", "-z"});
     }},
    {"ground", "", option_group::air, "PLANE",
     "The box ends at this plane, which cuts the body: -0.32, for z = -0.32, or y=-0.32.",
     place<&InputOptions::air, &EnclosureOptions::ground>},
    {"wake", "", option_group::air, "H", "Edge length behind the body, up to two of its longest sides.",
     place<&InputOptions::air, &EnclosureOptions::wake>, true, air_edge_range},
    {"feature-angle",
     "",
     option_group::input,
     "DEG",
     "Degrees between facets above which an edge bounds patches, if the file has none. Default 0: one patch.",
     place<&InputOptions::feature_angle_deg>,
     true,
     {"0 (none), or below 180 degrees", 0, 180, true, true}},
    {"solid",
     "",
     option_group::input,
     "N",
     "CAD files: only this solid, counted from 1. Default 0: all.",
     place<&InputOptions::cad, &CadOptions::solid>,
     true,
     {"a whole number, 0 (all) or that of one", 0}},
    {"unite", "", option_group::input, "", "CAD files: join solids that touch or overlap.",
     place<&InputOptions::cad, &CadOptions::unite>},
    {"no-imprint", "", option_group::input, "", "CAD files: refuse solids that touch, which share walls else.",
     place<&InputOptions::cad, &CadOptions::no_imprint>},
    {"unit", "", option_group::input, "", "CAD files: unit into which lengths are converted. Default mm.",
     [](InputOptions& o) -> OptionField::Value { return choice(o.cad.unit, length_unit_names()); }},
    {"cad-deflection",
     "",
     option_group::input,
     "D",
     "CAD files: distance of chords from curves as a share of the diagonal. Default 0: by the volume, to 1e-4.",
     place<&InputOptions::cad, &CadOptions::deflection>,
     true,
     {"0 (by the volume), or from 1e-7 to 0.1 of the diagonal", 1e-7, 0.1, true}},
    {"optimise-surface",
     "",
     option_group::input,
     "N",
     "Sweeps that slide vertices off the feature edges to better places first. Default 0: the surface is kept.",
     place<&InputOptions::optimisation_sweeps>,
     true,
     {"a whole number, 0 (keep it) or more sweeps", 0}},
};

constexpr OptionRow<SizeOptions> size_rows[] = {
    {"size", "", option_group::sizes, "H",
     "Wanted mean edge length, in units of the input, or with % of the diagonal of its bounding box. Default: as the "
     "surface.",
     place<&SizeOptions::size>, true, size_range::length},
    {"size-is", "", option_group::sizes, "",
     "What lengths of all these options are: the mean edge, or a bound, below which all but one edge in a hundred "
     "stay. Default mean.",
     [](SizeOptions& o) -> OptionField::Value {
         return choice(o.meaning, {"mean", "bound"});
     }},
    {"max-volume", "", option_group::sizes, "V", "Largest volume of a tetrahedron, instead of --size.",
     place<&SizeOptions::max_volume>, true, size_range::max_volume},
    {"cells", "", option_group::sizes, "N",
     "Finds the size that gives N tetrahedra within 15 %, as 50000, 50k or 1M, instead of --size.",
     [](SizeOptions& o) -> OptionField::Value { return OptionField::Count{&o.cells}; }, true, size_range::cells},
    {"fineness", "", option_group::sizes, "",
     "How fine surface and cells are where no size is given: each step has some two to three times the cells. Default "
     "medium.",
     [](SizeOptions& o) -> OptionField::Value {
         return choice(o.fineness, {"coarse", "medium", "fine"});
     }},
    {"size-in", "", option_group::sizes, "SHAPE=H",
     "Edge length H, as of --size, in box:x0,y0,z0,x1,y1,z1=H, sphere:x,y,z,r=H or cylinder:x0,y0,z0,x1,y1,z1,r=H. "
     "Repeatable.",
     place<&SizeOptions::inside>},
    {"size-on", "", option_group::sizes, "NAME=H",
     "Edge length H on a patch of the input, as NAME=H, or with % NAME=2%; * in a name stands for any characters. "
     "Repeatable.",
     place<&SizeOptions::on>},
    {"size-region", "", option_group::sizes, "NAME=H",
     "Edge length H in regions, in place of --size, as NAME=H; * stands for any characters. Repeatable.",
     place<&SizeOptions::in_region>},
    {"size-near", "", option_group::sizes, "NAME=H:D",
     "Edge length H up to the distance D from a patch, as NAME=H:D. Repeatable.", place<&SizeOptions::near>},
    {"growth", "", option_group::sizes, "G",
     "How fast edges may lengthen away from where a size is asked for: by G for each unit of distance. If given, cells "
     "grow inwards from the edges of the surface, too. Default 0: 0.3, and not from the surface.",
     place<&SizeOptions::growth>, true, size_range::growth},
    {"size-field", "", option_group::sizes, "FILE",
     "Mesh of tetrahedra, .vtu or .msh, with the edge length as a scalar at its nodes.",
     place<&SizeOptions::field_file>},
    {"chord-error", "", option_group::sizes, "D",
     "Finer where the surface is curved: distance of edges from it, in units of the input, or with % of its "
     "diagonal.",
     place<&SizeOptions::chord_error>, true, size_range::length},
    {"segments-per-turn", "", option_group::sizes, "N", "Finer where the surface is curved: edges of a full circle.",
     place<&SizeOptions::segments_per_turn>, true, size_range::segments_per_turn},
    {"cells-across", "", option_group::sizes, "N", "Finer where walls are thin: cells from one side to the other.",
     place<&SizeOptions::cells_across>, true, size_range::cells_across},
};

constexpr OptionRow<RunRequest> parts_rows[] = {
    {"parts",
     "n",
     option_group::cuts,
     "K",
     "Number of parts K >= 1. Default: 4 for each worker, or what --memory asks for.",
     place<&RunRequest::parts>,
     true,
     {"a whole number, 1 or more, at most 2147483647", 1, 2147483647, true}},
};

constexpr OptionRow<RunRequest> meshing_rows[] = {
    {"radius-edge", "", option_group::meshing, "Q",
     "Bound of circumradius over shortest edge; 0: no refinement. Default 1.4.",
     place<&RunRequest::mesher, &MesherChoices::radius_edge>, true, radius_edge_range},
    {"cut", "", option_group::cuts, "",
     "Where planes lie: across the principal axis, or a coordinate axis. Default inertia.",
     [](RunRequest& o) -> OptionField::Value {
         return choice(o.cut.criterion, {"inertia", "volume", "equidistant"});
     }},
    {"axis", "", option_group::cuts, "", "Coordinate axis across which to cut. Default: chosen by --cut.",
     [](RunRequest& o) -> OptionField::Value {
         return choice(o.cut.axis, {"auto", "x", "y", "z"}, -1);
     }},
    {"balance", "", option_group::expert, "", "What the halves of a cut have alike. Default work.",
     [](RunRequest& o) -> OptionField::Value {
         return choice(o.cut.balance, {"nodes", "faces", "volume", "inertia", "work"});
     }},
    {"contour", "", option_group::expert, "",
     "How contours are found: minimum cut, crossed edges, or split facets. Default min-cut.",
     [](RunRequest& o) -> OptionField::Value {
         return choice(o.cut.contour, {"min-cut", "edges", "straight"});
     }},
    {"surface", "", option_group::input, "",
     "keep every facet; split some where no contour of edges exists; remesh all within --deviation; auto: remesh CAD "
     "files, and where slivers would spoil the cells, else split, and divide what is coarser than sizes; wrap it "
     "first, whatever it is, and remesh that. Default auto.",
     [](RunRequest& o) -> OptionField::Value { return surface_choice(o); }},
    {"deviation", "", option_group::input, "D",
     "Largest distance of a remeshed surface from the input, in its units, or with % of its diagonal. Default: a "
     "twentieth of the shortest edge that is wanted, or 0.05% if none is; less where the body is thin; of a wrap, a "
     "tenth of the gap if that is more. Volumes are held, but for those of folds that it takes out.",
     place<&RunRequest::deviation>, true, deviation_range},
    {"order",
     "",
     option_group::meshing,
     "N",
     "Order of the cells: 1, the default, or 2 with a node on each edge, as structural analysis wants them.",
     place<&RunRequest::order>,
     true,
     {"1 or 2", 1, 2}},
    {"curve", "", option_group::meshing, "",
     "Of order 2: auto, the default, has nodes of edges on the true surface of CAD and on the input of what is "
     "remeshed; straight, in the middle of the edges.",
     [](RunRequest& o) -> OptionField::Value {
         return choice(o.curving, {"auto", "straight"});
     }},
    {"mesher", "", option_group::meshing, "",
     "What fills the parts: auto, the default, takes lattice, unless --tetgen-switches is given.",
     [](RunRequest& o) -> OptionField::Value { return mesher_choice(o.mesher.name); }},
    {"improve", "", option_group::meshing, "",
     "Better cells in place of the worst; not with --tetgen-switches. Default true: --no-improve keeps them.",
     place<&RunRequest::mesher, &MesherChoices::improve>},
    {"workers",
     "j",
     option_group::running,
     "W",
     "Mesher processes of each rank. Default: its share of the processors that it may use.",
     place<&RunRequest::workers, &WorkerOptions::count>,
     false,
     {"a whole number, 0 (share of the processors) to 4096", 0, 4096}},
    {"timeout",
     "",
     option_group::running,
     "S",
     "Seconds for one attempt at one part; 0: none. A part that took longer is marked in the report. Default 600.",
     place<&RunRequest::workers, &WorkerOptions::timeout_seconds>,
     false,
     {"0 (none), or 0.001 to 1e9 seconds", 1e-3, 1e9, true}},
    {"memory",
     "",
     option_group::running,
     "SIZE",
     "Memory of one worker, as 2G or 500M, or a number of MB, by which K is chosen, too; 0: unlimited. Default 0.",
     [](RunRequest& o) -> OptionField::Value { return OptionField::Memory{&o.workers.memory_mb}; },
     false,
     {"a size such as 2G or 500M, or a whole number of MB, 0 (unlimited) to 1099511627776", 0, 0x1p40}},
    {"attempts",
     "",
     option_group::expert,
     "N",
     "Attempts at a part, at most: with other orders, tolerances, weaker bounds. Default 10.",
     place<&RunRequest::workers, &WorkerOptions::attempts>,
     true,
     {"a whole number, 1 or more", 1}},
    {"tetgen-switches", "", option_group::expert, "SWITCHES",
     "Expert: TetGen switches instead of q and a (p, Y are always on).",
     [](RunRequest& o) -> OptionField::Value { return &o.mesher.tetgen.switches; }},
};

constexpr OptionRow<RunRequest> output_rows[] = {
    {"format", "", option_group::output, "LIST",
     "Formats of the result, with commas between; kerf export --help lists them. Default vtu.",
     place<&RunRequest::outputs, &OutputOptions::formats>, false},
    {"fields", "", option_group::output, "LIST",
     "Qualities of each cell in vtu files, with commas between: min-dihedral, max-dihedral, radius-edge, aspect, "
     "shape; or all, or none. Default min-dihedral.",
     place<&RunRequest::outputs, &OutputOptions::fields>, false},
    {"patch-type", "", option_group::output, "NAME=TYPE",
     "OpenFOAM's type of a patch: patch (default), wall, symmetry, symmetryPlane; * in NAME stands for any characters. "
     "Repeatable.",
     place<&RunRequest::outputs, &OutputOptions::patch_types>, false},
    {"split-regions", "", option_group::output, "",
     "OpenFOAM: one mesh for each region, their walls mapped to each other.",
     place<&RunRequest::outputs, &OutputOptions::split_regions>, false},
    {"reference", "", option_group::output, "",
     "Mesh the whole in one piece, too, and compare: comparison.svg, and a table with -v.",
     place<&RunRequest::outputs, &OutputOptions::reference>, false},
    {"stl", "", option_group::output, "", "Write the closed surface of every part as binary STL, too.",
     place<&RunRequest::outputs, &OutputOptions::stl>, false},
    {"report", "", option_group::output, "FILE", "Write the report to this file too.",
     place<&RunRequest::outputs, &OutputOptions::report_file>, false},
    {"events", "", option_group::running, "FILE",
     "Write progress as one JSON object per line to this file, or to fd:N.",
     place<&RunRequest::outputs, &OutputOptions::events_file>, false},
    {"trace", "", option_group::expert, "FILE", "Write every cut with its stages and refused tries to this file.",
     place<&RunRequest::outputs, &OutputOptions::trace_file>, false},
};

}  // namespace

std::vector<OptionField> input_option_fields(InputOptions& options) {
    std::vector<OptionField> fields;
    append_fields(fields, input_rows, options);
    return fields;
}

std::vector<OptionField> size_option_fields(SizeOptions& options) {
    std::vector<OptionField> fields;
    append_fields(fields, size_rows, options);
    return fields;
}

std::vector<OptionField> option_fields(RunRequest& request) {
    std::vector<OptionField> fields;
    append_fields(fields, parts_rows, request);
    append_fields(fields, size_rows, request.sizes);
    append_fields(fields, meshing_rows, request);
    append_fields(fields, output_rows, request);
    append_fields(fields, input_rows, request.input_options);
    return fields;
}

void InputOptions::check() const {
    InputOptions copy = *this;
    for (const OptionField& field : input_option_fields(copy)) field.check();
    seeds_of(*this);
    if (wrapping.offset.number() > 0 && !wraps())
        throw Error(ErrorCode::usage, "--offset is for a surface that is wrapped. Give --gap, too, or leave it out.");
    repair_plan_of(*this);
    air.check();
}

std::vector<std::string> command_words(InputOptions options) {
    InputOptions usual;
    const std::vector<OptionField> fields = input_option_fields(options), usual_fields = input_option_fields(usual);
    std::vector<std::string> words;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const OptionField& field = fields[i];
        if (field.text() == usual_fields[i].text()) continue;
        const auto* list = std::get_if<OptionField::List>(&field.value);
        if (std::holds_alternative<bool*>(field.value))
            words.push_back("--" + field.name);
        else if (list == nullptr)
            words.insert(words.end(), {"--" + field.name, field.text()});
        else
            for (const std::string& item : **list) words.insert(words.end(), {"--" + field.name, join_items({item})});
    }
    return words;
}

std::vector<OptionText> option_texts(RunRequest request, bool shapes_parts_only) {
    std::vector<OptionText> texts;
    for (const OptionField& field : option_fields(request))
        if (field.shapes_parts || !shapes_parts_only) texts.push_back({field.name, field.text()});
    return texts;
}

void set_options(RunRequest& request, const std::vector<OptionText>& texts, const std::string& source) {
    const std::vector<OptionField> fields = option_fields(request);
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
