// The bytes of a file.
#pragma once

#include <cstddef>
#include <fstream>
#include <span>
#include <string>

namespace kerf {

/// Reads a file from front to back. Throws Error(io) naming the file and the system's reason if it cannot be opened or
/// read, and refuses `-`, folders and everything else that has no size.
class FileReader {
 public:
    explicit FileReader(const std::string& path);
    /// The number of bytes when the file was opened.
    std::size_t size() const { return size_; }
    /// Fills `bytes` with the next bytes of the file; throws Error(io) if they are fewer.
    void read(std::span<char> bytes);

 private:
    const std::string& path_;
    std::ifstream file_;
    std::size_t size_ = 0;
};

/// Returns the whole content. Throws as FileReader.
std::string read_file(const std::string& path);

}  // namespace kerf
