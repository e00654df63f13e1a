"""`windhover trim`: the speed at which a propeller carries a weight, on one and two ranks; a run from there stays; what
cannot be trimmed is refused; an interrupted trim keeps what it has: test_trim.py WINDHOVER MESHES."""
import csv
import json
import math
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()
MESHES = pathlib.Path(sys.argv.pop(1)).resolve()
GRAVITY, WIND = 9.80665, 15

# A propeller that climbs at 15 m/s, which keeps its wake steady, under a body that may move along z alone.
CASE = f"""
[mesh]
geometry = "{MESHES / 'propeller_in_box.geo'}"
file = "propeller.msh"
parameters = {{h = 0.2}}
[fluid]
boundary = {{propeller = "wall", sides = "farfield"}}
[wind]
velocity_m_s = [0, 0, -{WIND}]
[[zone]]
name = "rotor"
parent = "box"
inner_surface = "slide"
axis = [0, 0, 1]
radius_m = 0.5
from_m = -0.2
to_m = 0.2
[body]
kind = "dynamic"
mass_kg = 1
inertia_kg_m2 = [0.1, 0.1, 0.1]
gravity_m_s2 = [0, 0, -{GRAVITY}]
[body.mount]
x = {{kind = "locked"}}
y = {{kind = "locked"}}
z = {{kind = "free"}}
rotation_x = {{kind = "locked"}}
rotation_y = {{kind = "locked"}}
rotation_z = {{kind = "locked"}}
[[body.rotor]]
name = "rotor"
inertia_kg_m2 = 0.01
spin_axis = [0, 0, 1]
speed_rad_s = 270
motor = {{kind = "servo"}}
[controller]
speed_rad_s = {{rotor = 270}}
[trim]
tolerance = 2e-3
mean_tolerance = 1e-3
[time]
step_s = 7.5e-4
steps = 100
start_steps = 4
first_step_ratio = 0.1
"""


class Trim(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(CASE)
        cls.call("mesh", "case.toml")
        cls.call("trim", "case.toml", "--out", "one")
        cls.speed = cls.found("one") * math.pi / 30
        with open(cls.folder / "one/history.csv") as file:
            cls.step = list(csv.DictReader(file))[-1]["dt_s"]  # a whole number of them is a revolution

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def call(cls, *arguments, ranks=1, code=0):
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        result = subprocess.run([*launcher, WINDHOVER, *arguments], cwd=cls.folder, capture_output=True, text=True)
        assert result.returncode == code, f"exit code {result.returncode}: {result.stderr}"
        return result

    @classmethod
    def found(cls, out):
        result = json.loads((cls.folder / out / "trim.json").read_text())
        assert result["converged"], result
        return result["unknowns"]["rotor_rotor_rpm"]

    def table(self, out, name):
        with open(self.folder / out / name) as file:
            return list(csv.DictReader(file))

    def settings(self, *settings):
        return [word for setting in settings for word in ("--set", setting)]

    def test_few_tries_each_written(self):
        rows = self.table("one", "trim.csv")
        self.assertLessEqual(len(rows), 7)
        self.assertEqual(rows[-1]["settled"], "1")
        self.assertLessEqual(float(rows[-1]["residual"]), 2e-3)
        self.assertLessEqual(float(rows[-1]["change"]), 1e-3)
        self.assertAlmostEqual(float(rows[-1]["left_z_N"]), float(rows[-1]["residual"]) * GRAVITY, delta=0.04)

    def test_ranks_and_starts_agree(self):
        self.call("trim", "case.toml", "--out", "two", ranks=2)
        self.assertAlmostEqual(self.found("two"), self.found("one"), delta=1e-3 * self.found("one"))
        self.call("trim", "case.toml", "--out", "near", *self.settings("body.rotor[0].speed_rad_s=240"))
        self.assertAlmostEqual(self.found("near"), self.found("one"), delta=2e-3 * self.found("one"))

    def test_thrust_from_rest_at_that_speed_is_the_weight(self):
        """Another way to the same balance: no trim, another start."""
        self.call("run", "case.toml", "--out", "held", *self.settings(
            f"body.rotor[0].speed_rad_s={self.speed}", f"controller.speed_rad_s.rotor={self.speed}",
            'body.mount.z.kind="locked"', f"time.step_s={self.step}", "time.steps=400"))
        rows = self.table("held", "history.csv")
        revolution = 2 * math.pi / self.speed
        last = [row for row in rows if float(row["time_s"]) > float(rows[-1]["time_s"]) - 4 * revolution]
        mean = sum(float(row["fz_N"]) for row in last) / len(last)
        self.assertAlmostEqual(mean, GRAVITY, delta=5e-3 * GRAVITY)

    def drift(self, out):
        rows = self.table(out, "history.csv")
        self.assertEqual(float(rows[0]["time_s"]), 0)
        self.assertEqual(float(rows[0]["z_m"]), 0)
        return max(abs(float(row["vz_m_s"])) for row in rows), float(rows[-1]["time_s"])

    def test_a_run_from_there_stays(self):
        for ranks in (1, 2):
            out = f"stays_{ranks}"
            self.call("run", "case.toml", "--out", out, ranks=ranks, *self.settings(
                "time.start_from=one", f"time.step_s={self.step}", f"controller.speed_rad_s.rotor={self.speed}"))
            speed, duration = self.drift(out)
            self.assertLess(speed, 4e-3 * GRAVITY * duration)
        self.call("run", "case.toml", "--out", "leaves", *self.settings("time.start_from=one"))  # commands 270 rad/s
        self.assertGreater(self.drift("leaves")[0], 10 * speed)

    def test_a_controller_that_commands_other_speeds_is_told(self):
        result = self.call("trim", "case.toml", "--out", "again", *self.settings(
            "time.start_from=one", "trim.max_evaluations=5"))
        self.assertIn("the controller commands speeds that differ by", result.stdout)
        self.assertEqual(len(self.table("again", "trim.csv")), 1)  # it was there already

    def test_no_balance_is_told(self):
        result = self.call("trim", "case.toml", "--out", "few", "--set", "trim.max_evaluations=2", code=3)
        self.assertIn("trim: no balance after 2 tries", result.stderr)
        self.assertEqual(len(self.table("few", "trim.csv")), 2)
        self.assertFalse(json.loads((self.folder / "few/trim.json").read_text())["converged"])
        result = self.call("trim", "case.toml", "--out", "unsettled", code=3, *self.settings(
            "body.rotor[0].speed_rad_s=262", "trim.max_windows=2", "trim.tolerance=0.5", "trim.mean_tolerance=1e-9"))
        self.assertIn("the means still change by", result.stderr)

    def test_interrupt_keeps_what_there_is(self):
        process = subprocess.Popen([WINDHOVER, "trim", "case.toml", "--out", "cut", "--set", "trim.tolerance=1e-12"],
                                   cwd=self.folder, stdout=subprocess.DEVNULL)
        table = self.folder / "cut/trim.csv"
        while process.poll() is None and (not table.exists() or table.read_text().count("\n") < 3):
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        self.assertGreaterEqual(len(self.table("cut", "trim.csv")), 2)
        self.assertEqual(json.loads((self.folder / "cut/trim.json").read_text())["reason"], "interrupted")
        self.call("trim", "case.toml", "--out", "on", "--set", "time.start_from=cut")
        self.assertAlmostEqual(self.found("on"), self.found("one"), delta=2e-3 * self.found("one"))

    def test_what_cannot_be(self):
        for setting, *parts in (
            ("trim.unknowns=[\"roter\"]", "trim.unknowns", 'did you mean "rotor"?'),
            ("trim.unknowns=[\"z\"]", "trim.unknowns", "on no spring"),
            ("trim.unknowns=[\"x\"]", "trim.unknowns", "held by body.mount.x"),
            ("trim.balance=[\"x\"]", "trim.balance", "held by body.mount.x"),
            ("body.mount.y.kind=free", "trim.unknowns: 1", "as many are needed"),
            ("body.mount.z.kind=locked", "trim.balance", "nothing needs balance"),
            ("trim={window_s = 0.1, window_revolutions = 1}", "trim.window_s", "at most one"),
            ("body.rotor[0].speed_rad_s=0", "body.rotor[0].speed_rad_s", "> 0"),
            ("body.gravity_m_s2=[0, 0, 0]", "trim.force_scale_N"),
            ("trim.tolerance=0", "trim.tolerance", "> 0"),
            ("time.start_from=nowhere", "nowhere", "no checkpoint"),
        ):
            with self.subTest(setting):
                result = self.call("trim", "case.toml", "--out", "wrong", "--set", setting, code=2)
                for part in parts:
                    self.assertIn(part, result.stderr)
                self.assertFalse((self.folder / "wrong/history.csv").exists())


if __name__ == "__main__":
    unittest.main()
