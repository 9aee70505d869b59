"""Arguments and options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

SceneArgument = Annotated[
    Path, typer.Argument(metavar="SCENE", help="Scene file: JSON, GeoJSON or WKT.", show_default=False)
]
SourceArgument = Annotated[
    Path,
    typer.Argument(
        metavar="SCENE", help="Scene file, or a boundary written by `cfree boundary -o`.", show_default=False
    ),
]
PictureOption = Annotated[
    Path | None,
    typer.Option("--picture", metavar="PNG", help="Write a figure: .png, .svg, .pdf ...", show_default=False),
]
ThreadsOption = Annotated[
    int | None, typer.Option("--threads", metavar="N", min=1, help="Threads to use.", show_default="all cores")
]
SecondsOption = Annotated[
    float | None,
    typer.Option(
        "--max-seconds", metavar="S", min=0, help="Stop trimming after S seconds, incomplete.", show_default="no limit"
    ),
]
MemoryOption = Annotated[
    str | None,
    typer.Option(
        "--max-memory", metavar="SIZE", help='Stop at "500MB" or "4GB" of memory, incomplete.', show_default="no limit"
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON, for machines.")]
