#include "files/export/inside/word_names.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

namespace kerf {

namespace {

// Characters of ASCII alone, whatever the locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_letter_or_digit(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }
bool is_allowed(char c) { return is_letter_or_digit(c) || c == '_' || c == '-'; }

std::string lower_case(std::string word) {
    for (char& c : word)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return word;
}

bool has_taken_beginning(std::string_view name, const WordRules& rules) {
    return std::any_of(rules.taken_beginnings.begin(), rules.taken_beginnings.end(),
                       [&](const std::string& taken) { return name.starts_with(taken); });
}

bool is_word(std::string_view name, const WordRules& rules) {
    return !name.empty() && name.size() <= rules.most_characters && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(), is_allowed) && !has_taken_beginning(name, rules);
}

std::string to_word(std::string_view name, const WordRules& rules) {
    std::string word;
    bool has_gap = false;
    for (const char c : name) {
        if (is_allowed(c) && (is_letter_or_digit(c) || !word.empty())) {
            if (has_gap && !word.empty()) word += '_';
            word += c;
            has_gap = false;
        } else {
            has_gap = true;
        }
    }
    if (word.empty()) return rules.kind;
    if (!is_letter(word.front()) || has_taken_beginning(word, rules)) word.insert(0, rules.kind + "_");
    return word.substr(0, rules.most_characters);
}

// The words that are taken, in the form in which the format tells them apart.
class TakenWords {
 public:
    explicit TakenWords(const WordRules& rules) : rules_(rules) {
        for (const std::string& word : rules.taken) take(word);
    }

    bool take(const std::string& word) { return taken_.insert(key(word)).second; }

    std::string take_like(const std::string& word) {
        if (take(word)) return word;
        for (std::int64_t& number = last_number_[key(word)];;) {
            const std::string ending = "_" + std::to_string(number = std::max<std::int64_t>(2, number + 1));
            const std::string other = word.substr(0, rules_.most_characters - ending.size()) + ending;
            if (take(other)) return other;
        }
    }

 private:
    std::string key(const std::string& word) const { return rules_.ignores_case ? lower_case(word) : word; }

    const WordRules& rules_;
    std::set<std::string> taken_;
    std::map<std::string, std::int64_t> last_number_;  // at the end of words like this one
};

}  // namespace

std::vector<std::string> word_names(std::span<const std::string> names, const WordRules& rules) {
    TakenWords taken(rules);
    std::vector<std::string> words(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        if (is_word(names[i], rules) && taken.take(names[i])) words[i] = names[i];
    for (std::size_t i = 0; i < names.size(); ++i)
        if (words[i].empty()) words[i] = taken.take_like(to_word(names[i], rules));
    return words;
}

std::string comment_text(std::string_view name) {
    std::string text(name);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = ' ';
    return text;
}

}  // namespace kerf
