// Programs of Kerf are found in one order of places, and what is missing names them.
#include "files/io/program_finder.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

constexpr const char* wanted = "kerf-of-this-test";

class ProgramFinder : public testing::Test {
 protected:
    ~ProgramFinder() override { ::unsetenv(programs_variable); }
    // A folder with the program in it.
    std::string folder(const std::string& called) const {
        std::filesystem::create_directories(folder_.file(called));
        std::ofstream(folder_.file(called + "/" + wanted)) << "#!/bin/sh\n";
        return folder_.file(called);
    }
    test::TemporaryFolder folder_;
};

TEST_F(ProgramFinder, TheFolderThatIsNamedComesBeforeTheEnvironment) {
    const std::string named = folder("named"), of_environment = folder("environment");
    ::setenv(programs_variable, of_environment.c_str(), 1);
    EXPECT_EQ(find_kerf_program(wanted, named), named + "/" + wanted);
    EXPECT_EQ(find_kerf_program(wanted), of_environment + "/" + wanted);
    EXPECT_EQ(find_kerf_program(wanted, folder_.file("nothing")), of_environment + "/" + wanted) << "the next place";
}

TEST_F(ProgramFinder, ProgramsLieBesideTheOneThatRuns) {
    const auto self = std::filesystem::read_symlink("/proc/self/exe");
    const ProgramSearch search = look_for_program(self.filename());
    EXPECT_TRUE(search.found);
    EXPECT_EQ(search.path, self.string());
}

TEST_F(ProgramFinder, WhatIsMissingNamesAllPlaces) {
    ::setenv(programs_variable, folder_.file("environment").c_str(), 1);
    const ProgramSearch search = look_for_program(wanted, folder_.file("named"));
    EXPECT_FALSE(search.found);
    EXPECT_EQ(search.path, folder_.file("named/") + wanted);
    const auto self = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    EXPECT_EQ(search.looked_at,
              (std::vector<std::string>{folder_.file("named/") + wanted, folder_.file("environment/") + wanted,
                                        (self / wanted).string(), (self.parent_path() / "bin" / wanted).string(),
                                        (self.parent_path() / "libexec/kerf" / wanted).string()}));
    try {
        find_kerf_program(wanted, folder_.file("named"));
        ADD_FAILURE() << "found";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        for (const std::string& place : search.looked_at)
            EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace kerf
