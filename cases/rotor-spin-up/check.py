"""Figures of the rotor spinning up: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check


def speed(run):
    return run.history["rotor_rotor_rpm"] * np.pi / 30


def parameters(run):
    """Inertia, torque constant, resistance, voltage."""
    rotor = run.case["body"]["rotor"][0]
    motor = rotor["motor"]
    return rotor["inertia_kg_m2"], motor["torque_constant_Nm_A"], motor["resistance_ohm"], motor["supply_V"]


def without_air(run):
    inertia, kt, resistance, supply = parameters(run)
    return supply / kt * (1 - np.exp(-run.history["time_s"] * kt**2 / (inertia * resistance)))


def balance(run):
    """What is missing between the rotor's angular momentum and the impulse of motor and air, over the former."""
    inertia, kt, resistance, supply = parameters(run)
    torque = kt * (supply - kt * speed(run)) / resistance - run.history["rotor_rotor_torque_Nm"]
    time = run.history["time_s"]
    impulse = np.sum(np.diff(time) * (torque[1:] + torque[:-1]) / 2)
    return float(impulse / (inertia * speed(run)[-1]) - 1)


def figures(runs, folder):
    values = {}
    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    for name, run in runs.items():
        axes.plot(run.history["time_s"], run.history["rotor_rotor_rpm"], label=name)
        values[f"balance_{name}"] = balance(run)
        values[f"last_rpm_{name}"] = float(run.history["rotor_rotor_rpm"][-1])
        values[f"iterations_{name}"] = float(run.history["coupling_iterations"][1:].mean())
    if "vacuum" in runs:
        run = runs["vacuum"]
        values["error_vacuum"] = float(np.abs(speed(run) / without_air(run)[-1] - without_air(run) / without_air(run)[-1]).max())
        axes.plot(run.history["time_s"], without_air(run) * 30 / np.pi, "k:", label="exact without air")
    if len(runs) == 2:
        values["air_over_vacuum"] = values["last_rpm_air"] / values["last_rpm_vacuum"]
    axes.set(xlabel="time [s]", ylabel="rotor speed [rpm]")
    axes.legend()
    figure.savefig(folder / "speed.png", dpi=120)
    return values


check.main(figures)
