"""Figures of the free asymmetric top: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check


def jacobi(u, m):
    """sn, cn, dn by the arithmetic-geometric mean (Abramowitz & Stegun 16.4)."""
    a, c, b = [1.0], [np.sqrt(m)], np.sqrt(1 - m)
    while abs(c[-1]) > 1e-16:
        a, c, b = [*a, (a[-1] + b) / 2], [*c, (a[-1] - b) / 2], np.sqrt(a[-1] * b)
    phi = 2 ** (len(a) - 1) * a[-1] * u
    for i in range(len(a) - 1, 0, -1):
        phi, before = (np.arcsin(c[i] / a[i] * np.sin(phi)) + phi) / 2, phi
    sn, cn = np.sin(phi), np.cos(phi)
    return sn, cn, np.sqrt(1 - m * sn**2)


def exact(time, inertia, start):
    """Body rates from (start_1, 0, start_3), I1 < I2 < I3 and L² > 2 E I2 (Landau & Lifshitz, Mechanics, §37)."""
    (i1, i2, i3), (a1, a3) = inertia, start
    m = (i2 - i1) * i1 * a1**2 / ((i3 - i2) * i3 * a3**2)
    rate = a3 * np.sqrt((i3 - i1) * (i3 - i2) / (i1 * i2))
    sn, cn, dn = jacobi(rate * time, m)
    return np.array([a1 * cn, a1 * np.sqrt(i1 * (i3 - i1) / (i2 * (i3 - i2))) * sn, a3 * dn])


def figures(runs, folder):
    values = {}
    for name, run in runs.items():
        body, history = run.case["body"], run.history
        inertia, start = np.array(body["inertia_kg_m2"]), body["rotation_rate_rad_s"]
        omega = np.radians([history["p_deg_s"], -history["r_deg_s"], history["q_deg_s"]])
        right = exact(history["time_s"], inertia, (start[0], start[2]))
        energy, momentum = inertia @ omega**2, np.sqrt(inertia**2 @ omega**2)
        crossings = np.count_nonzero(np.diff(np.sign(omega[0])))
        values["periods"] = crossings / 2
        values["rate_error"] = float(np.abs(omega - right).max() / np.abs(right).max())
        values["energy_drift"] = float(np.abs(energy / energy[0] - 1).max())
        values["momentum_drift"] = float(np.abs(momentum / momentum[0] - 1).max())
    return values


check.main(figures)
