"""Isentropic vortex carried by a uniform stream; lengths in core radii, velocities in sound speeds."""

import numpy as np


def solution(d, strength, stream, gamma=1.4):
    """Density, velocity and pressure at the places d [n, 2 or 3] from the axis; free stream: density 1, pressure 1/gamma."""
    r2 = d[:, 0] ** 2 + d[:, 1] ** 2
    swirl = strength / (2 * np.pi) * np.exp(0.5 * (1 - r2))
    temperature = 1 - (gamma - 1) / 2 * swirl**2
    velocity = np.tile(np.asarray(stream, float), (len(d), 1))
    velocity[:, 0] -= swirl * d[:, 1]
    velocity[:, 1] += swirl * d[:, 0]
    density = temperature ** (1 / (gamma - 1))
    return density, velocity, density * temperature / gamma
