#include "files/io/inside/text_scanner.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace kerf {
namespace {

std::string digits_by_chance(std::mt19937& random, std::size_t most) {
    std::string digits;
    for (std::size_t left = random() % (most + 1); left > 0; --left) digits += static_cast<char>('0' + random() % 10);
    return digits;
}

// A number as programs write it, in all its shapes.
std::string number_by_chance(std::mt19937& random) {
    const char* signs[] = {"", "-", "+"};
    std::string number = signs[random() % 3];
    const std::string whole = digits_by_chance(random, 20), fraction = digits_by_chance(random, 25);
    number += whole.empty() && fraction.empty() ? "7" : whole;
    if (!fraction.empty() || random() % 2) number += "." + fraction;
    if (random() % 2)
        number += (random() % 2 ? "e" : "E") + std::string(signs[random() % 3]) + std::to_string(random() % 330);
    return number;
}

TEST(TextScanner, ReadsNumbersAsTheLibraryOfCDoes) {
    std::mt19937 random(3);
    std::string text;
    std::vector<std::string> numbers;
    for (int i = 0; i < 20000; ++i) {
        const char* gaps[] = {" ", "\t", "\n", "\r\n", " \f\v ", "#comment 5\n", " # 5\r"};
        numbers.push_back(number_by_chance(random));
        text += numbers.back() + gaps[random() % 7];
    }
    const std::string path = "numbers";
    TextScanner scanner(text, path, '#');
    for (const std::string& number : numbers) {
        const double expected = std::strtod(number.c_str(), nullptr), value = scanner.next_real();
        ASSERT_EQ(value, expected) << number;
        ASSERT_EQ(std::signbit(value), std::signbit(expected)) << number;
        ASSERT_EQ(scanner.to_real(number), value) << number;
    }
    EXPECT_TRUE(scanner.at_end());
}

TEST(TextScanner, ReadsWholeNumbersAsWordsSay) {
    std::mt19937_64 random(4);
    std::string text;
    std::vector<std::int64_t> numbers;
    for (int i = 0; i < 5000; ++i) {
        numbers.push_back(static_cast<std::int64_t>(random()) >> (random() % 64));
        const std::string sign = numbers.back() >= 0 && random() % 3 == 0 ? "+" : "";
        const char* tails[] = {" ", "\n", "/ ", "/7/x\t", "//-2\r\n", "#3\n"};
        text += sign + std::to_string(numbers.back()) + tails[random() % 6];
    }
    const std::string path = "numbers";
    TextScanner scanner(text, path, '#');
    for (const std::int64_t number : numbers) ASSERT_EQ(scanner.next_integer_before('/'), number);
    EXPECT_TRUE(scanner.at_end());
}

std::string message_of_word(const std::string& word, bool is_whole) {
    const std::string text = "1\r\n2\r3\n " + word + " 5", path = "file";
    TextScanner scanner(text, path);
    for (int i = 0; i < 3; ++i) scanner.next_word();
    try {
        is_whole ? static_cast<double>(scanner.next_integer()) : scanner.next_real();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(TextScanner, RefusesWhatIsNoNumberWithItsLine) {
    for (const char* word : {"1.5x", "--1", "+-1",   "++1", "-",    "+",      ".",     "e5",  "1e",       "1e+",
                             "0x10", "1,5", "1.2.3", "1#2", "nan(", "nan(1 ", "infin", "5/6", "\xC3\xBC", "1\x01"}) {
        const std::string first = std::string(word).substr(0, std::string_view(word).find(' '));
        EXPECT_EQ(message_of_word(word, false), "file, line 4: a number is expected, not \"" + first +
                                                    "\". Correct the line or export the surface again.");
    }
    for (const char* word : {"1.0", "1e3", "x", "-", "+-1", "5/6", "nan"})
        EXPECT_EQ(message_of_word(word, true), "file, line 4: a whole number is expected, not \"" + std::string(word) +
                                                   "\". Correct the line or export the surface again.");
    EXPECT_EQ(message_of_word("9223372036854775808", true),
              "file, line 4: the number \"9223372036854775808\" is too large. Correct the line or export the surface "
              "again.");
    EXPECT_EQ(message_of_word("-9223372036854775808", true), "");
}

TEST(TextScanner, TakesNumbersUpToTheEndOfTheTextAndNoFurther) {
    const std::string text = "12 3456", path = "file";
    for (std::size_t size = 0; size <= text.size(); ++size) {
        TextScanner scanner(std::string_view(text).substr(0, size), path);
        if (size == 0 || size == 3) {
            if (size == 3) scanner.next_real();
            EXPECT_THROW(scanner.next_real(), Error);
            continue;
        }
        EXPECT_EQ(scanner.next_real(), size == 1 ? 1 : 12);
        if (size > 3) {
            EXPECT_EQ(scanner.next_integer(), std::stoi(text.substr(3, size - 3)));
        }
        EXPECT_TRUE(scanner.at_end());
    }
}

}  // namespace
}  // namespace kerf
