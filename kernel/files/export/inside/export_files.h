// The files of an export: where they are written, and a list of those that are.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/types.h"
#include "files/export/patch_types.h"
#include "files/io/checked_file.h"
#include "files/io/run_manifest.h"
#include "files/part/cell_fields.h"

namespace kerf {

/// Options of single formats. Each format takes those that concern it.
struct FormatOptions {
    CellFieldSet fields = default_cell_fields;  ///< fields of cells in files of vtu
    bool msh_ascii = false;                     ///< msh as text
    std::vector<PatchType> patch_types = {};    ///< types in openfoam; other patches are of the type `patch`
    bool split_regions = false;                 ///< openfoam: one mesh for each region
};

class ExportFiles;
class GhostFinder;

/// A new file that is written from its beginning to its end, through a buffer of its own. Throws Error(io).
class ExportFile {
 public:
    ExportFile(ExportFile&&) = default;

    void write(const void* data, std::size_t size);
    void write(std::string_view text) { write(text.data(), text.size()); }
    template <class T>
    void values(std::span<const T> values) {
        write(values.data(), values.size_bytes());
    }
    template <class T>
    void value(const T& value) {
        write(&value, sizeof value);
    }
    /// Writes a number as decimal text; a double with as few digits as give it back exactly.
    void number(std::int64_t number);
    void number(double number);
    /// Writes x y z as text, with a space between.
    void point(const Vec3& p);

    /// Ends the file and lists it. Buffered bytes may meet a full disk only here.
    void close();

 private:
    friend class ExportFiles;
    ExportFile(ExportFiles& files, std::string name, const std::string& path);
    char* room(std::size_t size);
    void flush();

    ExportFiles* files_;
    std::string name_;
    std::unique_ptr<CheckedFile> file_;
    std::unique_ptr<Hasher> hasher_;
    std::vector<char> buffer_;
    std::size_t used_ = 0;
    std::int64_t written_ = 0;
};

/// The files of one export, below a folder. May be used by several threads.
class ExportFiles {
 public:
    /// Takes the folder, and the `place` to which the files are moved when all are complete; empty: they stay in
    /// `folder`. `own`: names of files at the place that an earlier export has written.
    explicit ExportFiles(std::string folder, std::string place = "", std::set<std::string> own = {},
                         FormatOptions options = {})
        : folder_(std::move(folder)),
          place_(place.empty() ? folder_ : std::move(place)),
          own_(std::move(own)),
          options_(std::move(options)) {}

    const std::string& folder() const { return folder_; }
    const std::string& place() const { return place_; }
    const FormatOptions& options() const { return options_; }
    /// Tells whether a file or folder of this name lies at the place to which no earlier export has written.
    bool is_of_others(const std::string& name) const;
    /// Makes a file of this name below the folder, and folders for a name with '/' in it. An older file is replaced.
    ExportFile create(const std::string& name);
    /// Returns the path of a file and makes its folders: for files that are not written from beginning to end.
    std::string path_of(const std::string& name);
    /// Lists a file from path_of() without its size and hash (-1 and empty), because others may still be writing it.
    void add(const std::string& name);
    /// Lists a file with its size and hash.
    void add(RunFile file);

    /// Returns the files that were listed, ascending by path, each once.
    std::vector<RunFile> list() const;

    /// Returns the finder of the cells around parts (files/export/inside/ghosts.h), one for all parts of an export.
    GhostFinder& ghosts();

 private:
    std::string folder_, place_;
    std::set<std::string> own_;
    FormatOptions options_;
    mutable std::mutex mutex_;
    std::vector<RunFile> files_;
    std::shared_ptr<GhostFinder> ghosts_;  // null until ghosts() is called
};

}  // namespace kerf
