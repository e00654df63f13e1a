"""A flight against time."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np


def plot_history(run, file):
    """Attitude, displacement, and speed and thrust of each rotor of a run against time."""
    h = run.history
    t = 1000 * h["time_s"]
    figure, ((attitude, place), (speed, thrust)) = plt.subplots(2, 2, figsize=(12, 8), sharex=True, layout="constrained")
    for name, sense in (("pitch", "nose up"), ("roll", "right wing down"), ("yaw", "clockwise from above")):
        attitude.plot(t, h[f"{name}_deg"], label=f"{name} ({sense})")
    for name, label in (("y_m", "height"), ("x_m", "ahead"), ("z_m", "right")):
        place.plot(t, 100 * (h[name] - h[name][0]), label=label)
    rotors = [name[6:-4] for name in h.dtype.names if name.startswith("rotor_") and name.endswith("_rpm")]
    for name in rotors:
        speed.plot(t, h[f"rotor_{name}_rpm"], label=name.replace("_", " "))
        thrust.plot(t, h[f"rotor_{name}_thrust_N"])
    attitude.set(title="attitude", ylabel="[°]")
    place.set(title="height and drift since the start", ylabel="[cm]")
    speed.set(title="speeds of the rotors", ylabel="[1/min]", xlabel="time [ms]")
    thrust.set(title="thrust of each rotor", ylabel="[N]", xlabel="time [ms]")
    settled = np.concatenate([h[f"rotor_{name}_thrust_N"][len(t) // 10:] for name in rotors])
    if len(settled):  # without the peak of an impulsive start
        low, high = min(0, settled.min()), max(settled.max(), 1e-3)
        thrust.set_ylim(1.08 * low, 1.08 * high)
    for axes in figure.axes:
        axes.grid(alpha=0.3)
        axes.ticklabel_format(useOffset=False)
    for axes in (attitude, place, speed):
        axes.legend()
    figure.savefig(file, dpi=120)
    plt.close(figure)
