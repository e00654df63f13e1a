"""Figures of the pitch-plunge section: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check

B, X, R2 = 0.5, 1.8, 3.48  # semichord, x_alpha, r_alpha squared
EXACT = 1 / np.sqrt(1 + X / np.sqrt(R2)), 1 / np.sqrt(1 - X / np.sqrt(R2))  # wind-off, over omega_alpha


def omega_alpha(run):
    body = run.case["body"]
    return np.sqrt(body["mount"]["y"]["stiffness_N_m"] / body["mass_kg"])


def misfit(parameters, time, signals):
    """What two damped oscillations with these growth rates and frequencies leave of the signals."""
    basis = [
        np.exp(growth * time) * wave(frequency * time)
        for growth, frequency in parameters.reshape(2, 2)
        for wave in (np.cos, np.sin)
    ]
    basis = np.column_stack([*basis, np.ones_like(time)])
    return np.concatenate([v - basis @ np.linalg.lstsq(basis, v, rcond=None)[0] for v in signals])


def modes(run, start, stop=1.0):
    """Growth rates and frequencies (over omega_alpha) of the two oscillations that fit plunge and pitch best between these
    parts of the run: rows, the slower first. Gauss-Newton with halved steps from the frequencies without wind."""
    history = run.history
    span = history["time_s"][-1]
    part = (history["time_s"] >= start * span) & (history["time_s"] <= stop * span)
    time = (history["time_s"][part] - start * span) * omega_alpha(run)
    signals = [history[name][part] / np.abs(history[name][part]).max() for name in ("y_m", "pitch_deg")]
    best = np.array([0, EXACT[0], -0.05, EXACT[1] * 0.8])
    for first in np.linspace(0.8, 1.2, 5):  # springs and air together: the frequencies move
        for second in np.linspace(0.5, 1.1, 13):
            guess = np.array([0, EXACT[0] * first, -0.05, EXACT[1] * second])
            if np.linalg.norm(misfit(guess, time, signals)) < np.linalg.norm(misfit(best, time, signals)):
                best = guess
    for _ in range(50):
        left = misfit(best, time, signals)
        h = 1e-6
        jacobian = np.column_stack([(misfit(best + h * e, time, signals) - left) / h for e in np.eye(4)])
        change = -np.linalg.lstsq(jacobian, left, rcond=None)[0]
        while np.linalg.norm(misfit(best + change, time, signals)) > np.linalg.norm(left) and np.abs(change).max() > 1e-9:
            change /= 2
        best = best + change
    return sorted(best.reshape(2, 2).tolist(), key=lambda mode: mode[1])


def plot(runs, file):
    figure, axes = plt.subplots(2, 1, figsize=(9, 7), layout="constrained", sharex=True)
    for name, run in runs.items():
        cycles = run.history["time_s"] * omega_alpha(run) / (2 * np.pi)
        axes[0].plot(cycles, run.history["y_m"] / B, label=name.replace("_", " "))
        axes[1].plot(cycles, run.history["pitch_deg"])
    axes[0].set(ylabel="plunge of the elastic axis / b")
    axes[1].set(ylabel="pitch [deg]", xlabel="omega_alpha t / 2 pi")
    axes[0].legend()
    figure.savefig(file, dpi=120)


def figures(runs, folder):
    values = {}
    if "wind_off" in runs:
        rates = modes(runs["wind_off"], 0)
        for mode, (_, frequency), exact in zip(("first", "second"), rates, EXACT):
            values[f"frequency_{mode}_mode"] = frequency / exact
    for name, run in runs.items():
        values[f"iterations_{name}"] = float(run.history["coupling_iterations"][1:].mean())
        if name.startswith("speed"):
            values[f"growth_{name}"] = max(growth for growth, _ in modes(run, 0.2))
    if runs:
        plot({name: run for name, run in runs.items() if name.startswith("speed")}, folder / "response.png")
    return values


check.main(figures)
