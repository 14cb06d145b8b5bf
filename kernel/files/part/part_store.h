// The store in which parts travel from the worker that has made them to the writers of all formats: compact files of
// this program.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/core/hash.h"
#include "files/part/part.h"

namespace kerf {

/// Writes a part without the global numbers of its interior vertices, which depend on the other parts, and without
/// nodes on edges (files/part/curved_nodes_file.h): 24 bytes a vertex and 16 a tetrahedron. Returns the hash of the
/// bytes, which depend on the part alone. A `durable` file outlives a power cut after the return. Throws Error(io).
FileHash write_stored_part(const std::string& path, const Part& part, bool durable = true);

/// Reads this content of a part, whose interior vertices are numbered from `first_interior_id` on. Throws Error(io) if
/// the file cannot be read, is no such file, or not whole; its numbers are in range when it returns. `hash`, unless
/// null, receives the hash of the file if PartContent::all is read.
Part read_stored_part(const std::string& path, std::int64_t first_interior_id, PartContent content = PartContent::all,
                      FileHash* hash = nullptr);

/// Takes a part a piece at a time, for results that are made without the whole part beside them. Every call has the
/// part with its global numbers, but without points and cells: these come in order, behind each other.
struct PartPieces {
    std::function<void(const Part& part)> boundary;  ///< first, once
    std::function<void(const Part& part, std::size_t first, std::span<const Vec3> points)> points;
    std::function<void(const Part& part, std::size_t first, std::span<const Tetrahedron> tets)> cells;
};

/// The stored parts of one mesh, of which the outline is known.
class StoredParts : public PartSource {
 public:
    struct Place {
        std::string path;
        std::int64_t first_interior_id = 0;
        FileHash hash = {0, 0};
    };
    StoredParts(MeshOutline outline, const std::vector<Place>& places)
        : outline_(std::move(outline)), places_(places.begin(), places.end()) {}

    const MeshOutline& outline() const override { return outline_; }
    /// Throws Error(io) naming the way out if the file is not as it was written.
    Part load(PartIndex index) const override;
    /// Loads this content; only the whole part is compared with the hash of its file.
    Part load_only(PartIndex index, PartContent content) const override;
    /// Hands out the part as load() has it, in pieces of at most 2 MB. Throws as load(), also after the last piece if
    /// only then the file turns out not to be as it was written; numbers are in range before.
    void load_in_pieces(PartIndex index, const PartPieces& take) const;
    /// Removes the file of a part that is not needed any more from the disk. Throws Error(io).
    void remove(PartIndex index) const;

 private:
    MeshOutline outline_;
    Array<PartIndex, Place> places_;
};

}  // namespace kerf
