"""Histories on 1, 2 and 4 ranks agree, and a restart repeats them byte for byte: test_parallel.py WINDHOVER MESHES."""
import unittest

from running import Running, arguments

WINDHOVER, MESHES = arguments()

# A tumbling cube of tetrahedra in wind, one side a wall: loads in all six components.
CASE = f"""
[mesh]
geometry = "{MESHES / 'cube.geo'}"
file = "cube.msh"
parameters = {{n = 5}}
[fluid]
boundary = {{wall = "wall", far = "farfield"}}
[wind]
velocity_m_s = [0, 60, 10]
[[body.motion]]
kind = "rotation"
axis = [1, 2, 3]
amplitude_deg = 20
frequency_hz = 40
[time]
step_s = 5e-4
steps = 8
start_steps = 2
[solver]
newton_tolerance = 1e-12
newton_iterations = 30
eisenstat_walker = false
krylov_tolerance = 1e-4
[output]
checkpoint_interval = 3
"""


class Parallel(Running):
    windhover, case = WINDHOVER, CASE

    def test_ranks_agree(self):
        for ranks in (1, 2, 4):
            self.run_case(f"ranks_{ranks}", ranks=ranks)
        self.assertEqual(len(self.table("ranks_1")), 9)
        for ranks in (2, 4):
            self.check_agreement(f"ranks_{ranks}", "ranks_1", 1e-9)

    def test_restart_repeats_the_history(self):
        for ranks in (1, 2):
            whole, parts = f"whole_{ranks}", f"parts_{ranks}"
            self.run_case(whole, ranks=ranks)
            self.call("run", "case.toml", "--out", parts, "--steps", "4", ranks=ranks)
            self.run_case(parts, restart=True, ranks=ranks)
            self.check_same_rows(parts, whole)


if __name__ == "__main__":
    unittest.main()
