"""Force of a still gas on a sphere that moves to and fro along a line: linear acoustics, all times in a/c."""

import numpy as np


def response(k):
    """Force over (density × volume × acceleration) at the reduced frequency k = ωa/c, complex."""
    s = 1j * k
    return -(1 + s) / (2 + 2 * s + s**2)


def force(times, acceleration):
    """The same force from rest at times[0], for any acceleration(t); Runge–Kutta steps between the given times."""

    def rate(t, z):
        return np.array([z[1], acceleration(t) - 2 * z[0] - 2 * z[1]])

    z, values = np.zeros(2), [0.0]
    for t, next_t in zip(times[:-1], times[1:]):
        h = next_t - t
        k1 = rate(t, z)
        k2 = rate(t + h / 2, z + h / 2 * k1)
        k3 = rate(t + h / 2, z + h / 2 * k2)
        k4 = rate(next_t, z + h * k3)
        z = z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        values.append(-z.sum())
    return np.array(values)


def free_oscillation(times, mass, stiffness):
    """Displacement over its start of a sphere on a spring, released from rest at times[0] = 0; gas density 1.

    The force above with the velocity as input: F = -V (U - w - 2 z), z' = w, w' = U - 2 z - 2 w, V = 4π/3.
    """
    volume = 4 / 3 * np.pi
    rates = np.array(
        [
            [0, 1, 0, 0],
            [-stiffness / mass, -volume / mass, 2 * volume / mass, volume / mass],
            [0, 0, 0, 1],
            [0, 1, -2, -2],
        ]
    )
    values, vectors = np.linalg.eig(rates)
    parts = np.linalg.solve(vectors, [1, 0, 0, 0])
    return (np.exp(np.outer(times, values)) @ (parts * vectors[0])).real
