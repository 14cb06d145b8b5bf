#include "solve/case/inside/petsc_options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace kerf {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Returns whether options may have the character: no quotes, which would hide blanks, and nothing of which PETSc makes
// the name of a file.
bool is_plain(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view(" -+.,_").find(c) != std::string_view::npos;
}

bool is_name(const std::string& word) { return word.size() > 1 && word[0] == '-' && is_letter(word[1]); }

bool is_of_solver(const std::string& name) {
    constexpr std::array<std::string_view, 4> objects = {"ksp_", "pc_", "eps_", "st_"};
    return std::any_of(objects.begin(), objects.end(), [&](std::string_view object) {
        return name.compare(1, object.size(), object) == 0 || name.find("_" + std::string(object)) != name.npos;
    });
}

// Returns whether a value leads out of the terminal: viewers that write into files whose names are their own, or open
// windows, and code in another language.
bool is_outside(const std::string& value) {
    constexpr std::array<std::string_view, 14> words = {"socket",      "binary", "string", "draw",    "vu",
                                                        "mathematica", "hdf5",   "vtk",    "matlab",  "saws",
                                                        "glvis",       "adios",  "python", "exodusii"};
    return std::find(words.begin(), words.end(), value) != words.end();
}

}  // namespace

std::string why_not_in_case(const std::string& options) {
    if (!std::all_of(options.begin(), options.end(), is_plain))
        return fmt::format(
            "petsc is '{}', but a case names no files: its options are of letters, digits, blanks and "
            "- + . , _ alone.",
            options);
    std::istringstream words(options);
    for (std::string word; words >> word;)
        if (is_name(word) ? !is_of_solver(word) : is_outside(word))
            return fmt::format(
                "petsc has '{}', which is no option of the solver, as those of -ksp_, -pc_, -eps_ and "
                "-st_ are that write no files.",
                word);
    return "";
}

}  // namespace kerf
