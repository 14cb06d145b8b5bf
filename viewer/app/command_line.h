// The command line of kerf-view: `kerf view` and `kerf screenshot` pass theirs on to it.
#pragma once

#include <string>
#include <vector>

#include "viewer/app/app.h"
#include "viewer/render/offscreen.h"

namespace kerf::view {

struct ViewCommand {
    bool screenshot = false;
    std::string input;                        ///< to open; empty: nothing
    std::string output;                       ///< PNG of a screenshot
    int width = 1280, height = 800;           ///< of a screenshot
    float scale = 1;                          ///< of fonts and lines, 2 on a HiDPI screen
    int antialias = 1;                        ///< the picture is drawn so many times as large and averaged
    std::optional<OffscreenLibrary> context;  ///< of a screenshot; none: the default
    bool panels = false;                      ///< the whole user interface in the screenshot
    bool auto_run = true;                     ///< a surface is cut and meshed once it is open
    ViewState state;
    ChosenView chosen;              ///< what of the state was asked for
    ViewOrigin origin;              ///< of the state, if it was read from a file
    std::optional<Theme> theme;     ///< if one was asked for
    std::string clip;               ///< as given: "x=0.3", "-z=0.5", "node=5", "1,1,0=0.4"
    std::string load_case;          ///< name; empty: the first one
    bool good_deformation = false;  ///< deform is what good_deformation() says
    int frames = 0;                 ///< pictures of a period of the motion; 0: one picture
    double timeout_seconds = 600;
    RunOptions run;
    std::string print;  ///< text to print instead (help, a usage error); empty: none
    int exit_code = 0;  ///< of that

    /// That are written: `output`, or FILE_001.png, FILE_002.png, ...
    std::vector<std::string> pictures() const;
    std::vector<std::string> files() const { return files_of(input, run.input_options); }
};

/// Never throws: what is wrong becomes `print` and exit code 2.
ViewCommand parse_view_command(int argc, const char* const* argv);

/// Whether the command asks for anything that only the document can tell: a clip plane at a cut, a case, a good
/// deformation, a camera that fits its body.
bool depends_on_document(const ViewCommand& command);
/// Sets that. `aspect`: width over height of the scene. Throws Error(usage) for what the document does not have.
void apply_document(const ViewCommand& command, const Document& document, double aspect, ViewState& state);

/// The clip plane that a text names; "node=N" needs the tree of the document. Throws Error(usage).
Clip clip_from_text(const std::string& text, const Clip& before, const Document& document);

}  // namespace kerf::view
