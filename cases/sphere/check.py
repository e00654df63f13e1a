"""Figures of the oscillating sphere: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import numpy as np
from windhover import check, fit
from windhover.exact import sphere


def force_ratio(run):
    """Complex amplitude of the force over the exact one, from the last period."""
    motion = run.case["body"]["motion"][0]
    omega, amplitude = 2 * np.pi * motion["frequency_hz"], motion["amplitude_m"]
    history = run.history
    last = history["time_s"] > history["time_s"][-1] - 2 * np.pi / omega * (1 - 1e-9)
    found = fit.harmonic(history["time_s"][last], history["fx_N"][last], omega)
    # x = A sin ωt = Re(−i A exp(iωt)), so the acceleration's amplitude is i A ω²
    return found / (4 / 3 * np.pi * sphere.response(omega) * 1j * amplitude * omega**2)


def figures(runs, folder):
    """Runs named fast_<n> and slow_<n>."""
    values, errors = {}, {}
    for name, run in runs.items():
        kind, n = name.split("_")
        ratio = force_ratio(run)
        values[f"amplitude_{name}"] = abs(ratio)
        values[f"phase_{name}"] = float(np.angle(ratio))
        errors.setdefault(kind, {})[1 / int(n)] = abs(ratio - 1)
    for kind, by_size in errors.items():
        if len(by_size) > 1:
            values[f"order_{kind}"] = fit.order(list(by_size), list(by_size.values()))
    return values


check.main(figures)
