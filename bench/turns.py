"""Compares programs, or ranks, second by second: turns.py [--work DIR] [--turns N] [--seconds S] [--mesh REFINE] NAME=PROGRAM:RANKS ...

Each continues the rotor's developed flow of claims.py, stopped but for its seconds, so that all meet the same machine. A turn gives
each the median of its steps; told are, over the turns, the median of that and of its ratio to the first one's, with quartiles. The
same program started twice can still differ by some 3 % (where its memory lies): start it several times. RANKS may be `core0` or
`core1`: one rank there; more ranks are bound to cores. A turn must be some steps long.
"""

import argparse
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import time

import claims


class Run:
    def __init__(self, flow, word):
        self.name, rest = word.split("=")
        program, ranks = rest.rsplit(":", 1)
        self.folder = flow.folder.parent / f"turns_{self.name}"
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(flow.folder, self.folder, ignore=shutil.ignore_patterns("fields", "summary.json"))
        launcher = ["taskset", "-c", ranks[4:]] if ranks.startswith("core") else ["mpiexec", "--bind-to", "core", "-n", ranks]
        sets = [part for s in flow.sets for part in ("--set", s)]
        self.process = subprocess.Popen(
            [*launcher, program, "run", flow.case, *sets, "--restart", "--steps", "1000000", "--out", self.folder],
            env=claims.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.seen = before = self.steps()
        while self.seen < before + 6:  # at speed
            if self.process.poll() is not None:
                raise SystemExit(f"{self.name}: {' '.join(map(str, self.process.args))} ended with {self.process.returncode}")
            time.sleep(0.3)
            self.seen = self.steps()
        self.signal(signal.SIGSTOP)
        self.turns = []

    def steps(self):
        return len(claims.rows_of(self.folder))

    def signal(self, which):
        ranks = subprocess.run(["ps", "-o", "pid=", "--ppid", str(self.process.pid)], capture_output=True, text=True)
        for pid in (self.process.pid, *map(int, ranks.stdout.split())):
            os.kill(pid, which)

    def turn(self, length):
        self.signal(signal.SIGCONT)
        time.sleep(length)
        self.signal(signal.SIGSTOP)
        rows = claims.rows_of(self.folder)[self.seen:]
        self.seen += len(rows)
        seconds = [float(row["wall_s"]) for row in rows if row["wall_s"]]
        self.turns.append(statistics.median(s for s in seconds if s < length))  # without the one that was stopped


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, default=claims.ROOT / "build/claims")
    parser.add_argument("--turns", type=int, default=12)
    parser.add_argument("--seconds", type=float, default=1.0)
    parser.add_argument("--mesh", default="1.75")
    parser.add_argument("runs", nargs="+", metavar="NAME=PROGRAM:RANKS")
    arguments = parser.parse_args()
    flow = claims.rotor(arguments.work.resolve(), arguments.mesh)
    flow.make()
    runs = []
    try:
        for word in arguments.runs:
            runs.append(Run(flow, word))
        for i in range(arguments.turns):
            for run in runs if i % 2 == 0 else reversed(runs):
                run.turn(arguments.seconds)
    finally:
        for run in runs:
            run.signal(signal.SIGKILL)
    for run in runs:
        low, middle, high = statistics.quantiles([a / b for a, b in zip(runs[0].turns, run.turns)])
        print(f"{run.name}  {statistics.median(run.turns):.4f} s  x{middle:.3f} ({low:.3f} to {high:.3f})")


if __name__ == "__main__":
    main()
