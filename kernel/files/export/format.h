// The formats that solvers read: one file of this folder and one line in formats.cpp each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/export/inside/export_files.h"
#include "files/io/output_kind.h"
#include "files/part/part.h"

namespace kerf {

struct MergeOptions {
    std::string msh_version = "4.1";  ///< version of Gmsh's format: 4.1 or 2.2
};

/// A format, as functions that write it, which are null where it has no such files. The bytes that they write depend on
/// the parts alone. They throw Error(io) if a file cannot be written, and Error(usage), before the first byte, for a
/// mesh that the format cannot hold.
struct Format {
    const char* name;                    ///< word for --format
    const char* help;                    ///< a few words on its kind and its readers
    const char* ending;                  ///< ending of merged files, with its dot; null: there are none
    OutputKind kind = {};                ///< kind of merged files, the named one and those beside it
    bool needs_face_neighbours = false;  ///< write_part() gets a part with neighbours of cells
    bool asks_for_one_part = false;      ///< write_part() loads no other part, write_whole() none
    int highest_order = 2;               ///< highest order of cells that it can hold
    bool has_values = false;             ///< the files have the values of a solution, too
    /// Returns the words for patches of these names in the files; null: patches have their names there, or numbers.
    std::vector<std::string> (*patch_words)(const std::vector<std::string>& names) = nullptr;

    /// Writes the files that belong to no part, or are written by several: called once, before any part.
    void (*write_whole)(const PartSource& parts, ExportFiles& files) = nullptr;
    /// Writes the files of one part. Several parts may be written at once, by threads and processes that share a disk.
    void (*write_part)(const PartSource& parts, PartIndex index, const Part& part, ExportFiles& files) = nullptr;
    /// Writes all parts as one mesh, a part at a time, in the file `stem` + ending, or in several that begin with the
    /// stem.
    void (*write_merged)(const PartSource& parts, const MergeOptions& options, ExportFiles& files,
                         const std::string& stem) = nullptr;

    /// Tells whether the format is read in one piece: it is written as "mesh" and its ending.
    bool is_merged_only() const { return !write_part && !write_whole; }
};

/// Returns all formats, in the order of the help.
std::span<const Format* const> formats();
/// Finds a format by its name. Throws Error(usage) with the names that there are.
const Format& find_format(std::string_view name);
/// Returns the formats of a list "vtu,msh", each once, in the order of formats(). Throws Error(usage), also for an
/// empty list.
std::vector<const Format*> parse_formats(std::string_view list);

/// Throws Error(usage), naming formats that can, if this one cannot hold cells of this order.
void require_order(const Format& format, int order);

/// Returns a sentence on the values of a solution that files of the format leave out; empty: there are none.
std::string tell_values_left_out(const Format& format, const MeshOutline& outline);

/// Writes all parts in the format, one after the other; a run does the same with many processes at once.
void write_format(const Format& format, const PartSource& parts, ExportFiles& files);

}  // namespace kerf
