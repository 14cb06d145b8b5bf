#include "files/threemf/inside/placed_objects.h"

#include <algorithm>
#include <map>

namespace kerf {

namespace {

constexpr std::uint64_t most_objects = std::uint64_t{1} << 32;
constexpr std::string_view blanks = " \t\r\n";

// Walks over the elements of a text.
class XmlTags {
 public:
    explicit XmlTags(std::string_view text) : text_(text) {}

    // Moves to the next element, the text between its brackets, past comments. Returns false at the end.
    bool next() {
        for (;;) {
            const std::size_t begin = text_.find('<');
            if (begin == text_.npos) return false;
            text_.remove_prefix(begin + 1);
            if (text_.starts_with("!--")) {
                text_.remove_prefix(std::min(text_.find("-->"), text_.size()));
                continue;
            }
            tag_ = text_.substr(0, text_.find('>'));
            return true;
        }
    }
    // Returns the name of the element without the prefix of a namespace.
    std::string_view name() const {
        const std::string_view name = tag_.substr(0, tag_.find_first_of(" \t\r\n/", 1));
        const std::size_t colon = name.find(':');
        return colon == name.npos || name.starts_with('/') ? name : name.substr(colon + 1);
    }
    // Returns the value of an attribute, empty if there is none of this name.
    std::string_view attribute(std::string_view name) const {
        for (std::size_t at = tag_.find(name); at != tag_.npos; at = tag_.find(name, at + 1)) {
            if (at == 0 || blanks.find(tag_[at - 1]) == blanks.npos) continue;
            std::string_view rest = after_blanks(tag_.substr(at + name.size()));
            if (!rest.starts_with('=')) continue;
            rest = after_blanks(rest.substr(1));
            if (rest.empty() || (rest.front() != '"' && rest.front() != '\'')) continue;
            return rest.substr(1, rest.find(rest.front(), 1) - 1);
        }
        return {};
    }

 private:
    static std::string_view after_blanks(std::string_view text) {
        return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
    }
    std::string_view text_, tag_;
};

}  // namespace

PlacedObjects count_placed_objects(std::string_view model) {
    std::map<std::string_view, PlacedObjects> objects;  // by their numbers
    PlacedObjects all;
    std::string_view current;
    const auto add = [&](PlacedObjects& to, std::string_view number, int own_level) {
        const auto found = objects.find(number);
        const PlacedObjects one = found == objects.end() ? PlacedObjects{1, 1} : found->second;
        to.objects = std::min(to.objects + one.objects, most_objects);
        to.levels = std::max(to.levels, one.levels + own_level);
    };
    for (XmlTags tags(model); tags.next();) {
        const std::string_view name = tags.name();
        if (name == "object")
            objects[current = tags.attribute("id")] = {1, 1};
        else if (name == "component")
            add(objects[current], tags.attribute("objectid"), 1);
        else if (name == "item")
            add(all, tags.attribute("objectid"), 0);
    }
    return all;
}

}  // namespace kerf
