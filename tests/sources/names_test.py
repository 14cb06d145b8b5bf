#!/usr/bin/env python3
"""Names are written as .clang-tidy says under readability-identifier-naming, told by Universal Ctags.

names_test.py ROOT; with --self-test in its place a small source with a name against each rule must be refused, and a
good one must not.

clang-tidy compiles every source for that, which takes minutes; ctags reads them in a second, but guesses where only a
compiler knows. What it takes for a declaration and is none is told by what a declaration must have (is_declaration).
Parameters of templates have no rule, nor have constants one of their own: they are called as variables are.
"""

import collections
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FOLDERS = ("kernel", "solve", "cli", "help", "viewer", "python")
# They belong to libraries: what is declared in them is called as the library wants it.
FOREIGN = ("std", "CLI", "pybind11")

LOWER_CASE = re.compile(r"[a-z]([a-z0-9_]*[a-z0-9])?")
LOWER_CASE_ = re.compile(r"[a-z]([a-z0-9_]*[a-z0-9])?_")
CAMEL_CASE = re.compile(r"[A-Z][a-zA-Z0-9]*")
RULES = {
    "namespace": (LOWER_CASE, "namespaces are lower_case"),
    "class": (CAMEL_CASE, "classes are CamelCase"),
    "struct": (CAMEL_CASE, "structs are CamelCase"),
    "union": (CAMEL_CASE, "unions are CamelCase"),
    "enum": (CAMEL_CASE, "enums are CamelCase"),
    "typedef": (CAMEL_CASE, "type aliases are CamelCase"),
    "function": (LOWER_CASE, "functions are lower_case"),
    "prototype": (LOWER_CASE, "functions are lower_case"),
    "variable": (LOWER_CASE, "variables are lower_case"),
    "externvar": (LOWER_CASE, "variables are lower_case"),
    "local": (LOWER_CASE, "variables are lower_case"),
    "parameter": (LOWER_CASE, "parameters are lower_case"),
    "enumerator": (LOWER_CASE, "enumerators are lower_case"),
    "member": (LOWER_CASE, "public and static members are lower_case, without _ at the end"),
    "private": (LOWER_CASE_, "private and protected members are lower_case with _ at the end"),
}
TOKENS = re.compile(r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.S)
BINDING = re.compile(r"\bauto\s*(?:const\s*)?&{0,2}\s*\[([^\[\]]*)\]\s*[=:({]")

# Each line that ends with a name in a comment declares it against a rule.
BAD = """
namespace Outer {  // Outer
class lower_class {  // lower_class
 public:
    int with_end_;  // with_end_
    int camelMember = 1;  // camelMember
    static constexpr int LIMIT = 2;  // LIMIT
    void doIt() const;  // doIt
 protected:
    int inherited = 0;  // inherited
 private:
    std::vector<int> no_end;  // no_end
    int Capital_ = 0;  // Capital_
    static constexpr int most_ = 2;  // most_
    void helper_();  // helper_
};
struct lower_struct {};  // lower_struct
union lower_union { int a; double b; };  // lower_union
enum class lower_enum {  // lower_enum
    one,
    Two,  // Two
    kThree = 3  // kThree
};
using lower_alias = int;  // lower_alias
typedef int lower_typedef;  // lower_typedef
template <class T>
using With_Underscore = std::vector<T>;  // With_Underscore
extern int Global;  // Global
constexpr double kPi = 3.14;  // kPi
int Function(int x) { return x; }  // Function
auto Trailing() -> int { return 1; }  // Trailing
template <class T>
T OfTemplate(T x);  // OfTemplate
void given(int Given,  // Given
           const std::map<int, int>& given_) {  // given_
    int Local = 1;  // Local
    const std::vector<int> Braces{1, 2};  // Braces
    std::string Round(3, 'x');  // Round
    for (int I = 0; I < 3; ++I) {}  // I
    for (const auto& Item : given_) {}  // Item
    const auto [first, Second] = pair();  // Second
    for (auto& [Key,  // Key
                value] : given_) {}
    std::for_each(begin, end, [&](int Element) {  // Element
        const int Inside = 1;  // Inside
    });
    try {
    } catch (const Error& E) {  // E
    }
    struct inner {};  // inner
}
}
"""

# What ctags takes for names against the rules, and what is well called.
GOOD = """
namespace CLI {
class app_of_another;
}
namespace std {
template <>
struct hash<kerf::Id> { std::size_t operator()(kerf::Id id) const; };
}
namespace kerf::of_two {
namespace {
PYBIND11_MODULE(_kerf, module) { module.attr("x") = 1; }
struct Traits : OpenMesh::DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::None);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
};
template <class T, std::size_t Size, bool Panels::*Panel>
class Sized final : public Base<T> {
 public:
    using Point = Eigen::Matrix<T, 3, 1>;
    enum class Kind { one, two_of_them };
    Sized() = default;
    explicit Sized(T x) : x_{x}, y_(x) {}
    ~Sized();
    Sized& operator=(const Sized&) = delete;
    bool operator()(OptionField::Memory) const { return "}{"[0] == '{'; }
    operator double() const { return 1'000'000.5; }
    static constexpr int limit = 1;
    T public_member = {};
    friend bool operator==(const Sized&, const Sized&) = default;
    template <class U>
    void each(U&& visit) const { visit(this->x_); }
 private:
    static constexpr T most = Size;
    static inline std::mutex mutex;
    T x_, y_ = most;
    std::array<int, Size> a_{};
    std::function<void(int)> call_;
};
template <class T, std::size_t Size, bool Panels::*Panel>
Sized<T, Size, Panel>::~Sized() {}
const char* text = R"(int NotAName;)";  // int NorThis;
void toggle(Context& context, Dialogs& /*dialogs*/, CLI::AppFormatMode) {
    context.panels.*Panel = !(context.panels.*Panel);
    const Handle(Poly_Triangulation) triangles = BRep_Tool::Triangulation(face, place);
    struct stat told {};
    const auto& [first, second_1] = pair();
    for (const auto [x, y] : pairs) Other::Use(x, y);
    const auto last = items[Index(x)] * Factor;
    int rows = 0, columns = static_cast<int>(Large);
    if (const auto* found = find(Text("a")); found && *found < Limit) return;
    static const std::map<int, int> names = {{1, Large}};
    [[maybe_unused]] const int none{};
    context.run([&, size = rows](const auto& one, auto&&... all) { return Type::Make(one, all...) + size; });
}
}
}
"""


def plain(text):
    """Without comments, texts and characters, with as many lines."""
    return TOKENS.sub(lambda found: " " + "\n" * found[0].count("\n"), text)


def ctags():
    for name in ("ctags-universal", "ctags"):
        program = shutil.which(name)
        version = [program, "--version"]
        if program and "Universal Ctags" in subprocess.run(version, capture_output=True, text=True).stdout:
            return program
    print("There is no Universal Ctags (package universal-ctags), by which names are found.")
    sys.exit(77)


def tags_of(root, files):
    """What ctags finds, as dictionaries."""
    command = [ctags(), "--options=NONE", "--quiet", "--languages=C++", "--langmap=C++:+.h", "--kinds-C++=+lpxz-d",
               "--fields=+aKSnE", "--fields-C++=+{properties}", "--output-format=json", "--sort=no", "-L", "-",
               "-o", "-"]
    found = subprocess.run(command, cwd=root, input="\n".join(files), capture_output=True, text=True, timeout=50)
    if found.returncode:
        sys.exit(f"ctags ended with {found.returncode}: {found.stderr}")
    tags = [json.loads(line) for line in found.stdout.splitlines()]
    return [tag for tag in tags if tag["_type"] == "tag" and not tag["name"].startswith("__anon")]


def is_declaration(tag, line):
    """Whether it is one to the compiler, too, and its name one that can be chosen.

    A function without a type is called as its class is, or a macro is taken for one; operators have no other name. A
    variable has a whole type: one that ends within a name of several parts or with the access to a member is part of
    an expression or the type of a parameter without a name, and one that only says `const` stands before a macro. With
    `struct stat told {}` no struct `told` is declared."""
    kind, name, type_name = tag["kind"], tag["name"], tag.get("typeref", "").removeprefix("typename:")
    if not re.match(r"\w", name) or name.startswith("operator"):
        return False
    if kind in ("function", "prototype"):
        return bool(type_name)
    if kind in ("local", "variable", "externvar", "parameter", "member"):
        is_part = re.search(r"(::|\.|->|\.\*|->\*)\s*$", type_name)
        return not is_part and type_name not in ("const", "static", "constexpr")
    if kind in ("struct", "class", "union", "enum"):
        return not re.search(rf"\b(?:struct|union|enum|class)\s+(?!class\b|struct\b|alignas\b)\w+\s+{name}\b", line)
    return True


def rule_of(tag):
    is_static = "static" in tag.get("properties", "").split(",")
    if tag["kind"] == "member" and tag.get("access") in ("private", "protected") and not is_static:
        return RULES["private"]
    return RULES.get(tag["kind"])


def is_foreign(tag):
    names = tag.get("scope", "").split("::") + ([tag["name"]] if tag["kind"] == "namespace" else [])
    return any(name in FOREIGN for name in names)


def bindings(text):
    """The names of structured bindings and their lines, which ctags does not tell."""
    for found in BINDING.finditer(text):
        for name in re.finditer(r"\w+", found[1]):
            yield text.count("\n", 0, found.start(1) + name.start()) + 1, name[0]


def check(root, files):
    """How many names there are, and (file, line, name, rule) of those against a rule."""
    lines = {file: plain((root / file).read_text()).split("\n") for file in files}
    names = [(tag["path"], tag["line"], tag["name"], rule_of(tag)) for tag in tags_of(root, files)
             if not is_foreign(tag) and is_declaration(tag, lines[tag["path"]][tag["line"] - 1])]
    for file in files:
        names += [(file, line, name, RULES["local"]) for line, name in bindings("\n".join(lines[file]))]
    bad = {(file, line, name, rule[1]) for file, line, name, rule in names if rule and not rule[0].fullmatch(name)}
    return len(names), sorted(bad)


def self_test():
    with tempfile.TemporaryDirectory(prefix="kerf_names_") as folder:
        root = pathlib.Path(folder)
        (root / "bad.cpp").write_text(BAD)
        (root / "good.h").write_text(GOOD)
        expected = collections.Counter()
        for number, line in enumerate(BAD.split("\n"), 1):
            if "// " in line:
                expected[("bad.cpp", number, line.split("// ")[1])] += 1
        _, bad = check(root, ["bad.cpp", "good.h"])
    found = collections.Counter(row[:3] for row in bad)
    wrong = [f"is not found: {row}" for row in expected - found] + [f"is found: {row}" for row in found - expected]
    unused = {rule[1] for rule in RULES.values()} - {row[3] for row in bad}
    sys.exit("\n".join(wrong + [f"is not tried: {rule}" for rule in unused]) or 0)


def main():
    if "--self-test" in sys.argv:
        self_test()
    root = pathlib.Path(sys.argv[1])
    files = sorted(str(path.relative_to(root)) for folder in FOLDERS for path in (root / folder).rglob("*.*")
                   if path.suffix in (".h", ".cpp"))
    count, bad = check(root, files)
    if not files or count < 10 * len(files):  # then ctags has not read them
        sys.exit(f"{len(files)} files of {root} have {count} names")
    print(f"{count} names in {len(files)} files")
    sys.exit("\n".join(f"{file}:{line}: {name}: {rule}" for file, line, name, rule in bad) or 0)


main()
