// CAD files are read by kerf-cad, a program of its own: OpenCASCADE takes longer to load than a small mesh takes, may
// crash, and need not be there. Both are processes of one build: options travel as arguments of the command line, in
// the order and spelling of arguments(), and the answer as bytes behind a magic text with the version. The fields
// behind it have no names, so that bytes of another version are refused as a whole. The format of a CAD file is told by
// its first bytes.
#include "files/io/cad_body.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

// The beginning of an answer. It has the version, since the fields behind it have no names.
constexpr std::string_view cad_magic = "kerf-cad " KERF_VERSION "\n";

// Returns false if the text is no such number.
template <class Number>
bool parse_number(const std::string& text, Number& number) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

bool parse_unit(const std::string& text, LengthUnit& unit) {
    const std::vector<std::string>& names = length_unit_names();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return false;
    unit = static_cast<LengthUnit>(found - names.begin());
    return true;
}

bool set_cad_option(CadOptions& options, const std::string& name, const std::string& text) {
    if (name == "--solid") return parse_number(text, options.solid) && options.solid >= 0;
    if (name == "--unit") return parse_unit(text, options.unit);
    if (name == "--deflection")
        return parse_number(text, options.deflection) && options.deflection >= 0 && options.deflection < 1;
    return false;
}

// Returns null if the argument is not this option.
bool* flag_of(CadOptions& options, const std::string& name) {
    if (name == "--unite") return &options.unite;
    if (name == "--no-imprint") return &options.no_imprint;
    if (name == "--on-faces") return &options.on_faces;
    if (name == "--as-it-is") return &options.as_it_is;
    return nullptr;
}

bool is_iges(std::string_view content) {
    constexpr std::size_t section_column = 72, line_length = 80;
    if (content.size() < line_length || content[section_column] != 'S') return false;
    const std::string_view number = content.substr(section_column + 1, line_length - section_column - 1);
    return number.find_first_not_of(" 0123456789") == number.npos;
}

}  // namespace

const std::vector<std::string>& length_unit_names() {
    static const std::vector<std::string> names = {"mm", "cm", "m", "inch", "ft"};
    return names;
}

double millimetres_of(LengthUnit unit) {
    constexpr std::array<double, 5> millimetres = {1, 10, 1000, 25.4, 304.8};
    return millimetres[static_cast<std::size_t>(unit)];
}

std::vector<std::string> CadOptions::arguments() const {
    std::vector<std::string> arguments = {"--solid",      fmt::format("{}", solid),
                                          "--unit",       length_unit_names()[static_cast<std::size_t>(unit)],
                                          "--deflection", fmt::format("{}", deflection)};
    if (unite) arguments.emplace_back("--unite");
    if (no_imprint) arguments.emplace_back("--no-imprint");
    if (on_faces) arguments.emplace_back("--on-faces");
    if (as_it_is) arguments.emplace_back("--as-it-is");
    return arguments;
}

CadOptions CadOptions::from_arguments(std::span<const std::string> arguments) {
    CadOptions options;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (bool* flag = flag_of(options, arguments[i])) {
            *flag = true;
            continue;
        }
        const std::string value = i + 1 < arguments.size() ? arguments[i + 1] : "";
        if (!set_cad_option(options, arguments[i], value))
            throw Error(ErrorCode::usage,
                        fmt::format("'{} {}' is no option. There are --solid N (0: all), --unite, --no-imprint, "
                                    "--on-faces, --as-it-is, --unit {} and --deflection D (below 1; 0: by volume).",
                                    arguments[i], value, fmt::join(length_unit_names(), "|")));
        ++i;
    }
    return options;
}

std::string to_text(const PatchFace& face) {
    std::string text = face.kind;
    if (face.radius > 0) text += fmt::format(" r = {:.6g}", face.radius);
    if (face.tube > 0) text += fmt::format(", {:.6g}", face.tube);
    return text;
}

Bytes to_cad_bytes(const CadAnswer& answer) {
    Bytes bytes(cad_magic.begin(), cad_magic.end());
    ByteWriter{bytes}(answer);
    return bytes;
}

CadAnswer from_cad_bytes(std::span<const char> bytes) {
    if (!std::string_view(bytes.data(), bytes.size()).starts_with(cad_magic))
        throw Error(ErrorCode::internal, "These bytes are no answer of this version's kerf-cad.");
    return from_bytes<CadAnswer>(bytes.subspan(cad_magic.size()));
}

CadFormat cad_format(std::string_view content) {
    if (is_iges(content)) return CadFormat::iges;
    content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
    if (content.starts_with("ISO-10303-21;")) return CadFormat::step;
    if (content.starts_with("DBRep_DrawableShape") || content.starts_with("CASCADE Topology")) return CadFormat::brep;
    return CadFormat::none;
}

const char* name(CadFormat format) {
    constexpr std::array<const char*, 4> names = {"none", "STEP", "IGES", "BREP"};
    return names[static_cast<std::size_t>(format)];
}

}  // namespace kerf
