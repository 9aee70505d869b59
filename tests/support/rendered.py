"""Render SVG by other programs, each picture in a process of its own, with limits.

    python tests/support/rendered.py resvg drawing.svg picture.png 2000

Renderers are compared with the reader: a pixel is filled if a shape covers its middle.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the process that renders needs neither
    import numpy as np
    from numpy.typing import NDArray

SECONDS = 10
MEMORY = 1 << 30
PACKAGES = {"resvg": "resvg_py", "cairosvg": "cairosvg"}


def missing(renderer: str) -> str:
    """Return the reason why a renderer cannot be used; the empty string if it can."""
    if sys.platform == "win32":
        return "processes have no limits on this system"
    package = PACKAGES[renderer]
    if importlib.util.find_spec(package) is None:
        return f"{package} is not installed"
    if renderer == "cairosvg":
        from ctypes.util import find_library

        return "" if find_library("cairo") else "libcairo is not installed"
    return ""


def picture(renderer: str, text: str, width: int) -> NDArray[np.float64]:
    """Return the share of each pixel that is painted, rows from above."""
    import numpy as np
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        drawing, image = Path(folder, "a.svg"), Path(folder, "a.png")
        drawing.write_text(text)
        command = [sys.executable, __file__, renderer, str(drawing), str(image), str(width)]
        subprocess.run(command, check=True, timeout=SECONDS, capture_output=True, preexec_fn=_limit)
        with Image.open(image) as opened:
            return np.asarray(opened.convert("RGBA"), dtype=np.float64)[..., 3] / 255


def _limit() -> None:
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def main(renderer: str, drawing: str, image: str, width: str) -> None:
    text = Path(drawing).read_text()
    if renderer == "resvg":
        import resvg_py

        png = resvg_py.svg_to_bytes(svg_string=text, width=int(width), dpi=96, languages=["en"])
        Path(image).write_bytes(bytes(png))
    else:
        import cairosvg

        cairosvg.svg2png(bytestring=text.encode(), write_to=image, output_width=int(width), unsafe=False)


if __name__ == "__main__":
    main(*sys.argv[1:])
