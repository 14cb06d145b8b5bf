// A reader of Gmsh's MSH, 4.1 and 2.2, binary and text, that takes nothing but what Kerf writes and nothing that Gmsh
// forbids.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "support/file_contents.h"

namespace kerf::test {

using MshEntity = std::array<std::int32_t, 2>;  // dimension, tag

struct MshNode {
    Vec3 point;
    MshEntity entity = {-1, 0};

    bool operator==(const MshNode&) const = default;
};

struct MshElement {
    MshEntity entity;
    std::vector<std::int64_t> corners;  // then of order 2 the nodes on edges, in Gmsh's order

    bool operator==(const MshElement&) const = default;
};

struct MshEntityFacts {
    std::array<Vec3, 2> box;
    std::vector<std::int32_t> physicals;
    MshEntity whole = {-1, 0};
    std::vector<std::int32_t> partitions;

    bool operator==(const MshEntityFacts&) const = default;
};

struct MshGhost {
    std::int32_t partition;
    std::vector<std::int32_t> seen_from;

    bool operator==(const MshGhost&) const = default;
};

using MshNodes = std::map<std::int64_t, MshNode>;
using MshElements = std::map<std::int64_t, MshElement>;

struct MshContent {
    std::map<MshEntity, std::string> names;  // by dimension and physical tag
    std::map<MshEntity, MshEntityFacts> entities;
    std::int64_t partitions = 0;
    std::map<std::int32_t, std::int32_t> ghost_entities;  // to their partition
    MshNodes nodes;
    MshElements elements;
    std::map<std::int64_t, MshGhost> ghosts;

    bool operator==(const MshContent&) const = default;
    bool is_ghost(const MshEntity& entity) const { return entity[0] == 3 && ghost_entities.contains(entity[1]); }
};

// Throws std::runtime_error for what the format forbids.
class MshReader {
 public:
    explicit MshReader(const std::string& path) : bytes_(bytes_of_file(path)) {
        expect("$MeshFormat");
        const std::string version = line();
        is_ascii_ = version.ends_with(" 0 8");
        require(version == "4.1 1 8" || version == "2.2 1 8" || version == "4.1 0 8" || version == "2.2 0 8",
                "version " + version);
        if (!is_ascii_) {
            require(value<std::int32_t>() == 1, "byte order");
            require(line().empty(), "line after the byte order");
        }
        expect("$EndMeshFormat");
        read_names();
        if (version.starts_with("4.1"))
            read_4_1();
        else
            read_2_2();
        require(at_ == bytes_.size(), "end of the file");
    }

    const MshContent& content() const { return content_; }
    bool is_ascii() const { return is_ascii_; }

 private:
    static void require(bool holds, const std::string& what) {
        if (!holds) throw std::runtime_error("MSH: " + what);
    }
    std::string line() {
        const std::size_t end = bytes_.find('\n', at_);
        require(end != bytes_.npos, "a line has an end");
        std::string text = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return text;
    }
    void expect(const std::string& wanted) {
        const std::string found = line();
        require(found == wanted, wanted + ", found " + found);
    }
    // A row of text has an end, and nothing is after it.
    void end(const std::string& section) {
        require(line().empty(), "line after " + section);
        if (is_ascii_) require(bytes_[at_ - 2] != '\n', "an empty line in " + section);
        expect("$End" + section);
    }
    bool begins(const std::string& section) {
        if (bytes_.compare(at_, section.size() + 2, "$" + section + "\n") != 0) return false;
        line();
        return true;
    }
    template <class T>
    T value() {
        if (is_ascii_) return number<T>();
        require(bytes_.size() - at_ >= sizeof(T), "bytes are missing");
        T value;
        std::memcpy(&value, bytes_.data() + at_, sizeof value);
        at_ += sizeof value;
        return value;
    }
    // The next one on this line or the next, one blank or line's end before it.
    template <class T>
    T number() {
        if (at_ > 0 && (bytes_[at_] == ' ' || bytes_[at_] == '\n')) ++at_;
        T value{};
        const auto [end, error] = std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
        require(error == std::errc(), "a number at byte " + std::to_string(at_));
        at_ = static_cast<std::size_t>(end - bytes_.data());
        return value;
    }
    std::int64_t size() { return static_cast<std::int64_t>(value<std::uint64_t>()); }
    std::int32_t integer() { return value<std::int32_t>(); }
    Vec3 point() {
        const auto x = value<double>(), y = value<double>(), z = value<double>();
        return {x, y, z};
    }
    std::vector<std::int32_t> integers() {
        std::vector<std::int32_t> list;
        for (std::int64_t i = 0, count = size(); i < count; ++i) list.push_back(integer());
        return list;
    }

    void read_names() {
        expect("$PhysicalNames");
        const int count = std::stoi(line());
        for (int i = 0; i < count; ++i) {
            std::istringstream row(line());
            MshEntity group;
            std::string name;
            row >> group[0] >> group[1];
            std::getline(row, name);
            // As Gmsh reads it: what is between the first two quotes, of a line that fits 256 bytes.
            require(name.size() < 255 && std::count(name.begin(), name.end(), '"') == 2, "name " + name);
            const std::size_t first = name.find('"') + 1;
            require(content_.names.emplace(group, name.substr(first, name.find('"', first) - first)).second, "names");
        }
        expect("$EndPhysicalNames");
    }

    void read_4_1() {
        expect("$Entities");
        read_entities(false);
        end("Entities");
        if (begins("PartitionedEntities")) {
            content_.partitions = size();
            for (std::int64_t i = 0, count = size(); i < count; ++i) {
                const std::int32_t tag = integer();
                content_.ghost_entities[tag] = integer();
            }
            read_entities(true);
            end("PartitionedEntities");
        }
        expect("$Nodes");
        read_blocks([this](const MshEntity& entity, std::int32_t parametric) { read_nodes(entity, parametric); });
        end("Nodes");
        expect("$Elements");
        read_blocks([this](const MshEntity& entity, std::int32_t type) { read_elements(entity, type); });
        end("Elements");
        if (begins("GhostElements")) {
            for (std::int64_t i = 0, count = size(); i < count; ++i) {
                const std::int64_t tag = size();
                const std::int32_t partition = integer();
                require(content_.ghosts.emplace(tag, MshGhost{partition, integers()}).second, "ghosts differ");
            }
            end("GhostElements");
        }
    }

    void read_entities(bool are_partitioned) {
        const std::int64_t points = size(), curves = size(), surfaces = size(), volumes = size();
        require(points == 0 && curves == 0, "only surfaces and volumes");
        for (std::int64_t i = 0; i < surfaces + volumes; ++i) {
            const MshEntity entity{i < surfaces ? 2 : 3, integer()};
            MshEntityFacts facts;
            if (are_partitioned) {
                facts.whole[0] = integer();
                facts.whole[1] = integer();
                facts.partitions = integers();
            }
            facts.box[0] = point();
            facts.box[1] = point();
            facts.physicals = integers();
            integers();  // of its boundary
            require(content_.entities.emplace(entity, facts).second, "entities differ");
        }
    }

    // A section of blocks, each of which reads `count_` items and adds their tags to `tags_`.
    template <class Read>
    void read_blocks(const Read& read) {
        const std::int64_t blocks = size(), count = size(), smallest = size(), largest = size();
        tags_.clear();
        for (std::int64_t i = 0; i < blocks; ++i) {
            const MshEntity entity{integer(), integer()};
            const std::int32_t kind = integer();
            count_ = size();
            require(content_.entities.contains(entity) || content_.is_ghost(entity), "entities of blocks are known");
            read(entity, kind);
        }
        require(static_cast<std::int64_t>(tags_.size()) == count, "items of blocks are different and counted");
        require(*tags_.begin() == smallest && *tags_.rbegin() == largest, "smallest and largest tag");
    }
    void read_nodes(const MshEntity& entity, std::int32_t parametric) {
        require(parametric == 0, "nodes are not parametric");
        std::vector<std::int64_t> tags;
        for (std::int64_t i = 0; i < count_; ++i) tags.push_back(size());
        for (const std::int64_t tag : tags) {
            require(tags_.insert(tag).second, "nodes differ");
            content_.nodes[tag] = {point(), entity};
        }
    }
    // Dimension and number of nodes: "MSH file format" in Gmsh's manual.
    static std::array<int, 2> nodes_of(std::int32_t type) {
        static const std::map<std::int32_t, std::array<int, 2>> types = {
            {2, {2, 3}}, {4, {3, 4}}, {9, {2, 6}}, {11, {3, 10}}};
        require(types.contains(type), "type of elements");
        return types.at(type);
    }
    void read_elements(const MshEntity& entity, std::int32_t type) {
        require(nodes_of(type)[0] == entity[0], "triangles and tetrahedra");
        for (std::int64_t i = 0; i < count_; ++i) {
            const std::int64_t tag = size();
            MshElement element{entity, {}};
            for (int k = 0; k < nodes_of(type)[1]; ++k) element.corners.push_back(size());
            require(tags_.insert(tag).second, "elements differ");
            content_.elements[tag] = element;
        }
    }

    void read_2_2() {
        expect("$Nodes");
        const std::int64_t nodes = std::stoll(line());
        for (std::int64_t i = 0; i < nodes; ++i) {
            const std::int64_t tag = integer();
            require(content_.nodes.emplace(tag, MshNode{point(), {-1, 0}}).second, "nodes differ");
        }
        end("Nodes");
        expect("$Elements");
        for (std::int64_t left = std::stoll(line()); left > 0;) {
            if (is_ascii_) {
                --left;
                read_element_of_text_2_2();
                continue;
            }
            const std::int32_t type = integer(), count = integer(), tags = integer();
            require(tags == 2 && count > 0 && count <= left, "block of elements");
            left -= count;
            for (std::int32_t i = 0; i < count; ++i) read_element_2_2(type);
        }
        end("Elements");
    }
    void read_element_of_text_2_2() {
        const std::int64_t tag = integer();
        const std::int32_t type = integer(), tags = integer();
        require(tags == 2, "element");
        read_element_2_2(type, tag);
    }
    void read_element_2_2(std::int32_t type) { read_element_2_2(type, integer()); }
    void read_element_2_2(std::int32_t type, std::int64_t tag) {
        const std::int32_t physical = integer();
        const auto [dimension, nodes] = nodes_of(type);
        MshElement element{{dimension, integer()}, {}};
        for (int k = 0; k < nodes; ++k) element.corners.push_back(integer());
        require(content_.elements.emplace(tag, element).second, "elements differ");
        content_.entities[element.entity].physicals = {physical};
    }

    std::string bytes_;
    std::size_t at_ = 0;
    bool is_ascii_ = false;
    MshContent content_;
    std::int64_t count_ = 0;
    std::set<std::int64_t> tags_;
};

inline MshContent read_msh(const std::string& path) { return MshReader(path).content(); }

}  // namespace kerf::test
