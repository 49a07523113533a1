#!/usr/bin/env python3
"""Other programs and slipzone on the same scenes, side by side in one run: a Markdown table on standard output.

    cargo build --release --bin slipzone --example time_scenes
    python3 benches/peers/run.py > table.md

numpy, scipy and ContactMechanics go into a virtual environment that is thrown away; GetFEM is Debian's
(`apt-get install python3-getfem`). Everything runs on one thread. See README.md.
"""

import datetime
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
RELEASE = HERE.parent.parent / "target" / "release"
GETFEM_LEVELS = "2"
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1"}

GRADED = 'layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }\n'
FLAT = GRADED + 'punch = { type = "flat", half_width = 1.0 }\nload = { force = 1.0 }\n'
GOODMAN = FLAT + 'friction = { type = "goodman", coefficient = 0.3 }\n'
CYLINDER = (
    'layer = { thickness = 1.0, poisson = 0.3, grading = { type = "homogeneous", modulus = 1.0 } }\n'
    'punch = { type = "cylinder", radius = 10.0 }\nload = { force = 0.349084814062548 }\n'
)
SCENES = {
    "flat": ("Flat punch without friction on the graded layer", FLAT),
    "goodman": ("The same with Goodman friction, eta = 0.3", GOODMAN),
    "cylinder": ("Cylinder by force on a homogeneous layer as thick as the contact is half-wide", CYLINDER),
}
# Numbers that are compared, by their path in slipzone's result.
NUMBERS = {
    "depth": ("load", "indentation"), "p(0)": ("pressure", "centre"), "edge": ("edge", "stress_intensity"),
    "a/b": ("stick", "ratio"),
}
TOLERANCES = ["1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10"]
# Cut-offs and nodes of the published scheme among which the coarsest that does is looked for.
PUBLISHED = {
    1e-3: [(c, n) for c in (10, 20, 40, 80) for n in (16, 32, 64, 128)],
    1e-6: [(c, n) for c in (160, 240, 320) for n in (512, 640, 768)],
}


def run(*command):
    """The JSON objects that a program prints, one to a line."""
    done = subprocess.run([str(c) for c in command], env=ONE_THREAD, capture_output=True, text=True, check=False)
    if done.returncode:
        print(f"{command[0]} {command[1]}: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


class Slipzone:
    """Scenes written into a folder, solved many times in one process."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def file(self, name, scene, solver):
        path = self.folder / f"{name}.toml"
        path.write_text(f"format = 1\n{scene}[solver]\n{solver}\n")
        return path

    def time(self, files, rounds):
        rows = run(RELEASE / "examples" / "time_scenes", rounds, *files)
        return [{**row, "numbers": {key: (row[a] or {}).get(b) for key, (a, b) in NUMBERS.items()}} for row in rows]


def errors(numbers, reference):
    given = {key: value for key, value in numbers.items() if value and reference.get(key)}
    return {key: abs(value / reference[key] - 1) for key, value in given.items()}


def worst(found):
    return max(found.values())


def spread(found):
    return " ".join(f"{found[key]:.0e}".replace("e-0", "e-") if key in found else "-" for key in NUMBERS)


def seconds(value):
    for unit, factor in (("s", 1), ("ms", 1e3)):
        if value * factor >= 1:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e6:.3g} us"


def published(slipzone, name, scene, reference):
    """The coarsest setting of the paper's scheme whose every number is within 1e-3, and 1e-6: fewest nodes, then waves."""
    for wanted, settings in PUBLISHED.items():
        files = [
            slipzone.file(f"{name}-published-{c}-{n}", scene,
                          f'tolerance = {wanted}\nflexibility = {{ type = "compliance" }}\n'
                          f'kernel = {{ type = "truncated", cutoff = {c}.0 }}\n'
                          f'quadrature = {{ type = "gauss-chebyshev", n = {n} }}')
            for c, n in settings
        ]
        good = []
        for (c, n), file in zip(settings, files):
            (row,) = slipzone.time([file], 1)
            found = errors(row["numbers"], reference)
            if found and worst(found) <= wanted:
                good.append((n, c, file))
        if good:
            n, c, file = min(good)
            (row,) = slipzone.time([file], 5)
            yield f"paper's scheme, cut-off {c}, n = {n}", row["numbers"], row["shortest"]


def finite_elements(kind, rows):
    """Each mesh, and its depth extrapolated with that of the mesh before."""
    last = None
    for row in rows:
        if kind == "flat":
            numbers = {"depth": 1 / row["force"], "p(0)": row["centre"] / row["force"]}
            spent = row["seconds"]
        else:
            numbers = {"depth": 1 / row["force"], "p(0)": row["centre"] / row["force"], "a/b": row["ratio"]}
            spent = row["seconds_with_friction"]
        yield f"GetFEM, {row['unknowns']} unknowns", numbers, spent
        if last and kind == "flat":
            force = (4 * row["force"] - last["force"]) / 3
            yield "the last two extrapolated", {"depth": 1 / force}, spent + last["seconds"]
        last = row


def peers(python, slipzone, references):
    """Rows of each scene: what, its numbers, its seconds."""
    getfem = run("/usr/bin/python3", HERE / "getfem_friction.py", GETFEM_LEVELS)
    dense = run(python, HERE / "dense.py")
    goodman = [row for row in getfem if row["kind"] == "goodman"]
    for row in getfem:
        if row["kind"] == "coulomb":
            print(f"Coulomb, {row['unknowns']} unknowns: a/b {row['ratio']:.5f}, force per depth "
                  f"{row['force_with_friction']:.5f}", file=sys.stderr)
    rows = {"flat": list(finite_elements("flat", goodman)), "goodman": list(finite_elements("goodman", goodman))}
    for row in dense:
        numbers = {"depth": row["indentation"], "p(0)": row["centre"], "edge": row["edge"]}
        label = f"dense numpy, {row['unknowns']} unknowns"
        rows["flat"].append((label, numbers, row["seconds"]))
        rows["goodman"].append((label, {**numbers, "a/b": row["ratio"]}, row["seconds_with_friction"]))
    rows["cylinder"] = [
        (f"ContactMechanics, {row['unknowns']} points", {"depth": row["indentation"], "p(0)": row["centre"]},
         row["seconds"])
        for row in run(python, HERE / "contact_mechanics.py")
    ]
    for name in ("flat", "goodman"):
        rows[name] += list(published(slipzone, name, SCENES[name][1], references[name]))
    return rows


def whole_command(file):
    """Shortest of many runs of the command line program, start and output included."""
    shortest = float("inf")
    for _ in range(40):
        started = time.perf_counter()
        subprocess.run([RELEASE / "slipzone", "solve", file, "--json", "-"], env=ONE_THREAD, capture_output=True, check=True)
        shortest = min(shortest, time.perf_counter() - started)
    return shortest


def versions(python):
    asked = "import importlib.metadata as m\nfor p in ('numpy', 'scipy', 'ContactMechanics'): print(p, m.version(p))"
    found = subprocess.run([python, "-c", asked], capture_output=True, text=True, check=True).stdout.splitlines()
    getfem = subprocess.run(["dpkg-query", "-W", "-f", "GetFEM ${Version}", "python3-getfem"],
                            capture_output=True, text=True, check=False).stdout or "no GetFEM"
    rust = subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    own = subprocess.run([RELEASE / "slipzone", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    return ", ".join([own, f"rustc {rust}", f"Python {platform.python_version()}", *found, getfem])


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", f"{folder}/venv"], check=True)
        python = f"{folder}/venv/bin/python"
        subprocess.run([python, "-m", "pip", "install", "--quiet", "numpy", "scipy", "ContactMechanics"], check=True)
        slipzone = Slipzone(folder)
        files = {
            name: [slipzone.file(f"{name}-{t}", scene, f"tolerance = {t}") for t in TOLERANCES]
            for name, (_, scene) in SCENES.items()
        }
        finest = {
            name: slipzone.time([slipzone.file(f"{name}-finest", scene, "tolerance = 1e-12")], 1)[0]
            for name, (_, scene) in SCENES.items()
        }
        references = {name: row["numbers"] for name, row in finest.items()}
        own = {name: slipzone.time(files[name], 200) for name in SCENES}
        rows = peers(python, slipzone, references)
        # Once more: whatever the machine did meanwhile, the shortest counts.
        for name in SCENES:
            for row, again in zip(own[name], slipzone.time(files[name], 200)):
                row["shortest"] = min(row["shortest"], again["shortest"])
        print(f"{datetime.date.today()}, {platform.machine()}, one thread: {versions(python)}")
        for name, (title, _) in SCENES.items():
            print(f"\n{title}; errors of {' / '.join(NUMBERS)}:\n")
            print("| program | errors | time | slipzone's | its errors | slipzone is faster by |\n|---|---|---|---|---|---|")
            mine = [(row["shortest"], t, errors(row["numbers"], references[name])) for t, row in zip(TOLERANCES, own[name])]
            for label, numbers, spent in rows[name]:
                found = errors(numbers, references[name])
                if not found:
                    continue
                serves = [m for m in mine if all(m[2][key] <= max(found[key], 1e-12) for key in found)]
                if serves:
                    time_, tolerance, its = min(serves, key=lambda m: m[0])
                    held = f"{seconds(time_)} at {tolerance} | {spread(its)} | {spent / time_:,.0f}"
                else:
                    held = "- | - | -"
                print(f"| {label} | {spread(found)} | {seconds(spent)} | {held} |")
        for name in SCENES:
            print(f"\nslipzone, whole command, {name} at 1e-8: {seconds(whole_command(files[name][6]))}", end="")
        print()


if __name__ == "__main__":
    main()
