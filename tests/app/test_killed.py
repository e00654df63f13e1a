"""A run that is killed (SIGKILL) at random moments and restarted each time ends as if it had never been:
test_killed.py WINDHOVER MESHES."""
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time
import unittest

from flying_sphere import case
from running import Running, arguments

WINDHOVER, MESHES = arguments()

# quick steps, a checkpoint after each: many of the kills meet one that is being written
SETTINGS = ["time.steps=60", "output.checkpoint_interval=1", "output.fields_interval=7", "solver.newton_tolerance=1e-4",
            "coupling.tolerance=1e-4", "coupling.pose_tolerance=1e-4", "coupling.step_tolerance=0.02"]
CHANGES = [word for setting in SETTINGS for word in ("--set", setting)]
TIMES_KILLED = 12


def children(pid):
    """The processes that this one, or one of its children, has started."""
    tasks = pathlib.Path(f"/proc/{pid}/task")
    found = []
    for file in tasks.glob("*/children"):
        try:
            started = file.read_text().split()
        except OSError:
            continue  # it has just ended
        for child in map(int, started):
            found += [child, *children(child)]
    return found


def ranks_of(process):
    def name(pid):
        try:
            return os.readlink(f"/proc/{pid}/exe")
        except OSError:
            return ""  # it has just ended

    return [pid for pid in [process.pid, *children(process.pid)] if name(pid) == str(WINDHOVER)]


class Killed(Running):
    windhover, case = WINDHOVER, case(MESHES)

    def kill(self, process):
        """One rank is killed, and mpiexec ends the others. Where the rank was just connecting to it, mpiexec itself may then
        wait for ever, once in several hundred kills (Open MPI 4.1.4: a lock of pmix_rte_finalize): no rank is left, and
        mpiexec is killed, too."""
        victims = ranks_of(process)[-1:]
        for pid in victims:
            os.kill(pid, signal.SIGKILL)
        try:
            return process.wait(30)
        except subprocess.TimeoutExpired:
            self.assertTrue(victims, "no rank was killed, and the run does not end")
            self.assertEqual(ranks_of(process), [])
            process.kill()
            return process.wait()

    def run_and_kill(self, out, seconds, ranks):
        """True when the run was killed: one of its ranks, and mpiexec ends the others."""
        started = self.folder / out / "history.csv"
        restart = ["--restart"] if list((self.folder / out / "checkpoint").glob("step_*.h5")) else []
        if not restart:
            shutil.rmtree(self.folder / out, ignore_errors=True)
        with open(self.folder / "log", "w") as log:
            process = subprocess.Popen(self.command("run", "case.toml", "--out", out, *restart, *CHANGES, ranks=ranks),
                                       cwd=self.folder, stdout=log, stderr=log)
            while not started.exists() and process.poll() is None:
                time.sleep(0.01)
            try:
                code = process.wait(seconds)
            except subprocess.TimeoutExpired:
                code = self.kill(process)
        if code == 0:
            return False
        self.assertIn(code, (-signal.SIGKILL, 128 + signal.SIGKILL), (self.folder / "log").read_text())
        return True

    def check(self, ranks):
        whole, killed = f"whole_{ranks}", f"killed_{ranks}"
        self.run_case(whole, *SETTINGS, ranks=ranks)
        last_rows = self.table(whole)
        stepping = sum(float(row["wall_s"]) for row in last_rows)
        seed = random.SystemRandom().getrandbits(32)
        chance = random.Random(seed)
        times = 0
        with self.subTest(ranks=ranks, seed=seed):
            while times < TIMES_KILLED:
                longest = stepping if times < TIMES_KILLED // 2 else stepping / 4
                if not self.run_and_kill(killed, chance.uniform(0, longest), ranks):
                    shutil.rmtree(self.folder / killed)  # it was faster: another run to kill
                times += 1
            while self.run_and_kill(killed, 600, ranks):
                pass
            self.check_same_rows(killed, whole)
            for table in ("coupling.csv", "solver.csv"):
                rows = ([{**row, "seconds": ""} for row in self.table(out, table)] for out in (killed, whole))
                self.assertEqual(*rows, table)
            states = [(self.folder / out / "checkpoint/step_00000060.h5").stat().st_size for out in (killed, whole)]
            self.assertEqual(*states)
            self.assertEqual([f.name for f in (self.folder / killed / "checkpoint").iterdir() if f.suffix != ".h5"], [])

    def test_one_rank(self):
        self.check(1)

    def test_two_ranks(self):
        self.check(2)


if __name__ == "__main__":
    unittest.main()
