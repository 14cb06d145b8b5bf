// The table of commands, and what finds them: keys, menus, the search box.
#include "viewer/panels/inside/commands.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"

namespace kerf::test {
namespace {

using namespace view;

std::vector<std::string> keys_of(const Command& command) {
    std::vector<std::string> keys;
    std::istringstream text(command.keys);
    for (std::string key; std::getline(text >> std::ws, key, ',');) keys.push_back(key);
    return keys;
}

Driver::Options shown_alone() {
    Driver::Options options;
    options.auto_run = false;
    return options;
}

TEST(Commands, HaveNamesAndKeysOfTheirOwn) {
    ASSERT_GT(commands().size(), 30u);
    std::set<std::string> names, keys;
    for (const Command& command : commands()) {
        EXPECT_TRUE(names.insert(command.name).second) << command.name;
        EXPECT_NE(std::string(command.heading), "") << command.name;
        for (const std::string& key : keys_of(command)) {
            EXPECT_TRUE(keys.insert(key).second) << key;
            EXPECT_EQ(command_of_key(key), &command) << key;
        }
    }
    EXPECT_EQ(command_of_key("Ctrl+J"), nullptr);
    EXPECT_EQ(command_of_key(""), nullptr);
    EXPECT_EQ(command_of_key("Shift+E"), command_of_key("E")) << "nothing else has it";
    EXPECT_NE(command_of_key("Shift+C"), command_of_key("C"));
}

// What a mesh is made for can be asked for in these words.
TEST(Commands, SaveExportAndMesh) {
    const auto finds = [](const char* words, const std::string& name) {
        const std::vector<const Command*> found = find_commands(words);
        return std::any_of(found.begin(), found.end(), [&](const Command* command) { return command->name == name; });
    };
    for (const char* name : {"Save run as...", "Save surface as...", "Save report page...", "Save picture..."})
        EXPECT_TRUE(finds("save", name)) << name;
    EXPECT_TRUE(finds("export", "Export mesh..."));
    EXPECT_TRUE(finds("mesh", "Export mesh..."));
    EXPECT_TRUE(finds("mesh", "Mesh the surface"));
}

TEST(Commands, AreFoundByTheirNamesAndKeys) {
    EXPECT_EQ(find_commands("").size(), commands().size());
    for (const Command& command : commands()) {
        std::string name = command.name;
        EXPECT_EQ(find_commands(name).front(), &command) << name;
        std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
        EXPECT_EQ(find_commands(name).front(), &command) << name;
        for (const std::string& key : keys_of(command)) {
            const auto found = find_commands(key);
            EXPECT_NE(std::find(found.begin(), found.end(), &command), found.end()) << key;
        }
    }
    EXPECT_TRUE(find_commands("no such words").empty());
    EXPECT_STREQ(find_commands("view top").front()->name, "Top view") << "in any order";
}

// Every entry of a menu is a command, and each command is listed by the search box with nothing typed.
TEST(Commands, AreAllInTheSearchBox) {
    Driver driver(shown_alone());
    driver.open(asset_path("cube"));
    driver.key(key_of('K'), true);
    driver.settle();
    for (const Command& command : commands())
        EXPECT_TRUE(driver.app().widgets().find(std::string("command ") + command.name)) << command.name;
    driver.key(key_escape);
    EXPECT_FALSE(driver.app().widgets().find("search commands")) << "one Escape closes it";
}

TEST(SearchBox, DoesWhatIsTyped) {
    Driver driver(shown_alone());
    driver.open(asset_path("cube"));
    driver.key(key_of('K'), true);
    driver.settle();
    driver.type("top");
    driver.key(key_enter);
    EXPECT_LT((driver.app().camera().back() - Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_FALSE(driver.app().widgets().find("search commands"));

    driver.key(key_of('K'), true);
    driver.settle();
    driver.type("view");
    const auto found = find_commands("view");
    ASSERT_GT(found.size(), 3u);
    driver.key(key_down);
    driver.key(key_down);
    driver.key(key_up);
    driver.key(key_enter);
    EXPECT_STREQ(found[1]->name, "Back view");
    EXPECT_LT((driver.app().camera().back() - Vec3::UnitY()).norm(), 1e-9) << "the second";
    EXPECT_EQ(driver.state().node, root_node) << "arrows were the box's alone";

    driver.key(key_of('K'), true);
    driver.settle();
    driver.click("command Edges");
    EXPECT_FALSE(driver.state().look.edges);
}

// A field of text keeps its letters, and Ctrl+A, but not the other keys with Ctrl.
TEST(SearchBox, OpensWhileAFieldHasTheKeyboard) {
    Driver driver;
    driver.open(asset_path("cube"));
    driver.state().panels.parameters = true;
    driver.click("parts");
    driver.key(key_of('A'), true);
    driver.key(key_of('H'));
    EXPECT_FALSE(driver.state().panels.keys);
    EXPECT_FALSE(driver.offers("search commands"));
    driver.key(key_of('K'), true);
    EXPECT_TRUE(driver.offers("search commands"));
}

TEST(SearchBox, DoesNothingThatCannotBeDone) {
    Driver driver(shown_alone());
    driver.open(asset_path("cube"));
    driver.key(key_of('K'), true);
    driver.settle();
    EXPECT_FALSE(driver.offers("command Undo the last repair"));
    driver.type("undo the last");
    driver.key(key_enter);
    EXPECT_TRUE(driver.app().session().repairs().can_repair());
    driver.key(key_escape);
    driver.key(key_of('K'), true);
    driver.settle();
    driver.type("nonsense");
    driver.key(key_enter);
    EXPECT_FALSE(driver.app().desk().wants_to_quit());
}

}  // namespace
}  // namespace kerf::test
