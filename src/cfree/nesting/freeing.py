"""Can a part leave the sheet, in the plane and past its neighbours?"""

from __future__ import annotations

import math
from typing import Any

from cfree.arguments import checked
from cfree.collision.nearest_free import ForbiddenPoseError
from cfree.errors import InvalidPoseError
from cfree.exact.number import to_fraction
from cfree.exact.pose import pose_at
from cfree.nesting.checking import SHEET, overlaps
from cfree.nesting.layout import Nesting, shape_box, union
from cfree.paths.path import Path
from cfree.planning.plan import plan
from cfree.scene.scene import Scene
from cfree.words import counted


@checked
def can_be_cut_free(nesting: Nesting, part: int, *, max_seconds: float | None = None) -> bool:
    """True if a placed part can leave its sheet in the plane, moved and turned past all others; proved in both cases.

    Parameters
    ----------
    nesting : Nesting
        Without overlaps; the edge of the sheet does not hold the part.
    part : int
        Index in `Nesting.placed`.
    max_seconds : float, optional
        Limit of time, see `cfree.plan`.

    Raises
    ------
    InvalidPoseError
        If the part overlaps another one; `overlaps` finds all of them.
    UndecidedError, IncompleteError
        If time, or a contact among round shapes, leave it open.

    See Also
    --------
    way_out : the path or the proof itself.

    Examples
    --------
    A bar in a closed ring cannot leave it, one in an open jaw can:

    >>> from cfree.nesting.layout import Part, Placed
    >>> from cfree.polygons.polygon import Polygon
    >>> ring = Polygon([(0, 0), (9, 0), (9, 9), (0, 9)], [[(2, 2), (2, 7), (7, 7), (7, 2)]])
    >>> jaw = Polygon([(0, 0), (9, 0), (9, 2), (2, 2), (2, 7), (9, 7), (9, 9), (0, 9)])
    >>> bar = Placed(Part([(0, 0), (4, 0), (4, 1), (0, 1)], "bar"), (3, 4, 0))
    >>> [can_be_cut_free(Nesting([], [Placed(Part(holder), (0, 0, 0)), bar]), 1) for holder in (ring, jaw)]
    [False, True]
    """
    return isinstance(way_out(nesting, part, max_seconds=max_seconds), Path)


@checked
def way_out(nesting: Nesting, part: int, *, max_seconds: float | None = None) -> Any:
    """Return a path of a placed part out of its sheet, past all others; or the proof that there is none.

    Parameters and errors are those of `can_be_cut_free`.

    Returns
    -------
    Path, or a proof as of `cfree.plan`
    """
    if not -len(nesting.placed) <= part < len(nesting.placed):
        raise IndexError(f"part: {part} of {counted(len(nesting.placed), 'placed part')}; count from 0")
    index = range(len(nesting.placed))[part]
    whole = nesting.scene(index)
    scene = Scene(whole.robot, whole.obstacles, obstacle_names=whole.obstacle_names, units=whole.units)
    pose = nesting.placed[index].pose
    boxes = [shape_box(shape) for shape in (*nesting.placed[index].shapes, *scene.obstacles)]
    x0, y0, x1, y1 = union(boxes)
    reach = to_fraction(math.ceil(4 * (x1 - x0 + y1 - y0)) + 1)
    try:
        return plan(scene, pose, pose_at(pose.x + reach, pose.y, pose.tau), max_seconds=max_seconds)
    except ForbiddenPoseError:
        found = next(one for one in overlaps(nesting) if index in one.parts and SHEET not in one.parts)
        raise InvalidPoseError(f"part {index} overlaps another one: {found}; separate them first") from None
