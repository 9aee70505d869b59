"""`convert` reads the scene in a file of any kind and writes it to a file of another."""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from cfree.arguments import checked
from cfree.curves.curved import Curved, healed_with_changes
from cfree.exact.number import Number
from cfree.formats.drawings.source import CURVE_SHARE, SCENE_ALONE
from cfree.formats.scene_file import EXPORTS, check_scene_path, load_shapes, save_scene
from cfree.formats.shapes import Shapes
from cfree.scene.complement import complement
from cfree.scene.reading import Note, together
from cfree.scene.rounded import rounded, rounded_shapes
from cfree.scene.scene import Scene, largest_of, round_count, shapes_in, shapes_of, with_polygons, with_reading

MOST_HEALED = 100  # shapes that are healed to tell if that makes them exact
COARSEST_HEALING, FINEST_HEALING = 1e-6, 1e-9
"""Lengths proposed to heal a shape, in its size: from the one to the other, as shorter ones make long numbers."""


@checked
def convert(
    source: str | PathLike[str],
    target: str | PathLike[str],
    *,
    robot: Any = None,
    outer: float | None = None,
    inner: float | None = None,
    tolerance: float | None = None,
    pivot: Literal["centroid"] | Sequence[Number] | None = None,
    **options: Any,
) -> Scene:
    """Read the scene in a file of any kind, and write it to another file, all of it or nothing.

    Parameters
    ----------
    source : path
        A file of any kind that `load_shapes` reads.
    target : path
        The suffix gives the format: ``.json``, ``.geojson``, ``.svg`` or ``.dxf``.
    robot : shape, sequence of shapes, Shapes, or path, optional
        A robot to replace the file's; of a file its robot, or all of its shapes if there is none.
    outer, inner : float, optional
        Replace round shapes by polygons around them, or inside them, within this error.
    tolerance : float, optional
        Without `outer` and `inner`, replace round shapes by polygons around them within this error. Formats that have
        no round shapes get polygons in any case, by default within a thousandth of the size.
    pivot : "centroid" or (x, y), optional
        The robot's reference point, see `Shapes.scene`.
    options
        All other options of `load_shapes`. Those about walls, small shapes, layout and unit of the scene (`strokes`,
        `min_area`, `space`, `units`, `scale`) have no effect on a robot's file.

    Returns
    -------
    Scene
        The scene that was written. Its `reading` has all losses and changes, those of writing included.

    Raises
    ------
    FormatError
        If the source cannot be read.
    UnsupportedError
        If the suffix of the target is of another format.

    Examples
    --------
    >>> import tempfile, cfree
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     scene = convert("examples/scenes/round_disc.json", f"{folder}/disc.svg", tolerance=0.01)
    ...     len(cfree.load_scene(f"{folder}/disc.svg").obstacles) == len(scene.obstacles)
    True
    >>> [note.kind for note in scene.reading]
    ['near']
    """
    is_file, is_made = isinstance(robot, str | PathLike), robot is None or isinstance(robot, Shapes)
    other = robot if is_file or is_made else shapes_in(robot, "robot")
    check_scene_path(target)
    its_options = {name: value for name, value in options.items() if name not in SCENE_ALONE}
    other = load_shapes(robot, curves=True, **its_options) if is_file else other
    scene, notes = written(
        load_shapes(source, curves=True, **options).scene(other, pivot), Path(target), outer, inner, tolerance
    )
    return with_reading(scene, together(scene.reading, notes))


def written(
    scene: Scene, target: Path, outer: float | None, inner: float | None, tolerance: float | None
) -> tuple[Scene, tuple[Note, ...]]:
    """Write a scene; return the scene in the file, and notes about its differences from the one before."""
    straight, notes = _straight(scene, target, outer, inner, tolerance)
    return straight, together(notes, save_scene(with_reading(straight, together(straight.reading, notes)), target))


def _straight(
    scene: Scene, target: Path, outer: float | None, inner: float | None, tolerance: float | None
) -> tuple[Scene, tuple[Note, ...]]:
    """Replace round shapes by polygons if wanted, or if the file format has no round shapes."""
    if outer is not None and inner is not None:
        raise ValueError("outer and inner: give one of them")
    for name, length in (("outer", outer), ("inner", inner), ("tolerance", tolerance)):
        if length is not None and not 0 < length < math.inf:
            raise ValueError(f"{name}: {length}; give a length above 0")
    error = outer if inner is None else inner
    if not scene.curved or (error is None and tolerance is None and not is_without_curves(target)):
        return scene, ()
    return straightened(scene, error or tolerance, inside=inner is not None)


def straightened(
    scene: Scene, error: float | None, *, inside: bool = False, remedy: str = ""
) -> tuple[Scene, tuple[Note, ...]]:
    """Replace round shapes by polygons around them, or inside, by default within a thousandth of the size; note it."""
    error = error or largest_of(scene) / CURVE_SHARE
    what = f"polygon {'inside' if inside else 'around'} a round shape"
    note = Note("near", what, "near", round_count(shapes_of(scene)), size=error, remedy=remedy)
    return scene.inner(error) if inside else scene.outer(error), (note,)


def as_exact(scene: Scene, error: float | None, *, remedy: str = "") -> tuple[Scene, tuple[Note, ...]]:
    """Replace only round shapes that the boundary cannot take as they are, by polygons around them; note it.

    Rounded shapes, such as discs, stadiums and grown polygons, stay. `error` is by default a thousandth of the size.

    Examples
    --------
    >>> from cfree.curves.curved import Curved
    >>> from cfree.scene.scene import Scene
    >>> mixed = Scene(Curved.circle((0, 0), 1), [Curved.circle((5, 0), 1), Curved.ellipse((9, 0), (1, 2))])
    >>> scene, (note,) = as_exact(mixed, 0.01)
    >>> scene.robot == mixed.robot, [type(shape).__name__ for shape in scene.obstacles], str(note)
    (True, ['Curved', 'Polygon'], 'near      polygon around a round shape within 0.01')
    """
    if not scene.curved or rounded_shapes(scene) is not None:
        return scene, ()
    error = error or largest_of(scene) / CURVE_SHARE
    parts, others, around = (
        [None if rounded(shape) else error for shape in shapes]
        for shapes in (scene.robot, scene.obstacles, complement(scene))
    )
    errors = [*parts, *others, error if any(around) else None]
    result = with_polygons(scene, errors, outward=True)
    replaced = round_count(shapes_of(scene)) - round_count(shapes_of(result))
    remedies = ", or ".join(filter(None, (_healing(scene), remedy)))
    return result, (Note("near", "polygon around a round shape", "near", replaced, size=error, remedy=remedies),)


def _healing(scene: Scene) -> str:
    """Return the option that makes round shapes of a scene exact, with their number; empty if none does."""
    lengths = []
    others = [shape for shape in shapes_of(scene) if isinstance(shape, Curved) and rounded(shape) is None]
    for shape in others[:MOST_HEALED]:
        healed, changes = healed_with_changes(shape, COARSEST_HEALING * shape.size)
        if changes and rounded(healed) is not None:
            lengths.append(max(2 * max(change.size for change in changes), FINEST_HEALING * shape.size))
    if not lengths:
        return ""
    of_some = f" of the first {MOST_HEALED}" if len(others) > MOST_HEALED else ""
    return f"--heal 1e{math.ceil(math.log10(max(lengths)))} makes {len(lengths)}{of_some} exact"


def is_without_curves(target: Path) -> bool:
    """True if the format of a file has no round shapes."""
    return target.suffix.lower() in EXPORTS
