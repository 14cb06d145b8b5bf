#!/usr/bin/env python3
"""The real window on a virtual display: it starts, answers a mouse click and keys, shows the same picture as
`kerf screenshot`, remembers its size, and closes with code 0. And without a display it says so.

window_test.py KERF SURFACE; needs Xvfb and xdotool.
"""

import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

PATIENCE = 60  # seconds for each step


def await_value(what, value):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        result = value()
        if result:
            return result
        time.sleep(0.1)
    sys.exit(f"waited in vain for {what}")


def start_display(folder):
    """Xvfb chooses a free number and tells it."""
    read, write = os.pipe()
    log = open(folder / "xvfb.log", "w")
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1400x900x24", "-nolisten", "tcp"],
        pass_fds=[write], stderr=log, stdout=log)
    os.close(write)
    number = b""
    while not number.endswith(b"\n"):
        more = os.read(read, 16)
        if not more:
            sys.exit("Xvfb does not start:\n" + (folder / "xvfb.log").read_text())
        number += more
    return server, ":" + number.decode().strip()


def check_without_display(kerf):
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([kerf, "view"], env=environment, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 7, done
    assert "display" in done.stderr and "kerf screenshot" in done.stderr, done.stderr


def xdotool(environment, *arguments):
    return subprocess.run(["xdotool", *arguments], env=environment, capture_output=True, text=True,
                          timeout=PATIENCE).stdout.split()


def press(environment, key):
    """As short as xdotool does it: down and up may fall into one frame."""
    xdotool(environment, "key", key)
    time.sleep(0.5)


def size_of_png(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


def take_picture(environment, folder, number):
    press(environment, "F12")
    state = folder / f"kerf-{number:03}.json"
    await_value(f"{state}", state.exists)
    time.sleep(0.2)
    return folder / f"kerf-{number:03}.png", json.loads(state.read_text())


def main():
    kerf, surface = (str(pathlib.Path(argument).resolve()) for argument in sys.argv[1:3])
    check_without_display(kerf)
    with tempfile.TemporaryDirectory(prefix="kerf_window_test_") as name:
        folder = pathlib.Path(name)
        server, display = start_display(folder)
        viewer = None
        try:
            run = folder / "run"
            subprocess.run([kerf, "mesh", surface, "-o", run, "-n", "4", "-q"], check=True, timeout=PATIENCE)
            # As large as it was last, but no larger than the screen.
            settings = folder / "kerf" / "viewer.json"
            settings.parent.mkdir()
            settings.write_text(json.dumps({"window": {"width": 2480, "height": 5000, "scale": 2}}))
            environment = dict(os.environ, DISPLAY=display, XDG_CONFIG_HOME=str(folder), LIBGL_ALWAYS_SOFTWARE="1")
            viewer = subprocess.Popen([kerf, "view", str(run), "--stage", "tetrahedra"], env=environment, cwd=folder)
            window = await_value("the window", lambda: xdotool(environment, "search", "--onlyvisible", "--name",
                                                               "run - Kerf"))[0]
            time.sleep(1)
            xdotool(environment, "mousemove", "--window", window, "640", "380")
            time.sleep(0.3)
            xdotool(environment, "mousedown", "1")
            time.sleep(0.3)
            xdotool(environment, "mouseup", "1")
            time.sleep(0.5)
            picture, clicked = take_picture(environment, folder, 1)
            assert clicked["selection"]["kind"] == "facet", clicked
            assert clicked["stage"] == "tetrahedra", clicked
            xdotool(environment, "key", "--delay", "3", "Left", "Left")  # with the same time GLFW takes them for one
            time.sleep(0.5)
            _, stepped = take_picture(environment, folder, 2)
            assert stepped["stage"] == "plane", stepped

            assert size_of_png(picture) == (1240, 900), size_of_png(picture)
            subprocess.run([kerf, "screenshot", run, "--state", folder / "kerf-001.json", "--resolution", "1240x900", "-o",
                            folder / "offscreen.png"], check=True, timeout=PATIENCE)
            assert picture.read_bytes() == (folder / "offscreen.png").read_bytes(), "window and screenshot differ"

            xdotool(environment, "windowsize", "--sync", window, "1100", "700")
            time.sleep(0.5)
            xdotool(environment, "key", "--delay", "3", "ctrl+q")
            assert viewer.wait(PATIENCE) == 0, viewer.returncode
            kept = json.loads(settings.read_text())["window"]
            assert kept == {"width": 1100, "height": 700, "scale": 1}, kept
        finally:
            for process in (viewer, server):
                if process and process.poll() is None:
                    process.terminate()
                    process.wait(PATIENCE)
    print("ok")


main()
