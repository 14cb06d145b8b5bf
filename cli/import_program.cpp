// The main function of kerf-cad and kerf-3mf: a file becomes a CadAnswer (files/io/cad_body.h), body or error, which
// kerf reads from standard output. These are programs of their own, because OpenCASCADE takes longer to load than a
// small mesh takes, may crash, and need not be installed, nor need lib3mf. The libraries print to standard output, too,
// so that it is moved away first: its descriptor is kept for the answer alone, and prints go to standard error. Nothing
// is written to a terminal, where the answer would be of no use. An error is in the answer as well as in a message and
// the exit code, so that kerf can tell its kind and elements. The process ends by _exit(), as the library's own end
// would take longer.
#include "cli/import_program.h"

#include <algorithm>
#include <array>
#include <exception>

#include <unistd.h>

#include "base/core/error.h"
#include "base/core/out_of_memory.h"
#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/output_file.h"

namespace kerf {

namespace {

CadAnswer failed(ErrorCode code, const std::string& message) { return {static_cast<std::int32_t>(code), message, {}}; }

// Reads standard input, which kerf writes, to its end.
Bytes read_input_stream() {
    Bytes bytes;
    std::array<char, 65536> buffer;
    for (ssize_t n = 0; (n = read(STDIN_FILENO, buffer.data(), buffer.size())) > 0;)
        bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + n);
    return bytes;
}

// Makes the answer for a file. `projector`: null to import the file.
CadAnswer answer_for(const std::string& path, std::span<const std::string> arguments, ImportFunction importer,
                     ProjectFunction projector) {
    try {
        const CadOptions options = CadOptions::from_arguments(arguments);
        std::string bytes = read_file(path);
        const FileHash hash = digest_of(bytes);
        CadAnswer answer;
        const std::string content = decompress(std::move(bytes), path);
        if (projector)
            answer.projected = projector(content, path, options, from_bytes<CadPoints>(read_input_stream()));
        else
            answer.body = importer(content, path, options);
        answer.body.file_hash = hash;
        return answer;
    } catch (const SolidDefect& defect) {
        CadAnswer answer = failed(defect.code(), defect.what());
        answer.defect = defect.kind();
        answer.elements = defect.elements();
        return answer;
    } catch (const Error& error) {
        return failed(error.code(), error.what());
    } catch (const std::exception& error) {
        if (is_out_of_memory(error)) return failed(ErrorCode::memory, path + ": Out of memory.");
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

// Takes `--project` out of the arguments, and returns whether it was there.
bool take_project(std::vector<std::string>& arguments) { return std::erase(arguments, "--project") > 0; }

void write_all(int descriptor, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = write(descriptor, bytes.data(), bytes.size());
        if (n <= 0) return;  // nobody reads
        bytes = bytes.subspan(n);
    }
}

}  // namespace

void run_import_program(int argc, char** argv, const char* name, ImportFunction importer, ProjectFunction projector) {
    const int output = dup(STDOUT_FILENO);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const std::string output_path = take_output(arguments);
    if (!projector || !take_project(arguments)) projector = nullptr;
    const bool asks = arguments.empty() || arguments.front().starts_with('-');
    CadAnswer answer = asks ? failed(ErrorCode::usage, "Usage: " + std::string(name) + " FILE [OPTIONS]")
                            : answer_for(arguments.front(), std::span(arguments).subspan(1), importer, projector);
    const Bytes bytes = to_cad_bytes(answer);
    if (!output_path.empty()) try {
            write_output_file(output_path, bytes);
        } catch (const Error& error) {
            answer.error_code = static_cast<int>(error.code());
            answer.message = error.what();
        }
    else if (isatty(output) == 0)
        write_all(output, bytes);
    if (answer.error_code != 0) write_all(STDERR_FILENO, name + (": " + answer.message) + "\n");
    _exit(answer.error_code);
}

}  // namespace kerf
