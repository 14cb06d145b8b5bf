// A case file is read by tables. Each kind of table has a list of keys with a function for each (CaseTable::Key), and a
// key that is not in the list is refused with the list; a new key is an entry there and a line of docs/solvers.md. The
// units and the names of all cases are noted first, since materials need the units and combinations need the names,
// wherever these stand in the file. Which keys of a support say its displacements tells its frame (`frame_keys`), so
// that keys of two frames are refused.
#include "solve/case/elastic_case.h"

#include <algorithm>

#include "files/io/file_bytes.h"
#include "solve/case/inside/case_table.h"
#include "solve/case/inside/material_reader.h"
#include "solve/case/inside/petsc_options.h"

namespace kerf {

namespace {

Gravity read_gravity(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "gravity");
    Gravity gravity;
    bool has_acceleration = false;
    table.read(values, {{"acceleration",
                         [&](const toml::node& n) {
                             gravity.acceleration = table.vector(n, "acceleration");
                             has_acceleration = true;
                         }},
                        {"case", [&](const toml::node& n) { gravity.load_case = table.case_name(n); }}});
    if (!has_acceleration) table.refuse(values, "gravity needs acceleration = [x, y, z].");
    return gravity;
}

Rotation read_rotation(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "rotation");
    Rotation rotation;
    bool has_axis = false, has_omega = false;
    table.read(values, {{"axis",
                         [&](const toml::node& n) {
                             rotation.axis = table.axis(n);
                             has_axis = true;
                         }},
                        {"omega",
                         [&](const toml::node& n) {
                             rotation.omega = table.number(n, "omega");
                             has_omega = true;
                         }},
                        {"case", [&](const toml::node& n) { rotation.load_case = table.case_name(n); }}});
    if (!has_axis || !has_omega)
        table.refuse(values,
                     "rotation needs axis = {point = [x, y, z], direction = [x, y, z]} and omega, in radians per "
                     "second.");
    return rotation;
}

Temperature read_temperature(const std::string& path, const toml::table& values) {
    const CaseTable table(path, "a temperature");
    Temperature temperature;
    bool has_difference = false;
    table.read(values, {{"difference",
                         [&](const toml::node& n) {
                             temperature.difference = table.number(n, "difference");
                             has_difference = true;
                         }},
                        {"material", [&](const toml::node& n) { temperature.materials = table.texts(n, "material"); }},
                        {"region", [&](const toml::node& n) { temperature.regions = table.texts(n, "region"); }},
                        {"case", [&](const toml::node& n) { temperature.load_case = table.case_name(n); }}});
    if (!has_difference)
        table.refuse(values, "a temperature needs difference: by how much it is warmer than where no stress is.");
    return temperature;
}

// Reads one [[combination]]. `cases`: the names of all cases; `others`: the combinations before it.
Combination read_combination(const std::string& path, const toml::table& values, const std::vector<std::string>& cases,
                             const std::vector<Combination>& others) {
    const CaseTable table(path, "a combination");
    Combination combination;
    const auto read_factors = [&](const toml::node& node) {
        for (const auto& [name, factor] : table.table(node, "cases = {dead = 1.35, wind = 1.5}")) {
            const std::string wanted(name.str());
            if (std::find(cases.begin(), cases.end(), wanted) == cases.end())
                table.refuse(factor, fmt::format("there is no case '{}', but {}.", wanted,
                                                 cases.empty() ? std::string("none with a name")
                                                               : fmt::format("'{}'", fmt::join(cases, "', '"))));
            combination.factors.emplace_back(wanted, table.number(factor, "a factor"));
        }
    };
    table.read(values, {{"name", [&](const toml::node& n) { combination.name = table.case_name(n); }},
                        {"cases", read_factors}});
    if (combination.name.empty() || combination.factors.empty())
        table.refuse(values, "a combination needs a name and cases = {dead = 1.35, wind = 1.5}: cases and factors.");
    if (std::find(cases.begin(), cases.end(), combination.name) != cases.end())
        table.refuse(values, fmt::format("'{}' is a case already.", combination.name));
    if (std::any_of(others.begin(), others.end(), [&](const Combination& one) { return one.name == combination.name; }))
        table.refuse(values,
                     fmt::format("'{}' is a combination already. Give this one another name.", combination.name));
    return combination;
}

class CaseReader {
 public:
    explicit CaseReader(const std::string& path) : path_(path), top_(path, "the case") {}

    ElasticCase read(const toml::table& file) {
        if (const toml::node* units = file.get("units")) read_units(*units);
        note_cases(file);
        const auto lists = [this](const char* what, auto read_one) {
            return CaseTable::Key{what,
                                  [this, what, read_one](const toml::node& node) { for_each(what, node, read_one); }};
        };
        const auto one_or_more = [this](const char* what, auto read_one) {
            return CaseTable::Key{what, [this, what, read_one](const toml::node& node) {
                                      if (node.is_table())
                                          read_one(*node.as_table());
                                      else
                                          for_each(what, node, read_one);
                                  }};
        };
        const auto materials = [&](const toml::node& node) {
            result_.materials = read_materials(path_, node, result_.units);
        };
        const std::vector<std::string>& cases = result_.load_cases;
        top_.read(
            file,
            {{"units", [](const toml::node&) {}},
             {"material", materials},
             lists("support", [&](const toml::table& t) { read_support(t); }),
             lists("spring", [&](const toml::table& t) { read_spring(t); }),
             lists("load", [&](const toml::table& t) { read_load(t); }),
             one_or_more("gravity", [&](const toml::table& t) { result_.gravity.push_back(read_gravity(path_, t)); }),
             one_or_more("rotation",
                         [&](const toml::table& t) { result_.rotations.push_back(read_rotation(path_, t)); }),
             one_or_more("temperature",
                         [&](const toml::table& t) { result_.temperatures.push_back(read_temperature(path_, t)); }),
             lists("combination",
                   [&](const toml::table& t) {
                       result_.combinations.push_back(read_combination(path_, t, cases, result_.combinations));
                   }),
             {"solver", [&](const toml::node& node) { read_solver(node); }}});
        if (result_.materials.empty())
            throw Error(ErrorCode::usage,
                        fmt::format("{} names no material. Add [material.steel] with young and poisson.", path_));
        return std::move(result_);
    }

 private:
    template <class ReadOne>
    void for_each(const char* what, const toml::node& node, const ReadOne& read_one) {
        const toml::array* list = node.as_array();
        if (!list) top_.refuse(node, fmt::format("a {} begins with [[{}]], in two brackets.", what, what));
        for (const toml::node& item : *list) read_one(top_.table(item, fmt::format("[[{}]]", what)));
    }

    void read_units(const toml::node& node) {
        const auto units = node.value_exact<std::string>();
        if (units != "mm" && units != "m")
            top_.refuse(node, "units is \"mm\" (mm, N, MPa, t) or \"m\" (m, N, Pa, kg).");
        result_.units = *units == "mm" ? CaseUnits::mm : CaseUnits::m;
    }

    // Notes the names of cases, wherever they stand, in the order of the file.
    void note_cases(const toml::table& file) {
        std::vector<std::pair<std::pair<std::size_t, std::size_t>, std::string>> found;
        const auto note = [&](const toml::table& table) {
            const toml::node* name = table.get("case");
            if (!name || !name->value_exact<std::string>()) return;
            const toml::source_position at = name->source().begin;
            found.push_back({{at.line, at.column}, *name->value_exact<std::string>()});
        };
        for (const char* what : {"load", "gravity", "rotation", "temperature"}) {
            const toml::node* node = file.get(what);
            if (node && node->is_table()) note(*node->as_table());
            if (!node || !node->is_array()) continue;
            for (const toml::node& item : *node->as_array())
                if (item.is_table()) note(*item.as_table());
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::string>& names = result_.load_cases;
        for (const auto& [place, name] : found)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }

    // Returns the keys by which supports, springs and loads select a place.
    static std::vector<CaseTable::Key> selection_keys(const CaseTable& table, SurfaceSelection& where,
                                                      std::string& label) {
        return {{"patch",
                 [&](const toml::node& n) {
                     where.patches = table.texts(n, "patch");
                     label = where.patches.front();
                 }},
                {"box",
                 [&](const toml::node& n) {
                     const auto v = table.numbers<6>(n, "box");
                     where.box = {Vec3(v[0], v[1], v[2]), Vec3(v[3], v[4], v[5])};
                     if (((*where.box)[0].array() > (*where.box)[1].array()).any())
                         table.refuse(n, "box is xmin, ymin, zmin, xmax, ymax, zmax.");
                     label = "box";
                 }},
                {"plane",
                 [&](const toml::node& n) {
                     where.plane = table.numbers<4>(n, "plane");
                     if ((*where.plane)[0] == 0 && (*where.plane)[1] == 0 && (*where.plane)[2] == 0)
                         table.refuse(n, "plane is a, b, c, d of ax + by + cz = d, and a, b, c are all 0.");
                     label = "plane";
                 }},
                {"point", [&](const toml::node& n) {
                     where.point = table.vector(n, "point");
                     label = "point";
                 }}};
    }

    static void require_one_selection(const CaseTable& table, const toml::table& values,
                                      const SurfaceSelection& where) {
        const int ways =
            (where.patches.empty() ? 0 : 1) + (where.box ? 1 : 0) + (where.plane ? 1 : 0) + (where.point ? 1 : 0);
        if (ways != 1) table.refuse(values, "exactly one of patch, box, plane and point says where it is.");
    }

    void read_support(const toml::table& values);
    void read_spring(const toml::table& values);
    void read_load(const toml::table& values);
    void read_solver(const toml::node& node);

    const std::string& path_;
    CaseTable top_;
    ElasticCase result_;
};

// The keys for the displacements of a support in one of the four frames.
struct FrameKeys {
    Support::Frame frame;
    std::array<const char*, 3> names;  // keys of the displacements; nullptr: no key
};
constexpr std::array<FrameKeys, 4> frame_keys = {{{Support::Frame::global, {"x", "y", "z"}},
                                                  {Support::Frame::normal, {"normal", nullptr, nullptr}},
                                                  {Support::Frame::direction, {"along", nullptr, nullptr}},
                                                  {Support::Frame::cylinder, {"radial", "axial", "tangential"}}}};

void CaseReader::read_support(const toml::table& values) {
    const CaseTable table(path_, "a support");
    Support support;
    std::string label;
    std::vector<Support::Frame> frames;
    bool has_axis = false, has_direction = false;
    std::vector<CaseTable::Key> keys = selection_keys(table, support.where, label);
    keys.push_back({"name", [&](const toml::node& n) { support.name = table.text(n, "name"); }});
    for (const FrameKeys& of_frame : frame_keys)
        for (std::size_t i = 0; i < 3; ++i)
            if (const char* name = of_frame.names[i])
                keys.push_back({name, [&support, &table, &frames, &of_frame, i, name](const toml::node& n) {
                                    support.displacement[i] = table.number(n, name);
                                    frames.push_back(of_frame.frame);
                                }});
    keys.push_back({"fixed", [&](const toml::node& n) {
                        table.yes(n, "fixed");
                        support.displacement.fill(0.0);
                        frames.push_back(Support::Frame::global);
                    }});
    keys.push_back({"direction", [&](const toml::node& n) {
                        support.direction = table.unit_vector(n, "direction");
                        has_direction = true;
                    }});
    keys.push_back({"axis", [&](const toml::node& n) {
                        support.axis = table.axis(n);
                        has_axis = true;
                    }});
    table.read(values, keys);
    require_one_selection(table, values, support.where);
    if (frames.empty())
        table.refuse(
            values,
            "a support needs x, y or z (displacements), or fixed = true, or normal, or direction with along, or "
            "axis with radial, axial or tangential.");
    support.frame = frames.front();
    if (std::count(frames.begin(), frames.end(), support.frame) != std::ssize(frames))
        table.refuse(values,
                     "of x y z, normal, along and radial axial tangential a support has one kind. Write a "
                     "support for each.");
    if (has_direction != (support.frame == Support::Frame::direction))
        table.refuse(values, "direction = [x, y, z] and along (the displacement) go together.");
    if (has_axis != (support.frame == Support::Frame::cylinder))
        table.refuse(values, "axis and radial, axial or tangential (displacements) go together.");
    if (support.where.point && support.frame == Support::Frame::normal)
        table.refuse(values, "at a point there is no normal: say direction and along.");
    if (support.name.empty()) support.name = label;
    result_.supports.push_back(std::move(support));
}

void CaseReader::read_spring(const toml::table& values) {
    const CaseTable table(path_, "a spring");
    Spring spring;
    std::string label;
    bool has_stiffness = false;
    std::vector<CaseTable::Key> keys = selection_keys(table, spring.where, label);
    keys.push_back({"name", [&](const toml::node& n) { spring.name = table.text(n, "name"); }});
    keys.push_back({"normal", [&](const toml::node& n) { spring.normal = table.number_above_zero(n, "normal"); }});
    keys.push_back({"stiffness", [&](const toml::node& n) {
                        has_stiffness = true;
                        spring.stiffness =
                            n.is_array() ? table.vector(n, "stiffness") : Vec3::Constant(table.number(n, "stiffness"));
                        if (spring.stiffness.minCoeff() < 0 || spring.stiffness.maxCoeff() <= 0)
                            table.refuse(n, "stiffness must not be negative, nor 0 in all directions.");
                    }});
    table.read(values, keys);
    require_one_selection(table, values, spring.where);
    if (has_stiffness == spring.normal.has_value())
        table.refuse(values,
                     "a spring needs exactly one of normal and stiffness, forces per area and displacement: along the "
                     "normal, or along x, y and z.");
    if (spring.where.point) table.refuse(values, "a spring has an area: say patch, box or plane.");
    if (spring.name.empty()) spring.name = label;
    result_.springs.push_back(std::move(spring));
}

void CaseReader::read_load(const toml::table& values) {
    const CaseTable table(path_, "a load");
    Load load;
    std::string label;
    std::vector<CaseTable::Key> keys = selection_keys(table, load.where, label);
    keys.push_back({"name", [&](const toml::node& n) { load.name = table.text(n, "name"); }});
    keys.push_back({"case", [&](const toml::node& n) { load.load_case = table.case_name(n); }});
    keys.push_back({"pressure", [&](const toml::node& n) { load.pressure = table.number(n, "pressure"); }});
    keys.push_back({"traction", [&](const toml::node& n) { load.traction = table.vector(n, "traction"); }});
    keys.push_back({"force", [&](const toml::node& n) { load.force = table.vector(n, "force"); }});
    table.read(values, keys);
    require_one_selection(table, values, load.where);
    if ((load.pressure ? 1 : 0) + (load.traction ? 1 : 0) + (load.force ? 1 : 0) != 1)
        table.refuse(values, "a load needs exactly one of pressure, traction and force.");
    if (load.where.point && !load.force) table.refuse(values, "at a point there can only be a force.");
    if (load.name.empty()) load.name = label;
    result_.loads.push_back(std::move(load));
}

void CaseReader::read_solver(const toml::node& node) {
    const CaseTable table(path_, "solver");
    SolverOptions& solver = result_.solver;
    table.read(
        top_.table(node, "[solver]"),
        {{"order",
          [&](const toml::node& n) {
              const auto order = n.value_exact<std::int64_t>();
              if (order != 1 && order != 2) table.refuse(n, "order is 1 or 2.");
              solver.order = *order;
          }},
         {"preconditioner",
          [&](const toml::node& n) {
              solver.preconditioner = table.text(n, "preconditioner");
              if (solver.preconditioner == "gamg") {
                  solver.preconditioner = "multigrid";
                  result_.notes.push_back(fmt::format("{}, line {}: preconditioner \"gamg\" is \"multigrid\" now.",
                                                      path_, n.source().begin.line));
              }
              if (solver.preconditioner != "multigrid" && solver.preconditioner != "icc")
                  table.refuse(n, "preconditioner is \"multigrid\" or \"icc\".");
          }},
         {"rtol",
          [&](const toml::node& n) {
              solver.rtol = table.number(n, "rtol");
              if (solver.rtol < 1e-14 || solver.rtol >= 1)
                  table.refuse(n, "rtol must lie between 1e-14, which is as far as numbers of 16 digits go, and 1.");
          }},
         {"max_iterations",
          [&](const toml::node& n) {
              const auto most = n.value_exact<std::int64_t>();
              if (!most || *most < 1 || *most > 1000000)
                  table.refuse(n, "max_iterations is a number from 1 to 1000000.");
              solver.max_iterations = *most;
          }},
         {"inertia_relief", [&](const toml::node& n) { solver.inertia_relief = table.yes(n, "inertia_relief"); }},
         {"petsc", [&](const toml::node& n) {
              solver.petsc = table.text(n, "petsc");
              if (const std::string why = why_not_in_case(solver.petsc); !why.empty()) table.refuse(n, why);
          }}});
}

}  // namespace

std::vector<std::string> ElasticCase::names() const {
    return load_cases.empty() ? std::vector<std::string>{""} : load_cases;
}

ElasticCase read_case(const std::string& path) {
    const std::string bytes = read_file(path);
    try {
        return CaseReader(path).read(toml::parse(bytes));
    } catch (const toml::parse_error& error) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}, line {}: {}.", path, error.source().begin.line, error.description()));
    }
}

void require_effect(const ElasticCase& wanted, const std::string& path) {
    const auto moves = [](const Support& support) {
        return std::any_of(support.displacement.begin(), support.displacement.end(),
                           [](const std::optional<double>& u) { return u && *u != 0; });
    };
    const bool is_moved = std::any_of(wanted.supports.begin(), wanted.supports.end(), moves);
    const bool has_mass_loads = !wanted.gravity.empty() || !wanted.rotations.empty();
    if (wanted.loads.empty() && !has_mass_loads && wanted.temperatures.empty() && !is_moved)
        throw Error(ErrorCode::usage,
                    fmt::format("{} loads nothing. Add a [[load]], [gravity], [rotation] or [temperature], a "
                                "displacement to a support, or ask for --modes.",
                                path));
    const auto find = [&](double Material::*property) {
        return std::find_if(wanted.materials.begin(), wanted.materials.end(),
                            [&](const MaterialUse& use) { return !(use.material.*property > 0); });
    };
    if (const auto without = find(&Material::density); has_mass_loads && without != wanted.materials.end())
        throw Error(ErrorCode::usage,
                    fmt::format("{} has {}, but material '{}' has no density. Add it, in t/mm^3 with mm and MPa, or in "
                                "kg/m^3 with m and Pa.",
                                path, wanted.gravity.empty() ? "a rotation" : "gravity", without->material.name));
    const bool expands = std::any_of(wanted.materials.begin(), wanted.materials.end(),
                                     [](const MaterialUse& use) { return use.material.expansion > 0; });
    if (!wanted.temperatures.empty() && !expands)
        throw Error(ErrorCode::usage,
                    fmt::format("{} has a temperature, but no material has an expansion. Add expansion, a coefficient "
                                "of lengths per degree, to one.",
                                path));
}

}  // namespace kerf
