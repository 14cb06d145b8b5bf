// MFEM's parallel mesh, "MFEM mesh v1.2": a file a rank, as its class ParMesh prints and reads it. A rank lists the
// groups of ranks that it shares vertices, edges or faces with, itself alone as the first. All ranks of a group list
// its entities in the same order, and name the corners of an edge or face in the same order, too: MFEM orients the
// unknowns of edges and faces by that. Here all are in the order of global numbers. The attribute of a tetrahedron is
// its material (files/export/inside/materials.h), that of a triangle its patch, both from 1. Names of attributes are
// comments, because only version 1.3 of the format has them, which older releases of MFEM refuse.
//
// Of order 2 the nodes of each rank are a function of the space H1_3D_P2 in place of the vertices: first those of
// vertices, then those of edges in the order of MFEM's numbers for them: as they come up, tetrahedron after
// tetrahedron, in each of which they are 01 02 03 12 13 23 (DSTable of Mesh::GetVertexToVertexTable(),
// Tetrahedron::edges).
//
// Walls between regions are shared faces and, once, boundary of the rank with the smaller part: inner boundary, as MFEM
// has it where a serial mesh with such triangles is shared out. Their patches have attributes of their own, by which
// conditions that are meant for the outside leave them out.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "files/export/format.h"
#include "files/export/inside/materials.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace {

constexpr int mfem_triangle = 2, mfem_tetrahedron = 4;  // MFEM's numbers of geometries

// The places of MFEM's edges of a tetrahedron among its ten nodes.
constexpr std::array<std::int8_t, 6> nodes_on_mfem_edges = {4, 6, 7, 5, 8, 9};

// The entities that the ranks of a group have in common, by the numbers of one of these ranks.
struct MfemGroup {
    std::vector<std::int32_t> vertices;
    std::vector<UndirectedEdge> edges;
    std::vector<Triangle> faces;
};

class MfemFile {
 public:
    MfemFile(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files)
        : parts_(parts),
          outline_(parts.outline()),
          index_(index),
          part_(part),
          file_(files.create(fmt::format("mesh.{:06}", index.value()))) {}

    void write() {
        file_.write("MFEM mesh v1.2\n\ndimension\n3\n");
        write_cells();
        write_vertices();
        file_.write("\nmfem_serial_mesh_end\n");
        find_groups();
        write_groups();
        file_.write("\nmfem_mesh_end\n");
        file_.close();
    }

 private:
    template <std::size_t n>
    void write_numbers(const std::array<std::int32_t, n>& numbers) {
        for (std::size_t i = 0; i < n; ++i) {
            if (i > 0) file_.write(" ");
            file_.number(std::int64_t{numbers[i]});
        }
        file_.write("\n");
    }

    void write_entry(const char* name, std::size_t number) { file_.write(fmt::format("{} {}\n", name, number)); }

    void write_cells() {
        file_.write(fmt::format("\nelements\n{}\n", part_.mesh.tets.size()));
        const std::string tetrahedron = fmt::format(" {} ", mfem_tetrahedron);
        const std::vector<std::int32_t> of_tets = Materials(parts_).of_tets(index_, part_);
        for (std::size_t t = 0; t < of_tets.size(); ++t) {
            file_.number(std::int64_t{of_tets[t]} + 1);
            file_.write(tetrahedron);
            write_numbers(part_.mesh.tets[t]);
        }
        file_.write("\n");
        write_names();
        std::int64_t listed = 0;
        for (std::size_t f = 0; f < part_.facets.size(); ++f) listed += part_.is_listed(f);
        file_.write(fmt::format("boundary\n{}\n", listed));
        for (std::size_t f = 0; f < part_.facets.size(); ++f) {
            if (!part_.is_listed(f)) continue;
            file_.write(fmt::format("{} {} ", part_.patch[f] + 1, mfem_triangle));
            write_numbers(part_.facets[f]);
        }
    }

    void write_names() {
        const auto write_all = [&](const char* kind, const NameTable& names) {
            for (std::size_t i = 0; i < names.size(); ++i) {
                std::string name = names.names()[i];
                std::replace_if(
                    name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
                file_.write(fmt::format("# {} {}: {}\n", kind, names.number(i) + 1, name));
            }
        };
        write_all("attribute", part_.region_names);
        write_all("boundary attribute", part_.patch_names);
    }

    void write_point(const Vec3& p) {
        file_.point(p);
        file_.write("\n");
    }

    void write_vertices() {
        file_.write(fmt::format("\nvertices\n{}\n", part_.mesh.vertices.size()));
        file_.write(part_.order() == 1 ? "3\n"
                                       : "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\n"
                                         "VDim: 3\nOrdering: 1\n\n");
        for (const Vec3& p : part_.mesh.vertices) write_point(p);
        if (part_.order() == 2) write_edge_nodes();
    }

    void write_edge_nodes() {
        std::vector<bool> is_written(part_.node_count());
        for (std::int64_t t = 0; t < part_.tet_count(); ++t) {
            const std::array<std::int32_t, 10> nodes = part_.nodes_of_tet(t);
            for (const std::int8_t place : nodes_on_mfem_edges) {
                const std::int32_t n = nodes[place];
                if (!is_written[n]) write_point(part_.node_point(n));
                is_written[n] = true;
            }
        }
    }

    MfemGroup& group_of(const std::vector<NodeId>& parts) {
        std::vector<std::int32_t> ranks;
        for (const NodeId part : parts) ranks.push_back(outline_.index_of(part).value());
        std::sort(ranks.begin(), ranks.end());
        return groups_[ranks];
    }

    void find_groups() {
        for (const SharedGroup& group : part_.shared) group_of(group.parts).vertices = group.vertices;
        for (const SharedEdgeGroup& group : part_.shared_edges) group_of(group.parts).edges = group.edges;
        std::map<NodeId, std::vector<Triangle>> faces_of;  // by neighbour
        for (std::size_t f = 0; f < part_.facets.size(); ++f)
            if (part_.is_interface(f)) faces_of[part_.neighbour[f]].push_back(by_global_id(part_.facets[f]));
        for (auto& [neighbour, faces] : faces_of) {
            std::sort(faces.begin(), faces.end(), [this](const Triangle& a, const Triangle& b) {
                return global_corners(part_, a) < global_corners(part_, b);
            });
            group_of({part_.id, neighbour}).faces = std::move(faces);
        }
    }

    Triangle by_global_id(Triangle face) const {
        std::sort(face.begin(), face.end(),
                  [this](std::int32_t a, std::int32_t b) { return part_.global_id[a] < part_.global_id[b]; });
        return face;
    }

    void write_groups() {
        write_entry("\ncommunication_groups\nnumber_of_groups", groups_.size() + 1);
        file_.write(fmt::format("\n# number of ranks in each group, followed by the ranks\n1 {}\n", index_.value()));
        std::size_t vertices = 0, edges = 0, faces = 0;
        for (const auto& [ranks, group] : groups_) {
            file_.write(fmt::format("{} {}\n", ranks.size(), fmt::join(ranks, " ")));
            vertices += group.vertices.size();
            edges += group.edges.size();
            faces += group.faces.size();
        }
        write_entry("\ntotal_shared_vertices", vertices);
        write_entry("total_shared_edges", edges);
        write_entry("total_shared_faces", faces);
        std::int32_t number = 0;
        for (const auto& [ranks, group] : groups_) write_group(++number, group);
    }

    void write_group(std::int32_t number, const MfemGroup& group) {
        file_.write(fmt::format("\n# group {}\n", number));
        write_entry("shared_vertices", group.vertices.size());
        for (const std::int32_t v : group.vertices) write_numbers(std::array{v});
        write_entry("\nshared_edges", group.edges.size());
        for (const UndirectedEdge& edge : group.edges) write_numbers(edge);
        write_entry("\nshared_faces", group.faces.size());
        for (const Triangle& face : group.faces) {
            file_.write(fmt::format("{} ", mfem_triangle));
            write_numbers(face);
        }
    }

    const PartSource& parts_;
    const MeshOutline& outline_;
    PartIndex index_;  // the rank that reads the part
    const Part& part_;
    ExportFile file_;
    std::map<std::vector<std::int32_t>, MfemGroup> groups_;  // by ranks
};

void write_mfem_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    MfemFile(parts, index, part, files).write();
}

}  // namespace

extern const Format mfem_format = {
    .name = "mfem", .help = "MFEM's parallel mesh, a file a rank", .ending = nullptr, .write_part = write_mfem_part};

}  // namespace kerf
