"""What a run of Kerf takes on many hosts, replayed from the costs of its stages on one core.

Costs are measured (`costs_of_runs`), the machine is assumed (`Machine`); `replay` puts them together for any numbers of
facets, cells and ranks and returns the seconds of each term. The order of a run is that of run/run/pipeline.h: the
root rank reads and checks; a cut is made once, by the lowest rank that has a part below it, which may use the cores of
the ranks that wait for it; one half goes to the rank that leads it; interfaces are matched by owner; ranks take parts,
longest first; they write what they have, and the root writes the report.
"""

import dataclasses
import heapq
import math


@dataclasses.dataclass(frozen=True)
class Machine:
    """Assumed. A rank has one core and one worker."""

    cores_of_host: int = 64
    network: float = 12.5e9  # bytes a second, of a host
    latency: float = 5e-6  # seconds, of a message
    memory: float = 5e9  # bytes a second between two ranks of a host
    files_of_host: float = 2e9  # bytes a second
    files: float = 100e9  # of all hosts together
    file_operations: float = 2e4  # a second, of all hosts together
    slowdown: float = 1.0  # of a core when all cores of its host work

    def hosts(self, ranks):
        return -(-ranks // self.cores_of_host)

    def file_seconds(self, size, ranks):
        return size / min(self.files, self.files_of_host * self.hosts(ranks))


@dataclasses.dataclass(frozen=True)
class Costs:
    """Seconds of one core; shares that run on threads are those of two cores, by Amdahl's law."""

    read: float  # of a facet: read, welded, checked
    read_on_threads: float  # share
    cut: float  # of a face of the surface that is cut
    cut_interface: float  # of a face of the interface
    cut_on_threads: float  # share
    prepare: float  # of a face of a part
    mesh: float  # of a cell: loaded, meshed, verified, stored
    start: float  # of a part
    write: float  # of a cell
    hash: float  # of a byte
    report: float  # of a part, on the root
    ticket: float  # of a part, on the root
    spread: tuple  # seconds of parts over what their load says, of a run
    interface_faces: float  # of all cuts of that run
    run_parts: int
    run_cells: int
    bytes_of_facet: float = 50  # of the input
    bytes_of_face: float = 60  # of a half that travels, of a face that is matched
    bytes_of_cell: float = 40  # as it is written
    files_of_part: float = 8  # files made, opened, renamed or removed


def on_threads(seconds, share, threads):
    """Amdahl's law."""
    return seconds * (1 - share + share / threads)


def share_on_threads(one, two):
    """The share that has halved, from the seconds on one and on two cores."""
    return min(1.0, max(0.0, 2 * (1 - two / one))) if one > 0 else 0.0


def interface_faces(costs, parts, cells):
    """Of all cuts into so many parts: their area grows with the third root of the parts, a face shrinks with cells."""
    measured = costs.run_parts ** (1 / 3) - 1
    area = (parts ** (1 / 3) - 1) / measured if measured > 0 else 0
    return costs.interface_faces * area * (cells / costs.run_cells) ** (2 / 3)


def cut_terms(costs, machine, facets, parts, cells, ranks):
    """Seconds until the last part is cut, and of that how long halves travel."""
    seconds = travelling = 0.0
    levels = math.ceil(math.log2(parts)) if parts > 1 else 0
    for level in range(levels):
        nodes = min(2**level, parts)
        before = interface_faces(costs, 2**level, cells)
        of_level = interface_faces(costs, 2 ** (level + 1), cells) - before
        faces = (facets + 2 * before) / nodes
        cost = costs.cut * faces + costs.cut_interface * of_level / nodes
        waiting = ranks / nodes  # ranks below a node
        threads = max(1, min(machine.cores_of_host, int(waiting)))
        seconds += on_threads(cost, costs.cut_on_threads, threads) * max(1.0, nodes / ranks)
        if waiting > 1:
            speed = machine.network if waiting > machine.cores_of_host else machine.memory
            travelling += machine.latency + costs.bytes_of_face * faces / 2 / speed
    return seconds + travelling, travelling


def makespan(seconds_of_parts, workers):
    """Seconds until the last worker is free when each takes the next part, longest first."""
    free_at = [0.0] * workers
    for seconds in sorted(seconds_of_parts, reverse=True):
        heapq.heapreplace(free_at, free_at[0] + seconds)
    return max(free_at)


def replay(costs, machine, facets, cells, ranks, parts_of_rank=4):
    """Seconds of each term of a run on so many ranks."""
    parts = parts_of_rank * ranks
    hosts, messages = machine.hosts(ranks), machine.latency * math.ceil(math.log2(2 * ranks))
    reading_threads = min(ranks, machine.cores_of_host)
    cut, travelling = cut_terms(costs, machine, facets, parts, cells, ranks)
    shared = interface_faces(costs, parts, cells)
    faces = facets + 2 * shared
    slow = machine.slowdown if ranks > 1 else 1
    exchange = costs.bytes_of_face * 2 * shared / (machine.network * hosts) if hosts > 1 else 0
    spread = [costs.spread[i % len(costs.spread)] for i in range(parts)]
    size = costs.bytes_of_cell * cells
    return {
        "read": max(
            on_threads(costs.read * facets, costs.read_on_threads, reading_threads),
            machine.file_seconds(costs.bytes_of_facet * facets, 1),
        ),
        "cut": cut - travelling,
        "halves travel": travelling,
        "prepare": costs.prepare * faces / ranks + exchange + 20 * messages,
        "mesh": makespan([slow * (costs.start + costs.mesh * cells / parts * s) for s in spread], ranks),
        "tickets": costs.ticket * parts if ranks > 1 else 0.0,
        "write": max(slow * costs.write * cells / ranks, machine.file_seconds(size, ranks)),
        "files": costs.files_of_part * parts / machine.file_operations if ranks > 1 else 0.0,
        "hash": costs.hash * size / ranks,
        "report": costs.report * parts + 40 * messages,
    }


def efficiency(costs, machine, facets, cells, ranks, parts_of_rank=4):
    """Speed-up over one rank by the number of ranks, and the terms."""
    alone = sum(replay(costs, machine, facets, cells, 1, parts_of_rank).values())
    terms = replay(costs, machine, facets, cells, ranks, parts_of_rank)
    return alone / sum(terms.values()) / ranks, terms


def line_through_zero(rows):
    """Least squares of y = a x + b z over rows (x, z, y), none of both negative."""
    xx, xz, zz, xy, zy = (sum(f(*row) for row in rows) for f in (
        lambda x, z, y: x * x, lambda x, z, y: x * z, lambda x, z, y: z * z,
        lambda x, z, y: x * y, lambda x, z, y: z * y,
    ))
    determinant = xx * zz - xz * xz
    if determinant > 1e-9 * xx * zz:
        a, b = (xy * zz - zy * xz) / determinant, (xx * zy - xz * xy) / determinant
        if a >= 0 and b >= 0:
            return a, b
    return (xy / xx if xx > 0 else 0.0), 0.0


def costs_of_runs(one, two):
    """Of the reports of two runs that do the same with one and with two workers."""
    totals, others = one["totals"], two["totals"]
    parts, cells, facets = one["parts"], totals["tets"], one["input"]["faces"]
    cuts = [node for node in one["tree"] if "cut" in node]
    cut_seconds = sum(node["cut"]["seconds"] for node in cuts)
    outside = totals["decompose_seconds"] / cut_seconds if cut_seconds > 0 else 1
    cut, cut_interface = line_through_zero(
        [(node["faces"], node["cut"].get("interface_faces", 0), outside * node["cut"]["seconds"]) for node in cuts]
    )
    first, same = (next((n["cut"]["seconds"] for n in r["tree"] if "cut" in n), 0) for r in (one, two))
    busy = sum(part["seconds"] for part in parts)
    load = sum(part["load"] for part in parts)
    stages = ("read", "decompose", "prepare", "mesh", "write", "hash")
    rest = totals["wall_seconds"] - sum(totals[stage + "_seconds"] for stage in stages)
    size = sum(file["bytes"] for file in one["files"]) if one.get("files") else 0
    return Costs(
        read=totals["read_seconds"] / facets,
        read_on_threads=share_on_threads(totals["read_seconds"], others["read_seconds"]),
        cut=cut,
        cut_interface=cut_interface,
        cut_on_threads=share_on_threads(first, same),
        prepare=totals["prepare_seconds"] / sum(part["surface_faces"] for part in parts),
        mesh=(busy - totals["start_seconds"]) / cells,
        start=totals["start_seconds"] / len(parts),
        write=totals["write_seconds"] / cells,
        hash=totals["hash_seconds"] / size if size else 0.0,
        report=max(0.0, rest) / len(parts),
        ticket=20e-6,
        spread=tuple((part["seconds"] / busy) / (part["load"] / load) for part in parts),
        interface_faces=sum(node["cut"].get("interface_faces", 0) for node in cuts),
        run_parts=len(parts),
        run_cells=cells,
        bytes_of_cell=size / cells if size else Costs.bytes_of_cell,
    )
