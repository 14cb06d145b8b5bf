// One part of a finished run, checked from its files alone.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "part/run_parts.h"
#include "prepare/oriented_triangle.h"
#include "report/report.h"
#include "run/edge_node_check.h"
#include "run/input_pieces.h"
#include "work/mesh_hash.h"

namespace kerf {

/// A vertex on the boundary of a part.
struct PlacedVertex {
    std::int64_t id;  ///< global number
    Vec3 point;
};

/// A triangle on an interface, as one part has it.
struct InterfaceFacet {
    NamedTriangle vertices;  ///< oriented as in the part with the smaller number
    std::int32_t part, neighbour;
};

/// What a part tells of itself, and what has to be compared with others.
struct PartFindings {
    std::string file;                           ///< path in the folder
    bool is_whole = true;                       ///< false: of order 2, and nobody knows its nodes on edges
    std::vector<std::string> differences = {};  ///< as FolderVerification::differences
    RunVerification laws = {};                  ///< the counts that a part alone can break
    std::int64_t tets = 0;
    double volume = 0;
    PartHash hash = {};
    NameTable patch_names = {}, region_names = {};
    std::vector<PlacedVertex> boundary = {};
    std::vector<InputPiece> pieces = {};
    std::vector<InterfaceFacet> interfaces = {};
    std::vector<std::array<std::int64_t, 2>> interior = {};  ///< first number and how many, if files have numbers
    std::int64_t unnumbered_interior = 0;                    ///< vertices of files that leave that to who reads them
    EdgeNodeCheck edge_nodes = {};                           ///< of order 2
};

/// Checks parts by themselves, each by verify_mesh(). From any thread.
class PartFilesCheck {
 public:
    /// `order` of the run; `is_of_this_version`: else headers may be others; `file_hashes`: of the files by their
    /// paths, as they are now; `stored`: of order 2 without VTU files, the parts with their nodes on edges, else null,
    /// and where they cannot be read. All of them must outlive the check.
    PartFilesCheck(const std::string& folder, int order, bool is_of_this_version,
                   const std::map<std::string, std::string>& file_hashes, const RunParts* stored)
        : folder_(folder),
          order_(order),
          is_of_this_version_(is_of_this_version),
          file_hashes_(file_hashes),
          stored_(stored) {}

    /// `of_report`: the part's row of report.json. Throws Error(io) for a missing or unreadable part.
    PartFindings operator()(const nlohmann::json& of_report) const;

 private:
    void check_what_follows(const Part& part, PartFindings& found) const;
    std::string hash_of_file(const std::string& path) const;

    const std::string& folder_;
    int order_;
    bool is_of_this_version_;
    const std::map<std::string, std::string>& file_hashes_;
    const RunParts* stored_;
};

}  // namespace kerf
