"""Check generated drawings against their known regions: nothing that forbids is missing, nothing allowed is invented.

    python tests/support/fuzz_drawings.py --count 10000 --seed 7

Drawing k is the same for ever: a way of `svg_drawings.py`, `dxf_drawings.py` or `text_drawings.py`, read as obstacle,
robot or workspace with random options, and half of those with curves as round shapes. An obstacle or a robot may be
smaller than drawn, and a workspace larger, by rounding alone; the other way by the tolerance. Anything else that is
missing must be in the record of reading as a loss.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import traceback
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

import shapely
from shapely import affinity
from shapely.geometry.base import BaseGeometry

import cfree
import dxf_drawings
import svg_drawings
import text_drawings
from cfree import Curved
from cfree.errors import CfreeError, FormatError
from cfree.formats.shapes import Shapes

ROUNDING = 1e-3
"""Greatest depth of truths, which are polygons, inside the curves that they stand for."""
CORNER = 20.0
"""Greatest distance of the corner of a polygon around a curve, in tolerances."""
LAYER = "walls"
WAYS = [
    *(("svg", name) for name in svg_drawings.WAYS),
    *(("dxf", name) for name in dxf_drawings.WAYS),
    *(("text", name) for name in text_drawings.WAYS),
]
WALLS = ("multiline", "wide_polyline", "polyline_of_varying_width", "wide_arc", "lines_of_a_width")
"""Ways that draw walls, which allow nothing; a robot's closed line is solid."""
LESS = ("less", "unknown")
"""Effects of notes about a loss."""


@dataclass
class Case:
    """A file, the options with which it is read, and its region in the file's unit, y upwards."""

    way: str
    name: str
    content: bytes
    truth: BaseGeometry
    options: dict[str, Any]
    role: str
    more: BaseGeometry | None = None
    beside: dict[str, bytes] = field(default_factory=dict)

    @property
    def tolerance(self) -> float:
        """The greatest error of curves, in the file's unit."""
        return float(self.options["tolerance"]) / float(Fraction(self.options.get("scale", 1)))


def case(number: int) -> Case:
    """Return drawing number k."""
    kind, way = WAYS[number % len(WAYS)]
    seed = number // len(WAYS)
    rng = random.Random(f"drawing {number}")
    role = rng.choice(["obstacle", "obstacle", "robot", "workspace"])
    options: dict[str, Any] = {"tolerance": rng.choice([0.02, 0.02, 0.1, 0.5, 2.0])}
    more: BaseGeometry | None = None
    beside: dict[str, bytes] = {}
    if kind == "svg":
        drawn = svg_drawings.make(way, seed)
        begin = drawn.text.index(">") + 1
        body = drawn.text[begin : drawn.text.rindex("</svg>")]
        text = f'{drawn.text[:begin]}<g id="{LAYER}">{body}</g></svg>'
        content, name, truth, more = text.encode(), "a.svg", _up(drawn.truth), drawn.more and _up(drawn.more)
        if drawn.painted:
            options |= _some(rng, {"join": [0.0, 0.01], "holes": ["nested"], "repair": [True]})
    elif kind == "dxf":
        plan = dxf_drawings.drawing(way, seed, marked=rng.random() < 0.5)
        content, name, truth = plan.text.encode(), "a.dxf", plan.must
        if plan.reading.strokes != "ignore":
            options["strokes"] = plan.reading.strokes
        options |= _some(rng, {"join": [0.0, 0.01], "repair": [True], "fills": ["outlines"]})
    else:
        written = text_drawings.make(way, seed)
        content, name, truth, beside = written.content, written.name, written.truth, written.beside
        options |= written.options
    options |= _some(rng, {"scale": ["1/1000", "25.4", 3], "min_area": [0.5], "curves": [True, True, True]})
    if "scale" in options:
        options["tolerance"] *= float(Fraction(options["scale"]))
    if name.endswith(".yaml") or (role == "workspace" and way in WALLS) or way == "lines_of_a_width":
        role = "obstacle"
    elif role != "obstacle":
        options["roles"] = {LAYER: role, "0": role}
    return Case(way, name, content, truth, options, role, more, beside)


def _up(shape: BaseGeometry) -> BaseGeometry:
    return affinity.scale(shape, 1, -1, origin=(0, 0))


def _some(rng: random.Random, values: dict[str, list[Any]]) -> dict[str, Any]:
    return {name: rng.choice(choices) for name, choices in values.items() if rng.random() < 0.25}


def fault(drawn: Case, folder: Path) -> tuple[str, str]:
    """Read a drawing; return the result in a word, and the fault, or an empty text."""
    path = folder / drawn.name
    path.write_bytes(drawn.content)
    for name, content in drawn.beside.items():
        (folder / name).write_bytes(content)
    try:
        shapes = cfree.load_shapes(path, **drawn.options)
    except FormatError as error:
        # a workspace whose region is in doubt is refused, and so is one made of lines or of points
        return "refused", "" if drawn.role == "workspace" else f"refused: {error}"
    return _compared(drawn, shapes)


def _compared(drawn: Case, shapes: Shapes) -> tuple[str, str]:
    scale = 1 / float(Fraction(drawn.options.get("scale", 1)))
    outer, inner = (
        affinity.scale(_region(shapes, drawn, inside=inside), scale, scale, origin=(0, 0)) for inside in (False, True)
    )
    truth, tolerance = drawn.truth, drawn.tolerance
    rounding = ROUNDING * truth.length + 1e-9
    allowed = truth
    if drawn.more is not None and any(note.effect == "more" for note in shapes.reading):
        allowed = truth.union(drawn.more)
    margin = 3 * tolerance + 1e-6
    thick = tolerance / 4 if any(isinstance(shape.polygon, Curved) for shape in shapes.shapes) else 0.0
    if drawn.role == "workspace":
        invented = outer.difference(truth.buffer(thick, join_style="mitre", mitre_limit=CORNER) if thick else truth)
        missing = truth.buffer(-margin, join_style="mitre", mitre_limit=CORNER).difference(inner)
    else:
        invented = outer.difference(allowed.buffer(margin, join_style="mitre", mitre_limit=CORNER))
        missing = truth.difference(outer)
        if thick:
            core = truth.buffer(-margin, join_style="mitre", mitre_limit=CORNER).difference(inner)
            missing = max(missing, core, key=lambda region: region.area)
    if invented.area > rounding:
        return "invented", f"{invented.area:.3g} of {truth.area:.5g} invented at {_place(invented)}: {_lines(shapes)}"
    if missing.area > rounding:
        # holes between the sides of a workspace, and a workspace smaller than drawn, are as bad for a path as none
        said = any(
            note.effect in LESS or (drawn.role == "workspace" and note.effect != "none") for note in shapes.reading
        )
        text = f"{missing.area:.3g} of {truth.area:.5g} missing at {_place(missing)}: {_lines(shapes)}"
        return ("missing and said", "") if said else ("missing", text)
    return "right", ""


def _region(shapes: Shapes, drawn: Case, *, inside: bool) -> BaseGeometry:
    """Return the union of the shapes of the role; polygons outside or inside of round ones."""
    error = float(drawn.options["tolerance"])
    polygons: list[Any] = []
    for shape in shapes.of(drawn.role):  # type: ignore[arg-type]
        if isinstance(shape.polygon, Curved):
            near = max(error / 4, shape.polygon.least_error)
            polygons += shape.polygon.inner(near) if inside else shape.polygon.outer(near)
        else:
            polygons.append(shape.polygon)
    return shapely.union_all([polygon.to_shapely() for polygon in polygons])


def _place(region: BaseGeometry) -> str:
    point = region.representative_point()
    return f"{point.x:.4g}, {point.y:.4g}"


def _lines(shapes: Shapes) -> str:
    return "; ".join(str(note) for note in shapes.reading)[:600]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    came, wrong = Counter[str](), Counter[tuple[str, str]]()
    with tempfile.TemporaryDirectory() as folder, suppress(KeyboardInterrupt):
        for number in range(options.seed, options.seed + options.count):
            drawn = case(number)
            try:
                what, text = fault(drawn, Path(folder))
            except CfreeError as error:
                what, text = type(error).__name__, str(error)
            except Exception as error:
                what, text = type(error).__name__, traceback.format_exc()
            came[what] += 1
            if text:
                wrong[drawn.way, what] += 1
                if wrong[drawn.way, what] <= 2:
                    print(
                        f"--- drawing {number}, {drawn.way} as {drawn.role}: {text}",
                        drawn.options,
                        sep="\n",
                        flush=True,
                    )
    for (way, what), count in sorted(wrong.items()):
        print(f"{way:<32} {what:<20} {count:>7,}")
    print(f"{came.total():,} drawings: {dict(came)}; {wrong.total()} faults")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
