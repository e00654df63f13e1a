"""Zones in a mesh of the user's that cannot be: test_zones.py WINDHOVER MESHES [unittest arguments]."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()
MESHES = pathlib.Path(sys.argv.pop(1)).resolve()

ZONE = """
[[zone]]
name = "rotor"
parent = "box"
inner_surface = "slide"
axis = [0, 0, 1]
radius_m = 0.5
from_m = -0.3
to_m = 0.3
rate_deg_s = 3000
"""
CASE = f"""
[mesh]
geometry = "{MESHES / 'paddle_in_box.geo'}"
file = "box.msh"
parameters = {{h = 0.3, paddle = 1}}
[fluid]
boundary = {{sides = "wall", paddle = "wall"}}
{ZONE}
[time]
step_s = 1e-4
steps = 2
"""


class Zones(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        made = cls.run_program("mesh", CASE)
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def run_program(cls, command, case, *sets, ranks=1):
        (cls.folder / "case.toml").write_text(case)
        launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        arguments = [word for key in sets for word in ("--set", key)]
        return subprocess.run([*launcher, WINDHOVER, command, "case.toml", *arguments], cwd=cls.folder, capture_output=True, text=True)

    def check_error(self, result, *parts):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)
        self.assertFalse((self.folder / "results/case/history.csv").exists())

    def test_good(self):
        checked = self.run_program("check", CASE)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("slide: sliding", checked.stdout)

    def test_nodes_off_the_surface(self):
        for ranks in (1, 2):
            self.check_error(self.run_program("run", CASE, "zone[0].radius_m=0.49", ranks=ranks), "surface 'slide' of zone 'rotor'",
                             "not on the cylinder of radius 0.49", "the worst is 0.01 off at (")
        self.check_error(self.run_program("run", CASE, "zone[0].to_m=0.32"), "not on the cylinder", "the worst is 0.02 off at (")
        self.check_error(self.run_program("run", CASE, "zone[0].axis=[0,0.1,1]"), "not on the cylinder")

    def test_two_zones_claim_a_surface(self):
        twice = CASE.replace("[time]", ZONE + "[time]")
        self.check_error(self.run_program("run", twice), "case.toml", 'zone[1]: the surface "slide" belongs to another zone\'s interface')
        turned = ZONE.replace('"rotor"', '"x"').replace('"box"', '"rotor"').replace('"x"', '"box"')
        self.check_error(self.run_program("run", CASE.replace("[time]", turned + "[time]")), "belongs to another zone's interface")

    def test_names(self):
        self.check_error(self.run_program("run", CASE, 'zone[0].name="rotr"'), "zone[0].name", 'did you mean "rotor"')
        self.check_error(self.run_program("run", CASE, 'zone[0].inner_surface="slid"'), "zone[0].inner_surface", 'did you mean "slide"')
        self.check_error(self.run_program("run", CASE.replace(ZONE, "")), "'slide' has no boundary condition")
        self.check_error(self.run_program("run", CASE, 'fluid.boundary.slide="wall"'), "'slide' is a sliding interface")

    def test_zones_exchanged(self):
        turned = ZONE.replace('"rotor"', '"x"').replace('"box"', '"rotor"').replace('"x"', '"box"')
        self.check_error(self.run_program("run", CASE.replace(ZONE, turned)), "zone 'box'", "inside out", "at (")


if __name__ == "__main__":
    unittest.main()
