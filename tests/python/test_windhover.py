"""The exact solutions and fits of the Python module."""

import sys
import unittest
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from windhover import fit, scene
from windhover.exact import riemann, sphere, vortex

SOD = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1)


class Riemann(unittest.TestCase):
    def test_sod(self):
        p, u = riemann.star(*SOD)
        self.assertAlmostEqual(p, 0.3031302, 7)
        self.assertAlmostEqual(u, 0.9274526, 7)
        density = riemann.solution(np.array([0.0, 0.9, 1.0, 1.75, 1.76]), *SOD)[0]
        np.testing.assert_allclose(density[1:], [0.4263194, 0.2655737, 0.2655737, 0.125], atol=1e-7)
        self.assertAlmostEqual(riemann.speeds(*SOD)[-1], 1.7521557, 7)

    def test_mirrored(self):
        left, right = (1.0, 0.3, 2.0), (0.7, -0.4, 0.5)
        mirror = lambda side: (side[0], -side[1], side[2])
        xi = np.linspace(-3, 3, 301) + 1e-6
        density, velocity, pressure = riemann.solution(xi, left, right)
        mirrored = riemann.solution(-xi, mirror(right), mirror(left))
        np.testing.assert_allclose(mirrored, [density, -velocity, pressure], rtol=1e-10)

    def test_continuous_in_both_fans(self):
        sides = (1.0, -1.0, 1.0), (1.0, 1.0, 1.0)
        density = riemann.solution(np.linspace(-3, 3, 60001), *sides)[0]
        self.assertLess(np.abs(np.diff(density)).max(), 2e-4)


class Vortex(unittest.TestCase):
    def test_centripetal(self):
        r = np.linspace(0.2, 4, 20)
        h = 1e-5
        at = lambda r: vortex.solution(np.column_stack([r, 0 * r]), 5.0, [0, 0, 0])
        slope = (at(r + h)[2] - at(r - h)[2]) / (2 * h)
        density, velocity, pressure = at(r)
        np.testing.assert_allclose(slope, density * velocity[:, 1] ** 2 / r, atol=1e-8)
        np.testing.assert_allclose(1.4 * pressure, density**1.4)


class Sphere(unittest.TestCase):
    def test_added_mass(self):
        self.assertAlmostEqual(sphere.response(0.0), -0.5)

    def test_transient_reaches_the_response(self):
        for k in (0.3, 1.0):
            t = np.linspace(0, 12 + 4 * np.pi / k, 4000)
            force = sphere.force(t, lambda t: np.cos(k * t))
            last = t > t[-1] - 2 * np.pi / k
            self.assertLess(abs(fit.harmonic(t[last], force[last], k) - sphere.response(k)), 1e-4)


class Fit(unittest.TestCase):
    def test_order(self):
        self.assertAlmostEqual(fit.order([1, 2, 4], [3, 12, 48]), 2)

    def test_harmonic(self):
        t = np.linspace(0, 7, 50)
        self.assertAlmostEqual(fit.harmonic(t, 3 * np.cos(2 * t + 0.4) + 5, 2), 3 * np.exp(0.4j))


class Scene(unittest.TestCase):
    """A box of 4 x 4 x 4 in tetrahedra, and its surface."""

    def setUp(self):
        image, tetrahedra, self.surface = vtkImageData(), vtkDataSetTriangleFilter(), vtkDataSetSurfaceFilter()
        image.SetDimensions(5, 5, 5)
        tetrahedra.SetInputData(image)
        self.surface.SetInputConnection(tetrahedra.GetOutputPort())
        self.surface.Update()
        self.box = scene.Mesh(tetrahedra.GetOutput())

    def walls(self):
        skin = self.surface.GetOutput()
        pressure = numpy_to_vtk(np.arange(float(skin.GetNumberOfCells())), deep=True)
        pressure.SetName("pressure_Pa")
        skin.GetCellData().AddArray(pressure)
        skin.GetCells = skin.GetPolys
        return scene.Walls([scene.Mesh(skin)])

    def test_linear_values_at_points(self):
        at = lambda places: places @ [[1.0], [2], [3]] + 1
        points = self.box.points
        center = points[self.box.nodes].reshape(-1, 4, 3).mean(axis=1)
        error = np.abs(self.box.at_points(at(center)) - at(points))[:, 0]
        margins = np.sum((points == 0) | (points == 4), axis=1)
        self.assertLess(error[margins == 0].max(), 1e-6)
        self.assertLess(error[margins == 1].mean(), 0.3)

    def test_normals_point_out(self):
        walls = self.walls()
        self.assertTrue(np.all(np.sum(walls.normal * (walls.center - 2), axis=1) > 1.9))

    def test_split(self):
        walls = self.walls()
        distance = lambda places: (places - 1.7) @ [0.6, 0.64, 0.48]
        corners, face = walls.split(distance)
        area = lambda c: np.linalg.norm(np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0]), axis=1) / 2
        self.assertGreater(len(corners), len(walls.corners))
        np.testing.assert_allclose(np.bincount(face, area(corners)), area(walls.corners))
        d = distance(corners)
        self.assertTrue(np.all((d.max(axis=1) < 1e-12) | (d.min(axis=1) > -1e-12)))

    def test_outline(self):
        edges = self.walls().outline(np.array([0.1, 0.2, 1]))
        length = np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1).sum()
        self.assertAlmostEqual(length, 24)  # six edges of the box


if __name__ == "__main__":
    unittest.main()
