// Writing to files that a user has named for a result.
#pragma once

#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "files/io/output_kind.h"

namespace kerf {

/// Returns the path behind all links that `path` ends with; the last link may lead to a file that does not exist yet.
std::string behind_links(const std::string& path);

/// Throws Error(io), naming both, if `output` is the file `input`, by whatever path or link: the input would be lost.
/// `option` names the output, as "--report". Either may be empty.
void refuse_to_overwrite(const std::string& input, const std::string& option, const std::string& output);

/// A file that a user has named, and the option that named it, as "--report". An empty path stands for no file.
struct NamedPath {
    std::string option, path;
    OutputKind kind = {};
};

/// Throws Error(usage), naming both, if two of the outputs are one file, by whatever paths or links: one of them would
/// be lost. Devices, pipes and descriptors take more than one.
void refuse_same_outputs(const std::vector<NamedPath>& outputs);

/// Tells whether the file is the folder or lies below it, by whatever links; false for an empty folder.
bool lies_inside(const std::string& file, const std::string& folder);

/// Throws Error(io), naming option, path and reason, if the file could not be written: its folder is missing, it is a
/// folder itself, or permissions forbid it; or if a file that is there is not of the kind and would be lost. An empty
/// file may always be replaced. Changes nothing. An empty path is good.
void require_writable(const std::string& option, const std::string& path, const OutputKind& kind);

/// Throws Error(usage), with the way out, for a folder to be made whose name looks like that of a file, as "part.stl":
/// it ends with a dot, a letter, and letters or digits, without a slash. A folder that exists may have any name.
/// `hint`: a sentence on files that may have been meant, with a blank before it.
void refuse_file_name(const std::string& option, const std::string& folder, const std::string& hint = "");

/// Opens a file to be written from its beginning. `fd:N`, /dev/stdout, /dev/stderr and /dev/fd/N are the process's own
/// descriptors: they are written to where they stand, and stay open. Returns null with errno if the file cannot be
/// opened; throws Error(io) for a pipe that nobody reads within 2 s.
std::FILE* open_output(const std::string& path);

/// Writes the file. An older file is replaced as a whole, and only when all bytes are written, so that a full disk
/// leaves the older one; where its folder allows no new file, it is written over. Links are followed; devices, pipes
/// and descriptors are written to. Throws Error(io) naming the file and the reason.
void write_output_file(const std::string& path, std::span<const char> bytes);

}  // namespace kerf
