"""Figures of the heavy top with a spinning rotor: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check


def precession(body):
    """Steady precession: (C − A) cos θ ψ'² + J Ω ψ' − m g l = 0, the slow root."""
    length, rotor = abs(body["mount"]["point_m"][1]), body["rotor"][0]
    across = body["inertia_kg_m2"][0] + body["mass_kg"] * length**2
    a = (body["inertia_kg_m2"][1] - across) * np.cos(body["rotation_rad"][2])
    b = rotor["inertia_kg_m2"] * rotor["speed_rad_s"]
    c = body["mass_kg"] * body["gravity_m_s2"][1] * length
    return (-b + np.sqrt(b**2 - 4 * a * c)) / (2 * a)


def figures(runs, folder):
    values = {}
    for run in runs.values():
        history = run.history
        turned = -np.unwrap(np.radians(history["yaw_deg"]))  # yaw is positive clockwise
        rate = np.polyfit(history["time_s"], turned, 1)[0]
        values["precession_over_theory"] = float(rate / precession(run.case["body"]))
        values["nutation_deg"] = float(np.ptp(history["pitch_deg"]))
        values["turns"] = float(turned[-1] / (2 * np.pi))
    return values


check.main(figures)
