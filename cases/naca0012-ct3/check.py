"""Figures of AGARD CT3: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover import check

SPAN = 0.01
# one cycle in order
ALPHA = np.array([5.95, 6.97, 6.57, 5.11, 3.49, 2.43, 2.67, 4.28])
LIFT = np.array([0.7502, 0.9064, 0.8480, 0.6985, 0.5402, 0.4013, 0.3876, 0.5433])
MOMENT = np.array([0.0168, 0.0297, 0.0378, 0.0333, 0.0215, 0.0111, 0.0050, 0.0048])
RISING = np.array([True, True, False, False, False, False, True, True])


class Cycle:
    """Incidence, lift and moment coefficients over a period, as functions of the phase of the pitching."""

    def __init__(self, run, cycles_before_the_end=0):
        motion, fluid = run.case["body"]["motion"][0], run.case["fluid"]
        self.mean, self.amplitude = motion["mean_deg"], motion["amplitude_deg"]
        turns = run.history["time_s"] * motion["frequency_hz"]
        last = turns[-1] - cycles_before_the_end
        part = (turns > last - 1.02) & (turns < last + 0.02)
        scale = 0.5 * fluid["density_kg_m3"] * run.case["wind"]["velocity_m_s"][0] ** 2 * SPAN
        self.turns = np.linspace(last - 1, last, 721)
        self.alpha = self.mean + self.amplitude * np.sin(2 * np.pi * self.turns)
        self.lift = np.interp(self.turns, turns[part], run.history["fy_N"][part] / scale)
        self.moment = np.interp(self.turns, turns[part], run.history["mz_Nm"][part] / scale)

    def at(self, alpha, rising):
        """Lift and moment where the incidence passes alpha on its way up or down."""
        quarter = np.arcsin((alpha - self.mean) / self.amplitude) / (2 * np.pi)
        phase = np.where(rising, quarter, 0.5 - quarter) % 1
        order = np.argsort(self.turns[:-1] % 1)
        turns = self.turns[:-1][order] % 1
        return [np.interp(phase, turns, values[:-1][order], period=1) for values in (self.lift, self.moment)]


def plot(cycles, file):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
    for name, cycle in cycles.items():
        left.plot(cycle.alpha, cycle.lift, label=name)
        right.plot(cycle.alpha, cycle.moment, label=name)
    for axes, values, label in ((left, LIFT, "lift coefficient"), (right, MOMENT, "moment coefficient")):
        axes.scatter(ALPHA, values, c=np.where(RISING, "k", "w"), edgecolors="k", zorder=3, label="experiment (filled: up)")
        axes.set(xlabel="incidence [deg]", ylabel=label)
        axes.legend()
    figure.savefig(file, dpi=120)


def write_points(cycles, file):
    with open(file, "w") as table:
        print("run,alpha_deg,lift_experiment,lift,moment_experiment,moment", file=table)
        for name, cycle in cycles.items():
            for row in zip(ALPHA, LIFT, cycle.at(ALPHA, RISING)[0], MOMENT, cycle.at(ALPHA, RISING)[1]):
                print(name, *(f"{value:.4f}" for value in row), sep=",", file=table)


def figures(runs, folder):
    values, cycles = {}, {name: Cycle(run) for name, run in runs.items()}
    for name, cycle in cycles.items():
        lift, moment = cycle.at(ALPHA, RISING)
        before = Cycle(runs[name], 1)
        values[f"lift_difference_{name}"] = float(np.abs(lift - LIFT).max())
        values[f"moment_difference_{name}"] = float(np.abs(moment - MOMENT).max())
        values[f"lift_mean_difference_{name}"] = float((lift - LIFT).mean())
        values[f"lift_scatter_{name}"] = float(np.abs(lift - LIFT - (lift - LIFT).mean()).max())
        # area of the loop, positive when run through counter-clockwise as in the experiment
        values[f"loop_area_{name}"] = float(-np.trapz(cycle.lift, cycle.alpha))
        values[f"change_of_lift_{name}"] = float(np.abs(cycle.lift - before.lift).max())
    plot(cycles, folder / "loops.png")
    write_points(cycles, folder / "points.csv")
    return values


check.main(figures)
