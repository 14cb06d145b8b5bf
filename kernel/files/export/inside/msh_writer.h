// Writes the sections of Gmsh's files.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>

#include "files/export/inside/export_files.h"
#include "files/export/inside/ghosts.h"
#include "files/export/inside/msh_tags.h"
#include "files/export/inside/patch_pieces.h"
#include "files/export/whole_mesh.h"

namespace kerf::msh {

/// The range of some numbers.
struct Numbers {
    std::int64_t first, last;

    void add(std::int64_t number) {
        first = std::min(first, number);
        last = std::max(last, number);
    }
};

/// Writes numbers one behind the other, as bytes or, as text, a row of them on a line.
class Writer {
 public:
    Writer(ExportFile file, const char* version, bool is_ascii) : file_(std::move(file)), is_ascii_(is_ascii) {
        file_.write(fmt::format("$MeshFormat\n{} {} 8\n", version, is_ascii_ ? 0 : 1));
        if (!is_ascii_) {
            file_.value(std::int32_t{1});
            file_.write("\n");
        }
        file_.write("$EndMeshFormat\n");
    }

    ExportFile& file() { return file_; }
    void begin(const char* section) { file_.write(fmt::format("${}\n", section)); }
    void end(const char* section) { file_.write(fmt::format("{}$End{}\n", is_ascii_ ? "" : "\n", section)); }
    void size(std::int64_t value) { put(value); }
    void number(std::int32_t value) { put(value); }
    void real(double value) { put(value); }
    void point(const Vec3& p) {
        for (const double x : p) put(x);
    }
    void end_row() {
        if (is_ascii_) file_.write("\n");
        is_in_row_ = false;
    }
    template <class T, std::size_t n>
    void row(const std::array<T, n>& numbers) {
        row(std::span<const T>(numbers));
    }
    template <class T>
    void row(std::span<const T> numbers) {
        if (!is_ascii_) return file_.values(numbers);
        for (const T number : numbers) put(number);
        end_row();
    }
    bool is_ascii() const { return is_ascii_; }

    /// Write an entity of the whole, or of a part; none of them has a boundary of its own.
    void entity(const Entity& entity, const Eigen::AlignedBox3d& box, std::int32_t physical) {
        number(entity.tag);
        box_and_physical(box, physical);
    }
    void entity_of_part(const Entity& entity, const Entity& of, PartIndex index, const Eigen::AlignedBox3d& box,
                        std::int32_t physical) {
        number(entity.tag);
        number(of.dimension);
        number(of.tag);
        size(1);
        number(index.value() + 1);
        box_and_physical(box, physical);
    }
    void counts_of_entities(std::int64_t surfaces, std::int64_t volumes) {
        row(std::array<std::int64_t, 4>{0, 0, surfaces, volumes});
    }

    /// Writes the first row of $Nodes and $Elements.
    void extent(std::int64_t blocks, std::int64_t count, const Numbers& numbers) {
        row(std::array<std::int64_t, 4>{blocks, count, tag_of(numbers.first), tag_of(numbers.last)});
    }

    void nodes(const Entity& entity, const Part& part, const std::vector<std::int32_t>& nodes) {
        block(entity, 0, nodes.size());
        for (const std::int32_t n : nodes) row(std::array{tag_of(part.node_id(n))});
        for (const std::int32_t n : nodes) point_row(part.node_point(n));
    }
    void nodes(const Entity& entity, const std::vector<GhostNode>& nodes) {
        block(entity, 0, nodes.size());
        for (const GhostNode& node : nodes) row(std::array{tag_of(node.id)});
        for (const GhostNode& node : nodes) point_row(node.point);
    }
    void triangles(const Entity& entity, const Part& part, const PatchPiece& piece, std::int64_t first) {
        if (piece.facets.empty()) return;
        block(entity, triangle_type(part.order()), piece.facets.size());
        for (std::size_t i = 0; i < piece.facets.size(); ++i)
            element(first + piece.places[i], nodes_of_facet(part, piece.facets[i]));
    }
    void tets(const Entity& entity, const Part& part, const std::vector<std::int32_t>& tets, std::int64_t first) {
        block(entity, tet_type(part.order()), tets.size());
        for (const std::int32_t t : tets) element(first + t, nodes_of_tet(part, t).in_order(order_of_nodes));
    }
    void tets(const Entity& entity, const std::vector<GhostCell>& cells, int order) {
        block(entity, tet_type(order), cells.size());
        for (const GhostCell& cell : cells) element(cell.number, cell.nodes.in_order(order_of_nodes));
    }

 private:
    template <class T>
    void put(T value) {
        if (!is_ascii_) return file_.value(value);
        if (is_in_row_) file_.write(" ");
        is_in_row_ = true;
        if constexpr (std::is_floating_point_v<T>)
            file_.number(value);
        else
            file_.number(std::int64_t{value});
    }
    void point_row(const Vec3& p) {
        point(p);
        end_row();
    }
    void box_and_physical(const Eigen::AlignedBox3d& box, std::int32_t physical) {
        point(box.min());
        point(box.max());
        size(1);
        number(physical);
        size(0);
        end_row();
    }
    void block(const Entity& entity, std::int32_t kind, std::size_t count) {
        number(entity.dimension);
        number(entity.tag);
        number(kind);
        size(count);
        end_row();
    }
    void element(std::int64_t number, const CellNodes& nodes) {
        std::array<std::int64_t, 11> record{tag_of(number)};
        std::transform(nodes.begin(), nodes.end(), record.begin() + 1, tag_of);
        row(std::span<const std::int64_t>(record.data(), nodes.size() + 1));
    }

    ExportFile file_;
    bool is_ascii_, is_in_row_ = false;
};

/// Writes $PhysicalNames: the names of patches and materials.
void write_names(ExportFile& file, const Tags& tags, const MeshOutline& outline);

/// Throws Error(usage) for values of a mesh whose tags have more than the 32 bits that $NodeData and $ElementData take.
void require_tags_fit(const MeshOutline& outline);

/// Write $NodeData and $ElementData: the values of a solution.
void write_part_values(const MeshOutline& outline, PartIndex index, const Part& part, Writer& writer);
void write_merged_values(const PartSource& parts, Writer& writer);

}  // namespace kerf::msh
