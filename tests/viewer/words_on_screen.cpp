#include "viewer/words_on_screen.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <imgui.h>

#include "support/places.h"

namespace kerf::test {

namespace {

using Texture = std::array<float, 4>;  // a rectangle of the atlas

struct Letter {
    const ImFontGlyph* glyph = nullptr;
    float space = 0;  // width of a blank in its font
};

std::map<Texture, Letter> letters_of_atlas() {
    std::map<Texture, Letter> letters;
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts) {
        const ImFontGlyph* blank = font->FindGlyph(' ');
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (glyph.Visible)
                letters.emplace(Texture{glyph.U0, glyph.V0, glyph.U1, glyph.V1}, Letter{&glyph, blank->AdvanceX});
    }
    return letters;
}

// Puts letters together that stand beside each other, with at most one blank between them.
class Lines {
 public:
    void add(const Letter& letter, const ImVec2& corner) {
        const float x = corner.x - letter.glyph->X0, y = corner.y - letter.glyph->Y0;
        const float gap = x - end_;
        if (lines_.empty() || std::abs(y - y_) > 0.1f || gap < -1 || gap > 1.5f * letter.space)
            lines_.emplace_back();
        else
            lines_.back().append(static_cast<std::size_t>(std::lround(gap / letter.space)), ' ');
        const unsigned code = letter.glyph->Codepoint;
        if (code < 0x80)
            lines_.back() += static_cast<char>(code);
        else
            lines_.back() += fmt::format("<{:x}>", code);
        end_ = x + letter.glyph->AdvanceX;
        y_ = y;
    }
    std::vector<std::string> take() { return std::move(lines_); }

 private:
    std::vector<std::string> lines_;
    float end_ = 0, y_ = 0;
};

// Two triangles a, a + 1, a + 2 and a, a + 2, a + 3: how ImGui draws rectangles.
bool is_rectangle(const ImDrawIdx* index) {
    const int a = index[0];
    const std::array<int, 6> pattern = {a, a + 1, a + 2, a, a + 2, a + 3};
    return std::equal(pattern.begin(), pattern.end(), index);
}

bool is_inside(const ImVec4& clip, const ImVec2& from, const ImVec2& to) {
    const float x = (from.x + to.x) / 2, y = (from.y + to.y) / 2;
    return x >= clip.x && x < clip.z && y >= clip.y && y < clip.w;
}

void add_letters(const ImDrawList& list, const ImDrawCmd& command, const std::map<Texture, Letter>& letters,
                 Lines& lines) {
    const ImDrawIdx* index = list.IdxBuffer.Data + command.IdxOffset;
    for (unsigned i = 0; i + 5 < command.ElemCount; i += is_rectangle(index + i) ? 6 : 3) {
        if (!is_rectangle(index + i)) continue;
        const ImDrawVert* first = list.VtxBuffer.Data + command.VtxOffset + index[i];
        const auto letter = letters.find({first[0].uv.x, first[0].uv.y, first[2].uv.x, first[2].uv.y});
        if (letter != letters.end() && is_inside(command.ClipRect, first[0].pos, first[2].pos))
            lines.add(letter->second, first[0].pos);
    }
}

}  // namespace

std::vector<std::string> words_on_screen() {
    const std::map<Texture, Letter> letters = letters_of_atlas();
    Lines lines;
    const ImDrawData& drawn = *ImGui::GetDrawData();
    for (int i = 0; i < drawn.CmdListsCount; ++i)
        for (const ImDrawCmd& command : drawn.CmdLists[i]->CmdBuffer)
            add_letters(*drawn.CmdLists[i], command, letters, lines);
    return lines.take();
}

testing::AssertionResult are_golden_words(const std::string& name, const std::vector<std::string>& lines) {
    const std::filesystem::path golden = fmt::format("{}/tests/golden/words/{}.txt", test::source_folder(), name);
    const std::filesystem::path folder = std::filesystem::path(test::candidate_folder()) / "words",
                                candidate = folder / fmt::format("{}.txt", name);
    std::vector<std::string> expected;
    std::ifstream file(golden);
    for (std::string line; std::getline(file, line);) expected.push_back(line);
    std::filesystem::remove(candidate);
    if (file.is_open() && lines == expected) return testing::AssertionSuccess();
    std::filesystem::create_directories(folder);
    std::ofstream(candidate) << fmt::format("{}\n", fmt::join(lines, "\n"));
    const std::size_t shared = std::min(lines.size(), expected.size());
    const auto first = static_cast<std::size_t>(
        std::mismatch(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(shared), expected.begin()).first -
        lines.begin());
    const auto line = [&](const std::vector<std::string>& all) { return first < all.size() ? all[first] : "nothing"; };
    return testing::AssertionFailure() << fmt::format("{} has '{}' in line {}, not '{}'; see {}", golden.string(),
                                                      line(expected), first + 1, line(lines), candidate.string());
}

}  // namespace kerf::test
