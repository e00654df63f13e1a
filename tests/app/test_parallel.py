"""Histories on 1, 2 and 4 ranks agree, and a restart repeats them byte for byte: test_parallel.py WINDHOVER MESHES."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()
MESHES = pathlib.Path(sys.argv.pop(1)).resolve()

# A tumbling cube of tetrahedra in wind, one side a wall: loads in all six components.
CASE = f"""
[mesh]
geometry = "{MESHES / 'cube.geo'}"
file = "cube.msh"
parameters = {{n = 5}}
[fluid]
boundary = {{wall = "wall", far = "farfield"}}
[wind]
velocity_m_s = [0, 60, 10]
[[body.motion]]
kind = "rotation"
axis = [1, 2, 3]
amplitude_deg = 20
frequency_hz = 40
[time]
step_s = 5e-4
steps = 8
start_steps = 2
[solver]
newton_tolerance = 1e-12
newton_iterations = 30
eisenstat_walker = false
krylov_tolerance = 1e-4
[output]
checkpoint_interval = 3
"""
# iteration counts depend on the partition, wall_s on the machine
NOT_COMPARED = {"newton", "krylov", "wall_s"}


def size(rows, key):
    """The largest value of a column, or of the vector whose component it is: what a difference is compared with."""
    vector = [key[0] + axis + key[2:] for axis in "xyz"] if key.endswith(("_N", "_Nm")) else [key]
    return max(math.hypot(*(float(row[k]) for k in vector)) for row in rows)


class Parallel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(CASE)
        cls.call("mesh", "case.toml")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def call(cls, *arguments, ranks=1):
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        subprocess.run([*launcher, WINDHOVER, *arguments], cwd=cls.folder, check=True, capture_output=True)

    def history(self, name):
        with open(self.folder / name / "history.csv") as file:
            return list(csv.DictReader(file))

    def test_ranks_agree(self):
        for ranks in (1, 2, 4):
            self.call("run", "case.toml", "--out", f"ranks_{ranks}", ranks=ranks)
        reference = self.history("ranks_1")
        self.assertEqual(len(reference), 9)
        for ranks in (2, 4):
            rows = self.history(f"ranks_{ranks}")
            self.assertEqual(len(rows), len(reference))
            for row, expected in zip(rows, reference):
                for key in expected.keys() - NOT_COMPARED:
                    error = abs(float(row[key]) - float(expected[key]))
                    self.assertLessEqual(error, 1e-9 * size(reference, key), (ranks, key, expected["step"]))

    def test_restart_repeats_the_history(self):
        for ranks in (1, 2):
            whole, parts = f"whole_{ranks}", f"parts_{ranks}"
            self.call("run", "case.toml", "--out", whole, ranks=ranks)
            self.call("run", "case.toml", "--out", parts, "--steps", "4", ranks=ranks)
            self.call("run", "case.toml", "--out", parts, "--restart", ranks=ranks)
            for row, expected in zip(self.history(parts), self.history(whole), strict=True):
                self.assertEqual({**row, "wall_s": ""}, {**expected, "wall_s": ""})


if __name__ == "__main__":
    unittest.main()
