// What is known of a finished run before a file of it is read.
#include "files/io/listed_files.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class ReportsOfRuns : public testing::Test {
 protected:
    ReportsOfRuns() { std::filesystem::create_directory(folder()); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder() + "/" + name) << text; }
    // What all readers of a report end with.
    template <class Read>
    void expect_error(ErrorCode code, const std::string& words, const Read& read) const {
        try {
            read();
            ADD_FAILURE() << "nothing was thrown: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    }
    std::string folder() const { return folder_.file("run"); }

    test::TemporaryFolder folder_;
};

TEST_F(ReportsOfRuns, AreReadOnlyAsTheyWereLeft) {
    expect_error(ErrorCode::io, "is not a finished run", [&] { read_report_json(folder()); });
    const std::string report = sealed("{\n  \"files\": []\n}\n");
    write("report.json", report);
    EXPECT_TRUE(read_report_json(folder()).at("files").empty());
    std::string changed = report;
    changed[4] ^= 1;
    write("report.json", changed);
    expect_error(ErrorCode::verification, "is not as Kerf has written it", [&] { read_report_json(folder()); });
}

// Somebody has computed their hashes again.
TEST_F(ReportsOfRuns, ThatSayNothingAreDamaged) {
    const auto read_list = [&] { return ListedFiles(folder(), read_report_json(folder())); };
    for (const char* text : {"{\n  \"files\": no\n}\n", "{\n  \"files\": 7\n}\n", "{\n  \"parts\": []\n}\n",
                             "{\n  \"files\": [{\"path\": 3}]\n}\n"}) {
        write("report.json", sealed(text));
        expect_error(ErrorCode::verification, "report.json is damaged: ", read_list);
        expect_error(ErrorCode::verification, "Copy the folder again", read_list);
    }
}

TEST_F(ReportsOfRuns, TellWhichFilesMayBeRead) {
    write("good", "what the run has left");
    write("other", "what it has left, too");
    nlohmann::json files = nlohmann::json::array();
    for (const char* name : {"good", "other"}) {
        const RunFile file = describe_file(folder(), name);
        files.push_back({{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}});
    }
    write("report.json", sealed(nlohmann::json{{"files", files}}.dump(2) + "\n"));
    write("other", "what somebody has left");
    write("foreign", "what nobody has listed");
    const ListedFiles listed(folder(), read_report_json(folder()));
    EXPECT_EQ(listed.verified("good"), folder() + "/good");
    for (const char* name : {"other", "foreign"})
        expect_error(ErrorCode::verification, name, [&] { listed.verified(name); });
}

}  // namespace
}  // namespace kerf
