"""The command line as a user meets it: test_commands.py WINDHOVER [unittest arguments]."""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()

GEOMETRY = """
DefineConstant[ n = 4 ];
Point(1) = {0, 0, 0};
line[] = Extrude {1, 0, 0} { Point{1}; Layers{n}; };
floor[] = Extrude {0, 1, 0} { Curve{line[1]}; Layers{n}; Recombine; };
box[] = Extrude {0, 0, 1} { Surface{floor[1]}; Layers{n}; Recombine; };
Physical Volume("box") = {box[1]};
Physical Surface("sides") = {floor[1], box[0], box[2], box[3], box[4], box[5]};
"""
CASE = """
[mesh]
geometry = "box.geo"
parameters = {n = 3}
[fluid]
boundary = {sides = "wall"}
[time]
step_s = 1e-4
steps = 4
"""


class Commands(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.write("box/box.geo", GEOMETRY)
        self.write("box/case.toml", CASE)

    def write(self, name, text):
        (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / name).write_text(text)

    def run_program(self, *arguments, ranks=1):
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        return subprocess.run([*launcher, WINDHOVER, *arguments], cwd=self.folder, capture_output=True, text=True)

    def check_error(self, result, *parts, code=2):
        self.assertEqual(result.returncode, code, result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)
        self.assertEqual(result.stderr.count("windhover:"), 1, result.stderr)

    def make_mesh(self):
        result = self.run_program("mesh", "box/case.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_usage(self):
        self.check_error(self.run_program(), "subcommand is required")
        self.check_error(self.run_program("fly"), "--help")
        self.check_error(self.run_program("run"), "CASE is required")
        self.assertEqual(self.run_program("--help").returncode, 0)
        self.assertIn("windhover 0.", self.run_program("--version").stdout)

    def test_errors_of_a_case(self):
        self.check_error(self.run_program("run", "none.toml"), "none.toml: cannot read this file")
        self.check_error(self.run_program("check", "box/case.toml", "--set", "fluid.gama=2"), 'did you mean "gamma"?')
        self.check_error(self.run_program("run", "box/case.toml"), "box_n3.msh does not exist; `windhover mesh`")
        self.assertFalse((self.folder / "results").exists())

    def test_error_is_printed_once_on_two_ranks(self):
        self.check_error(self.run_program("run", "none.toml", ranks=2), "none.toml: cannot read this file")
        self.check_error(self.run_program("mesh", "box/case.toml", ranks=2), "without mpiexec")

    def test_mesh(self):
        self.assertIn("27 cells: 27 hexahedra", self.make_mesh().stdout)
        self.assertEqual({path.name for path in (self.folder / "box").iterdir()}, {"box.geo", "case.toml", "box_n3.msh"})
        self.check_error(self.run_program("mesh", "box/case.toml", "--set", "mesh.parameters.m=3"),
                         'has no DefineConstant "m"', "n")

    def test_mesh_errors(self):
        self.write("box/box.geo", GEOMETRY + "\nnonsense;\n")
        self.check_error(self.run_program("mesh", "box/case.toml"), "gmsh failed", "line 10: syntax error")
        self.assertFalse((self.folder / "box/box_n3.msh").exists())
        (self.folder / "box/box.geo").unlink()
        self.check_error(self.run_program("mesh", "box/case.toml"), "box.geo: cannot read this file")
        environment = {**os.environ, "PATH": "/nowhere"}
        self.write("box/box.geo", GEOMETRY)
        result = subprocess.run([WINDHOVER, "mesh", "box/case.toml"], cwd=self.folder, capture_output=True, text=True,
                                env=environment)
        self.check_error(result, "gmsh: cannot start this program")

    def test_another_run_is_not_overwritten(self):
        self.make_mesh()
        self.write("out/history.csv", "precious\n")
        self.check_error(self.run_program("run", "box/case.toml", "--out", "out"), "another run", "--restart")
        self.assertEqual((self.folder / "out/history.csv").read_text(), "precious\n")
        self.assertEqual(len(list((self.folder / "out").iterdir())), 1)

    def long_run(self, out, **environment):
        """A run that has taken steps and would take many more."""
        process = subprocess.Popen([WINDHOVER, "run", "box/case.toml", "--out", out, "--set", "time.steps=100000000"],
                                   cwd=self.folder, env={**os.environ, **environment}, stdout=subprocess.DEVNULL)
        history = self.folder / out / "history.csv"
        while process.poll() is None and (not history.exists() or history.read_text().count("\n") < 4):
            time.sleep(0.05)
        return process

    def test_interrupt_writes_a_checkpoint(self):
        self.make_mesh()
        for number, code in (signal.SIGINT, 130), (signal.SIGTERM, 143):
            out = f"out{code}"
            process = self.long_run(out)
            process.send_signal(number)
            self.assertEqual(process.wait(), code)
            self.assertTrue(list((self.folder / out / "checkpoint").glob("*.h5")))

    def test_malloc_asks_for_large_pages_unless_the_user_rules(self):
        self.make_mesh()
        os.environ.pop("GLIBC_TUNABLES", None)
        theirs = {"GLIBC_TUNABLES": "glibc.malloc.hugetlb=0"}
        for out, given, expected in ("ours", {}, "glibc.malloc.hugetlb=1"), ("theirs", theirs, theirs["GLIBC_TUNABLES"]):
            process = self.long_run(out, **given)
            words = pathlib.Path(f"/proc/{process.pid}/environ").read_text().split("\0")
            process.kill()
            process.wait()
            self.assertEqual([w for w in words if w.startswith("GLIBC_TUNABLES=")], [f"GLIBC_TUNABLES={expected}"])

    def run_case(self, *arguments, **others):
        return self.run_program("run", "box/case.toml", "--out", "out", *arguments, **others)

    def newest_checkpoint(self):
        return max((self.folder / "out/checkpoint").glob("*.h5"))

    def history(self):
        """The rows without their last column, the wall time."""
        return [line.rpartition(",")[0] for line in (self.folder / "out/history.csv").read_text().splitlines()]

    def test_restart_continues_bit_for_bit(self):
        self.make_mesh()
        # waves, and Newton's method that stops where the last step's truncation error says
        settings = ["fluid.initial.kind=riemann", "fluid.initial.position_m=0.4", "fluid.initial.right={pressure_Pa=9e4, density_kg_m3=1.1}",
                    "solver.newton_tolerance=1e-9", "solver.truncation_fraction=0.3", "time.step_s=3e-4"]
        remembers = [word for setting in settings for word in ("--set", setting)]
        self.assertEqual(self.run_case("--steps", "6", *remembers).returncode, 0)
        whole = self.history()
        (self.folder / "out").rename(self.folder / "whole")
        self.assertEqual(self.run_case("--steps", "4", *remembers).returncode, 0)
        with open(self.folder / "out/history.csv", "a") as file:
            file.write("5,of a run that was killed\n6,")
        self.assertEqual(self.run_case("--restart", "--steps", "6", *remembers).returncode, 0)
        self.assertEqual(self.history(), whole)

    def test_restart_with_a_lagged_preconditioner(self):
        """A checkpoint at its interval ends the service of the preconditioner, so a restart from there repeats the run."""
        def residuals(out):
            rows = (self.folder / out / "solver.csv").read_text().splitlines()
            drop = rows[0].split(",").index("seconds")
            return [[word for i, word in enumerate(row.split(",")) if i != drop] for row in rows]

        self.make_mesh()
        settings = ["--set", "solver.jacobian_lag=8", "--set", "output.checkpoint_interval=3", "--set", "fluid.initial.kind=riemann",
                    "--set", "fluid.initial.position_m=0.4",
                    "--set", "fluid.initial.right={pressure_Pa=9e4, density_kg_m3=1.1}", "--set", "time.step_s=3e-4"]
        self.assertEqual(self.run_case("--steps", "6", *settings).returncode, 0)
        whole = self.history()
        (self.folder / "out").rename(self.folder / "whole")
        for restart, steps in ((), "3"), (("--restart",), "6"):
            self.assertEqual(self.run_case(*restart, "--steps", steps, *settings).returncode, 0)
        self.assertEqual(self.history(), whole)
        self.assertEqual(residuals("out"), residuals("whole"))

    def test_wrong_checkpoints(self):
        self.make_mesh()
        self.check_error(self.run_case("--restart"), "no checkpoint")
        self.assertEqual(self.run_case().returncode, 0)
        history = (self.folder / "out/history.csv").read_text()
        self.run_program("mesh", "box/case.toml", "--set", "mesh.parameters.n=2")
        self.check_error(self.run_case("--restart", "--set", "mesh.parameters.n=2"), "another mesh")
        os.truncate(self.newest_checkpoint(), self.newest_checkpoint().stat().st_size - 1000)
        self.check_error(self.run_case("--restart"), self.newest_checkpoint().name, "cut short")
        self.check_error(self.run_case("--restart", ranks=2), self.newest_checkpoint().name, "cut short")
        self.newest_checkpoint().write_text("something else")
        self.check_error(self.run_case("--restart"), self.newest_checkpoint().name, "no checkpoint")
        self.assertEqual((self.folder / "out/history.csv").read_text(), history)

    def test_full_disk(self):
        self.make_mesh()
        command = [WINDHOVER, "run", "box/case.toml", "--out", "out", "--steps", "100000000",
                   "--set", "output.checkpoint_interval=20"]
        process = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        checkpoint = self.folder / "out/checkpoint/step_00000020.h5"
        while process.poll() is None and not checkpoint.exists():
            time.sleep(0.001)
        # From here on files may not grow beyond this size; tables are smaller, a checkpoint reserves more.
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (200_000, resource.RLIM_INFINITY))
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 2, errors)
        self.assertRegex(errors, "^windhover: .*/step_[0-9]+.h5.tmp: cannot write this file: File too large\n$")
        self.assertFalse(list(checkpoint.parent.glob("*.tmp")))
        last = int(self.newest_checkpoint().stem.removeprefix("step_"))
        self.assertEqual(self.run_case("--restart", "--steps", str(last + 2)).returncode, 0)
        self.assertEqual(len(self.history()), 1 + last + 3)

    def test_wrong_meshes(self):
        self.make_mesh()
        mesh = self.folder / "box/box_n3.msh"
        self.check_error(self.run_case("--set", "fluid.boundary={}"), "sides")
        mesh.write_text(mesh.read_text()[:2000])
        self.check_error(self.run_case(), "box_n3.msh")
        mesh.write_text("nothing")
        self.check_error(self.run_case(), "box_n3.msh: not a gmsh mesh")
        self.assertFalse((self.folder / "out").exists())

    def test_verify(self):
        self.write("box/verify.toml", """
[[run]]
name = "a"
quick = true
[[run]]
name = "b"
set = ["mesh.parameters.n=2"]
ranks = 2
[[figure]]
name = "cells"
expected = 27
tolerance = 0
needs = ["a"]
[[figure]]
name = "ratio"
min = 3
needs = ["a", "b"]
""")
        self.write("box/check.py", """
import json, pathlib, sys
cells = {path.parent.name: json.loads(path.read_text())["cells"] for path in pathlib.Path(sys.argv[1]).glob("*/summary.json")}
print(json.dumps({"cells": cells["a"], "ratio": cells["a"] / cells.get("b", 1)}))
""")
        quick = self.run_program("verify", "box", "--quick")
        self.assertEqual(quick.returncode, 0, quick.stdout + quick.stderr)
        self.assertRegex(quick.stdout, r"cells +27 +27 +27 to 27 +yes")
        self.assertRegex(quick.stdout, r"ratio .*skipped")
        self.assertFalse((self.folder / "results/box/b").exists())
        everything = self.run_program("verify", "box/")
        self.assertEqual(everything.returncode, 0, everything.stdout + everything.stderr)
        self.assertRegex(everything.stdout, r"ratio +3.375 .*yes")
        self.write("box/verify.toml", (self.folder / "box/verify.toml").read_text().replace("min = 3", "min = 4"))
        wrong = self.run_program("verify", "box")
        self.assertEqual(wrong.returncode, 1, wrong.stdout + wrong.stderr)
        self.assertTrue((self.folder / "results/box/verify.json").exists())


unittest.main()
