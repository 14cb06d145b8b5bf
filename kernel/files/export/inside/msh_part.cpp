// One file of MSH 4.1 a part, as Gmsh writes partitioned meshes: PartFile collects everything that the sections count,
// and then writes the sections in the order that Gmsh reads. A piece is what the part has of one patch or one material;
// each is an entity of the part, whose parent is the entity of the whole with the same patch or material. A node is
// written once, with its first patch, else with its material (files/export/inside/patch_pieces.h). Ghost cells and the
// nodes that only they have belong to one volume more, and $GhostElements says which part owns each. Tags are those of
// the whole (files/export/inside/msh_tags.h), so that the files of all parts fit together.
#include "files/export/inside/msh_part.h"

#include <algorithm>

#include <fmt/format.h>

#include "files/export/inside/msh_writer.h"

namespace kerf::msh {

namespace {

class PartFile {
 public:
    PartFile(const PartSource& parts, PartIndex index, const Part& part, GhostFinder& ghosts)
        : outline_(parts.outline()),
          index_(index),
          part_(part),
          tags_(parts),
          pieces_(patch_pieces(part)),
          materials_(material_pieces(parts, index, part, pieces_.inside)),
          ghosts_(ghosts.ghosts_of(parts, part)),
          ghost_volume_(tags_.ghosts_of_part(index)) {}

    void write(Writer writer) const {
        write_names(writer.file(), tags_, outline_);
        write_entities(writer);
        write_partitioned_entities(writer);
        write_nodes(writer);
        write_elements(writer);
        if (has_ghosts()) write_ghosts(writer);
        write_part_values(outline_, index_, part_, writer);
        writer.file().close();
    }

 private:
    bool has_ghosts() const { return !ghosts_.cells.empty(); }

    // The boxes are those of this part: the whole is not known here.
    void write_entities(Writer& writer) const {
        writer.begin("Entities");
        writer.counts_of_entities(pieces_.on_patches.size(), materials_.size());
        for (const PatchPiece& piece : pieces_.on_patches)
            writer.entity(Tags::surface(piece.patch), piece.box, Tags::physical_patch(piece.patch));
        for (const MaterialPiece& piece : materials_)
            writer.entity(Tags::whole(piece.material), piece.box, tags_.physical_material(piece.material));
        writer.end("Entities");
    }

    void write_partitioned_entities(Writer& writer) const {
        writer.begin("PartitionedEntities");
        writer.size(tags_.parts());
        writer.end_row();
        writer.size(has_ghosts());
        writer.end_row();
        if (has_ghosts()) writer.row(std::array{ghost_volume_.tag, index_.value() + 1});
        writer.counts_of_entities(pieces_.on_patches.size(), materials_.size());
        for (const PatchPiece& piece : pieces_.on_patches)
            writer.entity_of_part(surface_of(piece), Tags::surface(piece.patch), index_, piece.box,
                                  Tags::physical_patch(piece.patch));
        for (const MaterialPiece& piece : materials_)
            writer.entity_of_part(volume_of(piece), Tags::whole(piece.material), index_, piece.box,
                                  tags_.physical_material(piece.material));
        writer.end("PartitionedEntities");
    }

    std::size_t block_count() const { return pieces_.on_patches.size() + materials_.size() + has_ghosts(); }

    void write_nodes(Writer& writer) const {
        Numbers numbers{part_.node_id(0), part_.node_id(0)};
        for (std::int64_t n = 1; n < part_.node_count(); ++n) numbers.add(part_.node_id(n));
        for (const GhostNode& node : ghosts_.nodes) numbers.add(node.id);
        writer.begin("Nodes");
        writer.extent(block_count(), part_.node_count() + std::ssize(ghosts_.nodes), numbers);
        for (const PatchPiece& piece : pieces_.on_patches) writer.nodes(surface_of(piece), part_, piece.nodes);
        for (const MaterialPiece& piece : materials_) writer.nodes(volume_of(piece), part_, piece.inside);
        if (has_ghosts()) writer.nodes(ghost_volume_, ghosts_.nodes);
        writer.end("Nodes");
    }

    void write_elements(Writer& writer) const {
        const std::int64_t tet = outline_.first_tet(index_), triangle = first_triangle(outline_, index_);
        const std::int64_t triangles = outline_.parts[index_].patch_facets;
        Numbers numbers{tet, tet + part_.tet_count() - 1};
        if (triangles > 0) numbers.add(triangle + triangles - 1);
        for (const GhostCell& cell : ghosts_.cells) numbers.add(cell.number);
        writer.begin("Elements");
        writer.extent(block_count() - pieces_without_facets(pieces_),
                      part_.mesh.tets.size() + triangles + ghosts_.cells.size(), numbers);
        for (const PatchPiece& piece : pieces_.on_patches) writer.triangles(surface_of(piece), part_, piece, triangle);
        for (const MaterialPiece& piece : materials_) writer.tets(volume_of(piece), part_, piece.tets, tet);
        if (has_ghosts()) writer.tets(ghost_volume_, ghosts_.cells, part_.order());
        writer.end("Elements");
    }

    void write_ghosts(Writer& writer) const {
        writer.begin("GhostElements");
        writer.size(std::ssize(ghosts_.cells));
        writer.end_row();
        for (const GhostCell& cell : ghosts_.cells) {
            writer.size(tag_of(cell.number));
            writer.number(cell.part.value() + 1);
            writer.size(1);
            writer.number(index_.value() + 1);
            writer.end_row();
        }
        writer.end("GhostElements");
    }

    Entity surface_of(const PatchPiece& piece) const { return tags_.surface_of_part(index_, piece.patch); }
    Entity volume_of(const MaterialPiece& piece) const { return tags_.volume_of_part(index_, piece.material); }

    const MeshOutline& outline_;
    PartIndex index_;
    const Part& part_;
    Tags tags_;
    PatchPieces pieces_;
    std::vector<MaterialPiece> materials_;
    Ghosts ghosts_;
    Entity ghost_volume_;
};

// Returns the name that Gmsh gives the file: a mesh in one piece has no number.
std::string file_name(std::size_t parts, PartIndex index) {
    return parts == 1 ? "mesh.msh" : fmt::format("mesh_{}.msh", index.value() + 1);
}

}  // namespace

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    require_tags_fit(parts.outline());
    const PartFile content(parts, index, part, files.ghosts());
    content.write(
        Writer(files.create(file_name(parts.outline().parts.size(), index)), "4.1", files.options().msh_ascii));
}

}  // namespace kerf::msh
