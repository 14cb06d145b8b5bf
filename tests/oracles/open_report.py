"""Opens the page of kerf report in Chromium without a window and a network, and looks at what it draws: turned,
clipped, moved apart, coarser, with a part picked.

usage: python3 open_report.py RUN PAGE.html FAILED.html FOLDER

FAILED.html is the page of a run with parts that could not be meshed. Writes files into FOLDER. Prints how many laws
held; the exit code is 1 if one did not.
"""

import html.parser
import json
import pathlib
import re
import subprocess
import sys

MOST_BYTES = 5_000_000
BROWSER = ["chromium", "--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu-sandbox",
           "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1280,1000",
           "--virtual-time-budget=20000", "--enable-logging=stderr", "--dump-dom"]
MIDDLE = "400,280"  # of the picture


class Broken(Exception):
    pass


def require(holds, law):
    if not holds:
        raise Broken(law)
    require.count += 1


require.count = 0


def without_network():
    """What a command begins with that sees no network, where the system allows that."""
    for command in (["unshare", "-n"], ["unshare", "-rn"]):
        if subprocess.run([*command, "true"], capture_output=True).returncode == 0:
            return command
    return []


class Dom(html.parser.HTMLParser):
    """What the page says of itself once its scripts have run."""

    def __init__(self, text):
        super().__init__()
        self.body, self.tags, self.rows, self.verdict = {}, [], [], ""
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        if tag == "body":
            self.body = {name[5:]: value for name, value in attributes.items() if name.startswith("data-")}
        if attributes.get("id") == "verdict":
            self.verdict = attributes.get("class")
        if tag == "tr" and "data-row" in attributes:
            self.rows.append((int(attributes["data-row"]), "chosen" in (attributes.get("class") or "")))


class Browser:
    def __init__(self, page, folder):
        self.page, self.folder = page, folder
        self.prefix = without_network()

    def open(self, view):
        command = [*self.prefix, *BROWSER, f"--user-data-dir={self.folder / 'profile'}",
                   f"{self.page.resolve().as_uri()}#check=1&{view}"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
        faults = [line for line in done.stderr.splitlines() if "CONSOLE" in line and self.page.name in line
                  and "GL Driver Message" not in line]  # which tell of the speed of a driver
        require(not faults, f"no script of the page fails at {view}: {faults}")
        dom = Dom(done.stdout)
        require(dom.body.get("ready") == "1", f"the page is drawn at {view}: {dom.body} {done.stderr[-500:]}")
        return dom


def data_of(text):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def check_file(page, report):
    text = page.read_text()
    require(page.stat().st_size < MOST_BYTES, f"the page has less than {MOST_BYTES} bytes")
    require(not re.search(r'(?:src|href)\s*=\s*["\']?(?:https?:|//)', text), "no tag names an address")
    data = data_of(text)
    require(sum(part["triangles"] for part in data["surface"]["parts"])
            == sum(part["surface_faces"] for part in report["parts"]), "all boundary triangles are in the page")
    require(data["report"]["totals"]["tets"] == report["totals"]["tets"], "the figures are those of the report")


def check_views(browser, report):
    parts = [part["id"] for part in report["parts"]]
    first = browser.open("")
    require(int(first.body["drawn"]) == sum(part["surface_faces"] for part in report["parts"]), "all of it is drawn")
    require(0.02 < float(first.body["covered"]) < 0.9, "the picture has the mesh and some background")
    require([row for row, _ in first.rows if row in parts][:len(parts)] == parts, "the table has a row for each part")
    require(first.verdict == "good", "a run that is verified is praised")
    require(first.tags.count("svg") > 8, "there are histograms and a tree")
    views = {"turned": "turn=120,-20", "clipped": "clip=x,0.4", "apart": "explode=0.5", "with edges": "show=edges",
             "with planes": "show=cuts", "by kind": "colour=sides", "interfaces alone": "hide=outer"}
    digests = {"first": first.body["digest"]}
    for name, view in views.items():
        dom = browser.open(view)
        digests[name] = dom.body["digest"]
        if name in ("clipped", "interfaces alone"):
            require(float(dom.body["covered"]) < float(first.body["covered"]), f"{name}: less is covered")
    require(len(set(digests.values())) == len(digests), f"each view has another picture: {digests}")
    require(browser.open("turn=35,25").body["digest"] == digests["first"], "the same view has the same picture")


def check_picks(browser, report):
    parts = {part["id"]: part for part in report["parts"]}
    nothing = browser.open("pick=2,2")
    require(nothing.body["part"] == "0", "the background is no part")
    for part in list(parts)[:2]:
        dom = browser.open(f"part={part}&only=1&zoom=0.5")
        require(int(dom.body["drawn"]) == parts[part]["surface_faces"], "a part alone has its own triangles")
    seen = set()
    for place in (MIDDLE, "300,330", "520,150"):
        dom = browser.open(f"pick={place}")
        picked = int(dom.body["part"])
        if picked:
            require(picked in parts, "what is picked is a part")
            require({row for row, chosen in dom.rows if chosen} == {picked}, "its row is marked, and no other")
            seen.add(picked)
    require(len(seen) > 1, f"other places have other parts: {seen}")


def check_failed(browser):
    first = browser.open("")
    require(first.verdict == "bad", "a run with failed parts is not praised")
    require(int(first.body["drawn"]) > 0, "the surfaces of failed parts are drawn")
    require(first.body["digest"] != browser.open("colour=part").body["digest"], "their colour says that they failed")


def main(run, page, failed, folder):
    page, failed, folder = pathlib.Path(page), pathlib.Path(failed), pathlib.Path(folder)
    report = json.loads((pathlib.Path(run) / "report.json").read_text())
    try:
        check_file(page, report)
        browser = Browser(page, folder)
        check_views(browser, report)
        check_picks(browser, report)
        check_failed(Browser(failed, folder))
    except Broken as broken:
        print(f"does not hold: {broken}", file=sys.stderr)
        return 1
    print(f"{require.count} laws hold")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
