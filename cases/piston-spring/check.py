"""Figures of the piston on a spring: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check, fit


def exact(run):
    """m x'' + ρcA x' + k x = 0 from rest, at the times of the history."""
    body, time = run.case["body"], run.history["time_s"]
    mass, stiffness, start = body["mass_kg"], body["mount"]["x"]["stiffness_N_m"], body["position_m"][0]
    rates = np.roots([mass, 1.0, stiffness])
    parts = np.linalg.solve([[1, 1], rates], [start, 0])
    return (np.exp(np.outer(time, rates)) @ parts).real / start


def displacement(run):
    return run.history["x_m"] / run.case["body"]["position_m"][0]


def figures(runs, folder):
    """Runs named <scheme>_<steps per unit of time>, and `fine`, whose steps are so small that its error is the mesh's."""
    values, errors = {}, {}
    fine = runs.get("fine")
    if fine:
        values["mesh_error"] = float(np.abs(displacement(fine) - exact(fine)).max())
    for name, run in runs.items():
        scheme, _, steps = name.partition("_")
        if name == "fine":
            continue
        values[f"error_{name}"] = float(np.abs(displacement(run) - exact(run)).max())
        values[f"iterations_{name}"] = float(run.history["coupling_iterations"][1:].mean())
        if fine:
            time = run.history["time_s"]
            same = np.interp(time, fine.history["time_s"], displacement(fine))
            errors.setdefault(scheme, {})[1 / float(steps)] = np.abs(displacement(run) - same).max()
    for scheme, by_step in errors.items():
        if len(by_step) > 2:
            values[f"order_{scheme}"] = fit.order(list(by_step), list(by_step.values()))
    return values


check.main(figures)
