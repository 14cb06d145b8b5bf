// The command line of kerf-view, to which `kerf view` and `kerf screenshot` pass theirs on.
#pragma once

#include <string>
#include <vector>

#include "viewer/app/app.h"
#include "viewer/render/offscreen.h"

namespace kerf::view {

/// The picture that `kerf screenshot` draws.
struct PictureOptions {
    std::string output;                       ///< PNG file
    int width = 1280, height = 800;           ///< size in pixels
    float scale = 1;                          ///< scale of fonts and lines, 2 on a HiDPI screen
    int antialias = 1;                        ///< the picture is drawn so many times as large and averaged
    std::optional<OffscreenLibrary> context;  ///< library that draws it; none: the default
    bool panels = false;                      ///< it has the whole user interface
    int frames = 0;                           ///< number of pictures of a period of the motion; 0: one picture
    double timeout_seconds = 600;

    /// Returns the pictures to be written: `output`, or FILE_001.png, FILE_002.png, ...
    std::vector<std::string> files() const;
};

/// All that the command line asks for.
struct ViewCommand {
    bool screenshot = false;
    std::string input;  ///< the file or folder to open; empty: none
    PictureOptions picture;
    bool auto_run = true;  ///< a surface is cut and meshed once it is open
    ViewState state;
    ChosenView chosen;              ///< the parts of the state that were asked for
    ViewOrigin origin;              ///< origin of the state, if it was read from a file
    std::optional<Theme> theme;     ///< the theme, if one was asked for
    std::string clip;               ///< the clip plane as given: "x=0.3", "-z=0.5", "node=5", "1,1,0=0.4"
    std::string load_case;          ///< name of the load case; empty: the first one
    bool good_deformation = false;  ///< Deformation::factor is to be that of good_deformation()
    RunRequest run;
    std::string print;  ///< text to print instead (help, a usage error); empty: none
    int exit_code = 0;  ///< exit code after `print`

    std::vector<std::string> files() const { return files_of(input, run.input_options); }
};

/// Parses the command line. Never throws: an error becomes `print` and its exit code, 2 for a wrong usage.
ViewCommand parse_view_command(int argc, const char* const* argv);

/// Returns whether the command asks for anything that needs the document: a clip plane at a cut, a case, a good
/// deformation, several pictures, a camera that fits its body.
bool depends_on_document(const ViewCommand& command);
/// Sets these in `state`. `aspect`: width over height of the scene. Throws Error(usage) for a node without a cut, or a
/// case that the document does not have.
void apply_document(const ViewCommand& command, const Document& document, double aspect, ViewState& state);

/// Returns `before` with the plane that a text names; "node=N" needs the tree of the document. Throws Error(usage).
Clip clip_from_text(const std::string& text, const Clip& before, const Document& document);

}  // namespace kerf::view
