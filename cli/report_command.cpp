// kerf report: a finished run as one page that can be sent by mail.
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "cli/answer.h"
#include "cli/commands.h"
#include "files/html/report_page.h"
#include "files/io/output_file.h"
#include "files/io/standard_streams.h"

namespace kerf {

namespace {

struct ReportRequest {
    std::string folder;
    std::string output;
    bool quiet = false;
};

// A run's folder holds nothing else: a page in it would be in the way of the next run.
void refuse_inside(const ReportRequest& request) {
    if (!lies_inside(request.output, request.folder)) return;
    throw Error(ErrorCode::io, fmt::format("{} would lie in the folder of the run, which would not be known as one of "
                                           "Kerf's any more. Name a file beside it, as {}.html.",
                                           request.output, request.folder));
}

// The output must be named as a page: the file there is replaced, which must not happen to a surface that was meant to
// be read.
void require_page(const std::string& output) {
    const std::string suffix = std::filesystem::path(output).extension().string();
    if (suffix == ".html" || suffix == ".htm") return;
    throw Error(ErrorCode::usage, fmt::format("--output {}: the page is a file of HTML. Name it {}.", output,
                                              std::filesystem::path(output).replace_extension(".html").string()));
}

std::string summary(const ReportPage& page, const std::string& output) {
    const std::string coarser =
        page.triangles == page.triangles_of_run
            ? ""
            : fmt::format(", of {} that the run has: the page's surface is coarser", page.triangles_of_run);
    return fmt::format("kerf: {}: {} part{}, {} boundary triangles{}, {:.1f} MB\n", output, page.parts,
                       page.parts == 1 ? "" : "s", page.triangles, coarser, page.html.size() * 1e-6);
}

int write_report(const ReportRequest& request) {
    require_page(request.output);
    refuse_inside(request);
    require_writable("--output", request.output, output_kind::page);
    const ReportPage page = report_page(request.folder);
    write_output_file(request.output, page.html);
    if (!request.quiet) tell(summary(page, request.output));
    return 0;
}

}  // namespace

void add_report_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<ReportRequest>();
    CLI::App* command =
        kerf.add_subcommand("report", "Write a finished run as one page of HTML, with its surface to be turned.");
    command->add_option("folder", request->folder, "Folder of the run.")->required()->type_name("DIR");
    command
        ->add_option("-o,--output", request->output,
                     "The page: one file, which needs no network; any browser shows it.")
        ->required()
        ->type_name("FILE.html");
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but errors.");
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return write_report(*request); }); });
}

}  // namespace kerf
