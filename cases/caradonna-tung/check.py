"""Figures of Caradonna and Tung's rotor: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check

DENSITY, TURNS_PER_SECOND = 1.225, 1248.1 / 60
RADIUS = 1.143
TIP_SPEED = 2 * np.pi * TURNS_PER_SECOND * RADIUS


def thrust(run):
    """The mean over the last revolution."""
    time, force = run.history["time_s"], run.history["fy_N"]
    last = time > time[-1] - 1 / TURNS_PER_SECOND
    return float(np.average(force[last], weights=np.diff(time, prepend=0)[last]))


def figures(runs, folder):
    return {f"CT_{name}": thrust(run) / (DENSITY * np.pi * RADIUS**2 * TIP_SPEED**2) for name, run in runs.items()}


check.main(figures)
