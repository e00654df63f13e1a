"""Error against cost of every coupling scheme at usual tolerances: python3 work_precision.py WINDHOVER OUT

Writes OUT/work_precision.csv and .png: the largest error of the displacement against a run with fine steps (so without the
mesh's error), Newton and Krylov iterations of the whole run, and the processor seconds that its steps took.
"""

import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from windhover.results import Run

CASE = Path(__file__).resolve().parent / "case.toml"
SCHEMES = {
    "loose": "scheme=loose",
    "loose-extrapolated": "scheme=loose-extrapolated",
    "strong, constant": "acceleration=constant",
    "strong, aitken": "acceleration=aitken",
    "strong, anderson": "acceleration=anderson",
    "strong, iqn-ils": "acceleration=iqn-ils",
}
USUAL = ["solver.newton_tolerance=1e-3", "coupling.tolerance=1e-3", "coupling.pose_tolerance=1e-3"]
STEPS = [0.4, 0.2, 0.1, 0.05, 0.025]


def processor_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def run(windhover, folder, settings):
    """The run, and its processor seconds without those of a run of no steps."""
    seconds = []
    for steps in (["--steps", "0"], []):
        out = folder / f"run{len(list(folder.iterdir()))}"
        before = processor_seconds()
        command = [windhover, "run", CASE, "--out", out, *steps, *(word for s in settings for word in ("--set", s))]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        seconds.append(processor_seconds() - before)
    return Run(out).history, seconds[1] - seconds[0]


def main(windhover, out):
    rows, curves = [], {}
    with tempfile.TemporaryDirectory() as temporary:
        fine, _ = run(windhover, Path(temporary), ["time.step_s=0.00625"])
        for scheme, setting in SCHEMES.items():
            for step in STEPS:
                history, seconds = run(windhover, Path(temporary), [f"coupling.{setting}", f"time.step_s={step}", *USUAL])
                error = np.abs(history["x_m"] - np.interp(history["time_s"], fine["time_s"], fine["x_m"])).max() / 1e-4
                iterations = history["coupling_iterations"][1:].mean()
                rows.append([scheme.replace(",", ""), step, error, iterations, history["newton"].sum(), history["krylov"].sum(), seconds])
                curves.setdefault(scheme, []).append((history["krylov"].sum(), error))
    with open(out / "work_precision.csv", "w") as table:
        print("scheme,step_s,error,iterations,newton,krylov,seconds", file=table)
        for row in rows:
            print(*(f"{v:.4g}" if isinstance(v, float) else v for v in row), sep=",", file=table)
    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    for (scheme, points), marker in zip(curves.items(), "osv^D*"):
        axes.loglog(*zip(*points), marker=marker, label=scheme)
    axes.set(xlabel="Krylov iterations of the whole run", ylabel="largest error of the displacement / start")
    axes.legend()
    figure.savefig(out / "work_precision.png", dpi=80)


main(sys.argv[1], Path(sys.argv[2]))
