"""Work and precision of a study: python3 -m windhover.study DIR

Draws DIR/study.png from what `windhover study` left in DIR: the error of each figure over the seconds of the steps, a line for each
setting besides the time step, the accuracy wanted as a dashed line.
"""

import argparse
import json
from itertools import cycle
from pathlib import Path


def is_series(key):
    """A key that makes another curve; the others, steps and what they bring with them, make points on one."""
    return not key.startswith("time.") or key in ("time.scheme", "time.damping")


def label(study, run):
    """What is written at a point: the time step, or the run where no step is among the keys."""
    steps = [run[key] for key in study["keys"] if key.startswith("time.step_")]
    return ", ".join(steps) or run["run"]


def title(study, runs):
    """The name of a curve: that of its [[run]], and the swept values."""
    groups = {run["group"] for run in runs}
    if len(groups) == 1:
        return ", ".join(filter(None, [*groups, *(runs[0][key] for key in study["swept"] if is_series(key))]))
    return ", ".join(runs[0][key] for key in study["keys"] if is_series(key))


def curves(study, figure):
    """(title, seconds, errors, labels) of each curve; an error of exactly zero has no place on a logarithmic axis."""
    error, found = f"{figure['name']}_error", {}
    for run in study["runs"]:
        if run["exit_code"] == 0 and run[error] and run["run"] != study["reference"]:
            found.setdefault(tuple(run[key] for key in study["keys"] if is_series(key)), []).append(run)
    return [(title(study, runs), [run["steps_wall_s"] for run in runs], [run[error] for run in runs],
             [label(study, run) for run in runs]) for runs in found.values()]


def draw(study, file):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figures = study["figures"]
    picture, panels = plt.subplots(1, len(figures), figsize=(7 * len(figures), 5.5), layout="constrained", squeeze=False)
    cost = next(run["steps_wall_s"] for run in study["runs"] if run["run"] == study["reference"])
    for axes, figure in zip(panels[0], figures):
        for (name, seconds, errors, labels), marker in zip(curves(study, figure), cycle("osv^D*Pp<>hX")):
            line, = axes.loglog(seconds, errors, marker=marker, label=name or None)
            for *place, text in zip(seconds, errors, labels):
                axes.annotate(text, place, textcoords="offset points", xytext=(5, 5), fontsize=8, color=line.get_color())
        axes.axhline(figure["allowed"], color="0.4", linestyle="--", linewidth=1)
        if cost > 0:
            axes.axvline(cost, color="0.4", linestyle=":", linewidth=1)
            axes.annotate("reference", (cost, 1), xycoords=("data", "axes fraction"), rotation=90, va="top", ha="right", fontsize=8)
        axes.set_xscale("log")
        axes.set_yscale("log")
        unit = "relative" if figure["relative"] else figure["unit"] or "in its unit"
        axes.set(xlabel="seconds of all steps", ylabel=f"error of {figure['name']} [{unit}]")
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            axes.legend()
    picture.suptitle(Path(study["study"]).parent.name + ": error against " + study["reference"])
    picture.savefig(file, dpi=120)
    plt.close(picture)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, help="the results folder of a study")
    folder = parser.parse_args().results
    draw(json.loads((folder / "study.json").read_text()), folder / "study.png")


if __name__ == "__main__":
    main()
