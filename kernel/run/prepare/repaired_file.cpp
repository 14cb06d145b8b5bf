// A file is read, repaired and measured against what it was, then written. A surface that nothing was done to is copied
// where the ending is the same, with all its bytes.
#include "run/prepare/repaired_file.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "files/io/file_bytes.h"
#include "files/io/output_file.h"
#include "run/prepare/surface_file.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

bool is_unchanged(const CheckedSoup& checked, const OrientationReport& turned) {
    return !checked.ladder.changed() && checked.tidied.dropped_facets == 0 &&
           turned.facets_flipped + turned.shells_flipped == 0;
}

// An .stl holds 32-bit floats, which may close a gap, or make facets cross. Throws Error(input) if they do.
void require_good_as_stl(const std::string& output, const Soup& soup, const InputOptions& options) {
    Soup rounded = soup;
    for (Vec3& p : rounded.vertices) p = p.cast<float>().cast<double>();
    if (rounded.vertices == soup.vertices) return;
    InputOptions as_read;
    as_read.voids = options.voids;
    const CheckedSoup of_file = check_soup(std::move(rounded), as_read, 0);
    const std::vector<Defect>& defects = of_file.diagnosis.defects;
    const auto error = std::find_if(defects.begin(), defects.end(),
                                    [](const Defect& defect) { return defect.severity == Severity::error; });
    std::string why;
    if (error != defects.end())
        why = "it would have " + counted(of_file.diagnosis.count(error->kind), error->kind);
    else if (soup.sides.empty() && !of_file.soup.sides.empty())
        why = "gaps between bodies would close, so that they share walls";
    if (!why.empty())
        throw Error(ErrorCode::input,
                    fmt::format("{}: The repaired surface can be meshed, but not with the 7 digits of an .stl: {}. "
                                "Write an .obj, .ply or .off, which have all digits; kerf wrap makes a surface that "
                                "fits an .stl.",
                                output, why));
}

void write_result(const RepairedFile& repaired) {
    const Soup& soup = repaired.checked.soup;
    if (repaired.can_be_meshed && !soup.sides.empty()) {
        const Complex complex = make_complex(soup);
        require_surface_file("--output", repaired.output, complex.region_count());
        write_surface(repaired.output, complex, soup.patch_names);
    } else {
        write_surface(repaired.output, soup);
    }
}

// Whether the output has the bytes of the input already: a clean file that is copied once more is no loss.
bool are_equal_files(const std::string& a, const std::string& b) {
    std::error_code error;
    return fs::is_regular_file(b, error) && fs::file_size(a, error) == fs::file_size(b, error) && !error &&
           read_file(a) == read_file(b);
}

}  // namespace

RepairedFile repair_file(const std::string& input, const InputOptions& options, const std::string& output,
                         StageListener* listener) {
    require_surface_file("--output", output);
    for (const std::string& file : files_of(input, options)) refuse_to_overwrite(file, "--output", output);
    if (!are_equal_files(input, output)) require_writable("--output", output, output_kind::surface);
    options.check();
    tell_progress(listener, "read", 0, 1);
    InputFiles files = read_input_files(input, options);
    Soup before = files.soup;
    if (!files.is_welded) weld_exactly(before);
    const bool is_alone = options.more_files.empty() && files.walls.empty() && options.scale == 1;
    tell_progress(listener, "repair", 0, 0);
    RepairedFile repaired{
        input, output, check_files(std::move(files), options, 1, cancellation_check(listener)), {}, {}, {}, {}, {}, {}};
    CheckedSoup& checked = repaired.checked;
    repaired.can_be_meshed = checked.diagnosis.clean();
    if (repaired.can_be_meshed)
        repaired.turned = apply_repairs(checked);
    else
        repaired.remedy = find_remedy(input, options, checked, listener);
    repaired.is_unchanged = is_unchanged(checked, repaired.turned);
    repaired.measures = measure_repair(before, checked.soup, cancellation_check(listener));
    repaired.is_copy = repaired.is_unchanged && is_alone && fs::path(input).extension() == fs::path(output).extension();
    if (repaired.is_copy) {
        write_output_file(output, read_file(input));
        return repaired;
    }
    if (repaired.can_be_meshed && fs::path(output).extension() == ".stl")
        require_good_as_stl(output, checked.soup, options);
    write_result(repaired);
    return repaired;
}

}  // namespace kerf
