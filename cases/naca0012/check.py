"""Figures of the steady NACA 0012: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check, fit, surface

SPAN = 0.01


def coefficients(run):
    """Lift, drag and moment coefficients at the end; the wind is along -x."""
    fluid, wind = run.case["fluid"], run.case["wind"]["velocity_m_s"]
    end = run.history[-1]
    scale = 0.5 * fluid["density_kg_m3"] * wind[0] ** 2 * SPAN
    return {"lift": end["fy_N"] / scale, "drag": -end["fx_N"] / scale, "moment": end["mz_Nm"] / scale}


def unsteadiness(run):
    """Change of the lift force over the last ten steps, of its size at the end."""
    lift = run.history["fy_N"]
    return abs(lift[-1] - lift[-11]) / abs(lift[-1])


def pressure(run):
    """Places behind the leading edge, along the chord, and pressure coefficients there."""
    patch = surface.read_patch(surface.last_fields(run), "airfoil")
    fluid, wind = run.case["fluid"], run.case["wind"]["velocity_m_s"]
    still = fluid["density_kg_m3"] * fluid["sound_speed_m_s"] ** 2 / fluid["gamma"]
    pitch = np.radians(run.history["pitch_deg"][-1])
    chordwise = patch["center"] @ [np.cos(pitch), np.sin(pitch), 0]
    return 0.25 - chordwise, (patch["pressure_Pa"] - still) / (0.5 * fluid["density_kg_m3"] * wind[0] ** 2)


def plot(runs, file):
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    for name, run in runs.items():
        axes.plot(*pressure(run), ".", markersize=3, label=name.replace("_", " "))
    axes.invert_yaxis()
    axes.set(xlabel="x / c from the leading edge", ylabel="pressure coefficient", title="NACA 0012, Mach 0.5")
    axes.legend()
    figure.savefig(file, dpi=120)


def figures(runs, folder):
    values, drag = {}, {}
    for name, run in runs.items():
        kind, n = name.rsplit("_", 1)
        found = coefficients(run)
        values |= {f"{quantity}_{name}": float(value) for quantity, value in found.items()}
        if kind == "zero":
            drag[1 / int(n)] = found["drag"]
        else:
            values[f"unsteadiness_{name}"] = float(unsteadiness(run))
    if len(drag) > 1:
        values["order_drag"] = fit.order(list(drag), np.abs(list(drag.values())))
    plot(runs, folder / "pressure.png")
    return values


check.main(figures)
