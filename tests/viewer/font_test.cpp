// The font of the user interface, wherever it lies, and what takes its place.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <imgui.h>

#include "support/temporary_folder.h"
#include "viewer/driver.h"
#include "viewer/panels/inside/font_file.h"

namespace kerf::test {
namespace {

// Makes fontconfig see only the fonts of one folder.
class OnlyFonts {
 public:
    explicit OnlyFonts(const std::string& file) {
        std::filesystem::create_directory(folder_.file("fonts"));
        if (!file.empty()) std::filesystem::copy_file(file, folder_.file("fonts/font.ttf"));
        std::ofstream(folder_.file("fonts.conf"))
            << "<?xml version=\"1.0\"?><fontconfig><dir>" << folder_.file("fonts") << "</dir><cachedir>"
            << folder_.file("cache") << "</cachedir></fontconfig>";
        setenv("FONTCONFIG_FILE", folder_.file("fonts.conf").c_str(), 1);
    }
    ~OnlyFonts() { unsetenv("FONTCONFIG_FILE"); }
    OnlyFonts(const OnlyFonts&) = delete;
    OnlyFonts& operator=(const OnlyFonts&) = delete;

 private:
    TemporaryFolder folder_;
};

TEST(Font, IsDejaVuSansOrWhatIsThere) {
    const std::string usual = view::find_font("DejaVu Sans").path;
    ASSERT_TRUE(usual.ends_with("/DejaVuSans.ttf")) << usual << "; install fonts-dejavu-core";
    const OnlyFonts elsewhere(usual);
    EXPECT_TRUE(view::find_font("DejaVu Sans").path.ends_with("/font.ttf"));
    EXPECT_TRUE(view::find_font("No Such Family").path.ends_with("/font.ttf"));
}

TEST(Font, IsOfTheProgramWhereThereIsNone) {
    const OnlyFonts none("");
    EXPECT_EQ(view::find_font("DejaVu Sans").path, "");
    Driver driver;
    driver.settle();
    EXPECT_GT(ImGui::GetFont()->CalcTextSizeA(15, 1e9f, 0, "Open").x, 10);
}

}  // namespace
}  // namespace kerf::test
