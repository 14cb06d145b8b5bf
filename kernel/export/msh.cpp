// Gmsh's MSH, after "MSH file format" in the reference manual of Gmsh: 4.1 in parts and merged, 2.2 merged, each binary
// or, where FormatOptions::msh_ascii says so, as text with the same sections in the same order.
//
// Nodes and elements have the same tags in all files. Tags count from 1, numbers in Kerf from 0. Nodes have their
// global numbers; elements are all tetrahedra, in the order of the parts, and then all triangles on patches. Triangles
// on interfaces are not written, as Gmsh leaves them out without Mesh.PartitionCreateTopology. A node belongs to its
// first patch, or else to a volume. Every body (part/bodies.h) is a physical group, since programs take that for the
// material, and each body of a part a volume of its own.
//
// A part's file says of which whole it is a part ($Entities: a volume for each body and a surface for each patch that
// the part has something of), which entities the part has ($PartitionedEntities), and which cells of other parts touch
// it ($GhostElements).
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "export/format.h"
#include "export/ghosts.h"
#include "export/patch_pieces.h"
#include "export/whole_mesh.h"
#include "part/bodies.h"

namespace kerf {

namespace {

namespace msh {

constexpr std::int32_t triangle_type = 2, tet_type = 4;
constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();

// ---- tags ----

struct Entity {
    std::int32_t dimension, tag;
};

// All entities have tags of their own, those of the whole and those of every part.
class Tags {
 public:
    explicit Tags(const PartSource& source)
        : parts_(static_cast<std::int32_t>(source.outline().parts.size())),
          patches_(static_cast<std::int32_t>(source.outline().patch_names.size())),
          bodies_(source.bodies().count()) {
        const std::int64_t volumes = (std::int64_t{parts_} + 1) * bodies_ + parts_;
        const std::int64_t surfaces = (std::int64_t{parts_} + 1) * patches_;
        if (std::max(volumes, surfaces) >= most_int32)
            throw Error(ErrorCode::usage,
                        fmt::format("{} patches in {} parts of {} bodies are more than Gmsh's 32-bit tags can tell "
                                    "apart. Use fewer parts, or another format.",
                                    patches_, parts_, bodies_));
    }

    static Entity surface(std::int32_t patch) { return {2, patch + 1}; }
    static Entity whole(std::int32_t body) { return {3, body + 1}; }
    Entity surface_of_part(std::int32_t rank, std::int32_t patch) const {
        return {2, (rank + 1) * patches_ + patch + 1};
    }
    Entity volume_of_part(std::int32_t rank, std::int32_t body) const { return {3, (rank + 1) * bodies_ + body + 1}; }
    Entity ghosts_of_part(std::int32_t rank) const { return {3, (parts_ + 1) * bodies_ + rank + 1}; }
    // Merged, the parts are the volumes, for each body that they have something of.
    Entity merged_volume(std::int32_t rank, std::int32_t body) const { return {3, rank * bodies_ + body + 1}; }

    // Physical tags are different in all dimensions, as Gmsh chooses them itself, and GetDP needs them.
    static std::int32_t physical_patch(std::int32_t patch) { return patch + 1; }
    std::int32_t physical_body(std::int32_t body) const { return patches_ + body + 1; }

    std::int32_t parts() const { return parts_; }
    std::int32_t bodies() const { return bodies_; }

 private:
    std::int32_t parts_, patches_, bodies_;
};

std::int64_t tag_of(std::int64_t number) { return number + 1; }

// Among all elements.
std::int64_t first_triangle(const MeshOutline& outline, std::int32_t rank) {
    return outline.tets() + outline.first_patch_facet(rank);
}

std::int64_t element_count(const MeshOutline& outline) {
    return first_triangle(outline, static_cast<std::int32_t>(outline.parts.size()));
}

// ---- names ----

constexpr std::size_t longest_name = 251;  // bytes; Gmsh refuses files with 253

// Without what ends a name or a line, and not inside of a character that takes several bytes.
std::string readable(std::string name, std::size_t most) {
    for (char& c : name) {
        if (c == '"') c = '\'';
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    if (name.size() <= most) return name;
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    while (most > 0 && continues(name[most])) --most;
    return name.substr(0, most);
}

// Gmsh has no escapes: quotes become apostrophes. Names that are alike then get the number of their patch.
std::vector<std::string> names_of_patches(const std::vector<std::string>& patch_names) {
    std::vector<std::string> names;
    std::set<std::string> used;
    for (const std::string& given : patch_names) {
        std::string name = readable(given, longest_name);
        for (std::size_t number = names.size() + 1; !used.insert(name).second; number += patch_names.size()) {
            const std::string suffix = fmt::format(" ({})", number);
            name = readable(given, longest_name - suffix.size()) + suffix;
        }
        names.push_back(name);
    }
    return names;
}

void write_names(ExportFile& file, const Tags& tags, const std::vector<std::string>& patch_names) {
    file.text(fmt::format("$PhysicalNames\n{}\n", static_cast<std::int32_t>(patch_names.size()) + tags.bodies()));
    std::int32_t patch = 0;
    for (const std::string& name : names_of_patches(patch_names))
        file.text(fmt::format("2 {} \"{}\"\n", Tags::physical_patch(patch++), name));
    if (tags.bodies() == 1) file.text(fmt::format("3 {} \"volume\"\n", tags.physical_body(0)));
    for (std::int32_t body = 0; body < tags.bodies() && tags.bodies() > 1; ++body)
        file.text(fmt::format("3 {} \"body_{}\"\n", tags.physical_body(body), body + 1));
    file.text("$EndPhysicalNames\n");
}

// ---- what a part has of a body ----

struct BodyPiece {
    std::int32_t body = 0;
    std::vector<std::int32_t> tets;    // of the part, ascending
    std::vector<std::int32_t> inside;  // vertices on no patch
    Eigen::AlignedBox3d box;
};

// Ascending by body. `inside`: those vertices that are asked for.
std::vector<BodyPiece> body_pieces(const PartSource& parts, std::int32_t rank, const Part& part,
                                   const std::vector<std::int32_t>& inside) {
    const std::vector<std::int32_t> of_tets = parts.bodies().of_tets(rank, part);
    std::map<std::int32_t, BodyPiece> pieces;
    std::vector<std::int32_t> of_vertices(part.mesh.vertices.size(), -1);
    for (std::size_t t = 0; t < of_tets.size(); ++t) {
        pieces[of_tets[t]].tets.push_back(static_cast<std::int32_t>(t));
        for (const std::int32_t v : part.mesh.tets[t]) of_vertices[static_cast<std::size_t>(v)] = of_tets[t];
    }
    for (std::size_t v = 0; v < of_vertices.size(); ++v)
        if (of_vertices[v] >= 0) pieces[of_vertices[v]].box.extend(part.mesh.vertices[v]);
    for (const std::int32_t v : inside) pieces[of_vertices[static_cast<std::size_t>(v)]].inside.push_back(v);
    std::vector<BodyPiece> ordered;
    for (auto& [body, piece] : pieces) {
        piece.body = body;
        ordered.push_back(std::move(piece));
    }
    return ordered;
}

// ---- 4.1 ----

struct Numbers {
    std::int64_t first, last;

    void add(std::int64_t number) {
        first = std::min(first, number);
        last = std::max(last, number);
    }
};

// Numbers one behind the other, or, as text, a row of them on a line.
class Writer {
 public:
    Writer(ExportFile file, const char* version, bool is_ascii) : file_(std::move(file)), is_ascii_(is_ascii) {
        file_.text(fmt::format("$MeshFormat\n{} {} 8\n", version, is_ascii_ ? 0 : 1));
        if (!is_ascii_) {
            file_.value(std::int32_t{1});
            file_.text("\n");
        }
        file_.text("$EndMeshFormat\n");
    }

    ExportFile& file() { return file_; }
    void begin(const char* section) { file_.text(fmt::format("${}\n", section)); }
    void end(const char* section) { file_.text(fmt::format("{}$End{}\n", is_ascii_ ? "" : "\n", section)); }
    void size(std::int64_t value) { put(value); }
    void number(std::int32_t value) { put(value); }
    void real(double value) { put(value); }
    void point(const Vec3& p) {
        for (const double x : p) put(x);
    }
    void end_row() {
        if (is_ascii_) file_.text("\n");
        is_in_row_ = false;
    }
    template <class T, std::size_t n>
    void row(const std::array<T, n>& numbers) {
        if (!is_ascii_) return file_.value(numbers);
        for (const T number : numbers) put(number);
        end_row();
    }
    bool is_ascii() const { return is_ascii_; }

    // Of the whole, or of a part; none has a boundary of its own.
    void entity(const Entity& entity, const Eigen::AlignedBox3d& box, std::int32_t physical) {
        number(entity.tag);
        box_and_physical(box, physical);
    }
    void entity_of_part(const Entity& entity, const Entity& of, std::int32_t rank, const Eigen::AlignedBox3d& box,
                        std::int32_t physical) {
        number(entity.tag);
        number(of.dimension);
        number(of.tag);
        size(1);
        number(rank + 1);
        box_and_physical(box, physical);
    }
    void counts_of_entities(std::size_t surfaces, std::size_t volumes) {
        row(std::array<std::int64_t, 4>{0, 0, static_cast<std::int64_t>(surfaces), static_cast<std::int64_t>(volumes)});
    }

    // What $Nodes and $Elements begin with.
    void extent(std::size_t blocks, std::size_t count, const Numbers& numbers) {
        row(std::array<std::int64_t, 4>{static_cast<std::int64_t>(blocks), static_cast<std::int64_t>(count),
                                        tag_of(numbers.first), tag_of(numbers.last)});
    }

    void nodes(const Entity& entity, const Part& part, const std::vector<std::int32_t>& vertices) {
        block(entity, 0, vertices.size());
        for (const std::int32_t v : vertices) size_row(tag_of(part.global_id[static_cast<std::size_t>(v)]));
        for (const std::int32_t v : vertices) point_row(part.mesh.vertices[static_cast<std::size_t>(v)]);
    }
    void nodes(const Entity& entity, const std::vector<GhostVertex>& vertices) {
        block(entity, 0, vertices.size());
        for (const GhostVertex& vertex : vertices) size_row(tag_of(vertex.id));
        for (const GhostVertex& vertex : vertices) point_row(vertex.point);
    }
    void triangles(const Entity& entity, const Part& part, const PatchPiece& piece, std::int64_t first) {
        block(entity, triangle_type, piece.facets.size());
        for (std::size_t i = 0; i < piece.facets.size(); ++i)
            element(first + piece.places[i],
                    global_corners(part, part.facets[static_cast<std::size_t>(piece.facets[i])]));
    }
    void tets(const Entity& entity, const Part& part, const std::vector<std::int32_t>& tets, std::int64_t first) {
        block(entity, tet_type, tets.size());
        for (const std::int32_t t : tets)
            element(first + t, global_corners(part, part.mesh.tets[static_cast<std::size_t>(t)]));
    }
    void tets(const Entity& entity, const std::vector<GhostCell>& cells) {
        block(entity, tet_type, cells.size());
        for (const GhostCell& cell : cells) element(cell.number, cell.corners);
    }

 private:
    template <class T>
    void put(T value) {
        if (!is_ascii_) return file_.value(value);
        if (is_in_row_) file_.text(" ");
        is_in_row_ = true;
        if constexpr (std::is_floating_point_v<T>)
            file_.number(value);
        else
            file_.number(std::int64_t{value});
    }
    void size_row(std::int64_t value) {
        size(value);
        end_row();
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
        size(static_cast<std::int64_t>(count));
        end_row();
    }
    template <std::size_t n>
    void element(std::int64_t number, const std::array<std::int64_t, n>& corners) {
        std::array<std::int64_t, n + 1> record{tag_of(number)};
        for (std::size_t i = 0; i < n; ++i) record[i + 1] = tag_of(corners[i]);
        row(record);
    }

    ExportFile file_;
    bool is_ascii_, is_in_row_ = false;
};

// ---- values ----

constexpr int of_tensor = 9;

// Gmsh knows scalars, vectors and whole tensors.
int components_of(const PartValues& values) { return values.components == 6 ? of_tensor : values.components; }

// $NodeData and $ElementData are alike in all versions. Tags have 32 bits.
class ValueSection {
 public:
    ValueSection(Writer& writer, const PartValues& values, std::int64_t count)
        : writer_(writer), name_(values.of == PartValues::Of::points ? "NodeData" : "ElementData") {
        writer.file().text(fmt::format("${}\n1\n\"{}\"\n1\n0.0\n3\n0\n{}\n{}\n", name_,
                                       readable(values.name, longest_name), components_of(values), count));
    }
    ~ValueSection() = default;
    ValueSection(const ValueSection&) = delete;
    ValueSection& operator=(const ValueSection&) = delete;

    void row(std::int64_t number, const PartValues& values, std::size_t i) {
        writer_.number(static_cast<std::int32_t>(tag_of(number)));
        const auto at = [&](std::size_t c) {
            return values.number(static_cast<std::size_t>(values.components) * i + c);
        };
        if (values.components == 6)
            for (const std::size_t c : {0, 3, 5, 3, 1, 4, 5, 4, 2}) writer_.real(at(c));  // of XX YY ZZ XY YZ XZ
        else
            for (std::size_t c = 0; c < static_cast<std::size_t>(values.components); ++c) writer_.real(at(c));
        writer_.end_row();
    }
    void end() { writer_.end(name_); }

 private:
    Writer& writer_;
    const char* name_;
};

void require_tags_fit(const MeshOutline& outline) {
    if (!outline.values.empty()) require_numbers_fit(outline, "values in MSH", most_int32 - 1);
}

// What a part has, at its vertices for which wanted(v) holds, and in its tetrahedra.
template <class Wanted>
void write_rows_of_part(ValueSection& section, const Part& part, std::size_t k, std::int64_t first_tet,
                        const Wanted& wanted) {
    const PartValues& values = part.values[k];
    if (values.of == PartValues::Of::tets) {
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
            section.row(first_tet + static_cast<std::int64_t>(t), values, t);
        return;
    }
    for (std::size_t v = 0; v < part.global_id.size(); ++v)
        if (wanted(v)) section.row(part.global_id[v], values, v);
}

void write_merged_values(const PartSource& parts, Writer& writer) {
    const MeshOutline& outline = parts.outline();
    for (std::size_t k = 0; k < outline.values.size(); ++k) {
        const bool of_points = outline.values[k].of == PartValues::Of::points;
        ValueSection section(writer, outline.values[k], of_points ? outline.vertices : outline.tets());
        for_each_whole_part(parts, [&](std::int32_t rank, const Part& part) {
            const std::vector<NodeId> owners = owners_of_vertices(part);
            write_rows_of_part(section, part, k, outline.first_tet(rank),
                               [&](std::size_t v) { return owners[v] == part.id; });
        });
        section.end();
    }
}

// ---- the file of a part ----

class PartFile {
 public:
    PartFile(const PartSource& parts, std::int32_t rank, const Part& part)
        : outline_(parts.outline()),
          rank_(rank),
          part_(part),
          tags_(parts),
          pieces_(patch_pieces(part)),
          bodies_(body_pieces(parts, rank, part, pieces_.inside)),
          ghosts_(ghosts_of(parts, part)),
          ghost_volume_(tags_.ghosts_of_part(rank)) {}

    void write(Writer writer) const {
        write_names(writer.file(), tags_, part_.patch_names);
        write_entities(writer);
        write_partitioned_entities(writer);
        write_nodes(writer);
        write_elements(writer);
        if (has_ghosts()) write_ghosts(writer);
        write_values(writer);
        writer.file().close();
    }

 private:
    bool has_ghosts() const { return !ghosts_.cells.empty(); }

    // Boxes are those of this part: the whole is not known here.
    void write_entities(Writer& writer) const {
        writer.begin("Entities");
        writer.counts_of_entities(pieces_.on_patches.size(), bodies_.size());
        for (const PatchPiece& piece : pieces_.on_patches)
            writer.entity(Tags::surface(piece.patch), piece.box, Tags::physical_patch(piece.patch));
        for (const BodyPiece& piece : bodies_)
            writer.entity(Tags::whole(piece.body), piece.box, tags_.physical_body(piece.body));
        writer.end("Entities");
    }

    void write_partitioned_entities(Writer& writer) const {
        writer.begin("PartitionedEntities");
        writer.size(tags_.parts());
        writer.end_row();
        writer.size(has_ghosts());
        writer.end_row();
        if (has_ghosts()) writer.row(std::array{ghost_volume_.tag, rank_ + 1});
        writer.counts_of_entities(pieces_.on_patches.size(), bodies_.size());
        for (const PatchPiece& piece : pieces_.on_patches)
            writer.entity_of_part(surface_of(piece), Tags::surface(piece.patch), rank_, piece.box,
                                  Tags::physical_patch(piece.patch));
        for (const BodyPiece& piece : bodies_)
            writer.entity_of_part(volume_of(piece), Tags::whole(piece.body), rank_, piece.box,
                                  tags_.physical_body(piece.body));
        writer.end("PartitionedEntities");
    }

    std::size_t block_count() const { return pieces_.on_patches.size() + bodies_.size() + has_ghosts(); }

    void write_nodes(Writer& writer) const {
        const auto [smallest, largest] = std::minmax_element(part_.global_id.begin(), part_.global_id.end());
        Numbers numbers{*smallest, *largest};
        for (const GhostVertex& vertex : ghosts_.vertices) numbers.add(vertex.id);
        writer.begin("Nodes");
        writer.extent(block_count(), part_.global_id.size() + ghosts_.vertices.size(), numbers);
        for (const PatchPiece& piece : pieces_.on_patches) writer.nodes(surface_of(piece), part_, piece.vertices);
        for (const BodyPiece& piece : bodies_) writer.nodes(volume_of(piece), part_, piece.inside);
        if (has_ghosts()) writer.nodes(ghost_volume_, ghosts_.vertices);
        writer.end("Nodes");
    }

    void write_elements(Writer& writer) const {
        const std::int64_t tet = outline_.first_tet(rank_), triangle = first_triangle(outline_, rank_);
        const std::int64_t triangles = outline_.parts[static_cast<std::size_t>(rank_)].patch_facets;
        Numbers numbers{tet, tet + part_.tet_count() - 1};
        if (triangles > 0) numbers.add(triangle + triangles - 1);
        for (const GhostCell& cell : ghosts_.cells) numbers.add(cell.number);
        writer.begin("Elements");
        writer.extent(block_count(),
                      part_.mesh.tets.size() + static_cast<std::size_t>(triangles) + ghosts_.cells.size(), numbers);
        for (const PatchPiece& piece : pieces_.on_patches) writer.triangles(surface_of(piece), part_, piece, triangle);
        for (const BodyPiece& piece : bodies_) writer.tets(volume_of(piece), part_, piece.tets, tet);
        if (has_ghosts()) writer.tets(ghost_volume_, ghosts_.cells);
        writer.end("Elements");
    }

    void write_ghosts(Writer& writer) const {
        writer.begin("GhostElements");
        writer.size(static_cast<std::int64_t>(ghosts_.cells.size()));
        writer.end_row();
        for (const GhostCell& cell : ghosts_.cells) {
            writer.size(tag_of(cell.number));
            writer.number(cell.rank + 1);
            writer.size(1);
            writer.number(rank_ + 1);
            writer.end_row();
        }
        writer.end("GhostElements");
    }

    void write_values(Writer& writer) const {
        for (std::size_t k = 0; k < part_.values.size(); ++k) {
            const bool of_points = part_.values[k].of == PartValues::Of::points;
            ValueSection section(writer, part_.values[k], of_points ? part_.vertex_count() : part_.tet_count());
            write_rows_of_part(section, part_, k, outline_.first_tet(rank_), [](std::size_t) { return true; });
            section.end();
        }
    }

    Entity surface_of(const PatchPiece& piece) const { return tags_.surface_of_part(rank_, piece.patch); }
    Entity volume_of(const BodyPiece& piece) const { return tags_.volume_of_part(rank_, piece.body); }

    const MeshOutline& outline_;
    std::int32_t rank_;
    const Part& part_;
    Tags tags_;
    PatchPieces pieces_;
    std::vector<BodyPiece> bodies_;
    Ghosts ghosts_;
    Entity ghost_volume_;
};

// As Gmsh calls them: a mesh in one piece has no number.
std::string file_name(std::size_t parts, std::int32_t rank) {
    return parts == 1 ? "mesh.msh" : fmt::format("mesh_{}.msh", rank + 1);
}

void write_part(const PartSource& parts, std::int32_t rank, const Part& part, ExportFiles& files) {
    require_tags_fit(parts.outline());
    const PartFile content(parts, rank, part);
    content.write(
        Writer(files.create(file_name(parts.outline().parts.size(), rank)), "4.1", files.options().msh_ascii));
}

// ---- merged ----

// A volume of the merged mesh.
struct MergedVolume {
    Entity entity;
    std::int32_t physical;
    Eigen::AlignedBox3d box;
};

// What the entities of the whole mesh need to be known of before they are written.
struct Whole {
    std::vector<Eigen::AlignedBox3d> surfaces;  // by patch
    std::vector<MergedVolume> volumes;
    std::size_t blocks = 0;
};

Whole survey(const PartSource& parts, const Tags& tags) {
    Whole whole;
    whole.surfaces.resize(parts.outline().patch_names.size());
    for_each_whole_part(parts, [&](std::int32_t rank, const Part& part) {
        const PatchPieces pieces = patch_pieces(part);
        for (const PatchPiece& piece : pieces.on_patches)
            whole.surfaces[static_cast<std::size_t>(piece.patch)].extend(piece.box);
        whole.blocks += pieces.on_patches.size();
        for (const BodyPiece& piece : body_pieces(parts, rank, part, {})) {
            whole.volumes.push_back({tags.merged_volume(rank, piece.body), tags.physical_body(piece.body), piece.box});
            ++whole.blocks;
        }
    });
    return whole;
}

void write_merged_entities(Writer& writer, const Whole& whole) {
    const auto used = static_cast<std::size_t>(
        std::count_if(whole.surfaces.begin(), whole.surfaces.end(), [](const auto& box) { return !box.isEmpty(); }));
    writer.begin("Entities");
    writer.counts_of_entities(used, whole.volumes.size());
    for (std::size_t p = 0; p < whole.surfaces.size(); ++p) {
        const auto patch = static_cast<std::int32_t>(p);
        if (!whole.surfaces[p].isEmpty())
            writer.entity(Tags::surface(patch), whole.surfaces[p], Tags::physical_patch(patch));
    }
    for (const MergedVolume& volume : whole.volumes) writer.entity(volume.entity, volume.box, volume.physical);
    writer.end("Entities");
}

void write_merged_4_1(const PartSource& parts, const Tags& tags, ExportFiles& files, const std::string& name) {
    const MeshOutline& outline = parts.outline();
    const Whole whole = survey(parts, tags);
    Writer writer(files.create(name), "4.1", files.options().msh_ascii);
    write_names(writer.file(), tags, outline.patch_names);
    write_merged_entities(writer, whole);

    writer.begin("Nodes");
    writer.extent(whole.blocks, static_cast<std::size_t>(outline.vertices), {0, outline.vertices - 1});
    for_each_whole_part(parts, [&](std::int32_t rank, const Part& part) {
        const PatchPieces pieces = owned_patch_pieces(part);
        for (const PatchPiece& piece : pieces.on_patches)
            writer.nodes(Tags::surface(piece.patch), part, piece.vertices);
        for (const BodyPiece& piece : body_pieces(parts, rank, part, pieces.inside))
            writer.nodes(tags.merged_volume(rank, piece.body), part, piece.inside);
    });
    writer.end("Nodes");

    const std::int64_t elements = element_count(outline);
    writer.begin("Elements");
    writer.extent(whole.blocks, static_cast<std::size_t>(elements), {0, elements - 1});
    for_each_whole_part(parts, [&](std::int32_t rank, const Part& part) {
        for (const PatchPiece& piece : patch_pieces(part).on_patches)
            writer.triangles(Tags::surface(piece.patch), part, piece, first_triangle(outline, rank));
        for (const BodyPiece& piece : body_pieces(parts, rank, part, {}))
            writer.tets(tags.merged_volume(rank, piece.body), part, piece.tets, outline.first_tet(rank));
    });
    writer.end("Elements");
    write_merged_values(parts, writer);
    writer.file().close();
}

// ---- merged, 2.2 ----

// Every element has its physical group, its entity and its corners, all in 32 bits; elements of one type come together,
// behind what they have in common.
class Elements22 {
 public:
    Elements22(Writer& writer, std::int32_t type, std::int64_t count) : writer_(writer), type_(type) {
        if (!writer.is_ascii() && count > 0)
            writer.row(std::array<std::int32_t, 3>{type, static_cast<std::int32_t>(count), tags});
    }

    template <std::size_t n>
    void add(std::int64_t number, std::int32_t physical, const Entity& entity,
             const std::array<std::int64_t, n>& corners) {
        writer_.number(static_cast<std::int32_t>(tag_of(number)));
        if (writer_.is_ascii()) {
            writer_.number(type_);
            writer_.number(tags);
        }
        writer_.number(physical);
        writer_.number(entity.tag);
        for (const std::int64_t corner : corners) writer_.number(static_cast<std::int32_t>(tag_of(corner)));
        writer_.end_row();
    }

 private:
    static constexpr std::int32_t tags = 2;

    Writer& writer_;
    std::int32_t type_;
};

void write_triangles_2_2(Writer& writer, const Part& part, const PartExtent& extent, std::int64_t number) {
    Elements22 elements(writer, triangle_type, extent.patch_facets);
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        if (part.patch[f] >= 0)
            elements.add(number++, Tags::physical_patch(part.patch[f]), Tags::surface(part.patch[f]),
                         global_corners(part, part.facets[f]));
}

void write_merged_2_2(const PartSource& parts, const Tags& tags, ExportFiles& files, const std::string& name) {
    const MeshOutline& outline = parts.outline();
    if (std::max(outline.vertices, element_count(outline)) > most_int32)
        throw Error(ErrorCode::usage,
                    fmt::format("{} nodes and {} elements are more than the 32-bit numbers of MSH 2.2 can tell apart. "
                                "Take MSH 4.1, or the mesh in parts.",
                                outline.vertices, element_count(outline)));
    Writer writer(files.create(name), "2.2", files.options().msh_ascii);
    write_names(writer.file(), tags, outline.patch_names);

    writer.file().text(fmt::format("$Nodes\n{}\n", outline.vertices));
    for_each_vertex(parts, [&](std::int64_t first, std::span<const Vec3> points) {
        for (const Vec3& point : points) {
            writer.number(static_cast<std::int32_t>(tag_of(first++)));
            writer.point(point);
            writer.end_row();
        }
    });
    writer.end("Nodes");

    writer.file().text(fmt::format("$Elements\n{}\n", element_count(outline)));
    for_each_part(parts, [&](std::int32_t rank, const Part& part) {
        write_triangles_2_2(writer, part, outline.parts[static_cast<std::size_t>(rank)], first_triangle(outline, rank));
        Elements22 elements(writer, tet_type, part.tet_count());
        std::int64_t number = outline.first_tet(rank);
        const std::vector<std::int32_t> bodies = parts.bodies().of_tets(rank, part);
        for (std::size_t t = 0; t < bodies.size(); ++t)
            elements.add(number++, tags.physical_body(bodies[t]), tags.merged_volume(rank, bodies[t]),
                         global_corners(part, part.mesh.tets[t]));
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

}  // namespace msh

}  // namespace

extern const Format msh_format = {.name = "msh",
                                  .help = "Gmsh MSH: gmsh; merged also deal.II, DOLFINx, meshio",
                                  .ending = ".msh",
                                  .patch_words = msh::names_of_patches,
                                  .write_part = msh::write_part,
                                  .write_merged = msh::write_merged};

}  // namespace kerf
