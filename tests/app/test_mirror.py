"""A mirror image of mesh and motion has the mirror image of the loads: no side and no sense of rotation is preferred."""
import unittest

import running

windhover, meshes = running.arguments()


def mirrored(mesh):
    """A gmsh 4.1 text file with x changed to -x, and elements (triangles, tetrahedra) turned right side out again."""
    lines = mesh.splitlines()
    section, left = "", 0
    for i, line in enumerate(lines):
        if line.startswith("$"):
            section, header, left = line, True, 0
        elif section in ("$Nodes", "$Elements") and header:
            header = False
        elif section in ("$Nodes", "$Elements") and left == 0:  # of a block
            left = int(line.split()[3])
        elif section == "$Elements":
            left -= 1
            tag, *nodes = line.split()
            nodes[:2] = nodes[1::-1]
            lines[i] = " ".join([tag, *nodes])
        elif section == "$Nodes":
            words = line.split()
            if len(words) == 1:  # tags come before the coordinates
                continue
            left -= 1
            words[0] = words[0][1:] if words[0].startswith("-") else "-" + words[0]
            lines[i] = " ".join(words)
    return "\n".join(lines) + "\n"


class Mirror(running.Running):
    windhover = windhover
    case = f"""
[mesh]
geometry = "{meshes / 'propeller_in_box.geo'}"
file = "propeller.msh"
parameters = {{h = 0.3}}
[fluid]
boundary = {{sides = "farfield", propeller = "wall"}}
[[zone]]
name = "rotor"
parent = "box"
inner_surface = "slide"
axis = [0, 0, 1]
radius_m = 0.5
from_m = -0.2
to_m = 0.2
[time]
step_s = 1e-4
steps = 10
[solver]
newton_tolerance = 1e-10
newton_iterations = 30
"""

    def test_loads(self):
        self.run_case("one", "zone.0.rate_deg_s=30000", "wind.velocity_m_s=[5, 3, 8]")
        mesh = self.folder / "propeller.msh"
        mesh.write_text(mirrored(mesh.read_text()))
        self.run_case("other", "zone.0.rate_deg_s=-30000", "wind.velocity_m_s=[-5, 3, 8]")
        one, other = self.table("one"), self.table("other")
        self.assertEqual(len(one), len(other))
        for key, sign in {"fx_N": -1, "fy_N": 1, "fz_N": 1, "mx_Nm": 1, "my_Nm": -1, "mz_Nm": -1}.items():
            scale = running.size(one, key)
            self.assertGreater(scale, 1)
            for a, b in zip(one, other):
                self.assertLess(abs(float(a[key]) - sign * float(b[key])), 1e-7 * scale, key)


if __name__ == "__main__":
    unittest.main()
