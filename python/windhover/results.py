"""The results folder of a run: tables, summary, effective case, final state."""

import json
import tomllib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np


def read_table(path):
    """A CSV file with a header line as a structured array."""
    return np.atleast_1d(np.genfromtxt(path, delimiter=",", names=True))


@dataclass
class State:
    """Flow at one time in SI units, one row per cell; places and velocities in the inertial frame."""

    time_s: float
    density: np.ndarray
    velocity: np.ndarray
    pressure: np.ndarray
    center: np.ndarray
    volume: np.ndarray
    rotation: np.ndarray  # from the first zone's frame to the inertial one
    origin: np.ndarray  # of that frame


def read_state(path):
    """The flow in a checkpoint."""
    with h5py.File(path) as file:
        q, center, volume = file["q"][:], file["centroid_m"][:], file["volume_m3"][:, 0]
        zone = file["zone"][:, 0].astype(int)
        a = dict(file.attrs)
    rotation, origin = np.reshape(a["zone_R"], (-1, 3, 3)), np.reshape(a["zone_x_m"], (-1, 3))
    scale = {name: float(np.ravel(a[name])[0]) for name in ("time_s", "density_kg_m3", "sound_speed_m_s", "gamma")}
    velocity = q[:, 1:4] / q[:, :1]
    pressure = (scale["gamma"] - 1) * (q[:, 4] - 0.5 * q[:, 0] * (velocity**2).sum(axis=1))
    return State(
        time_s=scale["time_s"],
        density=q[:, 0] * scale["density_kg_m3"],
        velocity=velocity * scale["sound_speed_m_s"],
        pressure=pressure * scale["density_kg_m3"] * scale["sound_speed_m_s"] ** 2,
        center=origin[zone] + np.einsum("nij,nj->ni", rotation[zone], center),
        volume=volume,
        rotation=rotation[0],
        origin=origin[0],
    )


class Run:
    """Everything a run left behind, read when asked for."""

    def __init__(self, folder):
        self.folder = Path(folder)

    @cached_property
    def history(self):
        return read_table(self.folder / "history.csv")

    @cached_property
    def solver(self):
        return read_table(self.folder / "solver.csv")

    @cached_property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    @cached_property
    def case(self):
        """The effective case: every key with its value."""
        return tomllib.loads((self.folder / "case.toml").read_text())

    @cached_property
    def final(self):
        return read_state(max((self.folder / "checkpoint").glob("step_*.h5")))


def runs(folder):
    """The finished runs in a folder, by name."""
    return {path.parent.name: Run(path.parent) for path in sorted(Path(folder).glob("*/summary.json"))}
