// The formats that solvers read: one file of this folder and one line in formats.cpp each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "export/export_files.h"
#include "io/output_kind.h"
#include "part/part.h"

namespace kerf {

struct MergeOptions {
    std::string msh_version = "4.1";  ///< of Gmsh: 4.1 or 2.2
};

/// How one format is written. Functions are null where a format has no such files. What they write depends on the parts
/// alone. They throw Error(io) if a file cannot be written, and Error(usage), before the first byte, for a mesh that
/// the format cannot hold.
struct Format {
    const char* name;                    ///< of --format
    const char* help;                    ///< what it is and who reads it, a few words
    const char* ending;                  ///< of merged files, with its dot; null: there are none
    OutputKind kind = {};                ///< of merged files, all that there are beside the named one, too
    bool needs_face_neighbours = false;  ///< write_part() gets a part with them
    bool asks_for_one_part = false;      ///< write_part() loads no other one, nor does write_whole() any
    int highest_order = 2;               ///< of the cells that it can hold
    /// What patches with these names are called in the files; null: by their names, or by numbers.
    std::vector<std::string> (*patch_words)(const std::vector<std::string>& names) = nullptr;

    /// The files that belong to no part, or are written by several: called once, before any part.
    void (*write_whole)(const PartSource& parts, ExportFiles& files) = nullptr;
    /// The files of one part. Several parts may be written at once, by threads and processes that share a disk.
    void (*write_part)(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) = nullptr;
    /// All parts as one mesh, a part at a time, in the file `stem` + ending, or in several that begin with the stem.
    void (*write_merged)(const PartSource& parts, const MergeOptions& options, ExportFiles& files,
                         const std::string& stem) = nullptr;

    /// Formats that are read in one piece are written as "mesh" and their ending.
    bool is_merged_only() const { return !write_part && !write_whole; }
};

/// All of them, in the order of the help.
std::span<const Format* const> formats();
/// Finds one by its name. Throws Error(usage) with the names that there are.
const Format& find_format(std::string_view name);
/// The formats of a list "vtu,msh", each once, in the order of formats(). Throws Error(usage), also for an empty list.
std::vector<const Format*> parse_formats(std::string_view list);

/// Throws Error(usage), with the formats that can, where the format cannot hold cells of this order.
void require_order(const Format& format, int order);

/// Writes all parts in the format, one after the other: what a run does with many processes at once.
void write_format(const Format& format, const PartSource& parts, ExportFiles& files);

}  // namespace kerf
