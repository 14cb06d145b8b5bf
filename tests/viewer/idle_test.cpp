// What is looked at and left alone costs nothing: no frame is wanted, and a frame that is drawn asks no file.
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <csignal>
#include <cstddef>
#include <fstream>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/temporary_folder.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

volatile std::sig_atomic_t file_calls = 0;

// From now on the kernel refuses this thread all that looks for files, and each try is counted.
bool refuse_files() {
    struct sigaction count {};
    count.sa_sigaction = [](int, siginfo_t*, void*) { file_calls = file_calls + 1; };
    count.sa_flags = SA_SIGINFO;
    ::sigaction(SIGSYS, &count, nullptr);
    std::vector<sock_filter> code = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr))};
    for (const unsigned call :
         {SYS_openat, SYS_newfstatat, SYS_statx, SYS_faccessat, SYS_readlinkat, SYS_getdents64, SYS_getcwd,
#ifdef SYS_open
          SYS_open, SYS_stat, SYS_lstat, SYS_access, SYS_readlink
#endif
         }) {
        code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
        code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
    }
    code.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
    const sock_fprog program = {static_cast<unsigned short>(code.size()), code.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

void look_around(Driver& driver) {
    for (int i = 0; i < 100; ++i) driver.move_to(static_cast<float>(13 * i % 1280), static_cast<float>(29 * i % 800));
}

// Of a hundred frames, the mouse here and there, after what `prepare` has shown. In a thread of its own: what is
// refused once is refused for good.
void expect_no_file_calls(const Driver::Options& options, const std::function<void(Driver&)>& prepare) {
    std::thread([&] {
        Driver driver(options);
        prepare(driver);
        driver.settle();
        look_around(driver);  // what is made once
        ASSERT_TRUE(refuse_files());
        file_calls = 0;
        look_around(driver);
        EXPECT_EQ(file_calls, 0);
        driver.key(key_of('O'), true);
        EXPECT_GT(file_calls, 0) << "the browser looks into a folder, so that calls are seen";
    }).join();
}

Driver::Options of_two_parts() {
    Driver::Options options;
    options.parts = 2;
    return options;
}

TEST(Idle, AFrameWithoutADocumentAsksNoFile) {
    const TemporaryFolder folder;
    Driver::Options options;
    options.config_folder = folder.file("config");
    expect_no_file_calls(options, [](Driver&) {});
}

TEST(Idle, AFrameOfARunAsksNoFile) {
    expect_no_file_calls(of_two_parts(), [](Driver& driver) {
        driver.open(asset_path("cube"));
        driver.state().step = {Stage::tetrahedra, -1};
        driver.state().coloring.by = ColorBy::min_dihedral;
        driver.state().panels.display = false;
        driver.state().panels.parameters = driver.state().panels.quality = true;
        driver.settle();
        driver.click("size-field");
        driver.type("no such file");
        driver.key(key_enter);
    });
}

TEST(Idle, AFrameOfProblemsAsksNoFile) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("open.off")) << "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";
    std::ofstream(folder.file("other.off")) << "OFF\n4 3 0\n5 0 0\n6 0 0\n5 1 0\n5 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n";
    expect_no_file_calls(of_two_parts(), [&](Driver& driver) {
        driver.open_files({folder.file("open.off"), folder.file("other.off")});
        EXPECT_TRUE(driver.document().has_problems() || !driver.document().error.empty());
    });
}

TEST(Idle, NothingIsDrawnAndNothingIsMade) {
    Driver driver(of_two_parts());
    driver.open(asset_path("cube"));
    for (int i = 0; i < 10; ++i) driver.frame(1);  // notices go
    driver.settle();
    const std::int64_t made = driver.app().geometry_made();
    for (int i = 0; i < 100; ++i) {
        EXPECT_TRUE(driver.app().settled());
        EXPECT_FALSE(driver.app().wants_frame());
    }
    driver.app().wake();
    EXPECT_TRUE(driver.app().wants_frame()) << "until something happens";
    driver.settle();
    EXPECT_EQ(driver.app().geometry_made(), made);
    EXPECT_FALSE(driver.app().wants_frame());
}

// Options are held against their ranges when they are edited, opened or put back.
TEST(Idle, OptionsAreCheckedAsTheyAreEdited) {
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(asset_path("cube"));
    driver.state().panels.parameters = true;
    driver.settle();
    EXPECT_TRUE(driver.offers("Run all"));
    driver.click("parts");
    driver.key(key_of('A'), true);
    driver.type("-1");
    driver.settle();
    EXPECT_FALSE(driver.offers("Run all"));
    driver.click("Reset");
    driver.settle();
    EXPECT_TRUE(driver.offers("Run all"));
}

}  // namespace
}  // namespace kerf::test
