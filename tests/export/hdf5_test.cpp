// What the file says is judged by programs of others (tests/oracles/hdf5_test.sh); here it is that its bytes depend on
// the mesh alone.
#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "export/cases.h"
#include "files/export/format.h"
#include "files/io/file_bytes.h"
#include "files/part/run_parts.h"
#include "support/temporary_folder.h"

namespace kerf::hdf5_test {
namespace {

const Format& hdf5() { return find_format("hdf5"); }

std::vector<std::string> bytes_of(const std::string& folder, const std::string& stem = "mesh") {
    return {read_file(folder + "/" + stem + ".h5"), read_file(folder + "/" + stem + ".xdmf")};
}

std::vector<std::string> exported(const RunParts& run) {
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file(""));
    write_format(hdf5(), run, files);
    EXPECT_EQ(files.list().size(), 2u);
    return bytes_of(folder.file(""));
}

void write_part(const RunParts& run, PartIndex index, ExportFiles& files) {
    hdf5().write_part(run, index, run.load(index), files);
}

TEST(Hdf5, TheOrderOfPartsIsNotInTheBytes) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file(""));
        hdf5().write_whole(run, files);
        for (auto rank = static_cast<std::int32_t>(run.outline().parts.size()); rank-- > 0;)
            write_part(run, PartIndex(rank), files);
        EXPECT_EQ(bytes_of(folder.file("")), exported(run));
    }
}

TEST(Hdf5, ThreadsMayWriteItTogether) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file(""));
        hdf5().write_whole(run, files);
        const auto count = static_cast<std::int32_t>(run.outline().parts.size());
        std::vector<std::thread> threads;
        for (std::int32_t first = 0; first < 4; ++first)
            threads.emplace_back([&, first] {
                for (std::int32_t rank = first; rank < count; rank += 4) write_part(run, PartIndex(rank), files);
            });
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(bytes_of(folder.file("")), exported(run));
    }
}

TEST(Hdf5, TheTimeIsNotInTheBytes) {
    const RunParts run(test::run_of(test::export_cases().front()));
    const std::vector<std::string> before = exported(run);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 counts seconds
    EXPECT_EQ(exported(run), before);
}

// Only the name of the file beside it is another one.
TEST(Hdf5, MergedIsTheSameFile) {
    for (const test::ExportCase& each : test::export_cases()) {
        SCOPED_TRACE(each.name);
        const RunParts run(test::run_of(each));
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file(""));
        hdf5().write_merged(run, {}, files, "all");
        const std::vector<std::string> merged = bytes_of(folder.file(""), "all"), parts = exported(run);
        EXPECT_EQ(merged[0], parts[0]);
        EXPECT_NE(merged[1].find(">all.h5:/geometry/vertices<"), std::string::npos);
        EXPECT_NE(parts[1].find(">mesh.h5:/geometry/vertices<"), std::string::npos);
    }
}

TEST(Hdf5, WhatWasThereIsReplaced) {
    const auto& cases = test::export_cases();
    const RunParts large(test::run_of(cases[1])), small(test::run_of(cases[0]));
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file(""));
    write_format(hdf5(), large, files);
    write_format(hdf5(), small, files);
    EXPECT_EQ(bytes_of(folder.file("")), exported(small));
}

// What goes wrong where files may have 4 kB.
std::string error_on_a_small_disk(const std::function<void()>& write) {
    rlimit before;
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 4096;
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string message = "nothing";
    try {
        write();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        message = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    return message;
}

TEST(Hdf5, AFullDiskIsAnError) {
    const RunParts run(test::run_of(test::export_cases().front()));
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file(""));
    const std::string expected = "Cannot write " + files.path_of("mesh.h5");
    EXPECT_EQ(error_on_a_small_disk([&] { hdf5().write_whole(run, files); }).substr(0, expected.size()), expected);
    hdf5().write_whole(run, files);
    EXPECT_EQ(error_on_a_small_disk([&] { write_part(run, PartIndex(0), files); }).substr(0, expected.size()),
              expected);
    write_format(hdf5(), run, files);  // the library is in order again
    EXPECT_EQ(bytes_of(folder.file("")), exported(run));
}

}  // namespace
}  // namespace kerf::hdf5_test
