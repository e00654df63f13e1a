"""Figures of the sphere on a spring: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check, fit
from windhover.exact import sphere


def displacement(run):
    return run.history["x_m"] / run.case["body"]["position_m"][0]


def exact(run):
    body = run.case["body"]
    return sphere.free_oscillation(run.history["time_s"], body["mass_kg"], body["mount"]["x"]["stiffness_N_m"])


def error(run, until=np.inf):
    return float(np.abs(displacement(run) - exact(run))[run.history["time_s"] <= until].max())


def difference(run, reference):
    """Largest difference of the displacements at the times of the run."""
    other = np.interp(run.history["time_s"], reference.history["time_s"], displacement(reference))
    return float(np.abs(displacement(run) - other).max())


def figures(runs, folder):
    values, errors = {}, {}
    for name, run in runs.items():
        kind, scheme, *step = name.split("_")
        values[f"error_{name}"] = error(run)
        values[f"iterations_{name}"] = float(run.history["coupling_iterations"][1:].mean())
        if kind == "order" and scheme != "fine" and "order_fine_0.025" in runs:
            errors.setdefault(scheme, {})[float(step[0])] = difference(run, runs["order_fine_0.025"])
        if kind == "large" and "large_iqn" in runs:
            if scheme in ("loose", "extrapolated"):
                values[f"worse_{scheme}"] = error(run) / error(runs["large_iqn"], run.history["time_s"][-1])
            else:
                values[f"difference_{name}"] = difference(run, runs["large_iqn"])
    for name in runs:
        kind, ratio, *n = name.split("_")
        if kind == "ratio" and n == ["6"] and f"ratio_{ratio}_4" in runs:
            values[f"mesh_ratio_{ratio}"] = values[f"error_{name}"] / values[f"error_ratio_{ratio}_4"]
    for scheme, by_step in errors.items():
        if len(by_step) == 3:
            values[f"order_{scheme}"] = fit.order(list(by_step), list(by_step.values()))
    return values


check.main(figures)
