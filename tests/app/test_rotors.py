"""Rotors from a case to a mesh whose interfaces hold: test_rotors.py WINDHOVER [unittest arguments]."""
import csv
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

PYTHON = pathlib.Path(__file__).resolve().parents[2] / "python"
WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()

CASE = """
[mesh]
farfield = {radius_m = 6, size_m = 3}
[[rotor]]
name = "left"
center_m = [-1.3, 0, 0]
axis = [0.1, 1, 0]
rpm = 1000
[rotor.blade]
count = 2
radius_m = 1
r_over_R = [0.25, 1]
c_over_R = [0.2, 0.15]
beta_deg = [20, 8]
[rotor.hub]
radius_m = 0.1
from_m = -0.06
to_m = 0.06
rounding_m = 0.04
[rotor.zone]
radius_m = 1.2
from_m = -0.3
to_m = 0.3
[rotor.size]
leading_edge = 0.1
trailing_edge = 0.1
chord = 0.3
span_m = 0.15
interface_m = 0.4
growth = 0.6
[time]
step_deg = 1
steps = 1
first_step_ratio = 0.01
"""


def second(case, name, x):
    """The same rotor once more, turning the other way."""
    rotor = case[case.index("[[rotor]]"):case.index("[time]")]
    other = rotor.replace('"left"', f'"{name}"\ndirection = "clockwise"').replace("-1.3", str(x))
    return case.replace("[time]", other + "[time]")


class Rotors(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_program(self, command, case, *arguments):
        (self.folder / "case.toml").write_text(case)
        return subprocess.run([WINDHOVER, command, "case.toml", *arguments], cwd=self.folder, capture_output=True, text=True)

    def check_error(self, result, *parts):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def test_two_rotors(self):
        case = second(CASE, "right", 1.3)
        made = self.run_program("mesh", case)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        self.assertRegex(made.stdout, r"zones: left \(\d+\) right \(\d+\) outer \(\d+\)")
        self.check_error(self.run_program("check", case, "--set", "rotor[0].blade.collective_deg=1"), "was made from other")
        checked = self.run_program("check", case, "--set", "rotor[0].rpm=900")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        for patch in ("left_blades: wall", "left_hub: wall", "right_blades: wall", "right_slide: sliding", "farfield: farfield"):
            self.assertIn(patch, checked.stdout)
        run = self.run_program("run", case, "--out", "out")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        effective = (self.folder / "out/case.toml").read_text()
        self.assertNotIn("[[zone]]", effective)
        again = self.run_program("check", effective)
        self.assertEqual(again.returncode, 0, again.stderr)
        thrust = float((self.folder / "out/history.csv").read_text().splitlines()[-1].split(",")[15])
        self.assertGreater(thrust, 0)

    def test_airfoil_file(self):
        """A mesh is the case's own from wherever the case is run, and not after another airfoil is named."""
        wedge = [(1, 0), (0.8, 0.03), (0.5, 0.06), (0.3, 0.07), (0.1, 0.05), (0.02, 0.02), (0, 0),
                 (0.02, -0.02), (0.1, -0.05), (0.3, -0.07), (0.5, -0.06), (0.8, -0.03), (1, 0)]
        (self.folder / "thick.dat").write_text("thick\n" + "".join(f"{x} {y}\n" for x, y in wedge))
        sections = 'section = [{r_over_R = 0.25, airfoil = "thick.dat"}, {r_over_R = 0.9, airfoil = "naca2410"}]'
        case = CASE.replace("beta_deg = [20, 8]", "beta_deg = [20, 8]\n" + sections)
        made = self.run_program("mesh", case)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        path = self.folder / "case.toml"
        checked = subprocess.run([WINDHOVER, "check", path], cwd=self.folder.parent, capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        other = self.run_program("check", case, "--set", "rotor[0].blade.section[1].airfoil=naca2412")
        self.check_error(other, "was made from other")
        self.check_error(self.run_program("mesh", case.replace("thick.dat", "thin.dat")), "case.toml:", "section[0]: thin.dat: airfoil")

    def tables(self, name):
        return {path.name: (self.folder / name / path.name).read_text() for path in (self.folder / name).glob("rotor_*.csv")}

    def rows(self, path):
        with open(self.folder / path) as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def test_tables(self):
        steps = ("--set", "time.step_deg=9", "--set", "time.start_steps=2", "--set", "time.first_step_ratio=0.1",
                 "--set", "output.fields_interval=25", "--set", "output.section_r_over_R=[0.89, 0.5]")
        self.assertEqual(self.run_program("mesh", CASE).returncode, 0)
        self.assertEqual(self.run_program("run", CASE, "--out", "whole", "--steps", "50", *steps).returncode, 0)
        self.assertEqual(self.run_program("run", CASE, "--out", "parts", "--steps", "25", *steps).returncode, 0)
        self.assertEqual(self.run_program("run", CASE, "--out", "parts", "--steps", "50", "--restart", *steps).returncode, 0)
        self.assertEqual(self.tables("whole"), self.tables("parts"))

        history = self.rows("whole/history.csv")
        for row in history[1:]:
            force = (0.1 * row["fx_N"] + row["fy_N"]) / math.hypot(0.1, 1)
            moment = (0.1 * row["mx_Nm"] + row["my_Nm"] - 1.3 * row["fz_N"]) / math.hypot(0.1, 1)
            self.assertAlmostEqual(row["rotor_left_thrust_N"], force, delta=1e-9 * abs(force))
            self.assertAlmostEqual(row["rotor_left_torque_Nm"], -moment, delta=1e-9 * abs(row["mx_Nm"]) + 1e-9 * abs(moment))
            self.assertGreater(row["rotor_left_torque_Nm"], 0)
            self.assertAlmostEqual(row["rotor_left_rpm"], 1000, delta=1e-9)
            self.assertAlmostEqual(row["rotor_left_CT"], row["rotor_left_thrust_N"] / (1.225 * (1000 / 60) ** 2 * 16), delta=1e-9)
            turned = math.remainder(row["rotor_left_angle_deg"] - 6000 * row["time_s"], 360)
            self.assertAlmostEqual(turned, 0, delta=1e-9)

        revolution, = self.rows("whole/rotor_left_revolutions.csv")
        inside = [row for row in history if row["time_s"] <= 0.06 + 1e-12]
        mean = sum((b["time_s"] - a["time_s"]) * (a["rotor_left_thrust_N"] + b["rotor_left_thrust_N"]) / 2
                   for a, b in zip(inside, inside[1:]))
        last = next(row for row in history if row["time_s"] > 0.06 + 1e-12)
        rest = 0.06 - inside[-1]["time_s"]
        slope = (last["rotor_left_thrust_N"] - inside[-1]["rotor_left_thrust_N"]) / (last["time_s"] - inside[-1]["time_s"])
        mean += rest * (inside[-1]["rotor_left_thrust_N"] + slope * rest / 2)
        self.assertAlmostEqual(revolution["thrust_N"], mean / 0.06, delta=1e-9 * mean / 0.06)
        self.assertAlmostEqual(revolution["time_s"], 0.06, delta=1e-12)
        self.assertLess(abs(revolution["hub_thrust_N"]), 0.05 * revolution["thrust_N"])
        self.check_strips(history, revolution)
        self.check_sections()
        summary = json.loads((self.folder / "whole/summary.json").read_text())
        self.assertEqual(summary["rotors"]["left"]["latest_revolution"]["CT"], revolution["CT"])

    def check_strips(self, history, revolution):
        """The strips add up to the blades' loads, at each output and on average."""
        width = 0.75 / 20
        strips = self.rows("whole/rotor_left_strips.csv")
        self.assertEqual({row["step"] for row in strips}, {0, 25, 50})
        last = [row for row in strips if row["step"] == 50]
        self.assertEqual(len(last), 40)
        self.assertAlmostEqual(last[0]["r_over_R"], 0.25 + width / 2, delta=1e-12)
        self.assertAlmostEqual(last[0]["chord_m"], 0.2 - 0.05 * (width / 2) / 0.75, delta=1e-12)
        self.assertAlmostEqual(sum(row["dT_dr_N_m"] for row in last) * width, history[50]["rotor_left_thrust_N"],
                               delta=0.01 * history[50]["rotor_left_thrust_N"])  # without the hub
        mean = self.rows("whole/rotor_left_strips_mean.csv")
        for column, whole, hub in (("dT_dr_N_m", "thrust_N", "hub_thrust_N"), ("dQ_dr_N", "torque_Nm", "hub_torque_Nm")):
            blades = revolution[whole] - revolution[hub]
            self.assertAlmostEqual(sum(row[column] for row in mean) * width, blades, delta=1e-11 * blades)
        self.assertEqual([row["blade"] for row in mean], 20 * [0] + 20 * [1])
        self.assertTrue(all(row["dT_dr_N_m"] > 0 and row["dQ_dr_N"] > 0 for row in mean))

    def check_sections(self):
        """The pressure around a section gives about the coefficient of the strip there."""
        points = self.rows("whole/rotor_left_sections_mean.csv")
        strips = self.rows("whole/rotor_left_strips_mean.csv")
        for blade in (0, 1):
            for r_over_R in (0.5, 0.89):
                own = [p for p in points if (p["blade"], p["r_over_R"]) == (blade, r_over_R)]
                sides = [[(p["x_over_c"], p["Cp"]) for p in own if p["side"] == side] for side in (-1, 1)]
                for side in sides:
                    self.assertEqual(side, sorted(side))
                    self.assertTrue(all(-0.01 < x < 1.01 for x, _ in side))
                lower, upper = (sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(s, s[1:])) for s in sides)
                strip = min((s for s in strips if s["blade"] == blade), key=lambda s: abs(s["r_over_R"] - r_over_R))
                self.assertAlmostEqual(lower - upper, strip["normal_coefficient"], delta=0.25 * strip["normal_coefficient"])

    def test_pictures(self):
        self.assertEqual(self.run_program("mesh", CASE).returncode, 0)
        run = self.run_program("run", CASE, "--out", "out", "--set", "time.step_deg=5", "--set", "time.steps=3")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        made = subprocess.run([sys.executable, "-m", "windhover.picture", "out", "--out", "pictures"], cwd=self.folder,
                              env={**os.environ, "PYTHONPATH": str(PYTHON)}, capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(made.stderr, "")
        for name in ("surface", "slice", "history"):
            png = (self.folder / f"pictures/{name}.png").read_bytes()
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
            width, height = struct.unpack(">II", png[16:24])
            self.assertTrue(800 <= height <= width <= 2000, (name, width, height))
            self.assertGreater(len(png), 30_000, name)  # more than an empty frame

    def test_errors(self):
        self.check_error(self.run_program("mesh", second(CASE, "right", 1)), "case.toml:", "overlaps that of rotor")
        self.check_error(self.run_program("mesh", CASE, "--set", "rotor[0].zone.radius_m=0.9"), "pokes through its zone")
        self.check_error(self.run_program("mesh", CASE, "--set", "mesh.min_dihedral_deg=50"), "is below mesh.min_dihedral_deg")
        self.check_error(self.run_program("run", CASE, "--set", "mesh.min_dihedral_deg=50"), "does not exist")
        self.check_error(self.run_program("mesh", CASE, "--set", "mesh.farfield.radius_m=0"), "mesh.farfield.radius_m is needed")
        self.check_error(self.run_program("check", CASE, "--set", "mesh.refine=0.9"), "does not exist; `windhover mesh`")


if __name__ == "__main__":
    unittest.main()
