"""Steps chosen to a tolerance: the error of a piston on a spring follows it, steps end at the controller's samples and
setpoints, ranks agree, a restart repeats byte for byte: test_adaptive.py WINDHOVER MESHES CASES."""
import pathlib
import unittest

import flying_sphere
from running import Running, arguments

WINDHOVER, MESHES, CASES = arguments(3)
TUBE = CASES / "piston-spring/tube.geo"
PISTON = (CASES / "piston-spring/case.toml").read_text()


def times(rows):
    return [float(row["time_s"]) for row in rows]


def interpolated(rows, t, name):
    """Through the four rows around t, a cubic."""
    x, y = times(rows), [float(row[name]) for row in rows]
    i = min(max(sum(time <= t for time in x), 2), len(x) - 2)
    near, value = range(i - 2, i + 2), 0.0
    for a in near:
        weight = 1.0
        for b in near:
            if a != b:
                weight *= (t - x[b]) / (x[a] - x[b])
        value += weight * y[a]
    return value


class Piston(Running):
    windhover = WINDHOVER
    case = PISTON.replace('geometry = "tube.geo"', f'geometry = "{TUBE}"\nfile = "tube.msh"')

    def test_error_follows_the_tolerance(self):
        end, start = "time.end_s=6", 1e-4
        self.run_case("fine", end, "time.step_s=0.01")
        fine, errors, steps = self.table("fine"), [], []
        for tolerance in (1e-2, 1e-3, 1e-4):
            out = f"tolerance_{tolerance}"
            self.run_case(out, end, "time.step_s=1", "time.first_step_ratio=0.02", f"coupling.step_tolerance={tolerance}")
            rows = self.table(out)
            errors.append(max(abs(float(row["x_m"]) - interpolated(fine, float(row["time_s"]), "x_m")) for row in rows) / start)
            steps.append(len(rows) - 1)
            self.assertEqual(float(rows[-1]["time_s"]), 6)
            self.assertLess(errors[-1], tolerance)
        for larger, smaller in zip(errors, errors[1:]):
            self.assertGreater(larger / smaller, 4, (errors, steps))
        self.assertGreater(steps[2], 5 * steps[0])

    def test_a_tolerance_out_of_reach_stops_the_run(self):
        result = self.run_case("lost", "time.step_s=1", "coupling.step_tolerance=1e-9", "solver.max_halvings=1", code=3)
        self.assertIn("coupling.step_tolerance", result.stderr)
        self.assertTrue(list((self.folder / "lost/checkpoint").glob("step_*.h5")))


class Sphere(Running):
    windhover, case = WINDHOVER, flying_sphere.case(MESHES)
    # samples every 4 ms, the setpoint jumps at 12.3 ms, the averages begin at 17 ms
    settings = ["time.step_s=3.5e-3", "time.first_step_ratio=0.1", "coupling.step_tolerance=0.1", "time.steps=30",
                "time.start_steps=2", "output.average_from_s=0.017",
                # heavy: whether a light body's step is solved in so many iterations depends on the partition
                "body.mass_kg=2",
                # ten times Newton's: loads that agree no better than they are solved may need any number of iterations
                "coupling.tolerance=1e-9", "coupling.pose_tolerance=1e-9"]

    def test_steps_end_at_events_on_one_and_two_ranks(self):
        for ranks in (1, 2):
            self.run_case(f"ranks_{ranks}", *self.settings, ranks=ranks)
        reached = times(self.table("ranks_1"))
        events = sorted([0.0123, 0.017, *(0.004 * k for k in range(1, 100))])
        self.assertGreater(reached[-1], 0.017)
        for event in (e for e in events if e < reached[-1]):
            self.assertLess(min(abs(t - event) for t in reached), 1e-12)
        self.assertGreater(len({f"{b - a:.6e}" for a, b in zip(reached, reached[1:])}), 5)  # they do differ
        self.check_agreement("ranks_2", "ranks_1", 1e-6, 1e-12)

    def test_restart_repeats_everything(self):
        for ranks in (1, 2):
            whole, parts = f"whole_{ranks}", f"parts_{ranks}"
            self.run_case(whole, *self.settings, ranks=ranks)
            for steps, restart in ((7, False), (8, True), (30, True)):
                self.run_case(parts, *self.settings, f"time.steps={steps}", restart=restart, ranks=ranks)
            self.check_same_rows(parts, whole)
            texts = [(pathlib.Path(self.folder) / out / "coupling.csv").read_text() for out in (whole, parts)]
            self.assertEqual(*texts)


del Running  # it is no test itself

if __name__ == "__main__":
    unittest.main()
