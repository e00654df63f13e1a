"""What there is to see of a run at one time: where the aircraft is, its walls, and the air on a vertical slice."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkProbeFilter

from .surface import last_fields, read_blocks

UP = np.array([0.0, 1.0, 0.0])


def unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-300)


class Mesh:
    """Points (n, 3) of a zone or wall, its cells as nodes and the start of each cell among them, values of its cells."""

    def __init__(self, block):
        self.block = block
        self.points = vtk_to_numpy(block.GetPoints().GetData()).astype(float)
        self.nodes = vtk_to_numpy(block.GetCells().GetConnectivityArray())
        self.start = vtk_to_numpy(block.GetCells().GetOffsetsArray())
        self.dimension = block.GetCell(0).GetCellDimension()

    def values(self, name):
        return vtk_to_numpy(self.block.GetCellData().GetArray(name)).astype(float)

    def at_points(self, values):
        """Values (cells, k) taken to the points by least squares over the cells around each, weighted with the inverse
        square of their distance. What is linear stays so up to the margin of a zone."""
        sizes = np.diff(self.start)
        cell = np.repeat(np.arange(len(sizes)), sizes)
        center = np.add.reduceat(self.points[self.nodes], self.start[:-1]) / sizes[:, None]
        away = center[cell] - self.points[self.nodes]
        weight = 1 / np.maximum(np.sum(away**2, axis=1), 1e-300)
        sums = lambda terms: np.bincount(self.nodes, weights=terms, minlength=len(self.points))
        count = np.maximum(sums(np.ones_like(weight)), 1)
        basis = np.column_stack([np.ones(len(cell)), away * np.sqrt(sums(weight) / count)[self.nodes, None]])
        matrix, right = np.zeros((len(count), 4, 4)), np.zeros((len(count), 4, values.shape[1]))
        for i, of_i in enumerate(basis.T):
            for j, of_j in enumerate(basis.T):
                matrix[:, i, j] = sums(weight * of_i * of_j)
            for j, value in enumerate(values.T):
                right[:, i, j] = sums(weight * of_i * value[cell])
        slack = np.array([1e-12, 1e-3, 1e-3, 1e-3])  # no slope where there are too few cells for one
        matrix += np.maximum(matrix[:, :1, :1], 1e-300) * np.diag(slack)
        return np.linalg.solve(matrix, right)[:, 0]


class Pose:
    """Where the aircraft is: moment point, rotation from body to inertial axes, heading and the direction to its right."""

    def __init__(self, run, step):
        self.row = row = run.history[np.searchsorted(run.history["step"], step)]
        self.point = np.array([row[name] for name in ("x_m", "y_m", "z_m")])
        roll, pitch, yaw = (np.radians(row[name]) for name in ("roll_deg", "pitch_deg", "yaw_deg"))
        c, s = np.cos, np.sin
        about_x = np.array([[1, 0, 0], [0, c(roll), -s(roll)], [0, s(roll), c(roll)]])
        about_z = np.array([[c(pitch), -s(pitch), 0], [s(pitch), c(pitch), 0], [0, 0, 1]])
        about_y = np.array([[c(yaw), 0, -s(yaw)], [0, 1, 0], [s(yaw), 0, c(yaw)]])
        self.rotation = about_y @ about_z @ about_x
        self.ahead, self.right = about_y[:, 0], about_y[:, 2]
        self.moment_point = np.array(run.case["body"]["moment_point_m"])

    def placed(self, point):
        """A point of the mesh in inertial axes."""
        return self.point + self.rotation @ (np.array(point) - self.moment_point)


class Walls:
    """The triangles of all walls: corners (n, 3, 3) in inertial axes, outward normals, pressure."""

    def __init__(self, meshes):
        corners, nodes, pressure, count = [], [], [], 0
        for mesh in meshes:
            sizes = np.diff(mesh.start)
            for i in range(1, sizes.max() - 1):  # fans of triangles
                faces = np.flatnonzero(sizes > i + 1)
                triangles = mesh.nodes[mesh.start[faces, None] + [0, i, i + 1]]
                corners.append(mesh.points[triangles])
                nodes.append(triangles + count)
                pressure.append(mesh.values("pressure_Pa")[faces])
            count += len(mesh.points)
        self.corners, self.nodes, self.pressure = (np.concatenate(parts) for parts in (corners, nodes, pressure))
        self.center = self.corners.mean(axis=1)
        areas = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        volume = np.sum(areas * (self.center - self.center.mean(axis=0)))
        self.normal = np.sign(volume) * unit(areas)

    def split(self, distance):
        """The triangles cut along a plane, from which places are at `distance`: corners (n, 3, 3), and of which triangle
        each is a part."""
        d = distance(self.corners)
        right = d > 0
        cut = np.flatnonzero(right.any(axis=1) & ~right.all(axis=1))
        lone = np.argmax(right[cut] != (right[cut].sum(axis=1) == 2)[:, None], axis=1)
        a, b, c = ((cut, (lone + i) % 3) for i in range(3))
        on_plane = lambda p, q: self.corners[p] + (self.corners[q] - self.corners[p]) * (d[p] / (d[p] - d[q]))[:, None]
        ab, ac, b, c, a = on_plane(a, b), on_plane(a, c), *(self.corners[i] for i in (b, c, a))
        parts = [np.stack(part, axis=1) for part in ((a, ab, ac), (ab, b, c), (ab, c, ac))]
        whole = np.setdiff1d(np.arange(len(d)), cut)
        return np.concatenate([self.corners[whole], *parts]), np.concatenate([whole, cut, cut, cut])

    def outline(self, direction):
        """Edges (n, 2, 3) between faces that look along the direction and faces that look against it."""
        sides = [0, 1], [1, 2], [2, 0]
        edges = np.sort(np.concatenate([self.nodes[:, side] for side in sides]), axis=1)
        ends = np.concatenate([self.corners[:, side] for side in sides])
        seen = np.tile(self.normal @ direction > 0, 3)
        _, first, index, uses = np.unique(edges, axis=0, return_index=True, return_inverse=True, return_counts=True)
        half_seen = np.bincount(index, weights=seen) == 1
        return ends[first[half_seen & (uses == 2)]]


class Slice:
    """The vertical plane through the first rotor along the heading: coordinates `ahead` (m) and `above` (n) in metres from
    the aircraft's moment point, and the velocity there (n, m, 3), nan where there is no air."""

    def __init__(self, run, pose, walls, zones, across=1200):
        rotors = {rotor["name"]: pose.placed(rotor["center_m"]) for rotor in run.case.get("rotor", [])}
        center = next(iter(rotors.values()), pose.point)
        self.normal, self.axes = pose.right, np.column_stack([pose.ahead, UP])
        self.offset = (center - pose.point) @ self.normal  # to the right of the moment point
        self.origin = pose.point + self.offset * self.normal
        ends = self.flat(walls.corners.reshape(-1, 3))
        low, high = ends.min(axis=0), ends.max(axis=0)
        self.size = max(high - low)
        self.rotors = [name for name, c in rotors.items() if abs(self.distance(c)) < 0.02 * self.size]
        low, high = low - self.size * np.array([0.45, 0.6]), high + self.size * np.array([0.35, 0.3])
        self.spacing = (high[0] - low[0]) / across
        self.ahead, self.above = (np.arange(a, b, self.spacing) for a, b in zip(low, high))
        self.velocity = np.full((len(self.above), len(self.ahead), 3), np.nan)
        for zone in zones:
            self.take_from(zone)
        self.close_gaps()

    def distance(self, places):
        """Of places (..., 3), positive to the right of the plane."""
        return (places - self.origin) @ self.normal

    def flat(self, places):
        """Places (..., 3) projected on the plane: (..., 2)."""
        return (places - self.origin) @ self.axes

    def corners(self):
        """Of the part of the plane that is sampled (4, 3)."""
        (left, *_, right), (bottom, *_, top) = self.ahead, self.above
        return self.origin + np.array([(left, bottom), (right, bottom), (right, top), (left, top)]) @ self.axes.T

    def velocity_at(self, places):
        """At places (..., 3) of the plane."""
        nearest = np.rint((self.flat(places) - (self.ahead[0], self.above[0])) / self.spacing).astype(int)
        column, row = (np.clip(nearest[..., i], 0, n - 1) for i, n in enumerate((len(self.ahead), len(self.above))))
        return self.velocity[row, column]

    def take_from(self, zone):
        points = vtkPoints()
        points.SetData(numpy_to_vtk((zone.points - self.origin) @ np.column_stack([self.axes, self.normal]), deep=True))
        zone.block.SetPoints(points)
        velocity = numpy_to_vtk(zone.at_points(zone.values("velocity")), deep=True)
        velocity.SetName("velocity at points")
        zone.block.GetPointData().AddArray(velocity)
        grid = vtkImageData()
        grid.SetDimensions(len(self.ahead), len(self.above), 1)
        grid.SetOrigin(self.ahead[0], self.above[0], 0)
        grid.SetSpacing(3 * [self.spacing])
        probe = vtkProbeFilter()
        probe.SetInputData(grid)
        probe.SetSourceData(zone.block)
        probe.Update()
        found = probe.GetOutput().GetPointData()
        inside = vtk_to_numpy(found.GetArray("vtkValidPointMask")) > 0
        self.velocity.reshape(-1, 3)[inside] = vtk_to_numpy(found.GetArray("velocity at points"))[inside]

    def close_gaps(self):
        """Fills points without air between two with air: the facets of two zones leave gaps on a round interface."""
        for v in (self.velocity, self.velocity.swapaxes(0, 1)):
            gap = np.isnan(v[1:-1]) & np.isfinite(v[:-2]) & np.isfinite(v[2:])
            v[1:-1][gap] = (v[:-2][gap] + v[2:][gap]) / 2


class Scene:
    """The last field output of a run."""

    def __init__(self, run):
        file = last_fields(run)
        meshes = [Mesh(block) for _, block in read_blocks(file)]
        self.pose = Pose(run, int(file.stem.removeprefix("step_")))
        self.walls = Walls([mesh for mesh in meshes if mesh.dimension == 2])
        self.slice = Slice(run, self.pose, self.walls, [mesh for mesh in meshes if mesh.dimension == 3])
        fluid = run.case["fluid"]
        self.gauge_pressure = self.walls.pressure - fluid["density_kg_m3"] * fluid["sound_speed_m_s"] ** 2 / fluid["gamma"]
