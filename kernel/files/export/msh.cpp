// Gmsh's MSH, after "MSH file format" in the reference manual of Gmsh: 4.1 in parts and merged, 2.2 merged, each binary
// or, where FormatOptions::msh_ascii says so, as text with the same sections in the same order.
//
// Nodes and elements have the same tags in all files. Tags count from 1, numbers in Kerf from 0. Nodes have their
// global numbers; elements are all tetrahedra, in the order of the parts, and then all triangles on patches. Triangles
// on interfaces are not written, as Gmsh leaves them out without Mesh.PartitionCreateTopology. A node belongs to its
// first patch, or else to a volume. Every material (files/export/inside/materials.h) is a physical group, as programs
// expect, and what a part has of one a volume of its own. Walls between regions are triangles of their patch, once
// each; their nodes are on it in both parts. Of order 2 elements have ten and six nodes.
//
// A part is one file of MSH 4.1: PartFile collects everything that the sections count, and then writes the sections in
// the order that Gmsh reads. A piece is what the part has of one patch or one material; each is an entity of the part,
// whose parent is the entity of the whole with the same patch or material. A node is written once, with its first
// patch, else with its material (files/export/inside/patch_pieces.h). Ghost cells and the nodes that only they have
// belong to one volume more, and $GhostElements says which part owns each. Tags are those of the whole
// (files/export/inside/msh_tags.h), so that the files of all parts fit together.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/format.h"
#include "files/export/inside/materials.h"
#include "files/export/inside/msh_writer.h"
#include "files/export/whole_mesh.h"

namespace kerf {

namespace msh {

namespace {

// The file of a part, as Gmsh writes partitioned meshes: the entities of the whole of which the part has something
// ($Entities), those of the part ($PartitionedEntities), and the cells of other parts that touch it ($GhostElements).
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

void write_part(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) {
    require_tags_fit(parts.outline());
    const PartFile content(parts, index, part, files.ghosts());
    content.write(
        Writer(files.create(file_name(parts.outline().parts.size(), index)), "4.1", files.options().msh_ascii));
}

// A volume of the merged mesh.
struct MergedVolume {
    Entity entity;
    std::int32_t physical;
    Eigen::AlignedBox3d box;
};

// The boxes and counts of entities of the whole mesh, which are written before the entities.
struct Whole {
    std::vector<Eigen::AlignedBox3d> surfaces;  // by patch
    std::vector<MergedVolume> volumes;
    std::size_t blocks = 0;         // of nodes
    std::size_t without_cells = 0;  // of them
};

Whole survey(const PartSource& parts, const Tags& tags) {
    Whole whole;
    whole.surfaces.resize(parts.outline().patch_names.size());
    for_each_part(parts, PartContent::all, [&](PartIndex index, const Part& part) {
        const PatchPieces pieces = patch_pieces(part);
        for (const PatchPiece& piece : pieces.on_patches) whole.surfaces[piece.patch].extend(piece.box);
        whole.blocks += pieces.on_patches.size();
        whole.without_cells += pieces_without_facets(pieces);
        for (const MaterialPiece& piece : material_pieces(parts, index, part, {})) {
            whole.volumes.push_back(
                {tags.merged_volume(index, piece.material), tags.physical_material(piece.material), piece.box});
            ++whole.blocks;
        }
    });
    return whole;
}

void write_merged_entities(Writer& writer, const Whole& whole) {
    const std::int64_t used =
        std::count_if(whole.surfaces.begin(), whole.surfaces.end(), [](const auto& box) { return !box.isEmpty(); });
    writer.begin("Entities");
    writer.counts_of_entities(used, whole.volumes.size());
    for (std::int32_t patch = 0; patch < std::ssize(whole.surfaces); ++patch) {
        if (!whole.surfaces[patch].isEmpty())
            writer.entity(Tags::surface(patch), whole.surfaces[patch], Tags::physical_patch(patch));
    }
    for (const MergedVolume& volume : whole.volumes) writer.entity(volume.entity, volume.box, volume.physical);
    writer.end("Entities");
}

void write_merged_4_1(const PartSource& parts, const Tags& tags, ExportFiles& files, const std::string& name) {
    const MeshOutline& outline = parts.outline();
    const Whole whole = survey(parts, tags);
    Writer writer(files.create(name), "4.1", files.options().msh_ascii);
    write_names(writer.file(), tags, outline);
    write_merged_entities(writer, whole);

    writer.begin("Nodes");
    writer.extent(whole.blocks, outline.nodes(), {0, outline.nodes() - 1});
    for_each_part(parts, PartContent::all, [&](PartIndex index, const Part& part) {
        const PatchPieces pieces = owned_patch_pieces(part);
        for (const PatchPiece& piece : pieces.on_patches) writer.nodes(Tags::surface(piece.patch), part, piece.nodes);
        for (const MaterialPiece& piece : material_pieces(parts, index, part, pieces.inside))
            writer.nodes(tags.merged_volume(index, piece.material), part, piece.inside);
    });
    writer.end("Nodes");

    const std::int64_t elements = element_count(outline);
    writer.begin("Elements");
    writer.extent(whole.blocks - whole.without_cells, elements, {0, elements - 1});
    for_each_part(parts, PartContent::all, [&](PartIndex index, const Part& part) {
        for (const PatchPiece& piece : patch_pieces(part).on_patches)
            writer.triangles(Tags::surface(piece.patch), part, piece, first_triangle(outline, index));
        for (const MaterialPiece& piece : material_pieces(parts, index, part, {}))
            writer.tets(tags.merged_volume(index, piece.material), part, piece.tets, outline.first_tet(index));
    });
    writer.end("Elements");
    write_merged_values(parts, writer);
    writer.file().close();
}

// Writes $Elements of MSH 2.2: every element has its physical group, its entity and its nodes, all in 32 bits; elements
// of one type come together, behind a header for all of them.
class Elements22 {
 public:
    Elements22(Writer& writer, std::int32_t type, std::int64_t count) : writer_(writer), type_(type) {
        if (!writer.is_ascii() && count > 0)
            writer.row(std::array<std::int32_t, 3>{type, static_cast<std::int32_t>(count), tags});
    }

    void add(std::int64_t number, std::int32_t physical, const Entity& entity, const CellNodes& nodes) {
        writer_.number(tag_of(number));
        if (writer_.is_ascii()) {
            writer_.number(type_);
            writer_.number(tags);
        }
        writer_.number(physical);
        writer_.number(entity.tag);
        for (const std::int64_t node : nodes) writer_.number(tag_of(node));
        writer_.end_row();
    }

 private:
    static constexpr std::int32_t tags = 2;

    Writer& writer_;
    std::int32_t type_;
};

void write_triangles_2_2(Writer& writer, const Part& part, const PartExtent& extent, std::int64_t number) {
    Elements22 elements(writer, triangle_type(part.order()), extent.patch_facets);
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (part.is_listed(f))
            elements.add(number++, Tags::physical_patch(part.patch[f]), Tags::surface(part.patch[f]),
                         nodes_of_facet(part, f));
}

void write_merged_2_2(const PartSource& parts, const Tags& tags, ExportFiles& files, const std::string& name) {
    const MeshOutline& outline = parts.outline();
    if (std::max(outline.nodes(), element_count(outline)) > most_int32)
        throw Error(ErrorCode::usage,
                    fmt::format("{} nodes and {} elements are more than the 32-bit numbers of MSH 2.2 can tell apart. "
                                "Take MSH 4.1, or the mesh in parts.",
                                outline.nodes(), element_count(outline)));
    Writer writer(files.create(name), "2.2", files.options().msh_ascii);
    write_names(writer.file(), tags, outline);

    writer.file().write(fmt::format("$Nodes\n{}\n", outline.nodes()));
    for_each_node(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& point : points) {
            writer.number(tag_of(first++));
            writer.point(point);
            writer.end_row();
        }
    });
    writer.end("Nodes");

    const Materials materials(parts);
    writer.file().write(fmt::format("$Elements\n{}\n", element_count(outline)));
    for_each_part(parts, PartContent::cells, [&](PartIndex index, const Part& part) {
        write_triangles_2_2(writer, part, outline.parts[index], first_triangle(outline, index));
        Elements22 elements(writer, tet_type(part.order()), part.tet_count());
        std::int64_t number = outline.first_tet(index);
        const std::vector<std::int32_t> of_tets = materials.of_tets(index, part);
        for (std::size_t t = 0; t < of_tets.size(); ++t)
            elements.add(number++, tags.physical_material(of_tets[t]), tags.merged_volume(index, of_tets[t]),
                         nodes_of_tet(part, t).in_order(order_of_nodes));
    });
    writer.end("Elements");
    write_merged_values(parts, writer);
    writer.file().close();
}

void write_merged(const PartSource& parts, const MergeOptions& options, ExportFiles& files, const std::string& stem) {
    const Tags tags(parts);
    require_tags_fit(parts.outline());
    if (options.msh_version == "4.1") return write_merged_4_1(parts, tags, files, stem + ".msh");
    if (options.msh_version == "2.2") return write_merged_2_2(parts, tags, files, stem + ".msh");
    throw Error(ErrorCode::usage,
                fmt::format("'{}' is no version of MSH that Kerf writes. There are 4.1 and 2.2.", options.msh_version));
}

}  // namespace

}  // namespace msh

extern const Format msh_format = {
    .name = "msh",
    .help = "Gmsh MSH: gmsh; merged also deal.II, DOLFINx, meshio",
    .ending = ".msh",
    .kind = {"MSH file", [](std::string_view text) { return text.starts_with("$MeshFormat\n"); }},
    .has_values = true,
    .patch_words = msh::readable_names,
    .write_part = msh::write_part,
    .write_merged = msh::write_merged};

}  // namespace kerf
