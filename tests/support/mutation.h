// Damage as files suffer it, by a seed.
#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <string_view>

namespace kerf::test {

/// One to four times: a byte, a bit or a digit changed, a piece cut out, repeated or taken from `donor`, or a number
/// written over another.
inline std::string mutate(std::string bytes, const std::string& donor, unsigned seed) {
    constexpr std::array<std::string_view, 12> words = {
        "nan", "-inf", "1e999", "1e-400", "-1", "0", "1", "3", "4000", "2147483648", "99999999999999999999", "\n"};
    constexpr std::string_view digits = "0123456789";
    std::mt19937 random(seed);
    const auto below = [&](std::size_t limit) { return random() % std::max<std::size_t>(1, limit); };
    const auto piece = [&](std::size_t size) {
        return 1 + below(std::min<std::size_t>(size, random() % 4 ? 20 : 2000));
    };
    for (std::size_t times = 1 + below(4); times > 0; --times) {
        const std::size_t at = below(bytes.size());
        switch (random() % 7) {
            case 0:
                if (!bytes.empty()) bytes[at] = static_cast<char>(random());
                break;
            case 1:
                if (!bytes.empty()) bytes[at] ^= static_cast<char>(1 << random() % 8);
                break;
            case 2:
                bytes.erase(at, piece(bytes.size()));
                break;
            case 3:
                bytes.insert(at, bytes.substr(below(bytes.size()), piece(bytes.size())));
                break;
            case 4:
                bytes.insert(at, donor.substr(below(donor.size()), piece(donor.size())));
                break;
            case 5:
                if (const std::size_t digit = bytes.find_first_of(digits, at); digit != bytes.npos)
                    bytes[digit] = digits[below(digits.size())];
                break;
            default:
                const std::size_t begin = std::min(bytes.find_first_of(digits, at), bytes.size());
                const std::size_t end = bytes.find_first_not_of("0123456789.e-", begin);
                bytes.replace(begin, end == bytes.npos ? end : end - begin, words[below(words.size())]);
        }
    }
    return bytes;
}

}  // namespace kerf::test
