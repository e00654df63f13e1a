"""Figures of the Slow Flyer in advance: python3 check.py RESULTS"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check
from windhover.results import read_table


def advance(run):
    """J = V/(n D)"""
    rotor = run.case["rotor"][0]
    return -run.case["wind"]["velocity_m_s"][1] / (rotor["rpm"] / 60 * 2 * rotor["blade"]["radius_m"])


def coefficient(run, name):
    """Mean over the last revolution."""
    return float(read_table(run.folder / "rotor_rotor_revolutions.csv")[name][-1])


def plot(J, CT, CP, measured, file):
    figure, axes = plt.subplots(figsize=(6, 4))
    for name, values, color in (("CT", CT, "tab:blue"), ("CP", CP, "tab:orange")):
        axes.plot(measured["J"], measured[name], "o", mfc="none", color=color, label=f"{name} measured")
        axes.plot(J, values, "x-", color=color, label=name)
    axes.set(xlabel="J", ylim=(0, 0.13))
    axes.legend()
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def figures(runs, folder):
    ordered = sorted(runs.values(), key=advance)
    J, CT, CP = (np.array([f(run) for run in ordered]) for f in
                 (advance, lambda run: coefficient(run, "CT"), lambda run: coefficient(run, "CP")))
    measured = read_table(HERE / "measured.csv")
    plot(J, CT, CP, measured, folder / "advance.png")
    result = {f"CT_{name}": coefficient(run, "CT") for name, run in runs.items()}
    reference = np.polyfit(J, np.interp(J, measured["J"], measured["CT"]), 1)[0]
    return {**result, "slope": float(np.polyfit(J, CT, 1)[0]), "slope_over_measured": float(np.polyfit(J, CT, 1)[0] / reference)}


check.main(figures)
