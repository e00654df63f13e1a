"""Figures of the static Slow Flyer, means over the last revolution: python3 check.py RESULTS"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from windhover import check
from windhover.results import read_table


def figures(runs, folder):
    last = {name: read_table(run.folder / "rotor_rotor_revolutions.csv")[-1] for name, run in runs.items()}
    return {f"{quantity}_{name}": float(row[quantity]) for name, row in last.items() for quantity in ("CT", "CP")}


check.main(figures)
