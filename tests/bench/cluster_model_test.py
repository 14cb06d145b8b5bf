"""Laws of the model by which runs on many hosts are projected."""

import dataclasses
import sys
import unittest

from cluster_model import (Costs, Machine, cut_terms, efficiency, interface_faces, line_through_zero, makespan,
                           on_threads, replay, share_on_threads)

COSTS = Costs(read=1e-6, read_on_threads=0.8, cut=2e-7, cut_interface=5e-6, cut_on_threads=0.5, prepare=1e-6, mesh=1e-6,
              start=0.002, write=2e-7, hash=1e-10, report=1e-4, ticket=2e-5, spread=(1.0,), interface_faces=3e4,
              run_parts=32, run_cells=3_000_000)
MACHINE = Machine()


class ClusterModel(unittest.TestCase):
    def test_work_that_is_shared_is_all_used(self):
        shared = dataclasses.replace(COSTS, read=0, cut=0, cut_interface=0, prepare=0, report=0, ticket=0, start=0)
        ideal = dataclasses.replace(MACHINE, latency=0, network=1e30, file_operations=1e30, files=1e30, files_of_host=1e30)
        for ranks in (1, 2, 64, 1024):
            self.assertAlmostEqual(efficiency(shared, ideal, 1e6, 1e9, ranks)[0], 1, delta=0.01)

    def test_what_one_rank_does_bounds_the_speed_up(self):
        serial = dataclasses.replace(COSTS, read_on_threads=0.0)
        for ranks in (2, 32, 1024):
            share, terms = efficiency(serial, MACHINE, 15e6, 1e8, ranks)
            alone = sum(replay(serial, MACHINE, 15e6, 1e8, 1).values())
            self.assertLessEqual(share * ranks, alone / terms["read"])
            self.assertAlmostEqual(terms["read"], 15.0, delta=1e-9)

    def test_efficiency_falls_with_ranks_and_rises_with_cells(self):
        falling = [efficiency(COSTS, MACHINE, 5e4, 1e9, ranks)[0] for ranks in (1, 8, 64, 512, 1024)]
        self.assertEqual(falling, sorted(falling, reverse=True))
        self.assertAlmostEqual(falling[0], 1)
        rising = [efficiency(COSTS, MACHINE, 5e4, cells, 256)[0] for cells in (1e6, 1e7, 1e8, 1e9)]
        self.assertEqual(rising, sorted(rising))

    def test_more_of_the_machine_is_never_slower(self):
        def of(machine):
            return sum(replay(COSTS, machine, 1e6, 1e8, 512).values())

        for field in ("network", "memory", "files_of_host", "files", "file_operations"):
            better = dataclasses.replace(MACHINE, **{field: 2 * getattr(MACHINE, field)})
            self.assertLessEqual(of(better), of(MACHINE))

    def test_cuts_of_one_rank_are_all_of_its_own(self):
        seconds, travelling = cut_terms(COSTS, MACHINE, 1e6, 64, 1e7, 1)
        self.assertEqual(travelling, 0)
        self.assertGreater(seconds, 6 * COSTS.cut * 1e6)

    def test_small_pieces(self):
        self.assertEqual(makespan([3, 3, 2, 2, 2], 2), 7)
        self.assertEqual(on_threads(10, 0.5, 1), 10)
        self.assertEqual(on_threads(10, 1, 5), 2)
        self.assertEqual(share_on_threads(10, 10), 0)
        self.assertEqual(share_on_threads(10, 5), 1)
        self.assertAlmostEqual(interface_faces(COSTS, 32, 3_000_000), 3e4)
        self.assertEqual(interface_faces(COSTS, 1, 3_000_000), 0)
        a, b = line_through_zero([(x, z, 2 * x + 3 * z) for x, z in ((1, 5), (4, 2), (7, 7))])
        self.assertAlmostEqual(a, 2)
        self.assertAlmostEqual(b, 3)


if __name__ == "__main__":
    sys.exit(unittest.main())
