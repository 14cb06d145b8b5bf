// Small files that are there as a whole or not at all, whatever ends the process or the machine.
#pragma once

#include <span>
#include <string>

namespace kerf {

/// Writes the file beside its place, waits until the disk has it, and moves it there: a power cut leaves the older
/// file or the new one. Throws Error(io) naming the file and the reason.
void write_durable_file(const std::string& path, std::span<const char> bytes);

/// Waits until the disk has the entries of the folder. Throws Error(io).
void sync_folder(const std::string& path);

/// Waits until the disk has all data that were written to the file system of the folder. Throws Error(io).
void sync_file_system(const std::string& folder);

}  // namespace kerf
