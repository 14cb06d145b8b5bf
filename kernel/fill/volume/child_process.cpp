// A child has three pipes (its standard streams) and a process descriptor that becomes readable when it ends.
// wait_any() sleeps in poll() on all of these, moves bytes as far as it can without blocking, and reaps. A child counts
// as ended when its process has ended, not when its pipes close: it may close them early, or leave them to a process of
// its own.
#include "fill/volume/child_process.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h>  // glibc 2.36 declares its functions without C linkage
}

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"

namespace kerf {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t log_bytes = 4096;
// Time between looks for the end of a child on a system that gives no process descriptors.
constexpr double fallback_seconds = 0.01;
constexpr double forever = std::numeric_limits<double>::infinity();

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

[[noreturn]] void throw_system_error(const std::string& what, int error) {
    throw Error(ErrorCode::io, fmt::format("{}: {}.", what, std::strerror(error)));
}

class FileDescriptor {
 public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    ~FileDescriptor() { close(); }
    int get() const { return fd_; }
    bool is_open() const { return fd_ >= 0; }
    void close() {
        if (is_open()) ::close(std::exchange(fd_, -1));
    }

 private:
    int fd_;
};

struct Pipe {
    FileDescriptor read_end, write_end;

    Pipe() {
        int fds[2];
        if (pipe2(fds, O_CLOEXEC) != 0) throw_system_error("A pipe to a child process cannot be made", errno);
        read_end = FileDescriptor(fds[0]);
        write_end = FileDescriptor(fds[1]);
    }
};

void make_non_blocking(const FileDescriptor& fd) { fcntl(fd.get(), F_SETFL, O_NONBLOCK); }

// Keeps SIGPIPE from this thread while it writes to a pipe whose reader may have gone, and takes away the one it
// caused.
class SigpipeGuard {
 public:
    SigpipeGuard() {
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        sigemptyset(&sigpipe_);
        sigaddset(&sigpipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &sigpipe_, &old_mask_);
    }
    SigpipeGuard(const SigpipeGuard&) = delete;
    SigpipeGuard& operator=(const SigpipeGuard&) = delete;
    ~SigpipeGuard() {
        constexpr timespec now{0, 0};
        if (!was_pending_) sigtimedwait(&sigpipe_, nullptr, &now);
        pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr);
    }

 private:
    sigset_t sigpipe_, old_mask_;
    bool was_pending_;
};

// The set-up of a child by posix_spawn: streams from the pipes, no other file, all signals as at the start of a
// program.
class SpawnSetup {
 public:
    SpawnSetup(const Pipe& input, const Pipe& output, const Pipe& log) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, input.read_end.get(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, output.write_end.get(), STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, log.write_end.get(), STDERR_FILENO);
        posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
        sigset_t signals;
        posix_spawnattr_init(&attributes_);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        sigemptyset(&signals);
        posix_spawnattr_setsigmask(&attributes_, &signals);
        sigaddset(&signals, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
    }
    SpawnSetup(const SpawnSetup&) = delete;
    SpawnSetup& operator=(const SpawnSetup&) = delete;
    ~SpawnSetup() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    const posix_spawn_file_actions_t* actions() const { return &actions_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
    posix_spawn_file_actions_t actions_;
    posix_spawnattr_t attributes_;
};

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments, const SpawnSetup& setup) {
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t pid = -1;
    const int error = posix_spawn(&pid, program.c_str(), setup.actions(), setup.attributes(), argv.data(), environ);
    if (error == ENOMEM) throw std::bad_alloc();
    if (error != 0)
        throw_system_error(fmt::format("The program {} cannot be started (check that it is installed)", program),
                           error);
    return pid;
}

// Writes as many of `bytes` behind the first `written` as the pipe takes; closes it at the end or when nobody reads.
void feed(FileDescriptor& pipe, const Bytes& bytes, std::size_t& written) {
    const SigpipeGuard guard;
    while (written < bytes.size()) {
        const ssize_t n = write(pipe.get(), bytes.data() + written, bytes.size() - written);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno == EAGAIN) return;
        if (n < 0) break;
        written += n;
    }
    pipe.close();
}

// Hands the bytes in the pipe to `take`; closes it at its end. One read of the pipe's capacity takes all that was
// there, while reading until it is empty could follow a fast writer for ever.
template <class Take>
void drain(FileDescriptor& pipe, Take take) {
    if (!pipe.is_open()) return;
    std::vector<char> buffer(fcntl(pipe.get(), F_GETPIPE_SZ));
    const ssize_t n = read(pipe.get(), buffer.data(), buffer.size());
    if (n > 0)
        take(buffer.data(), n);
    else if (n == 0 || (errno != EAGAIN && errno != EINTR))
        pipe.close();
}

int poll_milliseconds(double seconds) {
    // Rounded up: waking a moment too early would turn the wait into a busy one.
    return seconds == forever ? -1 : static_cast<int>(std::ceil(std::clamp(seconds, 0.0, 1e6) * 1e3));
}

}  // namespace

struct ChildPool::Child {
    int tag = 0;
    pid_t pid = -1;
    FileDescriptor input, output, log, ended;
    Bytes input_bytes;
    std::size_t written = 0;
    Clock::time_point start;
    bool killed = false;
    ChildResult result;

    void read_streams() {
        drain(output,
              [&](const char* data, std::size_t n) { result.output.insert(result.output.end(), data, data + n); });
        drain(log, [&](const char* data, std::size_t n) {
            result.log.append(data, n);
            if (result.log.size() > log_bytes) result.log.erase(0, result.log.size() - log_bytes);
        });
    }

    double seconds_to_look() const {
        const double limit =
            result.timeout_seconds > 0 && !killed ? result.timeout_seconds - seconds_since(start) : forever;
        return ended.is_open() ? limit : std::min(limit, fallback_seconds);
    }

    void enforce_limit() {
        if (killed || result.timeout_seconds <= 0 || seconds_since(start) < result.timeout_seconds) return;
        kill(pid, SIGKILL);
        killed = true;
    }

    // Returns whether the process has ended; its result is complete then.
    bool reap() {
        int status = 0;
        rusage usage{};
        if (wait4(pid, &status, WNOHANG, &usage) != pid) return false;
        read_streams();
        result.seconds = seconds_since(start);
        result.peak_rss_bytes = usage.ru_maxrss * 1024;
        if (WIFEXITED(status)) {
            result.end = ChildResult::End::exited;
            result.exit_code = WEXITSTATUS(status);
        } else {
            result.signal = WTERMSIG(status);
            result.end = killed && result.signal == SIGKILL ? ChildResult::End::timed_out : ChildResult::End::signalled;
        }
        return true;
    }

    void kill_and_reap() {
        kill(pid, SIGKILL);
        while (waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
};

std::string ChildResult::describe() const {
    switch (end) {
        case End::exited:
            return fmt::format("ended with exit code {}", exit_code);
        case End::signalled:
            return fmt::format("was killed by signal {} ({})", signal, strsignal(signal));
        case End::timed_out:
            return fmt::format("ran longer than its {:g} s and was stopped", timeout_seconds);
    }
    return {};
}

ChildPool::ChildPool() = default;

ChildPool::~ChildPool() {
    for (Child& child : children_) child.kill_and_reap();
}

std::size_t ChildPool::running() const { return children_.size(); }

// A child in the list is not reaped, so its number is still its own.
void ChildPool::interrupt(int tag) {
    for (const Child& child : children_)
        if (child.tag == tag) kill(child.pid, SIGINT);
}

void ChildPool::start(int tag, const std::string& program, const std::vector<std::string>& arguments, Bytes input,
                      double timeout_seconds) {
    children_.reserve(children_.size() +
                      1);  // nothing may throw between the start of a process and its place in the list
    Pipe input_pipe, output_pipe, log_pipe;
    Child child;
    child.tag = tag;
    child.start = Clock::now();
    child.pid = spawn(program, arguments, SpawnSetup(input_pipe, output_pipe, log_pipe));
    child.input = std::move(input_pipe.write_end);
    child.output = std::move(output_pipe.read_end);
    child.log = std::move(log_pipe.read_end);
    child.ended = FileDescriptor(pidfd_open(child.pid, 0));
    child.input_bytes = std::move(input);
    child.result.timeout_seconds = timeout_seconds;
    for (const FileDescriptor* fd : {&child.input, &child.output, &child.log}) make_non_blocking(*fd);
    feed(child.input, child.input_bytes, child.written);
    children_.push_back(std::move(child));
}

std::optional<ChildPool::Finished> ChildPool::wait_any(double wait_seconds) {
    KERF_CHECK(running() > 0);
    const Clock::time_point start = Clock::now();
    const double limit = wait_seconds < 0 ? forever : wait_seconds;
    std::vector<pollfd> polled;
    while (true) {
        double sleep = limit - seconds_since(start);
        polled.clear();
        for (const Child& child : children_) {
            sleep = std::min(sleep, child.seconds_to_look());
            polled.push_back({child.input.get(), POLLOUT, 0});  // poll() skips closed descriptors, which are negative
            for (const FileDescriptor* fd : {&child.output, &child.log, &child.ended})
                polled.push_back({fd->get(), POLLIN, 0});
        }
        poll(polled.data(), polled.size(), poll_milliseconds(sleep));
        for (Child& child : children_) {
            if (child.input.is_open()) feed(child.input, child.input_bytes, child.written);
            child.read_streams();
            child.enforce_limit();
        }
        const auto ended = std::find_if(children_.begin(), children_.end(), [](Child& child) { return child.reap(); });
        if (ended != children_.end()) {
            Finished finished{ended->tag, std::move(ended->result)};
            children_.erase(ended);
            return finished;
        }
        if (seconds_since(start) >= limit) return std::nullopt;
    }
}

}  // namespace kerf
