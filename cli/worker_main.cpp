// kerf-worker: one call of a mesher in a process of its own, started by kerf; run/work/part_job.h has the protocol.
// Standard input and output are a message channel, so that all that meshers print to standard output goes to standard
// error instead.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "base/core/out_of_memory.h"
#include "base/core/stopwatch.h"
#include "base/parallel/process_memory.h"
#include "run/work/part_job.h"

namespace kerf {

namespace {

Bytes read_all(int file) {
    Bytes bytes;
    std::array<char, 1 << 16> buffer;
    for (;;) {
        const ssize_t n = read(file, buffer.data(), buffer.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return bytes;
        bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + n);
    }
}

bool write_all(int file, const Bytes& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        done += n;
    }
    return true;
}

void limit_address_space(std::int64_t megabytes) {
    if (megabytes <= 0) return;
    const rlim_t bytes = megabytes << 20;
    const rlimit limit = {bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

}  // namespace kerf

// Serves one attempt: reads it from standard input, answers on standard output. `--memory` limits the address space (0:
// not at all). The process ends with `--parent` (0: its own) and not by Ctrl-C, which reaches all processes of a
// terminal but is the parent's to answer.
int main(int argc, char** argv) {
    using namespace kerf;
    const auto number_behind = [&](const char* option) -> std::int64_t {
        for (int i = 1; i + 1 < argc; i += 2)
            if (std::strcmp(argv[i], option) == 0) return std::strtoll(argv[i + 1], nullptr, 10);
        return 0;
    };
    std::signal(SIGINT, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::int64_t parent = number_behind("--parent");
    if (parent > 0 && getppid() != parent)
        return static_cast<int>(ErrorCode::internal);  // the parent has ended before prctl()
    limit_address_space(number_behind("--memory"));
    const int answer = dup(STDOUT_FILENO);
    if (answer < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return static_cast<int>(ErrorCode::io);
    PartResult result;
    try {
        const Stopwatch loading;
        const auto attempt = from_bytes<PartAttempt>(read_all(STDIN_FILENO));
        const PartJob job = read_job(attempt.job_file);
        const double load_seconds = loading.seconds();
        result = run_part_job(job, attempt.call, attempt.part_file, attempt.durable);
        result.load_seconds = load_seconds;
    } catch (const Error& e) {
        result.code = static_cast<int>(e.code());
        result.message = e.what();
    } catch (const std::exception& e) {
        if (!is_out_of_memory(e)) throw;
        result = out_of_memory();
    }
    result.peak_rss_bytes = own_peak_rss_bytes();
    return write_all(answer, to_bytes(result)) ? 0 : static_cast<int>(ErrorCode::io);
}
