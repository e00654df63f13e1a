"""An airframe with rotors from a case to a mesh: test_airframe.py WINDHOVER [unittest arguments]."""
import collections
import math
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np

WINDHOVER = pathlib.Path(sys.argv.pop(1)).resolve()

CASE = """
[mesh]
resolution = "small"
resolutions = {small = 0.8, large = 2}
farfield = {radius_m = 8, size_m = 3}
[airframe]
size_m = 0.2
cells_per_turn = 20
growth = 0.6
[[airframe.part]]
name = "body"
size_m = [1, 0.4, 0.6]
mass_kg = 2
[[airframe.part]]
name = "arm"
kind = "capsule"
from_m = [0.1, 0, 0]
to_m = [1.2, 0, 0]
radius_m = 0.1
mirror = "x"
density_kg_m3 = 10
[[rotor]]
name = "front"
center_m = [1.3, 0.6, 0]
rpm = 1000
mass_kg = 0.1
[rotor.blade]
count = 2
radius_m = 1
r_over_R = [0.25, 1]
c_over_R = [0.2, 0.15]
beta_deg = [20, 8]
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
wake_m = 0.4
growth = 0.6
[[rotor]]
name = "rear"
like = "front"
center_m = [-1.3, 0.6, 0]
direction = "clockwise"
[time]
step_deg = 1
steps = 2
first_step_ratio = 0.01
"""
BALL, ZONE = 4 / 3 * math.pi * 8**3, math.pi * 1.2**2 * 0.6
AIRFRAME = 1 * 0.4 * 0.6 + 2 * (math.pi * 0.1**2 * (1.2 - 0.5) + 2 / 3 * math.pi * 0.1**3)


class Mesh:
    """Of a gmsh file in format 4.1: the triangles of each named surface and volume, the tetrahedra of each volume."""

    def __init__(self, path):
        self.sections = {}
        lines = path.read_text().splitlines()
        for begin, line in enumerate(lines):
            if line.startswith("$") and not line.startswith("$End"):
                self.sections[line[1:]] = lines[begin + 1:lines.index("$End" + line[1:], begin)]
        self.read_names()
        self.read_nodes()
        self.read_elements()

    def read_names(self):
        names = {}
        for line in self.sections["PhysicalNames"][1:]:
            dimension, tag, name = line.split(maxsplit=2)
            names[int(dimension), int(tag)] = name.strip('"')
        rows = iter(self.sections["Entities"])
        counts = [int(x) for x in next(rows).split()]
        self.name = {}
        for dimension, count in enumerate(counts):
            for _ in range(count):
                words = next(rows).split()
                groups = words[5:] if dimension == 0 else words[8:]
                if dimension >= 2 and int(words[7]):
                    self.name[dimension, int(words[0])] = names[dimension, int(groups[0])]

    def read_nodes(self):
        rows = iter(self.sections["Nodes"])
        self.point = {}
        for _ in range(int(next(rows).split()[0])):
            count = int(next(rows).split()[3])
            tags = [int(next(rows)) for _ in range(count)]
            for tag in tags:
                self.point[tag] = np.array([float(x) for x in next(rows).split()])

    def read_elements(self):
        rows = iter(self.sections["Elements"])
        self.elements = collections.defaultdict(list)
        self.by_surface = {}
        for _ in range(int(next(rows).split()[0])):
            dimension, tag, _, count = (int(x) for x in next(rows).split())
            cells = [tuple(int(x) for x in next(rows).split()[1:]) for _ in range(count)]
            self.elements[dimension, self.name[dimension, tag]] += cells

    def volume(self, name):
        corners = np.array([[self.point[n] for n in cell] for cell in self.elements[3, name]])
        edges = corners[:, 1:] - corners[:, :1]
        return np.linalg.det(edges).sum() / 6

    def boundary(self, name):
        """The outward faces that one tetrahedron of a volume has alone."""
        faces = {}
        for a, b, c, d in self.elements[3, name]:
            for face in ((a, c, b), (a, b, d), (b, c, d), (a, d, c)):
                key = tuple(sorted(face))
                if key in faces:
                    faces[key] = None
                else:
                    faces[key] = face
        return {key: face for key, face in faces.items() if face}

    def enclosed(self, faces):
        corners = np.array([[self.point[n] for n in face] for face in faces])
        return np.einsum("ij,ij->", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]) / 6


class Airframe(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def run_program(self, command, case, *arguments):
        (self.folder / "case.toml").write_text(case)
        return subprocess.run([WINDHOVER, command, "case.toml", *arguments], cwd=self.folder, capture_output=True, text=True)

    def check_done(self, result):
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def check_error(self, result, *parts):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for part in parts:
            self.assertIn(part, result.stderr)

    def check_solids(self, mesh, airframe, zones):
        """All of the boundary is named; airframe, zones and ball have their volumes; the air fills what is between."""
        faces = mesh.boundary("outer")
        solids = collections.Counter()
        for name in ("farfield", "airframe", *(zone + "_slide" for zone in zones)):
            keys = {tuple(sorted(t)) for t in mesh.elements[2, name]} & faces.keys()
            self.assertGreater(len(keys), 20, name)
            solids[name] = mesh.enclosed([faces.pop(key) for key in keys])
        self.assertFalse(faces, "the outer zone has faces without a name")
        self.assertAlmostEqual(sum(solids.values()) / mesh.volume("outer"), 1, places=10)
        self.assertAlmostEqual(-solids["airframe"] / airframe, 1, delta=0.006)
        self.assertAlmostEqual(solids["farfield"] / BALL, 1, delta=0.15)  # cells of 3 m on a ball of 8 m
        for zone in zones:
            self.assertAlmostEqual(-solids[zone + "_slide"] / ZONE, 1, delta=0.05)

    def test_mesh(self):
        made = self.run_program("mesh", CASE)
        self.check_done(made)
        self.assertIn("zones: front (", made.stdout)
        self.assertIn("sound crosses the smallest cell in", made.stdout)
        name = self.folder.name + "_small.msh"
        mesh = Mesh(self.folder / name)
        self.assertEqual({n for d, n in mesh.elements if d == 3}, {"outer", "front", "rear"})
        self.assertEqual({n for d, n in mesh.elements if d == 2},
                         {"farfield", "airframe", "front_slide", "front_blades", "rear_slide", "rear_blades"})
        self.check_solids(mesh, AIRFRAME, ("front", "rear"))
        front, rear = (len(mesh.elements[2, rotor + "_blades"]) for rotor in ("front", "rear"))
        self.assertEqual(front, rear)
        self.assertGreater(len(mesh.elements[3, "front"]), 700)
        self.assertLess(len(mesh.elements[3, "outer"]), 60000)
        self.check_run()

    def check_run(self):
        checked = self.run_program("check", CASE)
        self.check_done(checked)
        for text in ("airframe: wall", "rear_slide: sliding", "mass 2.975 kg, centre of gravity (0, 0.04034, 0) m"):
            self.assertIn(text, checked.stdout)
        self.check_done(self.run_program("run", CASE, "--out", "out"))
        effective = (self.folder / "out/case.toml").read_text()
        self.check_done(self.run_program("check", effective))
        self.check_error(self.run_program("check", CASE, "--set", "airframe.part[1].radius_m=0.11"), "was made from other")
        self.check_done(self.run_program("check", CASE, "--set", "airframe.part[0].mass_kg=3"))

        self.check_dynamic_body()

    def check_dynamic_body(self):
        """Its mass is that of the parts, and a rotor's inertia follows from its blades."""
        case = CASE.replace("[time]", '[body]\nkind = "dynamic"\n[[body.rotor]]\nname = "rear"\nspin_axis = [0, -1, 0]\nmotor.kind = "servo"\n'
                            "[controller]\nspeed_rad_s = {rear = 100}\n[time]")
        self.check_done(self.run_program("run", case, "--steps", "1", "--out", "fall"))
        body = tomllib.loads((self.folder / "fall/case.toml").read_text())["body"]
        self.assertAlmostEqual(body["mass_kg"], 2 + 0.2 + 20 * (math.pi * 0.1**2 * 1.1 + 4 / 3 * math.pi * 0.1**3))
        np.testing.assert_allclose(body["center_of_gravity_m"], [0, 0.2 * 0.6 / body["mass_kg"], 0], atol=1e-12)
        self.assertGreater(min(body["inertia_kg_m2"]), 0.1)
        chord = lambda r: 0.2 - 0.05 * (r - 0.25) / 0.75
        r = np.linspace(0.25, 1, 20001)
        gyration = np.sum(chord(r) ** 2 * r**2) / np.sum(chord(r) ** 2)
        self.assertAlmostEqual(body["rotor"][0]["inertia_kg_m2"] / (0.1 * gyration), 1, places=3)

    def write_step(self, shape):
        """Its unit is the millimetre."""
        (self.folder / "body.geo").write_text('SetFactory("OpenCASCADE"); ' + shape)
        subprocess.run(["gmsh", "-0", "body.geo", "-o", "body.step"], cwd=self.folder, check=True, capture_output=True)

    def test_step_file(self):
        self.write_step("Box(1) = {-500, -200, -300, 1000, 400, 600};")
        body = CASE[CASE.index("[[airframe.part]]"):CASE.index('[[airframe.part]]\nname = "arm"')]
        case = CASE.replace(body, 'step = "body.step"\n')
        rotors = case[case.index("[[rotor]]"):case.index("[time]")]
        case = case.replace(rotors, "").replace("step_deg = 1", "step_s = 1e-5")
        self.check_done(self.run_program("mesh", case))
        self.check_solids(Mesh(self.folder / (self.folder.name + "_small.msh")), AIRFRAME, ())
        self.write_step("Rectangle(1) = {0, 0, 0, 1, 1};")
        self.check_error(self.run_program("mesh", case), "body.step: has no solid")

    def test_errors(self):
        def error(key, *parts):
            self.check_error(self.run_program("mesh", CASE, "--set", key), *parts)

        error("rotor[0].center_m=[1.3,0.2,0]", 'rotor "front": its zone overlaps the airframe at (')
        error("rotor[1].center_m=[-1.3,0.505,0]", 'rotor "rear": its zone comes nearer to the airframe than 0.01 m at (')
        error("airframe.part[1].from_m=[0.9,0,0]", "falls into 3 pieces that do not touch")
        error("airframe.part[0].center_m=[7.8,0,0]", "airframe: ")
        error("airframe.part[1].radius_m=0", 'part "arm": radius_m is needed')
        error('rotor[1].like="frond"', "must be the name of a rotor before it", 'did you mean "front"')
        error('mesh.resolution="smal"', "is not in mesh.resolutions", 'did you mean "small"')
        self.check_error(self.run_program("mesh", CASE.replace("capsule", "cone")), "case.toml:", "must be one of")
        self.check_error(self.run_program("mesh", CASE.replace('kind = "capsule"', 'kind = "ellipsoid"')), "unknown key for kind")


if __name__ == "__main__":
    unittest.main()
