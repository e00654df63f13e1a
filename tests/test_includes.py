"""Rejects includes against the arrows of docs/architecture.md: test_includes.py SOURCE_DIR."""
import pathlib
import re
import sys

MAY_INCLUDE = {
    "base": set(),
    "mesh": {"base"},
    "fluid": {"base", "mesh"},
    "body": {"base"},
    "control": {"base"},
    "coupling": {"base", "body", "control"},
    "io": {"base"},
    "geometry": {"base", "io"},
    "mesher": {"base", "io", "geometry"},
    "app": {"base", "mesh", "fluid", "body", "control", "coupling", "io", "geometry"},
}

source = pathlib.Path(sys.argv[1]) / "src"
problems = [f"src/{path.name}: not a folder of docs/architecture.md"
            for path in source.iterdir() if path.is_dir() and path.name not in MAY_INCLUDE]
for path in sorted(source.glob("*/**/*.*")):
    folder = path.relative_to(source).parts[0]
    allowed = MAY_INCLUDE.get(folder, set()) | {folder}
    for number, line in enumerate(path.read_text().splitlines(), 1):
        include = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
        if include and include[1].split("/")[0] not in allowed:
            problems.append(f"{path.relative_to(source.parent)}:{number}: {folder} may not include {include[1]}")
print("\n".join(problems))
sys.exit(bool(problems))
