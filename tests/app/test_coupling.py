"""Bodies that the air moves: ranks agree, a restart repeats byte for byte, what cannot be is refused, a step that fails
is halved and in the end stops the run: test_coupling.py WINDHOVER MESHES."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()
MESHES = pathlib.Path(sys.argv.pop(1)).resolve()

ROTORS = "".join(f"""
[[body.rotor]]
name = "{name}"
inertia_kg_m2 = 1e-4
spin_axis = [0, {spin}, 0]
speed_rad_s = 300
motor = {{ kind = "{motor}" }}
[[controller.rotor]]
name = "{name}"
position_m = [{x}, 0, {z}]
thrust_N_s2 = 4e-5
torque_Nm_s2 = 6e-7
min_speed_rad_s = 50
max_speed_rad_s = 900
""" for name, x, z, spin, motor in (("front_right", 1, 1, 1, "servo"), ("front_left", 1, -1, -1, "servo"),
                                   ("rear_left", -1, -1, 1, "servo"), ("rear_right", -1, 1, -1, "servo")))

# A light sphere that flies off in a gust, with rotors that have no air of their own and a sampled controller; its centre
# of gravity lies beside its middle.
CASE = f"""
[mesh]
geometry = "{MESHES / 'ball_around_sphere.geo'}"
file = "sphere.msh"
[fluid]
boundary = {{sphere = "wall", far = "farfield"}}
[wind]
velocity_m_s = [-20, 5, 3]
[body]
kind = "dynamic"
mass_kg = 0.2
inertia_kg_m2 = [0.05, 0.06, 0.07]
center_of_gravity_m = [0.02, -0.03, 0.01]
[controller]
kind = "cascade"
rate_hz = 250
plan = [{{time_s = 0}}, {{time_s = 0.0123, position_m = [1, 0, 0]}}]
{ROTORS}
[time]
step_s = 2e-3
steps = 10
[solver]
newton_tolerance = 1e-10
newton_iterations = 30
eisenstat_walker = false
krylov_tolerance = 1e-4
[coupling]
tolerance = 1e-10
pose_tolerance = 1e-10
[output]
checkpoint_interval = 3
"""
# iteration counts depend on the partition, wall_s on the machine
NOT_COMPARED = {"newton", "krylov", "wall_s", "coupling_iterations"}


def size(rows, key):
    """The largest value of a column, or of the vector whose component it is: what a difference is compared with."""
    vector = [key[0] + axis + key[2:] for axis in "xyz"] if key.endswith(("_N", "_Nm")) else [key]
    return max(math.hypot(*(float(row[k]) for k in vector)) for row in rows)


class Coupling(unittest.TestCase):
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
    def call(cls, *arguments, ranks=1, code=0):
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        result = subprocess.run([*launcher, WINDHOVER, *arguments], cwd=cls.folder, capture_output=True, text=True)
        assert result.returncode == code, f"exit code {result.returncode}: {result.stderr}"
        return result

    def run_case(self, out, *settings, **others):
        changes = [word for setting in settings for word in ("--set", setting)]
        return self.call("run", "case.toml", "--out", out, *changes, **others)

    def table(self, out, name):
        with open(self.folder / out / name) as file:
            return list(csv.DictReader(file))

    def check_same_rows(self, one, two):
        for row, expected in zip(self.table(one, "history.csv"), self.table(two, "history.csv"), strict=True):
            self.assertEqual({**row, "wall_s": ""}, {**expected, "wall_s": ""})
        self.assertEqual((self.folder / one / "coupling.csv").read_text(), (self.folder / two / "coupling.csv").read_text())

    def test_ranks_agree(self):
        for ranks in (1, 2):
            self.run_case(f"ranks_{ranks}", ranks=ranks)
        reference, rows = (self.table(f"ranks_{ranks}", "history.csv") for ranks in (1, 2))
        self.assertEqual(len(reference), 11)
        self.assertGreater(size(reference, "x_m"), 1e-3)
        for row, expected in zip(rows, reference, strict=True):
            for key in expected.keys() - NOT_COMPARED:
                error = abs(float(row[key]) - float(expected[key]))
                self.assertLessEqual(error, 1e-7 * size(reference, key) + 1e-14, (key, expected["step"]))

    def test_restart_repeats_everything(self):
        for ranks in (1, 2):
            for scheme in ("scheme=loose-extrapolated", "acceleration=iqn-ils", "acceleration=anderson"):
                whole, parts = f"whole_{ranks}_{scheme}", f"parts_{ranks}_{scheme}"
                self.run_case(whole, f"coupling.{scheme}", ranks=ranks)
                self.run_case(parts, f"coupling.{scheme}", "time.steps=5", ranks=ranks)
                self.call("run", "case.toml", "--out", parts, "--restart", "--set", f"coupling.{scheme}", ranks=ranks)
                self.check_same_rows(parts, whole)

    def test_killed_run_loses_the_steps_after_its_checkpoint_only(self):
        self.run_case("whole")
        self.run_case("killed", "time.steps=7")
        (max((self.folder / "killed/checkpoint").glob("*.h5"))).unlink()  # as if it had been killed before step 7's
        self.call("run", "case.toml", "--out", "killed", "--restart")
        self.check_same_rows("killed", "whole")

    def test_no_agreement_stops_the_run_with_its_state(self):
        result = self.run_case("lost", "coupling.max_iterations=1", "solver.max_halvings=2", code=3)
        self.assertIn("step 1 after 0 s failed", result.stderr)
        self.assertIn("no agreement of vehicle and air after 1 coupling iterations", result.stderr)
        self.assertTrue((self.folder / "lost/checkpoint/step_00000000.h5").exists())
        rows = self.table("lost", "coupling.csv")
        self.assertEqual([row["accepted"] for row in rows], ["0"] * 3)  # the step and its halves
        self.assertEqual(len(self.table("lost", "history.csv")), 1)

    def test_what_cannot_be(self):
        for setting, *parts in (
            ("body.mass_kg=0", "body.mass_kg", "> 0"),
            ("body.inertia_kg_m2=[1, 1, 0]", "body.inertia_kg_m2", "singular"),
            ("body.inertia_kg_m2=[1, 1]", "body.inertia_kg_m2", "three numbers"),
            ("body.rotor[1].motor.kind=none", "body.rotor[1].motor.kind", "needs a motor"),
            ("body.mount={x = {kind = \"locked\", stiffness_N_m = 3}}", "body.mount.x", "spring"),
            ("body.mount={x = {kind = \"locked\"}, y = {kind = \"free\", mean_m = 1}}", "body.mount.y", "prescribed"),
            ("controller.cascade={rate_gain_1_s = [1, 2]}", "controller.cascade.rate_gain_1_s", "three numbers"),
            ("controller.rotor[2].position_m=[1, 0, 1]", "controller.mixer", "cannot produce"),
            ("controller.rotor[3].name=tail", "controller.rotor", "rear_right"),
            ("controller.rotor[0].thrust_axis=[1, 0, 0]", "controller.rotor[0].thrust_axis", "parallel"),
            ("coupling.scheme=weak", "coupling.scheme", "loose-extrapolated"),
            ("coupling.acceleration=newton", "coupling.acceleration", "iqn-ils"),
            ("coupling.relaxation=2", "coupling.relaxation", "1"),
            ("body.motion=[{rate_m_s = 1}]", "body.motion: unknown key for kind = \"dynamic\""),
            ("body.kind=prescribed", "body.", "unknown key for kind = \"prescribed\""),
        ):
            with self.subTest(setting):
                result = self.run_case("wrong", setting, code=2)
                for part in parts:
                    self.assertIn(part, result.stderr)
                self.assertFalse((self.folder / "wrong").exists())

    def test_checkpoint_of_another_vehicle(self):
        self.run_case("other", "time.steps=3")
        text = CASE.replace(ROTORS, "").replace('kind = "cascade"\nrate_hz = 250\nplan', 'kind = "none"\n#')
        (self.folder / "other.toml").write_text(text)
        result = self.call("run", "other.toml", "--out", "other", "--restart", code=2)
        self.assertIn("another vehicle", result.stderr)


if __name__ == "__main__":
    unittest.main()
