// The commands of kerf that save what is open, as lists of arguments and as text to be copied.
#pragma once

#include <string>
#include <vector>

#include "files/export/format.h"
#include "viewer/model/document.h"

namespace kerf::view {

/// The file or folder that somebody wants to save a mesh to.
struct MeshFile {
    const Format* format = nullptr;
    std::string path;  ///< a file, or a folder where the format has no file of the whole mesh
    int order = 0;     ///< order of the cells: 1 or 2; 0: that of the run
};

/// Returns whether a finished run with cells is open.
bool has_mesh(const Document& document);
/// Returns the folder that commands take for the open run: that of its solution, where one is open, else its own, and
/// where that is a temporary one that was saved, the place where it was saved to.
std::string folder_of(const Document& document);

/// Returns a path for a folder of the run that nothing has yet, NAME_run, NAME_run_2 and so on, in the folder where the
/// program was started. Its trace, beside it, would replace nothing either.
std::string unused_run_folder(const Document& document);

/// Returns the path with the ending of the format, or with none where the format has folders alone.
std::string with_ending(const std::string& path, const Format& format);

/// Return the arguments of kerf that write a mesh, a page or a run.
std::vector<std::string> arguments_of_mesh(const std::string& folder, const MeshFile& file);
std::vector<std::string> arguments_of_page(const std::string& folder, const std::string& path);
std::vector<std::string> arguments_of_run(const Document& document, const std::string& folder);
/// Returns the arguments that repair the open surface as it was repaired here, and write it.
std::vector<std::string> arguments_of_surface(const Document& document, const std::string& path);

/// Returns "kerf merge out --output=out.msh", as a shell takes it.
std::string command_text(const std::vector<std::string>& arguments);

}  // namespace kerf::view
