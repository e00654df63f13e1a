"""Measures what docs/performance.md says of whole steps: claims.py [--work DIR] [--only NAME ...] [--json FILE]

Rotor (cases/slow-flyer-static) and quadcopter (cases/quadcopter-headwind). Each section continues a developed flow, which is
made first where DIR has none: minutes on 178 k cells, an hour on 1.2 M. `seconds` are medians of the later half of the steps,
`decile_s` their first decile (what others do on the machine adds to it least), `total_s` is all of them: making preconditioners
and, in the first step, what a restart costs.
Nothing else should run meanwhile.
"""

import argparse
import csv
import json
import os
import pathlib
import shutil
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
PROGRAM = ROOT / "build/release/windhover"
ROTOR, QUADCOPTER = (ROOT / f"cases/{name}/case.toml" for name in ("slow-flyer-static", "quadcopter-headwind"))
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SMALL = ["solver.method=dual_time", "solver.newton_tolerance=0.01", "solver.truncation_fraction=0", "solver.extrapolate=false"]
EXPLICIT = ["time.scheme=ssp_rk3"]


def windhover(command, case, sets, *words, ranks=1):
    launcher = ["mpiexec", "--oversubscribe", "--bind-to", "none", "-n", str(ranks)] if ranks > 1 else []
    sets = [word for s in sets for word in ("--set", s)]
    subprocess.run([*launcher, PROGRAM, command, case, *sets, *words], check=True, env=ENVIRONMENT, stdout=subprocess.DEVNULL)


def rows_of(folder):
    with open(folder / "history.csv") as file:
        return list(csv.DictReader(file))


class Flow:
    """Results of a run that others continue; made when they are first asked for."""

    def __init__(self, case, folder, sets, steps):
        self.case, self.folder, self.sets, self.steps = case, folder, sets, steps

    def make(self):
        if (self.folder / "summary.json").exists():
            return
        windhover("mesh", self.case, self.sets)
        windhover("run", self.case, self.sets, "--steps", str(self.steps), "--out", self.folder)

    def go_on(self, steps, sets=(), ranks=1, into=None):
        """Figures of so many steps more; their results stay in `into`."""
        self.make()
        folder = into or self.folder.parent / "again"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.folder, folder, ignore=shutil.ignore_patterns("fields", "summary.json"))
        before = int(rows_of(folder)[-1]["step"])
        windhover("run", self.case, [*self.sets, *sets], "--restart", "--steps", str(before + steps), "--out", folder, ranks=ranks)
        rows = [row for row in rows_of(folder) if int(row["step"]) > before]
        late = rows[len(rows) // 2:]
        mean = lambda column, rows=late: statistics.mean(float(row[column]) for row in rows)
        thrust = [column for column in rows[0] if column.endswith("_thrust_N")]
        cells = json.loads((folder / "summary.json").read_text())["cells"]
        times = sorted(float(row["wall_s"]) for row in late)
        seconds = statistics.median(times)
        total = sum(float(row["wall_s"]) for row in rows)
        return {"cells": cells, "ranks": ranks, "seconds": seconds, "us_per_cell": 1e6 * seconds / cells,
                "decile_s": times[len(times) // 10], "total_s": total, "newton": mean("newton"), "krylov": mean("krylov"),
                "thrust_N": sum(mean(t, rows) for t in thrust)}


def rotor(work, refine):
    name = f"rotor_{refine}"
    return Flow(ROTOR, work / name, [f"mesh.file={work / name}.msh", f"mesh.refine={refine}"], 437)


def quadcopter_flow(work):
    return Flow(QUADCOPTER, work / "quadcopter", [f"mesh.file={work / 'quadcopter.msh'}", "wind.velocity_m_s=[-5, 0, 0]"], 60)


def steps(work, tell):
    """A revolution with steps of each size, from the same flow."""
    for degrees in (1, 2, 5, 10, 20):
        tell(rotor(work, 1.75).go_on(360 // degrees, [f"time.step_deg={degrees}"]), degrees=degrees)


def linear(work, tell):
    """Linear solves to 0.01, with step and mesh."""
    tight = ["solver.eisenstat_walker=false", "solver.krylov_tolerance=0.01"]
    for preconditioner in ("ilu", "rrk-multigrid"):
        for refine, sizes in ((1.75, (1, 2, 5, 10)), (1.15, (5,)), (2.65, (5,))):
            for degrees in sizes:
                sets = [*tight, f"time.step_deg={degrees}", f"solver.preconditioner={preconditioner}"]
                tell(rotor(work, refine).go_on(20, sets), preconditioner=preconditioner, degrees=degrees)


def growth(work, tell):
    """Four meshes in turn, the case's own settings; more steps where they are short, for what disturbs comes and goes."""
    for _ in range(3):
        for refine, n in ((1.15, 240), (1.75, 96), (2.65, 36), (3.3, 24)):
            for degrees in (2, 5):
                tell(rotor(work, refine).go_on(n, [f"time.step_deg={degrees}"]), degrees=degrees)


def ranks(work, tell):
    """One and two ranks in turn."""
    for flow in (rotor(work, 1.75), quadcopter_flow(work)):
        for _ in range(5):
            for n in (1, 2):
                tell(flow.go_on(32, ranks=n), case=flow.case.parent.name)


def small_steps(work, tell, flow, degrees, explicit_degrees, sets=()):
    """Dual time to two orders and SSP-RK3, after implicit steps of the small size."""
    small = Flow(flow.case, work / f"{flow.folder.name}_small", flow.sets, 0)
    if not (small.folder / "summary.json").exists():
        flow.go_on(60, [f"time.step_deg={degrees}", *sets], into=small.folder)
    tell(small.go_on(12, [f"time.step_deg={degrees}", *SMALL, *sets]), method="dual time", degrees=degrees)
    tell(small.go_on(100, [f"time.step_deg={explicit_degrees}", *EXPLICIT, *sets]), method="ssp_rk3", degrees=explicit_degrees)


def rotor_baselines(work, tell):
    small_steps(work, tell, rotor(work, 1.75), 0.0585, 0.00224)


def quadcopter(work, tell):
    """Strong and loose coupling at 10° in turn, then the baselines, loosely coupled as in the paper."""
    flow = quadcopter_flow(work)
    for _ in range(2):
        for scheme in ("strong", "loose"):
            tell(flow.go_on(30, [f"coupling.scheme={scheme}"]), method=scheme, degrees=10)
    small_steps(work, tell, flow, 0.085, 0.0054, ["coupling.scheme=loose"])


SECTIONS = (steps, linear, growth, ranks, rotor_baselines, quadcopter)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, default=ROOT / "build/claims")
    parser.add_argument("--only", nargs="+", choices=[s.__name__ for s in SECTIONS])
    parser.add_argument("--json", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    results = []

    def tell(figures, **settings):
        results.append({"section": section.__name__, **settings, **figures})
        if "degrees" in settings:
            results[-1]["revolution_s"] = figures["seconds"] * 360 / settings["degrees"]
        print("  ".join(f"{key} {value:.5g}" if isinstance(value, float) else f"{key} {value}"
                        for key, value in results[-1].items()), flush=True)
        if arguments.json:
            arguments.json.write_text(json.dumps(results, indent=2) + "\n")

    for section in SECTIONS:
        if not arguments.only or section.__name__ in arguments.only:
            section(arguments.work.resolve(), tell)


if __name__ == "__main__":
    main()
