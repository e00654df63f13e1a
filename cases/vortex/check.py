"""Figures of the isentropic vortex: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check, fit
from windhover.exact import vortex

WIDTH = 12.8


def density_error(run):
    """L2 norm of the density's error over that of the vortex's own density."""
    case, state = run.case, run.final
    stream, initial = np.array(case["wind"]["velocity_m_s"]), case["fluid"]["initial"]
    place = (state.center - initial["center_m"] - stream * state.time_s) @ state.rotation
    if "box" in case["mesh"]["geometry"]:
        place[:, :2] -= WIDTH * np.round(place[:, :2] / WIDTH)
    exact, _, _ = vortex.solution(place, initial["strength"], stream)
    return fit.l2(state.volume, state.density - exact) / fit.l2(state.volume, exact - 1)


def space_figures(runs):
    """Runs named <motion>_<cells>_<n>."""
    errors = {}
    for name, run in runs.items():
        if name.startswith(("still_", "translating_", "rotating_")):
            series, n = name.rsplit("_", 1)
            errors.setdefault(series, {})[WIDTH / int(n)] = density_error(run)
            yield f"error_{name}", errors[series][WIDTH / int(n)]
    for series, by_size in errors.items():
        if len(by_size) > 1:
            yield f"order_{series}", fit.order(list(by_size), list(by_size.values()))


def time_figures(runs):
    """Runs named steps_<n>: differences between results that differ in the time step alone."""
    states = [runs[name].final for name in ("steps_8", "steps_16", "steps_32") if name in runs]
    if len(states) < 3:
        return
    for quantity in ("density", "velocity"):
        jumps = [getattr(a, quantity) - getattr(b, quantity) for a, b in zip(states, states[1:])]
        coarse, fine = (fit.l2(states[0].volume, np.linalg.norm(jump.reshape(len(jump), -1), axis=1)) for jump in jumps)
        yield f"order_in_time_{quantity}", float(np.log2(coarse / fine))


def work_figures(runs, folder):
    """Runs named work_<scheme>_<steps>; writes work.csv and work.png."""
    rows = {}
    for name, run in runs.items():
        if name.startswith("work_"):
            scheme, steps = name.removeprefix("work_").rsplit("_", 1)
            row = int(steps), density_error(run), run.summary["wall_s"]["fluid"]
            rows.setdefault(scheme, []).append(row)
            yield f"error_{name}", row[1]
            yield f"seconds_{name}", row[2]
    if not rows:
        return
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    with open(folder / "work.csv", "w") as table:
        print("scheme,steps,density_error,seconds", file=table)
        for scheme, entries in rows.items():
            entries.sort()
            for steps, error, seconds in entries:
                print(f"{scheme},{steps},{error:.3e},{seconds:.2f}", file=table)
            _, error, seconds = zip(*entries)
            axes.loglog(seconds, error, "o-", label=scheme)
    axes.set(xlabel="seconds", ylabel="relative L2 error of density", title="Vortex, 128 x 128 cells, three core radii")
    axes.grid(which="both", alpha=0.3)
    axes.legend()
    figure.savefig(folder / "work.png", dpi=120)


def plot_errors(values, file):
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    series = {}
    for name, error in values.items():
        if name.startswith("error_") and not name.startswith("error_work_"):
            kind, n = name.removeprefix("error_").rsplit("_", 1)
            series.setdefault(kind, []).append((WIDTH / int(n), error))
    for kind, points in series.items():
        axes.loglog(*zip(*sorted(points)), "o-", label=kind.replace("_", ", "))
    h = np.array([0.1, 0.4])
    axes.loglog(h, 0.2 * h**2, "k--", label="second order")
    axes.set(xlabel="edge length / core radius", ylabel="relative L2 error of density")
    axes.legend(fontsize=8)
    figure.savefig(file, dpi=120)


def figures(runs, folder):
    values = {**dict(space_figures(runs)), **dict(time_figures(runs)), **dict(work_figures(runs, folder))}
    plot_errors(values, folder / "errors.png")
    return values


check.main(figures)
