"""Figures of the static Slow Flyer: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check

DENSITY, TURNS_PER_SECOND = 1.225, 6528 / 60
DIAMETER = 0.254


def thrust(run):
    """The mean over the last revolution."""
    time, force = run.history["time_s"], run.history["fy_N"]
    last = time > time[-1] - 1 / TURNS_PER_SECOND
    return float(np.average(force[last], weights=np.diff(time, prepend=0)[last]))


def figures(runs, folder):
    return {f"CT_{name}": thrust(run) / (DENSITY * TURNS_PER_SECOND**2 * DIAMETER**4) for name, run in runs.items()}


check.main(figures)
