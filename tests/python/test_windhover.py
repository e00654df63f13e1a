"""The exact solutions and fits of the Python module."""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from windhover import fit
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


if __name__ == "__main__":
    unittest.main()
