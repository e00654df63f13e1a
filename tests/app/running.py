"""A case in a temporary folder, run again and again, and what is compared of its histories."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

# iteration counts depend on the partition, wall_s on the machine
NOT_COMPARED = {"newton", "krylov", "coupling_iterations", "wall_s"}


def arguments(count=2):
    """The paths after the test's name: the program, the folder of meshes, ...; unittest sees none of them."""
    return [pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(count)]


def size(rows, key):
    """The largest value of a column, or of the vector whose component it is: what a difference is compared with."""
    vector = [key[0] + axis + key[2:] for axis in "xyz"] if key.endswith(("_N", "_Nm")) else [key]
    return max(math.hypot(*(float(row[k]) for k in vector)) for row in rows)


class Running(unittest.TestCase):
    windhover = case = None  # set by the test: the program and the text of its case

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(cls.case)
        cls.call("mesh", "case.toml")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def command(cls, *arguments, ranks=1):
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        return [*launcher, cls.windhover, *arguments]

    @classmethod
    def call(cls, *arguments, ranks=1, code=0):
        result = subprocess.run(cls.command(*arguments, ranks=ranks), cwd=cls.folder, capture_output=True, text=True)
        assert result.returncode == code, f"exit code {result.returncode}: {result.stderr}"
        return result

    def run_case(self, out, *settings, restart=False, **others):
        changes = [word for setting in settings for word in ("--set", setting)]
        again = ["--restart"] if restart else []
        return self.call("run", "case.toml", "--out", out, *again, *changes, **others)

    def table(self, out, name="history.csv"):
        with open(self.folder / out / name) as file:
            return list(csv.DictReader(file))

    def check_same_rows(self, one, two):
        """Equal to the last digit, seconds aside."""
        for row, expected in zip(self.table(one), self.table(two), strict=True):
            self.assertEqual({**row, "wall_s": ""}, {**expected, "wall_s": ""})

    def check_agreement(self, one, two, tolerance, least=0.0):
        reference = self.table(two)
        for row, expected in zip(self.table(one), reference, strict=True):
            for key in expected.keys() - NOT_COMPARED:
                error = abs(float(row[key]) - float(expected[key]))
                self.assertLessEqual(error, tolerance * size(reference, key) + least, (key, expected["step"]))
