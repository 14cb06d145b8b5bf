// Commands that are programs of their own beside kerf, which links none of their libraries.
#pragma once

#include <string>
#include <vector>

namespace kerf {

struct OtherProgram {
    const char* command;  ///< command of kerf
    const char* program;  ///< program that lies beside kerf
    const char* help;     ///< text for the list of commands
    const char* advice;   ///< advice where the program is missing: the way to build it, and a way without it
};

/// Returns the program of a command; null if the command is kerf's own.
const OtherProgram* find_other_program(const std::string& command);

/// Returns the output of all programs that are installed, run with these arguments, each once.
std::string output_of_other_programs(const std::vector<std::string>& arguments);

/// Replaces this program by another one, with the same arguments. Throws Error(usage), saying how to build it, if it is
/// not installed. `argv` ends with a null pointer.
[[noreturn]] void become(const OtherProgram& other, char** argv);

inline constexpr const char* viewer_advice =
    "The viewer is a program of its own beside kerf; build it with KERF_VIEWER=ON, which needs libglfw3-dev, "
    "libimgui-dev, libfontconfig-dev, and libosmesa6-dev or libegl-dev, or open the run folder's mesh.pvtu in "
    "ParaView.";
inline constexpr OtherProgram other_programs[] = {
    {"solve", "kerf-solve", "Linear elasticity on a surface or a finished run: displacements and stresses.",
     "The solver is a program of its own beside kerf; build it with KERF_SOLVE=ON, which needs libpetsc-real-dev, or "
     "export the mesh: kerf export --format abaqus for CalculiX."},
    {"view", "kerf-view", "Open the viewer: every cut step by step, every cell.", viewer_advice},
    {"screenshot", "kerf-view", "The same as a picture, without a display.", viewer_advice}};

}  // namespace kerf
