"""All benchmarks on 1 and 2 ranks: run.py BENCH_PROGRAM BUILD_FOLDER [--json FILE]"""

import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
MESHES = ROOT / "tests/meshes"
SHAPES = {  # about 150 k tetrahedra, 216 k hexahedra
    "tetrahedra": ("cube", ["-setnumber", "n", "32"]),
    "hexahedra": ("box", ["-setnumber", "nx", "60", "-setnumber", "ny", "60", "-setnumber", "nz", "60"]),
}


def make_mesh(folder, name):
    geometry, numbers = SHAPES[name]
    file = folder / f"{name}.msh"
    if not file.exists():
        file.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["gmsh", "-3", "-v", "2", *numbers, MESHES / f"{geometry}.geo", "-o", file], check=True,
                       stdout=subprocess.DEVNULL)
    return file


def measure(program, mesh, name, ranks):
    launcher = ["mpiexec", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        print(f"-- {name}, {ranks} rank{'s' if ranks > 1 else ''}", flush=True)
        subprocess.run([*launcher, program, mesh, name, file.name], check=True)
        return json.loads(pathlib.Path(file.name).read_text())


def sliding(program, build):
    """A rotor's zone of about 21, 46 and 110 thousand cells, one rank."""
    results = []
    for refine in (1, 1.3, 1.75):
        case = [ROOT / "cases/slow-flyer-static/case.toml"]
        mesh = (build / f"bench/meshes/rotor_{refine}.msh").resolve()
        # gmsh's mesh depends on the folder, and now and then has a flatter cell than a case would accept
        keys = [f"mesh.refine={refine}", f"mesh.file={mesh}", "mesh.min_dihedral_deg=0", "time.step_deg=2"]
        mesh.parent.mkdir(parents=True, exist_ok=True)
        sets = [word for key in keys for word in ("--set", key)]
        subprocess.run([build / "windhover", "mesh", *case, *sets], check=True, stdout=subprocess.DEVNULL)
        with tempfile.NamedTemporaryFile(suffix=".json") as file:
            subprocess.run([program + "_sliding", *case, f"rotor {refine}", file.name, *keys], check=True)
            results += json.loads(pathlib.Path(file.name).read_text())
    return results


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("build")
    parser.add_argument("--json")
    arguments = parser.parse_args()
    results = sliding(arguments.program, pathlib.Path(arguments.build))
    for name in SHAPES:
        mesh = make_mesh(pathlib.Path(arguments.build) / "bench/meshes", name)
        one, two = (measure(arguments.program, mesh, name, ranks) for ranks in (1, 2))
        print(f"-- {name}, speed-up on 2 ranks")
        for a, b in zip(one, two):
            b["speed_up"] = a["median"] / b["median"]
            print(f"{a['name']:44} {b['speed_up']:.2f}")
        results += one + two
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(results, indent=2) + "\n")


main()
