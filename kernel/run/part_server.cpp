// The worker's side of a job: standard input and output are a message channel, so whatever meshers print to standard
// output is sent to standard error instead.
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "core/bytes.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "run/part_job.h"
#include "run/process_memory.h"

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
        done += static_cast<std::size_t>(n);
    }
    return true;
}

void limit_address_space(std::int64_t megabytes) {
    if (megabytes <= 0) return;
    const auto bytes = static_cast<rlim_t>(megabytes) << 20;
    const rlimit limit = {bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

int serve_part_job(std::int64_t memory_mb, std::int64_t parent) {
    std::signal(SIGINT, SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (parent > 0 && getppid() != parent) return static_cast<int>(ErrorCode::internal);  // it has ended before that
    limit_address_space(memory_mb);
    const int answer = dup(STDOUT_FILENO);
    if (answer < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return static_cast<int>(ErrorCode::io);
    PartResult result;
    try {
        const Stopwatch loading;
        const auto attempt = from_bytes<PartAttempt>(read_all(STDIN_FILENO));
        const PartJob job = read_job(attempt.job_file);
        const double load_seconds = loading.seconds();
        result = run_part_job(job, attempt.call, attempt.part_file);
        result.load_seconds = load_seconds;
    } catch (const Error& e) {
        result.code = static_cast<int>(e.code());
        result.message = e.what();
    } catch (const std::bad_alloc&) {
        result = out_of_memory();
    }
    result.peak_rss_bytes = own_peak_rss_bytes();
    return write_all(answer, to_bytes(result)) ? 0 : static_cast<int>(ErrorCode::io);
}

}  // namespace kerf
