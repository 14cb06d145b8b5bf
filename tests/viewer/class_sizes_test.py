#!/usr/bin/env python3
"""No class of the viewer has more member functions than one can know, whether they are public or not; constructors,
destructors and operators aside.

class_sizes_test.py FOLDER; with --list it prints the largest classes.
"""

import pathlib
import re
import sys

LIMIT = 25
NO_FUNCTION = re.compile(r"(using|typedef|friend|static_assert|template\s+class)\b")
TYPE = re.compile(r"\b(class|struct|union|enum)\b\s+([\w:]+)")

SAMPLE = """
namespace a {
struct Small { int x = f(1), y{2}; int get() const { return x; } };
class Large : public Base<int (*)(int)> {  // has ten
 public:
    explicit Large(int x)
        : x_{x},
          y_(x) { if (x) reset(); }
    ~Large();
    Large& operator=(const Large&) = delete;
    bool operator()(int) const { return "}{"[0] == '{'; }
    static constexpr int one() { return 1; }
    void two(std::function<void(int)> f = {}), three();
    template <class T> std::shared_ptr<const T> four(T (&x)[2]) { while (x) { } return {}; }
    virtual auto five() const noexcept -> int = 0;
    [[nodiscard]] const std::vector<int>& six() const { return v_; }
    enum class Kind { no(), yes };
    struct Inner { void not_mine(); int nor_mine() { return 0; } };
    using Call = void(int);
    friend void foreign(Large& large);
 private:
    std::function<void(int)> call_; Call* other_ = nullptr; int size_ = count(3);
    std::array<int, sizeof(int)> a_{}; struct { int z; } z_;
    void seven(); void eight(int a, int b = g(2));
    std::optional<std::function<int()>> nine(); decltype(auto) ten();
};
class Only;
}
int free_function(Large* large) { struct Local { void f(); }; return 0; }
"""


def plain(text):
    """Without comments, lines of the preprocessor, texts and characters."""
    text = re.sub(r'R"(\w*)\(.*?\)\1"', "0", text, flags=re.S)
    token = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\''
    text = re.sub(token, lambda found: " " if found[0][0] == "/" else "0", text, flags=re.S)
    return re.sub(r"^\s*#(?:[^\n]*\\\n)*[^\n]*", " ", text, flags=re.M)


def end_of_block(text, begin):
    depth = 0
    for end in range(begin, len(text)):
        depth += (text[end] == "{") - (text[end] == "}")
        if depth == 0:
            return end
    raise ValueError("a bracket is not closed: " + text[begin:begin + 80])


def without_arguments(text):
    """Without those of templates."""
    before = None
    text = text.replace("->", " ").replace("operator<", "operator ")
    while before != text:
        before, text = text, re.sub(r"<[^<>]*>", " ", text)
    return text


def declarations(text):
    """What a block declares: the words before the body, without bodies, and the body of a type or a namespace."""
    begin = at = depth = 0
    head = ""
    while at < len(text):
        letter = text[at]
        depth += (letter in "([") - (letter in ")]")
        if letter == "{":
            head += text[begin:at]
            end = end_of_block(text, at)
            begin, before, at = end + 1, at, end
            words = without_arguments(head)
            if depth == 0 and "(" not in words and re.search(r"\b(namespace|class|struct|union|enum)\b", words):
                yield words, text[before + 1:end]
                head = ""
            elif depth == 0 and "(" in words.split("=")[0] and not re.match(r"\s*[,{]", text[begin:]):
                yield words, None
                head = ""
        elif letter == ";" and depth == 0:
            yield without_arguments(head + text[begin:at]), None
            head, begin = "", at + 1
        at += 1


def functions_of(words, type_name):
    """The member functions that a declaration names."""
    words = re.sub(r"\b(public|protected|private)\s*:|\[\[.*?\]\]|\b(alignas|decltype|noexcept)\s*\([^()]*\)|"
                   r"\btemplate\b|\bexplicit\b", " ", words).strip()
    if NO_FUNCTION.match(words) or "operator" in words:
        return []
    before = None
    while before != words:  # arguments
        before, words = words, re.sub(r"\([^()]*\)", "!", words)
    words = re.sub(r"\s+:\s.*", "", words, flags=re.S)  # what a constructor initialises
    names = [re.search(r"(~?\w+)\s*!", part.split("=")[0]) for part in words.split(",")]
    return [name[1] for name in names if name and name[1].lstrip("~") != type_name]


def classes(text, name=None):
    """Of all types that a text defines their names, and the member functions that each declares."""
    own = []
    for words, block in declarations(text):
        if block is None:
            own += functions_of(words, name) if name else []
            continue
        kind = TYPE.search(words)
        if "namespace" in words:
            yield from classes(block)
        elif not re.search(r"\benum\b", words):
            yield from classes(block, kind[2].split("::")[-1] if kind else "of no name")
    if name:
        yield name, own


def main():
    sample = dict(classes(plain(SAMPLE)))
    expected = "one two three four five six seven eight nine ten".split()
    assert sample["Large"] == expected, f"of the sample are counted {sample}"
    assert sample["Small"] == ["get"] and len(sample["Inner"]) == 2, f"of the sample are counted {sample}"
    found = []
    for path in sorted(pathlib.Path(sys.argv[1]).rglob("*.*")):
        if path.suffix in (".h", ".cpp"):
            found += [(len(own), name, path) for name, own in classes(plain(path.read_text()))]
    found.sort(key=lambda row: -row[0])
    assert len(found) > 100, f"{sys.argv[1]} has {len(found)} classes"
    for count, name, path in found if "--list" in sys.argv else []:
        print(f"{count:4} {name} ({path})")
    too_large = [f"{name} ({path}) has {count} member functions" for count, name, path in found if count > LIMIT]
    sys.exit("\n".join(too_large + [f"Divide by what its parts know: at most {LIMIT}."]) if too_large else 0)


main()
