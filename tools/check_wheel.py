"""Check that an installed cfree matches its wheel: from Python 3.12 on, the stable interface of all later versions."""

import importlib.metadata
import sys
from pathlib import Path

import cfree._core

wheel = importlib.metadata.distribution("cfree").read_text("WHEEL") or ""
tags = [line.split(": ", 1)[1] for line in wheel.splitlines() if line.startswith("Tag: ")]
name, stable = Path(cfree._core.__file__).name, sys.version_info >= (3, 12)
expected = {"linux": "_core.abi3.so", "darwin": "_core.abi3.so", "win32": "_core.pyd"}[sys.platform] if stable else name
if not tags or any(("-abi3-" in tag) != stable for tag in tags) or name != expected:
    sys.exit(f"Python {sys.version_info.major}.{sys.version_info.minor}: tags {tags}, extension {name}")
print(f"{', '.join(tags)}: {name}")
