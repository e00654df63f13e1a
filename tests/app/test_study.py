"""`windhover study`: runs made, continued and compared; failures in the table; mistakes named: test_study.py WINDHOVER CASES."""
import fcntl
import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import tempfile
import termios
import time
import unittest

from running import Running, arguments

WINDHOVER, CASES = arguments()

# a piston on a spring closes a tube of ten cells
CASE = f"""
[mesh]
geometry = "{CASES / 'piston-spring/tube.geo'}"
parameters = {{n = 5, length = 2}}
file = "tube.msh"
"""
CASE += """
[fluid]
density_kg_m3 = 1
sound_speed_m_s = 1
boundary = {piston = "wall", open = "farfield", sides = "symmetry"}
[body]
kind = "dynamic"
mass_kg = 2
inertia_kg_m2 = [1, 1, 1]
gravity_m_s2 = [0, 0, 0]
position_m = [1e-4, 0, 0]
[body.mount]
x = {kind = "spring", stiffness_N_m = 2}
y = {kind = "locked"}
z = {kind = "locked"}
rotation_x = {kind = "locked"}
rotation_y = {kind = "locked"}
rotation_z = {kind = "locked"}
[time]
step_s = 0.1
end_s = 4
"""
STUDY = """
set = ["time.damping=0"]
reference = "fine"
[sweep]
time.step_s = [0.4, 0.1]
[[run]]
name = "fine"
set = ["time.step_s=0.02"]
[[run]]
name = "strong"
[[run]]
name = "loose"
set = ["coupling.scheme=loose"]
[[figure]]
name = "displacement"
unit = "m"
entry = "x_m"
take = "curve"
accuracy = 0.02
[[figure]]
name = "end"
unit = "m"
entry = "x_m"
take = "last"
tolerance = 1e-5
[[figure]]
name = "cells"
file = "summary.json"
entry = "cells"
expected = 10
"""
NAMES = ["fine", "strong,step_s=0.4", "strong,step_s=0.1", "loose,step_s=0.4", "loose,step_s=0.1"]


class Study(Running):
    windhover, case = WINDHOVER, CASE

    @classmethod
    def setUpClass(cls):
        super(Running, cls).setUpClass()
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        (cls.folder / "case.toml").write_text(CASE)
        (cls.folder / "steps.toml").write_text(STUDY)
        cls.first = cls.call("study", "steps.toml", "--out", "steps").stdout  # makes the mesh, too

    def study(self, name, text, **others):
        (self.folder / f"{name}.toml").write_text(text)
        return self.call("study", f"{name}.toml", "--out", name, **others)

    def rows(self, out):
        return {row["run"]: row for row in self.table(out, "study.csv")}

    def check_refused(self, text, *parts):
        said = self.study("wrong", text, code=2).stderr
        for part in ("wrong.toml", *parts):
            self.assertIn(part, said)
        self.assertFalse((self.folder / "wrong").exists())

    def test_table(self):
        rows = self.rows("steps")
        self.assertEqual(list(rows), NAMES)
        for name, row in rows.items():
            self.assertEqual(row["exit_code"], "0", row)
            history = self.table(f"steps/{name}")
            summary = json.loads((self.folder / "steps" / name / "summary.json").read_text())
            self.assertEqual(int(row["steps"]), len(history) - 1)
            self.assertAlmostEqual(float(row["newton_per_step"]), summary["newton_per_step"])
            self.assertAlmostEqual(float(row["krylov_per_step"]), summary["krylov_per_step"])
            self.assertAlmostEqual(float(row["coupling_per_step"]), summary["coupling_iterations_per_step"])
            self.assertAlmostEqual(float(row["wall_s"]), summary["wall_s"]["total"], 3)
            self.assertAlmostEqual(float(row["steps_wall_s"]), summary["wall_s"]["fluid"], 3)
            self.assertAlmostEqual(float(row["seconds_per_step"]), summary["seconds_per_step"], 3)
            self.assertEqual(float(row["end"]), float(history[-1]["x_m"]))
            self.assertEqual(float(row["cells_error"]), 0)
        self.assertEqual(rows["fine"]["time.step_s"], "0.02")
        self.assertEqual(rows["loose,step_s=0.4"]["coupling.scheme"], "loose")

    def test_errors(self):
        """The largest difference of the curves, interpolated here anew; each scheme's falls with its order."""
        fine = self.table("steps/fine")
        at = {round(float(row["time_s"]), 9): float(row["x_m"]) for row in fine}
        errors = {name: float(row["displacement_error"]) for name, row in self.rows("steps").items()}
        for name in NAMES[1:]:
            expected = max(abs(float(row["x_m"]) - at[round(float(row["time_s"]), 9)]) for row in self.table(f"steps/{name}"))
            self.assertAlmostEqual(errors[name], expected / max(map(abs, at.values())), 9)
        self.assertEqual(errors["fine"], 0)
        self.assertGreater(errors["strong,step_s=0.4"], 8 * errors["strong,step_s=0.1"])
        self.assertGreater(errors["loose,step_s=0.1"], 5 * errors["strong,step_s=0.1"])

    def test_conclusion(self):
        """The cheapest of those that are accurate in every figure."""
        rows = self.rows("steps")
        accurate = [row for row in rows.values() if row["run"] != "fine" and float(row["displacement_error"]) <= 0.02
                    and float(row["end_error"]) <= 1e-5]
        self.assertTrue(0 < len(accurate) < 4, accurate)
        self.assertEqual({row["run"] for row in accurate} | {"fine"},
                         {name for name, row in rows.items() if row["accurate"] == "true"})
        cheapest = min(accurate, key=lambda row: float(row["steps_wall_s"]))
        last = self.first.splitlines()[-1]
        self.assertIn(f"cheapest setting within 2 % of displacement, 1e-05 m of end, 1 % of cells: {cheapest['run']} (", last)
        factor = float(rows["fine"]["steps_wall_s"]) / float(cheapest["steps_wall_s"])
        self.assertIn(f"{factor:.3g} times faster than the reference fine", last)

    def test_plot(self):
        self.assertIn("study.csv, study.png", self.first)
        self.assertTrue((self.folder / "steps/study.png").read_bytes().startswith(b"\x89PNG"))

    def test_what_is_there_is_not_made_again(self):
        shutil.copytree(self.folder / "steps", self.folder / "again")
        shutil.rmtree(self.folder / "again" / NAMES[1])
        before = {name: (self.folder / "again" / name / "history.csv").stat().st_mtime_ns for name in NAMES if name != NAMES[1]}
        said = self.call("study", "steps.toml", "--out", "again").stdout
        self.assertEqual(said.count("is there"), 4, said)
        self.assertRegex(said, r"\[2/5\] strong,step_s=0.4 \.\.\. 10 steps, ")
        for name, time_made in before.items():
            self.assertEqual((self.folder / "again" / name / "history.csv").stat().st_mtime_ns, time_made)
        other = self.call("study", "steps.toml", "--out", "again", "--set", "solver.newton_tolerance=1e-4", code=2).stderr
        for part in ("again/fine", "other settings", "newton_tolerance = 0.001", "newton_tolerance = 0.0001", "--out"):
            self.assertIn(part, other)

    def test_other_folders_stay(self):
        """A folder that happens to have the name of a run is not a run's."""
        (self.folder / "others/fine").mkdir(parents=True)
        (self.folder / "others/fine/thesis.tex").write_text("precious")
        said = self.call("study", "steps.toml", "--out", "others", code=2).stderr
        self.assertIn("others/fine: holds something else", said)
        self.assertEqual((self.folder / "others/fine/thesis.tex").read_text(), "precious")

    def test_without_matplotlib(self):
        block = self.folder / "block/matplotlib"
        block.mkdir(parents=True)
        (block / "__init__.py").write_text("raise ImportError('no matplotlib here')")
        shutil.copytree(self.folder / "steps", self.folder / "plain")
        (self.folder / "plain/study.png").unlink()
        # the project's own folder comes first on the path, and has no matplotlib
        environment = {**os.environ, "PYTHONPATH": str(block.parent)}
        result = subprocess.run(self.command("study", "steps.toml", "--out", "plain"), cwd=self.folder, env=environment,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("no plot: ", result.stdout)
        self.assertIn("no matplotlib here", result.stdout)
        self.assertIn("cheapest setting", result.stdout)

    def interrupt(self, number, out, ranks):
        """Sent to the study alone, while its second run is at work."""
        text = f'ranks = {ranks}\nset = ["output.checkpoint_interval=1000000"]\nreference = "a"\n' + "".join(
            f'[[run]]\nname = "{name}"\nset = ["time.step_s={step}"]\n' for name, step in (("a", 0.1), ("b", 0.005)))
        text += '[[figure]]\nname = "x"\nunit = "m"\nentry = "x_m"\ntolerance = 1\n'
        (self.folder / f"{out}.toml").write_text(text)
        with open(self.folder / f"{out}.log", "w") as log:
            process = subprocess.Popen(self.command("study", f"{out}.toml", "--out", out), cwd=self.folder, stdout=log)
            history = self.folder / out / "b/history.csv"
            while process.poll() is None and (not history.exists() or history.read_text().count("\n") < 20):
                time.sleep(0.01)
            process.send_signal(number)
            self.assertEqual(process.wait(60), 128 + number)
        said = (self.folder / f"{out}.log").read_text()
        self.assertIn("interrupted; the same command goes on", said)
        checkpoint, = (self.folder / out / "b/checkpoint").glob("*.h5")
        self.assertLess(20, int(checkpoint.stem.removeprefix("step_")) + 2)
        self.assertLess(len(self.table(f"{out}/b")), 800)
        rest = self.call("study", f"{out}.toml", "--out", out).stdout
        self.assertIn("a: is there", rest)
        self.assertEqual(len(self.table(f"{out}/b")), 801)
        attempts = json.loads((self.folder / out / "b/attempts.json").read_text())
        self.assertEqual(len(attempts), 2)
        self.assertEqual(attempts[1]["exit_code"], 0)
        row = self.rows(out)["b"]
        self.assertEqual(int(row["steps"]), 800)
        self.assertAlmostEqual(float(row["steps_wall_s"]), sum(float(r["wall_s"]) for r in self.table(f"{out}/b")))
        self.run_case(f"{out}_whole", "output.checkpoint_interval=1000000", "time.step_s=0.005", ranks=ranks)
        self.check_same_rows(f"{out}/b", f"{out}_whole")

    def test_interrupt(self):
        self.interrupt(signal.SIGINT, "interrupted", 1)

    def test_interrupt_on_two_ranks(self):
        self.interrupt(signal.SIGTERM, "terminated", 2)

    def test_terminal(self):
        """A bar; Ctrl-C goes to the study, which asks its run to end once."""
        master, slave = pty.openpty()
        text = STUDY.replace("0.02", "0.0001", 1)
        (self.folder / "terminal.toml").write_text(text)
        process = subprocess.Popen(self.command("study", "terminal.toml", "--out", "terminal"), cwd=self.folder, stdin=slave,
                                   stdout=slave, stderr=slave, start_new_session=True,
                                   preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        os.close(slave)
        said = b""
        while b" %  left" not in said or not (self.folder / "terminal/fine/history.csv").exists():
            said += os.read(master, 4096)
        self.assertIn(b"[........................] 1/5  fine", said)
        os.write(master, b"\x03")
        self.assertEqual(process.wait(60), 130)
        os.close(master)
        attempt, = json.loads((self.folder / "terminal/fine/attempts.json").read_text())
        self.assertEqual(attempt["exit_code"], 130)

    def test_one_study_in_a_folder(self):
        text = STUDY.replace("0.02", "0.0001", 1)
        (self.folder / "long.toml").write_text(text)
        command = self.command("study", "long.toml", "--out", "long")
        study = subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL)
        while not (self.folder / "long/fine/history.csv").exists():
            time.sleep(0.01)
        self.assertIn("still at work", self.call("study", "long.toml", "--out", "long", code=2).stderr)
        child, = map(int, pathlib.Path(f"/proc/{study.pid}/task/{study.pid}/children").read_text().split())
        study.kill()
        study.wait()
        self.assertIn("still at work", self.call("study", "long.toml", "--out", "long", code=2).stderr)
        os.kill(child, signal.SIGTERM)

    def test_failing_run(self):
        rows = self.study("failing", STUDY + """
[[run]]
name = "impossible"
set = ["coupling.max_iterations=1", "solver.max_halvings=0"]
""").stdout
        table = self.rows("failing")
        for step in ("0.4", "0.1"):
            row = table[f"impossible,step_s={step}"]
            self.assertEqual((row["exit_code"], row["displacement_error"], row["accurate"]), ("3", "", "false"))
            self.assertIn("failed, the last try with", row["reason"])
        self.assertIn("exit code 3", rows)
        self.assertIn("cheapest setting", rows)
        self.assertIn("impossible,step_s=0.4: is there", self.call("study", "failing.toml", "--out", "failing").stdout)

    def test_failing_reference(self):
        said = self.study("lost", STUDY.replace('"time.step_s=0.02"', '"coupling.max_iterations=1", "solver.max_halvings=0", "time.step_s=0.2"'),
                          code=3).stdout
        self.assertIn("no conclusion: the reference fine has not finished", said)
        self.assertEqual(self.rows("lost")["strong,step_s=0.4"]["displacement_error"], "")

    def test_mistakes(self):
        swap = lambda old, new: STUDY.replace(old, new, 1)
        self.check_refused(swap("[sweep]", "[sweeep]"), 'unknown section (did you mean "sweep"?)')
        self.check_refused(swap("tolerance", "tolerence"), "figure[1].tolerence", 'did you mean "tolerance"?')
        self.check_refused(swap("time.step_s =", "time.stp_s ="), "stp_s", 'did you mean "step_s"?')
        self.check_refused(swap("0.4", "-0.4"), "strong,step_s=-0.4", "time.step_s", "must be > 0")
        self.check_refused(swap("[0.4, 0.1]", "0.4"), "time.step_s = 0.4", "expected a list")
        self.check_refused(swap("scheme=loose", "scheme=lose"), "coupling.scheme", '"lose"', 'did you mean "loose"?')
        self.check_refused(swap('"x_m"', '"x_mm"'), "wrong.toml:14: displacement", "x_mm", 'did you mean "x_m"?')
        self.check_refused(swap('take = "last"', 'take = "first"'), "figure[1].take", '"mean", "last"')
        self.check_refused(swap('"fine"', '"fin"'), 'reference = "fin"', 'did you mean "fine"?')
        self.check_refused(STUDY.replace('"fine"', '"finest"', 1).replace('name = "fine"', 'name = "other"').replace("0.02", "0.1"),
                           "several runs", "other", "strong,step_s=0.1")
        self.check_refused(STUDY + 'from_s = 1\n', "cells", "are for tables")
        self.check_refused(swap("accuracy = 0.02", "revolutions = 2"), "turns steadily")
        self.check_refused('case = "none.toml"\n' + STUDY, "none.toml: cannot read this file")
        self.check_refused(swap('name = "loose"', 'name = "strong"'), 'two runs are called "strong,step_s=0.4"')

    def test_wrong_entry_of_a_table_without_history(self):
        said = self.study("entry", STUDY.replace('entry = "cells"', 'entry = "sells"'), code=2).stderr
        self.assertIn('fine/summary.json: has no entry "sells"', said)
        self.assertIn('did you mean "cells"?', said)

    def test_studies_of_the_project(self):
        """Every combination is a valid case."""
        for name, runs in (("slow-flyer-static", 5), ("quadcopter-headwind", 8), ("piston-spring", 31), ("sphere-spring", 25)):
            said = self.call("study", CASES / name / "study.toml", "--check").stdout.splitlines()
            self.assertEqual(len(said), runs + 2, said)
            self.assertTrue(said[-1].startswith("reference: "))


if __name__ == "__main__":
    unittest.main()
