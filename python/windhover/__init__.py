"""Reading the results of Windhover, and exact solutions to hold them against."""

from .results import Run, runs

__all__ = ["Run", "runs"]
