#include "solve/elastic_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "core/error.h"
#include "io/file_bytes.h"

namespace kerf {

namespace {

// A table of the file with what may be in it.
class CaseTable {
 public:
    using Read = std::function<void(const toml::node&)>;
    struct Key {
        std::string name;
        Read read;
    };

    CaseTable(const std::string& path, std::string title) : path_(path), title_(std::move(title)) {}

    [[noreturn]] void refuse(const toml::node& place, const std::string& what) const {
        throw Error(ErrorCode::usage, fmt::format("{}, line {}: {}", path_, place.source().begin.line, what));
    }

    void read(const toml::table& table, const std::vector<Key>& keys) const {
        for (const auto& [name, node] : table) {
            const auto known =
                std::find_if(keys.begin(), keys.end(), [&, n = name.str()](const Key& key) { return key.name == n; });
            if (known == keys.end()) {
                std::string names;
                for (const Key& key : keys) names += fmt::format("{}{}", names.empty() ? "" : ", ", key.name);
                refuse(node, fmt::format("{} has no '{}'. There are {}.", title_, name.str(), names));
            }
            known->read(node);
        }
    }

    double number(const toml::node& node, const char* what) const {
        const auto value = node.value<double>();
        if (!value || !std::isfinite(*value)) refuse(node, fmt::format("{} of {} is no number.", what, title_));
        return *value;
    }
    std::string text(const toml::node& node, const char* what) const {
        const auto value = node.value_exact<std::string>();
        if (!value || value->empty()) refuse(node, fmt::format("{} of {} is no text in quotes.", what, title_));
        return *value;
    }
    template <std::size_t N>
    std::array<double, N> numbers(const toml::node& node, const char* what) const {
        std::array<double, N> values{};
        const toml::array* list = node.as_array();
        if (!list || list->size() != N)
            refuse(node, fmt::format("{} of {} is no list of {} numbers.", what, title_, N));
        for (std::size_t i = 0; i < N; ++i) values[i] = number((*list)[i], what);
        return values;
    }
    Vec3 vector(const toml::node& node, const char* what) const {
        const auto values = numbers<3>(node, what);
        return {values[0], values[1], values[2]};
    }
    std::vector<std::string> texts(const toml::node& node, const char* what) const {
        const toml::array* list = node.as_array();
        if (!list) return {text(node, what)};
        std::vector<std::string> values;
        for (const toml::node& item : *list) values.push_back(text(item, what));
        if (values.empty()) refuse(node, fmt::format("{} of {} is an empty list.", what, title_));
        return values;
    }

 private:
    const std::string& path_;
    std::string title_;
};

class CaseReader {
 public:
    explicit CaseReader(const std::string& path) : path_(path) {}

    ElasticCase read(const toml::table& file) {
        const CaseTable top(path_, "the case");
        top.read(file,
                 {{"material", [&](const toml::node& node) { read_materials(node); }},
                  {"support", [&](const toml::node& node) { for_each("support", node, &CaseReader::read_support); }},
                  {"load", [&](const toml::node& node) { for_each("load", node, &CaseReader::read_load); }},
                  {"gravity", [&](const toml::node& node) { read_gravity(node); }},
                  {"solver", [&](const toml::node& node) { read_solver(node); }}});
        if (result_.materials.empty())
            throw Error(ErrorCode::usage,
                        fmt::format("{} names no material. Add [material.steel] with young and poisson.", path_));
        return std::move(result_);
    }

 private:
    const toml::table& table_of(const toml::node& node, const std::string& example) const {
        const toml::table* table = node.as_table();
        if (!table) CaseTable(path_, "the case").refuse(node, fmt::format("{} is what is expected here.", example));
        return *table;
    }

    void for_each(const char* what, const toml::node& node, void (CaseReader::*read_one)(const toml::table&)) {
        const toml::array* list = node.as_array();
        if (!list)
            CaseTable(path_, "the case")
                .refuse(node, fmt::format("a {} begins with [[{}]], in two brackets.", what, what));
        for (const toml::node& item : *list) (this->*read_one)(table_of(item, fmt::format("[[{}]]", what)));
    }

    void read_materials(const toml::node& node) {
        for (const auto& [name, item] : table_of(node, "[material.steel]")) {
            const std::string title(name.str());
            const CaseTable table(path_, fmt::format("material '{}'", title));
            MaterialUse use;
            bool has_young = false, has_poisson = false;
            use.material.name = title;
            const toml::table& values = table_of(item, "[material.steel]");
            table.read(values, {{"young",
                                 [&](const toml::node& n) {
                                     use.material.young = table.number(n, "young");
                                     has_young = true;
                                     if (use.material.young <= 0) table.refuse(n, "young must be above 0.");
                                 }},
                                {"poisson",
                                 [&](const toml::node& n) {
                                     use.material.poisson = table.number(n, "poisson");
                                     has_poisson = true;
                                     if (use.material.poisson <= -1 || use.material.poisson >= 0.5)
                                         table.refuse(n, "poisson must lie between -1 and 0.5, without both.");
                                 }},
                                {"density",
                                 [&](const toml::node& n) {
                                     use.material.density = table.number(n, "density");
                                     if (use.material.density < 0) table.refuse(n, "density must not be negative.");
                                 }},
                                {"region", [&](const toml::node& n) { use.regions = table.texts(n, "region"); }},
                                {"parts", [&](const toml::node& n) { use.parts = part_numbers(table, n); }},
                                {"patch", [&](const toml::node& n) { use.patches = table.texts(n, "patch"); }}});
            if (!has_young || !has_poisson)
                table.refuse(values, fmt::format("material '{}' needs young and poisson.", title));
            if (!use.regions.empty() + !use.parts.empty() + !use.patches.empty() > 1)
                table.refuse(values,
                             fmt::format("material '{}' has several of region, parts and patch; one of them says where "
                                         "it is.",
                                         title));
            result_.materials.push_back(std::move(use));
        }
    }

    static std::vector<NodeId> part_numbers(const CaseTable& table, const toml::node& node) {
        std::vector<NodeId> parts;
        const toml::array* list = node.as_array();
        if (!list || list->empty()) table.refuse(node, "parts is no list of numbers of parts.");
        for (const toml::node& item : *list) {
            const auto number = item.value_exact<std::int64_t>();
            if (!number || *number < 1 || *number > std::numeric_limits<NodeId>::max())
                table.refuse(item, "parts is no list of numbers of parts.");
            parts.push_back(static_cast<NodeId>(*number));
        }
        return parts;
    }

    // The keys that select, of supports and loads.
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

    void read_support(const toml::table& values) {
        const CaseTable table(path_, "a support");
        Support support;
        std::string label;
        std::vector<CaseTable::Key> keys = selection_keys(table, support.where, label);
        keys.push_back({"name", [&](const toml::node& n) { support.name = table.text(n, "name"); }});
        constexpr std::array<const char*, 3> axes = {"x", "y", "z"};
        for (std::size_t i = 0; i < axes.size(); ++i)
            keys.push_back({axes[i], [&support, &table, i, axis = axes[i]](const toml::node& n) {
                                support.displacement[i] = table.number(n, axis);
                            }});
        keys.push_back({"fixed", [&](const toml::node& n) {
                            if (n.value_exact<bool>() != true) table.refuse(n, "fixed can only be true.");
                            support.displacement.fill(0.0);
                        }});
        table.read(values, keys);
        require_one_selection(table, values, support.where);
        if (!support.displacement[0] && !support.displacement[1] && !support.displacement[2])
            table.refuse(values, "a support needs x, y or z (displacements), or fixed = true.");
        if (support.name.empty()) support.name = label;
        result_.supports.push_back(std::move(support));
    }

    void read_load(const toml::table& values) {
        const CaseTable table(path_, "a load");
        Load load;
        std::string label;
        std::vector<CaseTable::Key> keys = selection_keys(table, load.where, label);
        keys.push_back({"name", [&](const toml::node& n) { load.name = table.text(n, "name"); }});
        keys.push_back({"case", [&](const toml::node& n) { load.load_case = table.text(n, "case"); }});
        keys.push_back({"pressure", [&](const toml::node& n) { load.pressure = table.number(n, "pressure"); }});
        keys.push_back({"traction", [&](const toml::node& n) { load.traction = table.vector(n, "traction"); }});
        keys.push_back({"force", [&](const toml::node& n) { load.force = table.vector(n, "force"); }});
        table.read(values, keys);
        require_one_selection(table, values, load.where);
        if ((load.pressure ? 1 : 0) + (load.traction ? 1 : 0) + (load.force ? 1 : 0) != 1)
            table.refuse(values, "a load needs exactly one of pressure, traction and force.");
        if (load.where.point && !load.force) table.refuse(values, "at a point there can only be a force.");
        if (load.name.empty()) load.name = label;
        if (load.load_case.find('/') != load.load_case.npos || load.load_case.starts_with('.'))
            table.refuse(values,
                         "the name of a case becomes that of a folder: no '/' in it, and no '.' at its beginning.");
        result_.loads.push_back(std::move(load));
    }

    void read_gravity(const toml::node& node) {
        const CaseTable table(path_, "gravity");
        const toml::table& values = table_of(node, "[gravity]");
        table.read(values,
                   {{"acceleration", [&](const toml::node& n) { result_.gravity = table.vector(n, "acceleration"); }}});
        if (!result_.gravity) table.refuse(values, "gravity needs acceleration = [x, y, z].");
    }

    void read_solver(const toml::node& node) {
        const CaseTable table(path_, "solver");
        SolverOptions& solver = result_.solver;
        table.read(table_of(node, "[solver]"),
                   {{"order",
                     [&](const toml::node& n) {
                         const auto order = n.value_exact<std::int64_t>();
                         if (order != 1 && order != 2) table.refuse(n, "order is 1 or 2.");
                         solver.order = static_cast<int>(*order);
                     }},
                    {"preconditioner",
                     [&](const toml::node& n) {
                         solver.preconditioner = table.text(n, "preconditioner");
                         if (solver.preconditioner != "gamg" && solver.preconditioner != "icc")
                             table.refuse(n, "preconditioner is \"gamg\" or \"icc\".");
                     }},
                    {"rtol",
                     [&](const toml::node& n) {
                         solver.rtol = table.number(n, "rtol");
                         if (solver.rtol <= 0 || solver.rtol >= 1) table.refuse(n, "rtol must lie between 0 and 1.");
                     }},
                    {"max_iterations",
                     [&](const toml::node& n) {
                         const auto most = n.value_exact<std::int64_t>();
                         if (!most || *most < 1 || *most > 1000000)
                             table.refuse(n, "max_iterations is a number from 1 to 1000000.");
                         solver.max_iterations = static_cast<int>(*most);
                     }},
                    {"petsc", [&](const toml::node& n) { solver.petsc = table.text(n, "petsc"); }}});
    }

    const std::string& path_;
    ElasticCase result_;
};

}  // namespace

std::vector<std::string> ElasticCase::names() const {
    std::vector<std::string> names;
    for (const Load& load : loads)
        if (!load.load_case.empty() && std::find(names.begin(), names.end(), load.load_case) == names.end())
            names.push_back(load.load_case);
    if (names.empty()) names.emplace_back();
    return names;
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

}  // namespace kerf
