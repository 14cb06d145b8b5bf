// One part of a finished run, checked from its files alone.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "files/part/run_parts.h"
#include "run/prepare/oriented_triangle.h"
#include "run/report/report.h"
#include "run/run/inside/edge_node_check.h"
#include "run/run/inside/input_pieces.h"
#include "run/work/mesh_hash.h"

namespace kerf {

/// A vertex on the boundary of a part.
struct PlacedVertex {
    std::int64_t id;  ///< global number
    Vec3 point;
};

/// A triangle on an interface, as one of its two parts has it.
struct InterfaceFacet {
    NamedTriangle vertices;  ///< oriented as in the part with the smaller number
    NodeId part, neighbour;
};

/// The findings about one part: its own defects, and all that has to be compared with other parts or the input.
struct PartFindings {
    std::string file;                           ///< path in the folder
    bool is_whole = true;                       ///< false: the part is of order 2, and its nodes on edges are unknown
    std::vector<std::string> differences = {};  ///< sentences for FolderVerification::differences
    RunVerification laws = {};                  ///< counts of laws that a single part can break
    std::int64_t tets = 0;
    double volume = 0;
    PartHash hash = {};
    NameTable patch_names = {}, region_names = {};
    std::vector<PlacedVertex> boundary = {};
    std::vector<InputPiece> pieces = {};
    std::vector<InterfaceFacet> interfaces = {};
    /// Ranges of global numbers of the vertices inside, as first number and count; empty if the file leaves numbers to
    /// its reader.
    std::vector<std::array<std::int64_t, 2>> interior = {};
    /// Number of the vertices inside, if the file leaves their numbers to its reader; else 0.
    std::int64_t unnumbered_interior = 0;
    EdgeNodeCheck edge_nodes = {};  ///< nodes of a part of order 2
};

/// Checks parts one by one, each by verify_mesh(). From any thread.
class PartFilesCheck {
 public:
    /// Takes the folder of a run. `order`: of the run's cells; `is_of_this_version`: whether this version of Kerf wrote
    /// it, else headers may differ; `file_hashes`: hashes of the files as they are now, by path; `stored`: for runs of
    /// order 2 without VTU files, the parts with their nodes on edges; null for other runs, and where they cannot be
    /// read. All references must outlive the check.
    PartFilesCheck(const std::string& folder, int order, bool is_of_this_version,
                   const std::map<std::string, std::string>& file_hashes, const RunParts* stored)
        : folder_(folder),
          order_(order),
          is_of_this_version_(is_of_this_version),
          file_hashes_(file_hashes),
          stored_(stored) {}

    /// Checks one part. `of_report`: its row of report.json. Throws Error(io) for a missing or unreadable part.
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
