"""The frame of a case's check.py: figures in, one JSON object out."""

import json
import sys
from pathlib import Path

from .results import runs


def main(figures):
    """Prints figures(runs by name, folder) for the results folder named on the command line."""
    folder = Path(sys.argv[1])
    print(json.dumps(figures(runs(folder), folder), indent=2))
