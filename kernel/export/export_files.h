// Where an export goes, and what it has written.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"
#include "export/patch_types.h"
#include "io/checked_file.h"
#include "io/run_manifest.h"
#include "part/cell_fields.h"

namespace kerf {

/// What formats are asked for beside the mesh. Each looks for what concerns it.
struct FormatOptions {
    CellFieldSet fields = default_cell_fields;  ///< what vtu says of cells
    bool msh_ascii = false;                     ///< msh as text
    std::vector<PatchType> patch_types = {};    ///< of openfoam; other patches are of the type `patch`
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
    /// Decimal; a double with as few digits as give it back exactly.
    void number(std::int64_t number);
    void number(double number);
    /// x y z with a space between.
    void point(const Vec3& p);

    /// The file is complete, and listed. Buffered bytes may meet a full disk only here.
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
    /// `place`: the folder to which the files are moved when all are complete; `folder` itself if empty. `own`: names
    /// of files there that an earlier export has written.
    explicit ExportFiles(std::string folder, std::string place = "", std::set<std::string> own = {},
                         FormatOptions options = {})
        : folder_(std::move(folder)),
          place_(place.empty() ? folder_ : std::move(place)),
          own_(std::move(own)),
          options_(std::move(options)) {}

    const std::string& folder() const { return folder_; }
    const std::string& place() const { return place_; }
    const FormatOptions& options() const { return options_; }
    /// Whether a file of this name lies at the place, or a folder, in which nothing was written by an earlier export.
    bool is_of_others(const std::string& name) const;
    /// A file of this name below the folder, which may have '/' in it: folders are made. What was there is replaced.
    ExportFile create(const std::string& name);
    /// Its path, with the folders made: for files that are not written from beginning to end.
    std::string path_of(const std::string& name);
    /// Lists such a file: without its size and hash (-1 and empty), because others may still be writing it.
    void add(const std::string& name);
    /// Lists a file of which everything is known.
    void add(RunFile file);

    /// What was written, ascending by path, each file once.
    std::vector<RunFile> list() const;

    /// What all parts of one export ask for the cells around them (export/ghosts.h).
    GhostFinder& ghosts();

 private:
    std::string folder_, place_;
    std::set<std::string> own_;
    FormatOptions options_;
    mutable std::mutex mutex_;
    std::vector<RunFile> files_;
    std::shared_ptr<GhostFinder> ghosts_;  // once it is asked for
};

}  // namespace kerf
