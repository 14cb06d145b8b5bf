// The names, entities and nodes of one of Gmsh's files, which its elements refer to.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace kerf::gmsh {

/// The geometric entities of one dimension, surfaces or volumes, and the physical groups that they belong to.
struct EntityKind {
    const char* name;
    std::vector<std::pair<std::int64_t, std::string>> groups = {};            // tag, name; sorted once complete
    std::vector<std::pair<std::int64_t, std::int64_t>> group_of_entity = {};  // entity, physical tag

    /// Returns the name of the group, or of the entity where the group is 0.
    std::string name_of(std::int64_t group, std::int64_t entity) const;
};

/// The content of the sections before the elements.
struct Model {
    EntityKind surfaces{"surface"}, volumes{"volume"};
    std::vector<std::pair<std::int64_t, std::vector<std::int64_t>>> surfaces_of_volume;  // entities
    bool is_partitioned = false;
    std::vector<std::pair<std::int64_t, std::int64_t>> vertex_of_node;  // tag, index

    EntityKind* of_dimension(std::int64_t dimension) {
        return dimension == 2 ? &surfaces : dimension == 3 ? &volumes : nullptr;
    }
};

/// Returns the value behind a key in sorted pairs, null if there is none. O(log n).
template <class Value>
const Value* find(const std::vector<std::pair<std::int64_t, Value>>& pairs, std::int64_t key) {
    const auto found = std::lower_bound(pairs.begin(), pairs.end(), key,
                                        [](const auto& pair, std::int64_t wanted) { return pair.first < wanted; });
    return found != pairs.end() && found->first == key ? &found->second : nullptr;
}

inline std::string EntityKind::name_of(std::int64_t group, std::int64_t entity) const {
    if (const std::string* found = find(groups, group)) return *found;
    return group != 0 ? "physical_" + std::to_string(group) : std::string(name) + "_" + std::to_string(entity);
}

}  // namespace kerf::gmsh
