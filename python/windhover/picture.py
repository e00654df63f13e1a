"""Pictures of a run of an aircraft: python3 -m windhover.picture RESULTS [--out DIR]

surface.png: the aircraft, its walls coloured by gauge pressure, and behind it the speed of the air on a vertical slice
slice.png: that slice from the side, with streamlines and the aircraft's outline
history.png: the flight against time
"""

import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import AsinhNorm, Normalize
from matplotlib.patches import Polygon

from .history_plot import plot_history
from .results import Run
from .scene import UP, Scene, unit

SPEED, PRESSURE = plt.get_cmap("viridis").with_extremes(bad="0.75"), plt.get_cmap("RdBu_r")
AMBIENT = 0.4  # the part of the light that falls on every side


class Camera:
    """Looks at a place from a direction, in perspective."""

    def __init__(self, place, direction, distance):
        self.place, self.back, self.distance = place, unit(direction), distance
        self.right = unit(np.cross(UP, self.back))
        self.up = np.cross(self.back, self.right)
        self.eye = place + distance * self.back

    def picture(self, places):
        """Coordinates in the picture (..., 2), to scale at the place looked at."""
        away = places - self.place
        return away @ np.column_stack([self.right, self.up]) / (1 - away @ self.back / self.distance)[..., None]

    def on_plane(self, picture, point, normal):
        """The places (..., 3) on a plane that are seen at coordinates of the picture."""
        rays = picture @ np.array([self.right, self.up]) - self.distance * self.back
        return self.eye + rays * (((point - self.eye) @ normal) / (rays @ normal))[..., None]


def speed_norm(speed):
    return Normalize(0, max(np.nanpercentile(speed, 99.8), 1e-3))


def pressure_norm(gauge):
    """Linear near zero, for the airframe, and logarithmic towards the much larger pressures on the blades."""
    limit = max(np.percentile(np.abs(gauge), 98), 1)
    return AsinhNorm(limit / 30, -limit, limit)


def draw_walls(axes, camera, scene, pressure, near):
    """The walls that face the camera, the farthest first; those behind the slice shine through it."""
    corners, face = scene.walls.split(scene.slice.distance)
    center, normal = corners.mean(axis=1), scene.walls.normal[face]
    seen = np.flatnonzero(np.sum(normal * (camera.eye - center), axis=1) > 0)
    seen = seen[np.argsort(center[seen] @ camera.back)]
    corners, center, normal, face = corners[seen], center[seen], normal[seen], face[seen]
    light = unit(camera.back + 0.9 * camera.up - 0.5 * camera.right)
    colors = PRESSURE(pressure(scene.gauge_pressure[face]))
    colors[:, :3] *= AMBIENT + (1 - AMBIENT) * np.clip(normal @ light, 0, 1)[:, None]
    in_front = near(scene.slice.distance(center))
    for part, zorder in ((~in_front, 0), (in_front, 2)):
        axes.add_collection(PolyCollection(camera.picture(corners[part]), facecolors=colors[part], edgecolors="face",
                                           linewidths=0.25, zorder=zorder))


def draw_slice(axes, camera, plane, norm, **options):
    """The speed on the slice as the camera sees it."""
    corners = camera.picture(plane.corners())
    (left, bottom), (right, top) = corners.min(axis=0), corners.max(axis=0)
    grid = np.stack(np.meshgrid(np.linspace(left, right, 1500), np.linspace(bottom, top, 1200)), axis=-1)
    speed = np.linalg.norm(plane.velocity_at(camera.on_plane(grid, plane.origin, plane.normal)), axis=-1)
    image = axes.imshow(speed, origin="lower", extent=(left, right, bottom, top), cmap=SPEED, norm=norm, **options)
    image.set_clip_path(axes.add_patch(Polygon(corners, facecolor="none", edgecolor="0.3", linewidth=0.8, **options)))
    return image


def title(scene, run):
    row, wind = scene.pose.row, np.linalg.norm(run.case["wind"]["velocity_m_s"])
    rotors = " and ".join(scene.slice.rotors).replace("_", " ")
    return (f"t = {1000 * row['time_s']:.1f} ms, wind {wind:.3g} m/s, pitch {row['pitch_deg']:.1f}°"
            + f", slice through {rotors}" * bool(rotors))


def draw_surface(scene, heading, file):
    pose, plane, walls = scene.pose, scene.slice, scene.walls.corners.reshape(-1, 3)
    side = -1 if plane.offset > 0 else 1  # the slice is on the far side
    camera = Camera((walls.min(axis=0) + walls.max(axis=0)) / 2, 0.8 * pose.ahead + 0.8 * side * pose.right + 0.55 * UP,
                    5 * plane.size)
    pressure, speed = pressure_norm(scene.gauge_pressure), speed_norm(np.linalg.norm(plane.velocity, axis=-1))
    figure, axes = plt.subplots(figsize=(12, 8), layout="constrained")
    image = draw_slice(axes, camera, plane, speed, zorder=1, alpha=0.85)
    draw_walls(axes, camera, scene, pressure, lambda distance: side * distance > 0)
    ends = camera.picture(np.concatenate([plane.corners(), walls]))
    (left, bottom), (right, top) = ends.min(axis=0), ends.max(axis=0)
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", title=heading)
    axes.set_axis_off()
    ticks = [m * 10**k for k in range(6) for m in (1, 3) if 2 * pressure.linear_width < m * 10**k < pressure.vmax]
    look = dict(ax=axes, shrink=0.75, aspect=30)
    bar = figure.colorbar(ScalarMappable(pressure, PRESSURE), label="gauge pressure on the walls [Pa]", extend="both",
                          ticks=[*(-t for t in reversed(ticks)), 0, *ticks], format="%g", **look)
    bar.minorticks_off()
    figure.colorbar(image, label="speed of the air on the slice [m/s]", extend="max", **look)
    figure.savefig(file, dpi=120)
    plt.close(figure)


def draw_side(scene, heading, file):
    plane = scene.slice
    speed = np.linalg.norm(plane.velocity, axis=-1)
    x, y, velocity = plane.ahead, plane.above, plane.velocity @ plane.axes
    figure, axes = plt.subplots(figsize=(12, 8), layout="constrained")
    image = axes.imshow(speed, origin="lower", extent=(x[0], x[-1], y[0], y[-1]), cmap=SPEED, norm=speed_norm(speed))
    axes.streamplot(x, y, velocity[..., 0], velocity[..., 1], color=(1, 1, 1, 0.6), linewidth=0.6, density=2, arrowsize=0.7)
    axes.add_collection(LineCollection(plane.flat(scene.walls.outline(plane.normal)), colors="k", linewidths=0.9))
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]), xlabel="ahead [m]", ylabel="above [m]", title=heading)
    figure.colorbar(image, label="speed of the air [m/s]", extend="max", shrink=0.75, aspect=30)
    figure.savefig(file, dpi=120)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, help="the results folder of a run")
    parser.add_argument("--out", type=Path, help="where the pictures go; when missing, there too")
    arguments = parser.parse_args()
    out = arguments.out or arguments.results
    out.mkdir(parents=True, exist_ok=True)
    run = Run(arguments.results)
    scene = Scene(run)
    heading = title(scene, run)
    draw_surface(scene, heading, out / "surface.png")
    draw_side(scene, heading, out / "slice.png")
    plot_history(run, out / "history.png")


if __name__ == "__main__":
    main()
