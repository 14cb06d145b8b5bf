#!/usr/bin/env python3
"""What the pages say without being run: links and pictures lead somewhere, options and commands in the text exist, the
README is short and leads to every page, the pages are few and short, computed columns are right, and files, classes and
functions that the READMEs of the house and its wings name are there.

pages_test.py SOURCE KERF
"""

import pathlib
import re
import subprocess
import sys

WORDS_OF_README = 900
PAGES, WORDS_OF_PAGES = 11, 9600  # of docs, blocks and tables included
WORDS_OF_HOUSE, WORDS_OF_WING = 1500, 850
SOURCES = ["kernel", "solve", "viewer", "help", "cli", "python"]
BESIDE = ["solve", "viewer"]  # wings beside the kernel
OF_OTHERS = {"mpi.h", "tetgen.h", "xxhash.h"}  # headers of libraries

OPTIONS_OF_OTHERS = {  # as the text has them
    "--bind-to": "mpirun",
    "--install": "cmake",
    "--oversubscribe": "mpirun",
    "--prefix": "cmake",
    "--test-dir": "ctest",
}


class Pages:
    def __init__(self, source):
        self.source = source
        self.wings = sorted([*source.glob("kernel/*/README.md"), *(source / f"{wing}/README.md" for wing in BESIDE)])
        self.house = source / "kernel/README.md"
        paths = [*source.glob("*.md"), *source.glob("docs/**/*.md"), source / "assets/README.md", self.house,
                 *self.wings]
        self.texts = {path: path.read_text() for path in sorted(paths)}

    def prose(self, path):
        """Without blocks of commands and files."""
        return re.sub(r"^```.*?^```$", "", self.texts[path], flags=re.M | re.S)

    def name(self, path):
        return str(path.relative_to(self.source))


def anchor(heading):
    """As GitHub makes it of a heading."""
    kept = re.sub(r"[^\w\- ]", "", heading.replace("`", "").strip().lower())
    return kept.replace(" ", "-")


def anchors(text):
    return {anchor(heading) for heading in re.findall(r"^#+ (.*)$", text, re.M)}


def links(pages, path):
    """(target, file, anchor) of the links of a page that stay in the repository."""
    for target in re.findall(r"\]\(([^)\s]+)\)", pages.prose(path)):
        if not re.match(r"[a-z]+:", target):
            file, _, place = target.partition("#")
            yield target, (path.parent / file).resolve() if file else path, place


def check_links(pages):
    for path, text in pages.texts.items():
        for target, file, place in links(pages, path):
            if not file.exists():
                yield f"{pages.name(path)}: the link {target} leads nowhere"
            elif place and place not in anchors(pages.texts.get(file, "")):
                yield f"{pages.name(path)}: no heading fits to {target}"


def check_front(pages):
    readme = pages.source / "README.md"
    words = len(pages.texts[readme].split())
    if words > WORDS_OF_README:
        yield f"README.md has {words} words; {WORDS_OF_README} are the limit"
    docs = [path for path in pages.texts if pages.source / "docs" in path.parents]
    words = sum(len(pages.texts[path].split()) for path in docs)
    if len(docs) > PAGES or words > WORDS_OF_PAGES:
        yield f"docs has {len(docs)} pages and {words} words; {PAGES} and {WORDS_OF_PAGES} are the limits"
    led_to = {file for _, file, _ in links(pages, readme)}
    for path in docs:
        if path not in led_to:
            yield f"README.md does not lead to {pages.name(path)}"


def code_spans(pages, path):
    return [" ".join(span.split()) for span in re.findall(r"`([^`]+)`", pages.prose(path))]


def helps(source, kerf):
    """Names of the commands, and all that they and ./run say of themselves."""
    def help_of(*command):
        return subprocess.run([*command, "--help"], capture_output=True, text=True, check=True, timeout=60).stdout
    top = help_of(kerf)
    commands = re.findall(r"^  ([a-z][\w-]*) {2,}\S", top, re.M)
    return commands, top + "".join(help_of(kerf, command) for command in commands) + help_of(source / "run")


def check_words(pages, kerf):
    commands, text = helps(pages.source, kerf)
    known = set(re.findall(r"(?<![\w-])--[a-z][\w-]*", text))
    unused = set(OPTIONS_OF_OTHERS)
    for path in pages.texts:
        for span in code_spans(pages, path):
            for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", span):
                unused.discard(option)
                if option not in known and option not in OPTIONS_OF_OTHERS:
                    yield f"{pages.name(path)}: no command has the option of `{span}`"
            called = re.match(r"(?:build/)?kerf ([a-z][\w-]*)", span)
            if called and called[1] not in commands:
                yield f"{pages.name(path)}: there is no command `{span}`"
            made = re.match(r"\./run ([a-z]+)", span)
            if made and not re.search(rf"^  {made[1]}\b", text, re.M):
                yield f"{pages.name(path)}: ./run has no command `{span}`"
    for option in sorted(unused):
        yield f"no page speaks of {option} of {OPTIONS_OF_OTHERS[option]}"


def rows(text, heading):
    """Cells of the table below the first line that begins like this."""
    lines = text[text.index(heading):].split("\n")[2:]
    for line in lines:
        if not line.startswith("|"):
            return
        yield [cell.strip() for cell in line.strip("|").split("|")]


def check_efficiency(pages):
    """Speed-up over Kerf's own single process over the number of processes, in percent."""
    table = list(rows(pages.texts[pages.source / "docs/measurements.md"], "| processes |"))
    if len(table) < 6:
        yield "docs/measurements.md: the table of processes is too short"
    for cells in table:
        processes, _, how = cells[0].partition(", ")
        if how != ("measured" if int(processes) <= 2 else "projected"):
            yield f"docs/measurements.md: {processes} processes are not {how}"
        for column in (1, 3, 5):
            wanted = 100 * float(cells[column]) / float(table[0][column]) / int(processes)
            if abs(wanted - float(cells[column + 1].removesuffix(" %"))) > 0.51:
                yield f"docs/measurements.md: {cells[column]} with {processes} processes are {wanted:.1f} %"


def check_versions(pages, kerf):
    text = subprocess.run([kerf, "--version"], capture_output=True, text=True, timeout=60).stdout
    version = text.split()[-1]
    for name, form in (("CHANGELOG.md", rf"^## {re.escape(version)} - "),
                       ("CITATION.cff", rf"^version: {re.escape(version)}$"),
                       ("docs/output.md", rf"prints `kerf {re.escape(version)}`")):
        if not re.search(form, (pages.source / name).read_text(), re.M):
            yield f"{name} does not speak of version {version}"


def check_scripts(pages):
    for script in sorted([*pages.source.glob("docs/cluster/*.slurm"), *pages.source.glob("tests/docs/stand_ins/*")]):
        done = subprocess.run(["bash", "-n", script], capture_output=True, text=True, timeout=60)
        if done.returncode:
            yield done.stderr


def check_house(pages):
    """Short pages, and what they name is there."""
    for path in [pages.house, *pages.wings]:
        words, limit = len(pages.texts[path].split()), WORDS_OF_HOUSE if path == pages.house else WORDS_OF_WING
        if words > limit:
            yield f"{pages.name(path)} has {words} words; {limit} are the limit"
    code = "\n".join(file.read_text() for folder in SOURCES for file in (pages.source / folder).rglob("*.[ch]*"))
    words_of_code = set(re.findall(r"\w+", code))
    for path in [pages.house, *pages.wings]:
        for span in code_spans(pages, path):
            if "NAME" in span or span in OF_OTHERS:
                continue
            if re.fullmatch(r"[\w/]+\.(h|cpp|bib|txt)|[a-z]\w*(/[a-z]\w*)+", span):
                if not any((folder / span).exists() for folder in (path.parent, pages.source / "kernel", pages.source)):
                    yield f"{pages.name(path)}: there is no file `{span}`"
            elif re.fullmatch(r"[\w:]+(\(\))?", span):
                for name in re.findall(r"\w+", span):
                    if name not in words_of_code and not (pages.source / "kernel" / name).exists():
                        yield f"{pages.name(path)}: no source has the name `{span}`"


def main():
    source, kerf = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    pages = Pages(source)
    wrong = [*check_links(pages), *check_front(pages), *check_words(pages, kerf), *check_efficiency(pages),
             *check_versions(pages, kerf), *check_scripts(pages), *check_house(pages)]
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(pages.texts)} pages")


main()
