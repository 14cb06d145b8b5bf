// The material of a cell is that of its part, else of its region, else of its body, else that of the rest
// (`MaterialPlaces::at`); a place that has two materials is refused. Bodies are those at whose surface there are
// triangles of the patches that a material names, found on all ranks together. The temperature of a region is a matter
// of its materials: where a case names one, each material in the region is there once more, for the region alone, so
// that thermal strains are arrays over materials. Numbers have 16 bits, of which the largest says that there is no
// material.
#include "solve/equations/inside/place_materials.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

constexpr MaterialNumber no_material = 65535;

// The numbers of the materials of named parts, of regions, of bodies, and of the rest.
struct MaterialPlaces {
    std::map<NodeId, MaterialNumber> of_part;
    std::vector<MaterialNumber> of_region;
    std::vector<MaterialNumber> of_body;
    MaterialNumber of_rest = no_material;

    MaterialNumber at(NodeId part, RegionIndex region, std::int32_t body) const {
        if (const auto named = of_part.find(part); named != of_part.end()) return named->second;
        const std::size_t r = region.value();
        if (r < of_region.size() && of_region[r] != no_material) return of_region[r];
        return of_body[body] != no_material ? of_body[body] : of_rest;
    }
};

class MaterialPlacer {
 public:
    MaterialPlacer(ElasticProblem& problem, const MeshOutline& outline, const ElasticCase& wanted,
                   const SurfaceSelector& selector, const SpaceBodies& bodies)
        : problem_(problem),
          space_(*problem.space),
          outline_(outline),
          wanted_(wanted),
          selector_(selector),
          bodies_(bodies) {}

    void place();
    // Gives these regions materials of their own; returns for each material its region, or -1.
    std::vector<std::int32_t> split_by_regions(const std::vector<char>& regions);

 private:
    void place_material(const MaterialUse& use, MaterialPlaces& places) const;
    void place_in_regions(const MaterialUse& use, const std::vector<std::string>& regions,
                          MaterialPlaces& places) const;
    std::vector<char> bodies_at(const std::vector<std::string>& patches, const std::string& who) const;

    ElasticProblem& problem_;
    const FeSpace& space_;
    const MeshOutline& outline_;
    const ElasticCase& wanted_;
    const SurfaceSelector& selector_;
    const SpaceBodies& bodies_;
};

// Returns a flag for each body: whether it has a triangle of these patches.
std::vector<char> MaterialPlacer::bodies_at(const std::vector<std::string>& patches, const std::string& who) const {
    SurfaceSelection where;
    where.patches = patches;
    std::vector<std::int32_t> found(bodies_.count, 0);
    for (const SurfaceFacet& facet : selector_.facets(where, who))
        found[bodies_.of_node[space_.nodes_of_facet(facet.part, facet.facet)[0]]] = 1;
    space_.ranks().all_reduce(std::span(found), Reduction::largest);
    return {found.begin(), found.end()};
}

void MaterialPlacer::place() {
    if (wanted_.materials.size() >= no_material)
        throw Error(ErrorCode::usage, "A case may have up to 65,534 materials.");
    problem_.materials.clear();
    MaterialPlaces places;
    places.of_body.resize(bodies_.count, no_material);
    places.of_region.resize(outline_.region_names.size(), no_material);
    for (const MaterialUse& use : wanted_.materials) {
        problem_.materials.push_back(use.material);
        place_material(use, places);
    }
    if (problem_.materials.size() == 1 && places.of_rest == 0) return;
    std::int64_t without = 0;
    for (std::size_t p = 0; p < space_.parts().size(); ++p) {
        const Part& part = space_.parts()[p];
        std::vector<MaterialNumber>& of_tet = problem_.material_of_tet.emplace_back();
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t) {
            of_tet.push_back(places.at(part.id, part.region_of(t), bodies_.of_node[space_.nodes_of(p, t)[0]]));
            if (of_tet.back() == no_material) ++without;
        }
    }
    without = space_.ranks().all_reduce(without, Reduction::sum);
    if (without > 0)
        throw Error(
            ErrorCode::usage,
            fmt::format("{} tetrahedra have no material. Add one without region, parts and patch: it is for the "
                        "rest.",
                        without));
}

void MaterialPlacer::place_in_regions(const MaterialUse& use, const std::vector<std::string>& regions,
                                      MaterialPlaces& places) const {
    for (const std::string& wanted : regions) {
        MaterialNumber& of_region =
            places.of_region[region_called(outline_, wanted, fmt::format("Material '{}'", use.material.name))];
        if (of_region != no_material)
            throw Error(ErrorCode::usage, fmt::format("The region '{}' has two materials: '{}' and '{}'.", wanted,
                                                      problem_.materials[of_region].name, use.material.name));
        of_region = problem_.materials.size() - 1;
    }
}

// Places the material that was added last.
void MaterialPlacer::place_material(const MaterialUse& use, MaterialPlaces& places) const {
    const MaterialNumber number = problem_.materials.size() - 1;
    const std::string who = fmt::format("Material '{}'", use.material.name);
    for (const NodeId id : use.parts) {
        if (std::none_of(outline_.parts.begin(), outline_.parts.end(), [&](const PartExtent& e) { return e.id == id; }))
            throw Error(ErrorCode::usage,
                        fmt::format("{} names part {}, which this mesh does not have.", who, id.value()));
        if (!places.of_part.emplace(id, number).second)
            throw Error(ErrorCode::usage, fmt::format("Part {} has two materials.", id.value()));
    }
    if (!use.patches.empty()) {
        const std::vector<char> here = bodies_at(use.patches, who);
        for (std::size_t b = 0; b < here.size(); ++b) {
            if (!here[b]) continue;
            if (places.of_body[b] != no_material)
                throw Error(ErrorCode::usage,
                            fmt::format("The body at patch '{}' has two materials: '{}' and '{}'.", use.patches.front(),
                                        problem_.materials[places.of_body[b]].name, use.material.name));
            places.of_body[b] = number;
        }
    }
    const std::vector<std::string>& regions = outline_.region_names;
    const bool is_name_of_region = std::find(regions.begin(), regions.end(), use.material.name) != regions.end();
    if (!use.says_where() && is_name_of_region) return place_in_regions(use, {use.material.name}, places);
    place_in_regions(use, use.regions, places);
    if (use.says_where()) return;
    if (places.of_rest != no_material)
        throw Error(ErrorCode::usage,
                    fmt::format("Materials '{}' and '{}' are for everything. Say with region, parts or "
                                "patch where one of them is.",
                                problem_.materials[places.of_rest].name, use.material.name));
    places.of_rest = number;
}

std::vector<std::int32_t> MaterialPlacer::split_by_regions(const std::vector<char>& regions) {
    const std::size_t count = problem_.materials.size();
    std::vector<std::int32_t> is_used(count * regions.size(), 0);
    const auto for_parts_there = [&](auto visit) {
        for (std::size_t p = 0; p < space_.parts().size(); ++p)
            if (regions[space_.region_of(p)]) visit(p, space_.region_of(p));
    };
    if (problem_.material_of_tet.empty())
        for (const Part& part : space_.parts()) problem_.material_of_tet.emplace_back(part.mesh.tets.size(), 0);
    for_parts_there([&](std::size_t p, std::size_t region) {
        for (const MaterialNumber m : problem_.material_of_tet[p]) is_used[count * region + m] = 1;
    });
    space_.ranks().all_reduce(std::span(is_used), Reduction::largest);
    std::vector<std::int32_t> region_of(count, -1);
    std::vector<MaterialNumber> number(is_used.size(), no_material);
    for (std::size_t at = 0; at < is_used.size(); ++at) {
        if (!is_used[at]) continue;
        if (region_of.size() >= no_material)
            throw Error(ErrorCode::usage,
                        "A case may have up to 65,534 materials, those of regions with a temperature of "
                        "their own counted by themselves.");
        number[at] = region_of.size();
        region_of.push_back(at / count);
        problem_.materials.push_back(problem_.materials[at % count]);
    }
    for_parts_there([&](std::size_t p, std::size_t region) {
        for (MaterialNumber& m : problem_.material_of_tet[p]) m = number[count * region + m];
    });
    return region_of;
}

}  // namespace

std::vector<std::int32_t> place_materials(ElasticProblem& problem, const MeshOutline& outline,
                                          const ElasticCase& wanted, const SurfaceSelector& selector,
                                          const SpaceBodies& bodies) {
    MaterialPlacer placer(problem, outline, wanted, selector, bodies);
    placer.place();
    std::vector<char> warmed(outline.region_names.size(), 0);
    bool any = false;
    for (const Temperature& temperature : wanted.temperatures)
        for (const std::string& region : temperature.regions)
            warmed[region_called(outline, region, "A temperature")] = any = true;
    if (any) return placer.split_by_regions(warmed);
    return std::vector<std::int32_t>(problem.materials.size(), -1);
}

std::size_t region_called(const MeshOutline& outline, const std::string& name, const std::string& who) {
    const std::vector<std::string>& names = outline.region_names;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Error(ErrorCode::usage,
                    fmt::format("{} names the region '{}', but {}.", who, name,
                                names.empty() ? std::string("the mesh has no regions with names")
                                              : fmt::format("those of the mesh are '{}'", fmt::join(names, "', '"))));
    return found - names.begin();
}

}  // namespace kerf
