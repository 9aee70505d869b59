"""How long a new process takes to be ready."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from measure import SCENES, Report, timed

AT_MOST = {"import cfree": 0.3, "cfree --help": 0.3, "cfree plan": 0.2}
COMMAND = str(Path(sys.executable).with_name("cfree"))


def run(quick: bool) -> Report:
    report = Report("Start of a process", ("command", "s"))
    commands = {
        "python -c pass": [sys.executable, "-c", "pass"],
        "import cfree": [sys.executable, "-c", "import cfree"],
        "cfree --help": [COMMAND, "--help"],
        "cfree plan": [COMMAND, "plan", str(Path(SCENES) / "benchmr_parking1.json")],
    }
    calls = [
        lambda command=command: subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        for command in commands.values()
    ]
    for name, times in zip(commands, timed(*calls, rounds=5 if quick else 11), strict=True):
        report.rows.append((name, times.text("s")))
        if name in AT_MOST:
            report.figure("start, seconds", name, times.best, "<=", AT_MOST[name], " s")
    return report
