#!/usr/bin/env python3
"""The commands of one page are run as they stand there, so that no page goes stale.

commands_test.py SOURCE BUILD PAGE

Every line of a ```sh block is a command, a backslash joins lines. They run in order in one folder of temporary files,
in which `assets`, `docs` and `build` are those of Kerf, and which has the files that pages speak of, see prepare(). Each
has to end with 0, or with N where its comment says `# exit N`. What takes too long is shortened by SHORTENED, and what
cannot be run is named, with the reason, in NOT_RUN: an entry of either that fits to no command of its page is an error.

Programs stand in for Slurm and ssh (stand_ins). `kerf view` has to come as far as to miss a display.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from surroundings import environment

PATIENCE = 120  # seconds for each command

SHORTENED = {
    "README.md": [("-n 8 --size 1%", "-n 8 --size 2%")],
    "docs/first_steps.md": [("-n 8 --size 1%", "-n 8 --size 3%"), ("--cells 200k", "--cells 40k")],
    "docs/solvers.md": [("--adapt 2", "--adapt 1")],
    "docs/cluster.md": [("-n 16 --size 2%", "-n 8")],
    # Interrupted when the first of many parts is done.
    "docs/options.md": [(
        "kerf mesh part.stl -o big --size 0.5 --memory 2G --events progress.jsonl",
        "kerf mesh part.stl -o big --size 0.05 -n 24 -j 1 --memory 2G --events progress.jsonl & "
        "until grep -q '\"done\"' progress.jsonl; do sleep 0.02; done; kill $!; wait $! || test $? = 130")],
}

NOT_RUN = {
    "README.md": {"./run build": "builds"},
    "docs/first_steps.md": {"./run demo": "builds"},
    "docs/cluster.md": {
        "git archive HEAD | docker build -t kerf -f docs/cluster/Dockerfile -": "loads Debian",
        'docker run --rm -v "$PWD:$PWD" -w "$PWD" kerf mesh part.stl -o out -n 8': "needs the image",
        "git archive -o kerf.tar HEAD && apptainer build kerf.sif docs/cluster/kerf.def": "loads Debian",
        "mpirun --bind-to none -n 2 apptainer run kerf.sif mesh part.stl -o out -n 8": "needs the image",
    },
    "docs/developing.md": {
        "./run test": "runs this",
        "ctest --test-dir build -N -R Contour": "would write into the log of the run that it is in",
        ".ci/run": "is all that has to pass",
    },
}


def fail(text):
    sys.exit("commands_test: " + text)


def commands(text):
    """Of all blocks, with a line each."""
    for block in re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S):
        for command in block.replace("\\\n", " ").split("\n"):
            if command.strip():
                yield command.strip()


def bare(command):
    """Without its comment."""
    return re.sub(r"\s+#.*$", "", command)


def without_last_facet(stl):
    """The bytes of a binary STL file that lacks a facet."""
    facets = int.from_bytes(stl[80:84], "little") - 1
    return stl[:80] + facets.to_bytes(4, "little") + stl[84:84 + 50 * facets]


def prepare(folder, source, build, text):
    for name in ("assets", "kernel", "run"):
        (folder / name).symlink_to(source / name)
    shutil.copytree(source / "docs", folder / "docs")  # programs write beside what they read
    (folder / "build").symlink_to(build)
    shutil.copy(source / "assets/cylinder.stl", folder / "part.stl")
    (folder / "open.stl").write_bytes(without_last_facet((folder / "part.stl").read_bytes()))
    (folder / "hosts").write_text("kerftest1 slots=2\nkerftest2 slots=2\n")
    # Debian's interpreter has Debian's packages.
    (folder / "bin").mkdir()
    (folder / "tmp").mkdir()
    (folder / "bin/python3").symlink_to("/usr/bin/python3")
    if "part.step" in text:  # a box of 10 x 6 x 4
        (folder / "box.geo").write_text(
            'SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 10, 6, 4}; Save "part.step";\n')
        subprocess.run(["gmsh", "-0", "box.geo"], cwd=folder, check=True, capture_output=True, timeout=PATIENCE)


def shortened(command, rules, used):
    for k, (old, new) in enumerate(rules):
        if old in command:
            used.add(k)
            command = command.replace(old, new)
    return command


def known_to_run(source, command):
    """What is not run is at least a command of ./run."""
    words = command.split()
    if words[0] != "./run":
        return True
    text = subprocess.run([source / "run", "help"], capture_output=True, text=True, timeout=PATIENCE).stdout
    return re.search(rf"^  {re.escape(words[1])}\b", text, re.M) is not None


def run(command, wanted, folder, environ):
    """What is wrong, or None."""
    start = time.monotonic()
    try:
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=environ, capture_output=True,
                              text=True, errors="replace", stdin=subprocess.DEVNULL, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return f"takes more than {PATIENCE} s"
    print(f"{time.monotonic() - start:6.2f} s  {command}", flush=True)
    if command.startswith("kerf view"):
        named = bare(command).split()[2]
        if not (folder / named).exists():
            return f"there is no {named}"
        said = done.returncode == 7 and "There is no display" in done.stderr
        return None if said else f"ends with {done.returncode}, not for want of a display:\n{done.stderr}"
    if done.returncode != wanted:
        return f"ends with {done.returncode}, not {wanted}:\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    return None


def main():
    source, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    page = sys.argv[3]
    text = (source / page).read_text()
    not_run, rules, used, passed_over = NOT_RUN.get(page, {}), SHORTENED.get(page, []), set(), set()
    wrong, count = [], 0
    with tempfile.TemporaryDirectory(prefix="kerf_docs_test_") as name:
        folder = pathlib.Path(name)
        prepare(folder, source, build, text)
        environ = environment(source, build, folder / "tmp")
        environ["PATH"] = f"{folder}/bin:" + environ["PATH"]
        for command in commands(text):
            if bare(command) in not_run:
                passed_over.add(bare(command))
                if not known_to_run(source, bare(command)):
                    wrong.append(f"{page}: {command}\n./run does not know it")
                continue
            if exported := re.fullmatch(r"export (\w+)=(\S+)", bare(command)):  # for the commands that follow
                environ[exported[1]] = exported[2].replace("$PATH", environ["PATH"]).replace("$PWD", str(folder))
                continue
            code = re.search(r"# exit (\d+)", command)
            problem = run(shortened(command, rules, used), int(code[1]) if code else 0, folder, environ)
            count += 1
            if problem:
                wrong.append(f"{page}: {command}\n{problem}")
    if not count:
        wrong.append(f"{page} has no command that is run")
    wrong += [f"{page} has no command {command!r} of NOT_RUN" for command in not_run if command not in passed_over]
    wrong += [f"{page} has no command with {old!r} of SHORTENED" for k, (old, _) in enumerate(rules) if k not in used]
    if wrong:
        fail("\n".join(wrong))
    print(f"{page}: {count} commands")


main()
