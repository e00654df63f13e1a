"""Figures of the vortex through a spinning zone: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check, fit
from windhover.exact import vortex


def density_error(run):
    """L2 norm of the density's error over that of the vortex's own density."""
    case, state = run.case, run.final
    stream, initial = np.array(case["wind"]["velocity_m_s"]), case["fluid"]["initial"]
    place = (state.center - initial["center_m"] - stream * state.time_s) / initial["core_radius_m"]
    exact, _, _ = vortex.solution(place, initial["strength"], stream)
    return fit.l2(state.volume, state.density - exact) / fit.l2(state.volume, exact - 1)


def figures(runs, folder):
    """Runs named sliding_<n> and still_<n>."""
    errors = {name: density_error(run) for name, run in runs.items()}
    values = {f"error_{name}": error for name, error in errors.items()}
    for kind in ("sliding", "still"):
        sizes = {1 / int(name.split("_")[1]): error for name, error in errors.items() if name.startswith(kind)}
        if len(sizes) > 1:
            values[f"order_{kind}"] = fit.order(list(sizes), list(sizes.values()))
    for name, error in errors.items():
        still = errors.get(name.replace("sliding", "still"))
        if name.startswith("sliding") and still:
            values[f"ratio_{name.split('_')[1]}"] = error / still
    return values


check.main(figures)
