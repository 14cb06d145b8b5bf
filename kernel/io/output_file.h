// Files that a user has named for a result.
#pragma once

#include <span>
#include <string>

namespace kerf {

/// Throws Error(io), naming both, if `output` is the file `input`, by whatever path or link: the input would be lost.
/// `option` names the output, as "--report". Either may be empty.
void refuse_to_overwrite(const std::string& input, const std::string& option, const std::string& output);

/// Throws Error(io), naming option, path and reason, if the file could not be written: its folder is missing, it is a
/// folder itself, or permissions forbid it. Changes nothing. An empty path is good.
void require_writable(const std::string& option, const std::string& path);

/// Writes the file. One that exists is replaced as a whole, and only when all bytes are written, so that a full disk
/// leaves the older one. Links are followed; devices and pipes are written to. Throws Error(io) naming the file and the
/// reason.
void write_output_file(const std::string& path, std::span<const char> bytes);

}  // namespace kerf
