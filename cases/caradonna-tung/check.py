"""Figures and plots of Caradonna and Tung's rotor: python3 check.py RESULTS"""

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

HELICOPTER = 4 / np.pi**3  # T/(rho pi R^2 (Omega R)^2) over T/(rho n^2 D^4)
RADII = [0.50, 0.68, 0.80, 0.89, 0.96]
MEASURED_LIFT = {0.439: [0.2345, 0.2815, 0.2886, 0.3143, 0.2683], 0.877: [0.2298, 0.2842, 0.2989, 0.3175, 0.2736]}


def tip_mach(run):
    omega = run.case["rotor"][0]["rpm"] * np.pi / 30
    return round(omega * run.case["rotor"][0]["blade"]["radius_m"] / run.case["fluid"]["sound_speed_m_s"], 3)


def thrust(run):
    """Helicopters' thrust coefficient, mean over the last revolution."""
    return float(read_table(run.folder / "rotor_rotor_revolutions.csv")["CT"][-1] * HELICOPTER)


def of_last(run, name):
    """The rows of a table of means that belong to the last revolution."""
    table = read_table(run.folder / name)
    return table[table["step"] == table["step"][-1]]


def lift(run):
    """Radii over R and normal-force coefficients, mean of the two blades."""
    rows = of_last(run, "rotor_rotor_strips_mean.csv")
    first, second = (rows[rows["blade"] == blade] for blade in (0, 1))
    return first["r_over_R"], (first["normal_coefficient"] + second["normal_coefficient"]) / 2


def measured_pressure(mach):
    rows = np.genfromtxt(HERE / "measured_cp.csv", delimiter=",", names=True, skip_header=1, dtype=None, encoding=None)
    return rows[rows["Mtip"] == mach]


def plot_pressure(runs, mach, file):
    """The first blade's pressure around five sections, over the measured one."""
    figure, panels = plt.subplots(1, 5, figsize=(17, 3.6), sharey=True)
    measured = measured_pressure(mach)
    for panel, radius in zip(panels, RADII):
        for color, (name, run) in zip(("tab:blue", "tab:orange", "tab:green"), runs.items()):
            rows = of_last(run, "rotor_rotor_sections_mean.csv")
            rows = rows[(rows["blade"] == 0) & np.isclose(rows["r_over_R"], radius)]
            for side in (1, -1):
                part = np.sort(rows[rows["side"] == side], order="x_over_c")
                panel.plot(part["x_over_c"], -part["Cp"], color=color, lw=1, label=name if side == 1 else None)
        points = measured[np.isclose(measured["r_over_R"], radius)]
        for surface, marker in (("upper", "o"), ("lower", "s")):
            part = points[points["surface"] == surface]
            panel.plot(part["x_over_c"], part["minus_Cp"], marker, color="k", mfc="none", ms=4, label=f"measured, {surface}")
        panel.set(title=f"r/R = {radius}", xlabel="x/c")
    panels[0].set(ylabel="-Cp")
    panels[0].legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def plot_lift(runs, file):
    figure, axes = plt.subplots(figsize=(6, 4))
    for mach, marker in ((0.439, "o"), (0.877, "s")):
        axes.plot(RADII, MEASURED_LIFT[mach], marker, color="k", mfc="none", label=f"measured, {mach}")
    for name, run in runs.items():
        axes.plot(*lift(run), lw=1, label=name)
    axes.set(xlabel="r/R", ylabel="sectional lift coefficient", ylim=(0, 0.45))
    axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(file, dpi=110)


def figures(runs, folder):
    for mach in MEASURED_LIFT:
        chosen = {name: run for name, run in runs.items() if tip_mach(run) == mach}
        if chosen:
            plot_pressure(chosen, mach, folder / f"pressure_{mach}.png")
    plot_lift(runs, folder / "lift.png")
    result = {f"CT_{name}": thrust(run) for name, run in runs.items()}
    for name, run in runs.items():
        computed = np.interp(RADII, *lift(run))
        result[f"lift_rms_{name}"] = float(np.sqrt(np.mean((computed - MEASURED_LIFT[tip_mach(run)]) ** 2)))
    return result


check.main(figures)
