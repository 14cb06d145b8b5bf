// How parts travel from the worker that has made them to the writers of all formats: compact files of this program.
#pragma once

#include <string>
#include <vector>

#include "core/hash.h"
#include "part/part.h"

namespace kerf {

/// Writes a part but for the global numbers of its interior vertices, which depend on the other parts: 24 bytes a
/// vertex and 16 a tetrahedron. Returns the hash of the bytes, which depend on the part alone. The file outlives a
/// power cut after the return. Throws Error(io).
FileHash write_stored_part(const std::string& path, const Part& part);

/// What is asked for of the part, its interior vertices numbered from `first_interior_id` on. Throws Error(io) if the
/// file cannot be read, is no such file, or not whole; its numbers are in range when it returns. `hash`, unless null,
/// receives that of the file of which PartContent::all was read.
Part read_stored_part(const std::string& path, std::int64_t first_interior_id, PartContent content = PartContent::all,
                      FileHash* hash = nullptr);

/// Stored parts of one mesh, of which the outline is known.
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
    /// Only the whole part is compared with what was written.
    Part load_only(PartIndex index, PartContent content) const override;
    /// Takes the file of a part that is not needed any more from the disk. Throws Error(io).
    void remove(PartIndex index) const;

 private:
    MeshOutline outline_;
    Array<PartIndex, Place> places_;
};

}  // namespace kerf
