// A file is read, repaired and measured against what it was, then written. A surface that nothing was done to is copied
// where the ending is the same, with all its bytes. An .stl holds 7 digits: a surface that they spoil is rounded and
// repaired again, before its measures are taken, so that the report is about what lies in the file.
#include "run/prepare/repaired_file.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>

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

void append(std::vector<StepReport>& to, std::vector<StepReport> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// An .stl holds 32-bit floats, which may close a gap, or make facets cross: the rounded surface is repaired again then.
// Throws Error(input) if it cannot be.
void fit_into_stl(CheckedSoup& checked, const InputOptions& options, const std::string& output,
                  const std::function<void()>& check_cancelled) {
    constexpr int most_rounds = 3;
    for (int round = 0;; ++round) {
        Soup rounded = checked.soup;
        for (Vec3& p : rounded.vertices) p = p.cast<float>().cast<double>();
        if (rounded.vertices == checked.soup.vertices) return;
        InputOptions as_read;
        as_read.voids = options.voids;
        const CheckedSoup of_file = check_soup(rounded, as_read, 0, check_cancelled);
        const bool shares_walls = checked.soup.sides.empty() && !of_file.soup.sides.empty();
        if (of_file.diagnosis.clean() && !shares_walls) return;
        CheckedSoup again;
        if (round < most_rounds && !shares_walls) again = check_soup(std::move(rounded), options, 0, check_cancelled);
        if (again.soup.facets.empty() || !again.diagnosis.clean())
            throw Error(ErrorCode::input,
                        fmt::format("{}: The repaired surface can be meshed, but not with the 7 digits of an .stl: {} "
                                    "Write an .obj, .ply or .off, which have all digits{}.",
                                    output,
                                    shares_walls ? "gaps between bodies would close, so that they share walls."
                                                 : of_file.diagnosis.summary(of_file.soup),
                                    shares_walls ? "" : ", or take kerf wrap"));
        apply_repairs(again);
        append(checked.ladder.steps, std::move(again.ladder.steps));
        checked.soup = std::move(again.soup);
    }
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
    const bool is_same_kind = fs::path(input).extension() == fs::path(output).extension();
    if (repaired.can_be_meshed && fs::path(output).extension() == ".stl" && !(repaired.is_unchanged && is_same_kind))
        fit_into_stl(checked, options, output, cancellation_check(listener));
    repaired.measures = measure_repair(before, checked.soup, cancellation_check(listener));
    repaired.is_copy = repaired.is_unchanged && is_alone && is_same_kind;
    if (repaired.is_copy) {
        write_output_file(output, read_file(input));
        return repaired;
    }
    write_result(repaired);
    return repaired;
}

}  // namespace kerf
