// The words of a picture, exactly, where its pixels are compared with a tolerance.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace kerf::test {

/// Every text that Dear ImGui drew in the last frame and that is in sight, in the order of drawing: read from the
/// rectangles of the letters, so that nothing that is drawn can be forgotten. What is cut off at a border lacks
/// letters.
std::vector<std::string> words_on_screen();

/// Whether tests/golden/words/NAME.txt has these lines. If not, the candidate is left beside those of the pictures
/// (golden_image.h).
testing::AssertionResult are_golden_words(const std::string& name, const std::vector<std::string>& lines);

}  // namespace kerf::test
