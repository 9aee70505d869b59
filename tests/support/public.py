"""All public names."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import cfree

PACKAGES: dict[str, ModuleType] = {
    "": cfree,
    **{f"{name}.": getattr(cfree, name) for name in cfree._PACKAGES.split() if name not in ("figures", "ompl")},
}
NAMES: dict[str, Any] = {
    prefix + name: getattr(package, name) for prefix, package in PACKAGES.items() for name in package.__all__
}
