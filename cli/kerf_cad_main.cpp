// kerf-cad: a CAD file to facets, in a process of its own. Started by kerf, which reads the answer from standard output
// (io/cad_body.h).
//
//     kerf-cad FILE [--solid N] [--unite] [--unit mm|cm|m|inch|ft] [--deflection D] [--output OUT]
//
// Standard output holds nothing but the answer, whatever OpenCASCADE prints. The exit code is that of the error.
#include <algorithm>
#include <exception>
#include <new>

#include <unistd.h>

#include "cad/cad_import.h"
#include "core/error.h"
#include "io/cad_body.h"
#include "io/compressed.h"
#include "io/file_bytes.h"
#include "io/output_file.h"

namespace kerf {

namespace {

CadAnswer failed(ErrorCode code, const std::string& message) { return {static_cast<std::int32_t>(code), message, {}}; }

CadAnswer answer_for(const std::string& path, std::span<const std::string> arguments) {
    try {
        const CadOptions options = CadOptions::from_arguments(arguments);
        std::string bytes = read_file(path);
        const FileHash hash = digest_of(bytes);
        CadAnswer answer;
        answer.body = import_cad(decompress(std::move(bytes), path), path, options);
        answer.body.file_hash = hash;
        return answer;
    } catch (const SolidDefect& defect) {
        CadAnswer answer = failed(defect.code(), defect.what());
        answer.defect = defect.kind();
        return answer;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return failed(ErrorCode::memory, path + ": Out of memory.");
    } catch (const std::exception& error) {
        return failed(ErrorCode::internal, path + ": " + error.what());
    }
}

// Takes `--output OUT` out of the arguments; empty if there is none.
std::string take_output(std::vector<std::string>& arguments) {
    const auto option = std::find(arguments.begin(), arguments.end(), "--output");
    if (option == arguments.end() || option + 1 == arguments.end()) return "";
    std::string path = *(option + 1);
    arguments.erase(option, option + 2);
    return path;
}

void write_all(int descriptor, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(descriptor, bytes.data(), bytes.size());
        if (n <= 0) return;  // nobody reads
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    const int output = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const std::string output_path = kerf::take_output(arguments);
    const bool asks = arguments.empty() || arguments.front().starts_with('-');
    kerf::CadAnswer answer =
        asks ? kerf::CadAnswer{static_cast<int>(kerf::ErrorCode::usage), "Usage: kerf-cad FILE [OPTIONS]", {}}
             : kerf::answer_for(arguments.front(), std::span(arguments).subspan(1));
    const kerf::Bytes bytes = kerf::to_cad_bytes(answer);
    if (!output_path.empty()) try {
            kerf::write_output_file(output_path, bytes);
        } catch (const kerf::Error& error) {
            answer.error_code = static_cast<int>(error.code());
            answer.message = error.what();
        }
    else if (isatty(output) == 0)
        kerf::write_all(output, bytes);
    if (answer.error_code != 0) kerf::write_all(STDERR_FILENO, "kerf-cad: " + answer.message + "\n");
    _exit(answer.error_code);  // OpenCASCADE's own end would take longer
}
