"""Bodies that the air moves: ranks agree, a restart repeats byte for byte, what cannot be is refused, a step that fails
is halved and in the end stops the run: test_coupling.py WINDHOVER MESHES."""
import json
import unittest

from flying_sphere import ROTORS, case
from running import Running, arguments, size

WINDHOVER, MESHES = arguments()

CASE = case(MESHES)


class Coupling(Running):
    windhover, case = WINDHOVER, CASE

    def check_same_rows(self, one, two):
        super().check_same_rows(one, two)
        self.assertEqual((self.folder / one / "coupling.csv").read_text(), (self.folder / two / "coupling.csv").read_text())

    def test_ranks_agree(self):
        for ranks in (1, 2):
            self.run_case(f"ranks_{ranks}", ranks=ranks)
        reference = self.table("ranks_1")
        self.assertEqual(len(reference), 11)
        self.assertGreater(size(reference, "x_m"), 1e-3)
        self.check_agreement("ranks_2", "ranks_1", 1e-7, 1e-14)

    def test_restart_repeats_everything(self):
        for ranks in (1, 2):
            for scheme in ("scheme=loose-extrapolated", "acceleration=iqn-ils", "acceleration=anderson"):
                whole, parts = f"whole_{ranks}_{scheme}", f"parts_{ranks}_{scheme}"
                self.run_case(whole, f"coupling.{scheme}", ranks=ranks)
                self.run_case(parts, f"coupling.{scheme}", "time.steps=5", ranks=ranks)
                self.run_case(parts, f"coupling.{scheme}", restart=True, ranks=ranks)
                self.check_same_rows(parts, whole)

    def test_iterations_are_told(self):
        told = self.run_case("told", "time.steps=4").stdout
        iterations = [int(float(row["coupling_iterations"])) for row in self.table("told")[1:]]
        self.assertRegex(told, rf"coupling {iterations[-1]}  roll .* deg\n")
        summary = json.loads((self.folder / "told/summary.json").read_text())
        self.assertAlmostEqual(summary["coupling_iterations_per_step"], sum(iterations) / 4)

    def test_no_agreement_stops_the_run_with_its_state(self):
        result = self.run_case("lost", "coupling.max_iterations=1", "solver.max_halvings=2", code=3)
        self.assertIn("step 1 after 0 s failed", result.stderr)
        self.assertIn("no agreement of vehicle and air after 1 coupling iterations", result.stderr)
        self.assertTrue((self.folder / "lost/checkpoint/step_00000000.h5").exists())
        rows = self.table("lost", "coupling.csv")
        self.assertEqual([row["accepted"] for row in rows], ["0"] * 3)  # the step and its halves
        self.assertEqual(len(self.table("lost", "history.csv")), 1)

    def test_a_body_that_flies_is_held_by_one_word(self):
        self.run_case("held", "body.kind=prescribed", "time.steps=2")
        rows = self.table("held")
        self.assertEqual([float(row["x_m"]) for row in rows], [0] * 3)
        self.assertNotIn("mass_kg", (self.folder / "held/case.toml").read_text().split("[body]")[1].split("[")[0])
        (self.folder / "no_kind.toml").write_text(CASE.replace('kind = "dynamic"\n', ""))
        result = self.call("run", "no_kind.toml", "--out", "wrong", code=2)
        self.assertIn('unknown key for kind = "prescribed"', result.stderr)

    def test_what_cannot_be(self):
        for setting, *parts in (
            ("body.mass_kg=0", "body.mass_kg", "> 0"),
            ("body.inertia_kg_m2=[1, 1, 0]", "body.inertia_kg_m2", "singular"),
            ("body.inertia_kg_m2=[1, 1]", "body.inertia_kg_m2", "three numbers"),
            ("body.rotor[1].motor.kind=none", "body.rotor[1].motor.kind", "needs a motor"),
            ("body.mount={x = {kind = \"locked\", stiffness_N_m = 3}}", "body.mount.x", "spring"),
            ("body.mount={x = {kind = \"locked\"}, y = {kind = \"free\", mean_m = 1}}", "body.mount.y", "prescribed"),
            ("controller.cascade={rate_gain_1_s = [1, 2]}", "controller.cascade.rate_gain_1_s", "three numbers"),
            ("controller.rotor[2].position_m=[1, 0, 1]", "controller.mixer", "cannot produce"),
            ("controller.rotor[3].name=tail", "controller.rotor", "rear_right"),
            ("controller.rotor[0].thrust_axis=[1, 0, 0]", "controller.rotor[0].thrust_axis", "parallel"),
            ("coupling.scheme=weak", "coupling.scheme", "loose-extrapolated"),
            ("coupling.acceleration=newton", "coupling.acceleration", "iqn-ils"),
            ("coupling.relaxation=2", "coupling.relaxation", "1"),
            ("body.motion=[{rate_m_s = 1}]", "body.motion: unknown key for kind = \"dynamic\""),
        ):
            with self.subTest(setting):
                result = self.run_case("wrong", setting, code=2)
                for part in parts:
                    self.assertIn(part, result.stderr)
                self.assertFalse((self.folder / "wrong").exists())

    def test_checkpoint_of_another_vehicle(self):
        self.run_case("other", "time.steps=3")
        text = CASE.replace(ROTORS, "").replace('kind = "cascade"\nrate_hz = 250\nplan', 'kind = "none"\n#')
        (self.folder / "other.toml").write_text(text)
        result = self.call("run", "other.toml", "--out", "other", "--restart", code=2)
        self.assertIn("another vehicle", result.stderr)


if __name__ == "__main__":
    unittest.main()
