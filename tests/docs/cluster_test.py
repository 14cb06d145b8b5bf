#!/usr/bin/env python3
"""What docs/cluster.md says, as far as one machine can show it: Open MPI's own ways of starting on several hosts, with
programs that stand in for Slurm and ssh, give the bytes of one process; the images have the packages of packages.txt.

cluster_test.py SOURCE KERF MPIRUN
"""

import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from surroundings import environment

GROUPS = ("build", "cad", "3mf", "solve", "python")  # of packages.txt, that the images have


def check(holds, text):
    if not holds:
        sys.exit("cluster_test: " + text)


def run(folder, environ, *command):
    done = subprocess.run(command, cwd=folder, env=environ, capture_output=True, text=True, timeout=120)
    check(done.returncode == 0, f"{command} ends with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def parts(folder):
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted((folder / "parts").iterdir())}


def check_hosts(source, kerf, mpirun):
    surface, script = source / "assets/hollow_box.stl", source / "docs/cluster/kerf.slurm"
    with tempfile.TemporaryDirectory(prefix="kerf_cluster_test_") as name:
        folder = pathlib.Path(name)
        (folder / "hosts").write_text("kerftest1 slots=2\nkerftest2 slots=2\n")
        run(folder, environment(source, kerf.parent, folder), kerf, "mesh", surface, "-o", "alone", "-n", "5", "-q")
        alone = parts(folder / "alone")
        check(len(alone) == 10, f"{len(alone)} files")
        ways = {
            "Slurm": ["sbatch", script, surface, "Slurm", "-n", "5"],
            "ssh": [mpirun, "--hostfile", "hosts", "--map-by", "ppr:1:node", "--bind-to", "none", kerf, "mesh", surface,
                    "-o", "ssh", "-n", "5"],
        }
        for way, command in ways.items():
            reached = folder / f"{way}.hosts"
            log = run(folder, environment(source, kerf.parent, folder, KERF_HOSTS_REACHED=str(reached)), *command)
            check(reached.exists() and sorted(reached.read_text().split()) == ["kerftest1", "kerftest2"],
                  f"{way} has not started on two hosts")
            check("2 ranks x " in log, f"{way} has not made two ranks:\n{log}")
            check(parts(folder / way) == alone, f"parts made by way of {way} are others")


def check_images(source):
    """./run build, which makes them, asks apt-get for the packages of packages.txt, where none is installed."""
    with tempfile.TemporaryDirectory(prefix="kerf_cluster_test_") as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        stand_ins = {
            "dpkg-query": "echo not-installed",
            "apt-get": f'echo "$*" >> {folder}/asked',
            "sudo": 'while [ "$1" = -n ]; do shift; done; exec "$@"',
            "cmake": "exit 0",
        }
        for program, lines in stand_ins.items():
            (folder / "bin" / program).write_text(f"#!/bin/sh\n{lines}\n")
            (folder / "bin" / program).chmod(0o755)
        for file in ("run", "packages.txt"):
            (folder / file).write_bytes((source / file).read_bytes())
        run(folder, dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}"), "bash", "run", "build")
        asked = [word for line in (folder / "asked").read_text().splitlines() if " install " in line
                 for word in line.partition(" install ")[2].split() if not word.startswith("-")]
    listed = [word for line in (source / "packages.txt").read_text().splitlines()
              if line.split()[:1] and line.split()[0] in GROUPS for word in line.split()[1:]]
    check(sorted(asked) == sorted(listed), f"apt-get was asked for {asked}, not for {listed}")
    for recipe in ("Dockerfile", "kerf.def"):
        text = (source / "docs/cluster" / recipe).read_text()
        check(re.search(r"^\s*(RUN )?cd /opt/kerf && \./run build && cmake --install build ", text, re.M),
              f"{recipe} does not build by ./run")
        check(re.search(r"^From:? ?debian:12$", text, re.M | re.I), f"{recipe} is not of Debian 12")
        check("apt-get" not in text, f"{recipe} has packages of its own")


def main():
    source, kerf, mpirun = (pathlib.Path(argument).absolute() for argument in sys.argv[1:4])
    check_images(source.resolve())
    check_hosts(source.resolve(), kerf.resolve(), mpirun)
    print("ok")


main()
