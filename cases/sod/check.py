"""Figures of Sod's tube: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check, fit
from windhover.exact import riemann

LEFT, RIGHT = (1.0, 0.0, 1.0), (0.125, 0.0, 0.1)
MIDDLE = 0.5


def exact(x, time):
    return riemann.solution((x - MIDDLE) / time, LEFT, RIGHT)


def profile(state, n):
    """Density averaged over n slices of the tube, and the slices' centres."""
    slices = np.minimum((state.center[:, 0] * n).astype(int), n - 1)
    volume = np.bincount(slices, state.volume, n)
    return (np.arange(n) + 0.5) / n, np.bincount(slices, state.volume * state.density, n) / volume


def crossing(x, density, level, near):
    """The place nearest to `near` where the density falls through the level."""
    (i,) = np.nonzero((density[:-1] >= level) & (density[1:] < level))
    if not i.size:
        return float("nan")
    places = x[i] + (x[i + 1] - x[i]) * (density[i] - level) / (density[i] - density[i + 1])
    return float(places[np.abs(places - near).argmin()])


def front_errors(x, density, time):
    """Distance of the contact and of the shock from their exact places, in slices."""
    *_, contact, shock, _ = riemann.speeds(LEFT, RIGHT)
    places = [MIDDLE + contact * time, MIDDLE + shock * time]
    for place in places:
        sides = exact(place + np.array([-1e-9, 1e-9]), time)[0]
        yield abs(crossing(x, density, sides.mean(), place) - place) * len(x)


def plot(profiles, file):
    x = np.linspace(0, 1, 2001)
    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    axes.plot(x, exact(x, 0.2)[0], "k", linewidth=1, label="exact")
    for name, (x, density) in profiles.items():
        axes.plot(x, density, ".", markersize=3, label=name.replace("_", " "))
    axes.set(xlabel="x", ylabel="density", title="Sod's tube at t = 0.2")
    axes.legend()
    figure.savefig(file, dpi=120)


def figures(runs, folder):
    values, profiles, errors = {}, {}, {}
    for name, run in runs.items():
        kind, n = name.rsplit("_", 1)
        state = run.final
        error = np.abs(state.density - exact(state.center[:, 0], state.time_s)[0])
        errors.setdefault(kind, {})[1 / int(n)] = values[f"l1_{name}"] = float(np.average(error, weights=state.volume))
        profiles[name] = profile(state, int(n))
        values[f"contact_{name}"], values[f"shock_{name}"] = front_errors(*profiles[name], state.time_s)
        values[f"lowest_{name}"] = float(min(state.density.min(), state.pressure.min()))
    for kind, by_size in errors.items():
        if len(by_size) > 1:
            values[f"order_{kind}"] = fit.order(list(by_size), list(by_size.values()))
    if profiles:
        plot(profiles, folder / "density.png")
    return values


check.main(figures)
