"""Wind that changes: the loads are those on a body that moves the other way in still air."""
import json
import math
import unittest

import running

windhover, meshes = running.arguments()

START, DURATION, PEAK = 0.002, 0.02, (6.0, 4.0, -3.0)


class Wind(running.Running):
    windhover = windhover
    case = f"""
[mesh]
geometry = "{meshes / 'ball_around_sphere.geo'}"
file = "sphere.msh"
[fluid]
boundary = {{sphere = "wall", far = "farfield"}}
[time]
step_s = 1e-3
steps = 8
[solver]
newton_tolerance = 1e-9
"""

    def forces(self, out):
        return [[float(row[f"f{axis}_N"]) for axis in "xyz"] for row in self.table(out)]

    def check_same_forces(self, one, two):
        largest = max(math.hypot(*f) for f in self.forces(two))
        self.assertGreater(largest, 1)
        for f, expected in zip(self.forces(one), self.forces(two), strict=True):
            self.assertLess(math.dist(f, expected), 1e-6 * largest)

    def test_gust(self):
        """Half of (1 - cos) of a velocity from the start on is a steady motion and an oscillation."""
        speed = math.hypot(*PEAK) / 2
        direction = [-x for x in PEAK]
        self.run_case("gust", f"wind.change=[{{kind='gust', duration_s={DURATION}, velocity_m_s={list(PEAK)}}}]")
        self.run_case(
            "moved",
            f"body.motion=[{{kind='translation', direction={direction}, rate_m_s={speed}}}, {{kind='translation', "
            f"direction={direction}, amplitude_m={-speed * DURATION / (2 * math.pi)}, frequency_hz={1 / DURATION}}}]",
        )
        self.check_same_forces("gust", "moved")
        self.assertEqual([float(row["vx_m_s"]) for row in self.table("gust")], [0.0] * 9)
        self.run_case("two", f"wind.change=[{{kind='gust', duration_s={DURATION}, velocity_m_s={list(PEAK)}}}]", ranks=2)
        self.check_same_forces("two", "gust")

    def test_step(self):
        """A ramp without duration from the start on is a wind, apart from the flow that it starts in."""
        self.run_case("step", f"wind.change=[{{velocity_m_s={list(PEAK)}}}]")
        self.run_case("wind", f"body.motion=[{{kind='translation', direction={[-x for x in PEAK]}, "
                              f"rate_m_s={math.hypot(*PEAK)}}}]")
        self.check_same_forces("step", "wind")

    def test_other_wind_than_where_the_flow_began(self):
        """Air at rest that is taken over into a wind is air in that wind."""
        self.run_case("still", "time.steps=2")
        wind = f"wind.velocity_m_s={list(PEAK)}"
        self.run_case("fresh", wind, "time.start_steps=2")
        self.run_case("taken_over", wind, "time.start_steps=2", f"time.start_from={self.folder / 'still'}")
        self.check_same_forces("taken_over", "fresh")

    def test_ramp_starts_when_told(self):
        self.run_case("ramp", f"wind.change=[{{start_s={START}, duration_s=0.004, velocity_m_s={list(PEAK)}}}]")
        forces = [math.hypot(*f) for f in self.forces("ramp")]
        self.assertLess(max(forces[:3]), 1e-6)
        self.assertGreater(min(forces[3:7]), 0.1)

    def test_momentum_audit(self):
        """What the air gains is what passes through the boundaries, up to the rule for the integral over time: order 2."""
        errors = []
        for fine in (1, 2, 4):
            self.run_case(f"audit_{fine}", f"wind.change=[{{kind='gust', duration_s={DURATION}, velocity_m_s={list(PEAK)}}}]",
                          f"time.step_s={1e-3 / fine}", f"time.steps={16 * fine}")
            audit = json.loads((self.folder / f"audit_{fine}/summary.json").read_text())["momentum"]
            self.assertGreater(math.hypot(*audit["walls_Ns"]), 0.5)
            self.assertGreater(math.hypot(*audit["air_Ns"]), 1)
            errors.append(audit["error"])
        self.assertLess(errors[-1], 5e-4)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertGreater(math.log2(coarse / fine), 1.8)

    def test_gust_needs_a_duration(self):
        error = self.call("run", "case.toml", "--set", "wind.change=[{kind='gust'}]", code=2).stderr
        self.assertIn("wind.change[0].duration_s = 0: must be > 0", error)


if __name__ == "__main__":
    unittest.main()
