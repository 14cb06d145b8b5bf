// A material is read in two steps, so that a case may take steel from the table and change one number: first the row of
// the table, by `like`, or by the name of the material if it gives neither young nor poisson; then the numbers of the
// case over it. The table is in SI, so that its rows need the units of the case, which are read before all tables.
#include "solve/case/inside/material_reader.h"

#include <limits>

namespace kerf {

namespace {

class MaterialReader {
 public:
    MaterialReader(const std::string& path, const std::string& name, CaseUnits units)
        : table_(path, fmt::format("material '{}'", name)), units_(units) {
        use_.material.name = name;
    }

    MaterialUse read(const toml::table& values) {
        start_from_table(values);
        Material& material = use_.material;
        table_.read(
            values,
            {{"like", [](const toml::node&) {}},
             {"young",
              [&](const toml::node& n) {
                  material.young = table_.number_above_zero(n, "young");
                  has_young_ = true;
              }},
             {"poisson",
              [&](const toml::node& n) {
                  material.poisson = table_.number(n, "poisson");
                  has_poisson_ = true;
                  if (material.poisson <= -1 || material.poisson >= 0.5)
                      table_.refuse(n, "poisson must lie between -1 and 0.5, without both.");
              }},
             {"density", [&](const toml::node& n) { material.density = table_.number_from_zero(n, "density"); }},
             {"expansion", [&](const toml::node& n) { material.expansion = table_.number_from_zero(n, "expansion"); }},
             {"yield", [&](const toml::node& n) { material.yield = table_.number_above_zero(n, "yield"); }},
             {"region", [&](const toml::node& n) { use_.regions = table_.texts(n, "region"); }},
             {"parts", [&](const toml::node& n) { use_.parts = part_numbers(n); }},
             {"patch", [&](const toml::node& n) { use_.patches = table_.texts(n, "patch"); }}});
        if (!has_young_ || !has_poisson_)
            table_.refuse(values, fmt::format("material '{}' needs young and poisson, or like = \"...\", one of {}.",
                                              material.name, table_material_names()));
        if (!use_.regions.empty() + !use_.parts.empty() + !use_.patches.empty() > 1)
            table_.refuse(values,
                          fmt::format("material '{}' has several of region, parts and patch; one of them says where "
                                      "it is.",
                                      material.name));
        return std::move(use_);
    }

 private:
    // Takes the numbers of the table, before the case's own ones.
    void start_from_table(const toml::table& values) {
        const toml::node* like = values.get("like");
        if (!like && (values.contains("young") || values.contains("poisson"))) return;
        const std::string name = like ? table_.text(*like, "like") : use_.material.name;
        const TableMaterial* row = find_table_material(name);
        if (!row) {
            if (!like) return;
            table_.refuse(*like,
                          fmt::format("no material is called '{}'. There are {}.", name, table_material_names()));
        }
        if (units_ == CaseUnits::unknown)
            table_.refuse(like ? *like : static_cast<const toml::node&>(values),
                          fmt::format("the numbers of '{}' need units. Say units = \"mm\" (mm, N, MPa, t) or \"m\" (m, "
                                      "N, Pa, kg) in the first line.",
                                      name));
        const std::string own = use_.material.name;
        use_.material = in_units(*row, units_);
        use_.material.name = own;
        use_.source = fmt::format("{} ({}): {}", row->name, row->grade, row->source);
        has_young_ = has_poisson_ = true;
    }

    std::vector<NodeId> part_numbers(const toml::node& node) const {
        std::vector<NodeId> parts;
        const toml::array* list = node.as_array();
        if (!list || list->empty()) table_.refuse(node, "parts is no list of numbers of parts.");
        for (const toml::node& item : *list) {
            const auto number = item.value_exact<std::int64_t>();
            if (!number || *number < 1 || *number > std::numeric_limits<std::int32_t>::max())
                table_.refuse(item, "parts is no list of numbers of parts.");
            parts.emplace_back(*number);
        }
        return parts;
    }

    CaseTable table_;
    CaseUnits units_;
    MaterialUse use_;
    bool has_young_ = false, has_poisson_ = false;
};

}  // namespace

std::vector<MaterialUse> read_materials(const std::string& path, const toml::node& node, CaseUnits units) {
    const CaseTable top(path, "the case");
    std::vector<MaterialUse> materials;
    for (const auto& [name, item] : top.table(node, "[material.steel]"))
        materials.push_back(
            MaterialReader(path, std::string(name.str()), units).read(top.table(item, "[material.steel]")));
    return materials;
}

}  // namespace kerf
