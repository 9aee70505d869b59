"""Write the trapezoids of a boundary as a Parquet table, for other programs; cfree reads archives only.

Each trapezoid is a row: its columns as in `docs/boundary-format.md`, and the contact of its patch, ``contact_kind``,
``contact_robot`` and ``contact_obstacle``. The table's metadata hold the scene as JSON.
"""

from __future__ import annotations

import os

from cfree.forbidden.boundary import Boundary
from cfree.forbidden.columns import COLUMNS
from cfree.formats.scene_file import scene_text
from cfree.formats.text.atomic import replacing
from cfree.formats.text.extras import needed

OF_PATCH = ("contact_kind", "contact_robot", "contact_obstacle")


def save_table(boundary: Boundary, path: str | os.PathLike[str]) -> None:
    """Write the table of a boundary."""
    pyarrow, parquet = (needed(name, "parquet", "Parquet") for name in ("pyarrow", "pyarrow.parquet"))
    trapezoids = boundary.trapezoids
    columns = {name: getattr(trapezoids, name) for name in COLUMNS}
    columns |= {name: getattr(boundary, name)[trapezoids.patch] for name in OF_PATCH}
    complete = b"true" if boundary.complete else b"false"
    metadata = {b"scene": scene_text(boundary.scene).encode(), b"complete": complete}
    table = pyarrow.table(columns).replace_schema_metadata(metadata)
    with replacing(path) as unfinished:
        parquet.write_table(table, unfinished)
