"""Ranges on which curves, poses and whole surfaces are on surfaces: t in [0, 1], and in Phi for patches."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from cfree.arrangements.curve import IntersectionCurve
from cfree.arrangements.moving_lines import MovingLine, between, dot
from cfree.exact.angle_interval import AlgebraicAngle, AngleInterval
from cfree.exact.forms import Form, W, closed_intervals, plus, product, reduced, signs_around, value_at


def ranges_on(curve: IntersectionCurve, lines: Sequence[MovingLine]) -> tuple[AngleInterval, ...]:
    """Ranges on which a curve on the lines is on their surfaces, or patches.

    Notes
    -----
    If t = N / D in lowest terms, t is in [0, 1] if D is not 0 and neither N D nor (D - N) D is negative.
    """
    edges: list[Form] = []
    for line in lines:
        N, D = along(curve, line)
        edges += [N, D, plus(D, N, -1)]

    def is_on_edges(signs: tuple[int, ...]) -> bool:
        return all(d and n * d >= 0 and r * d >= 0 for n, d, r in zip(*(iter(signs),) * 3, strict=True))

    return _ranges(lines, edges, is_on_edges)


def ranges_of(lines: Sequence[MovingLine]) -> tuple[AngleInterval, ...]:
    """Ranges common to all patches."""
    return _ranges(lines, [], lambda signs: True)


def is_on_patches(lines: Sequence[MovingLine], angle: AlgebraicAngle) -> bool:
    """True if an orientation is in the range of every patch."""
    return all(not line.is_empty and all(value_at(phi, angle) >= 0 for phi in line.Phi) for line in lines)


def is_inside_patches(lines: Sequence[MovingLine], angle: AlgebraicAngle) -> bool:
    """True if an orientation is inside the range of every patch, not at an end."""
    return all(value_at(phi, angle) > 0 for line in lines for phi in line.Phi)


def along(curve: IntersectionCurve, line: MovingLine) -> tuple[Form, Form]:
    """Return t = N / D, in lowest terms, of a curve's points on a surface that contains the curve."""
    (x, y, w), (Px, Py), unit = (curve.x, curve.y, curve.w), line.P, (line.unit,)
    offset = between((product(Px, w), product(Py, w)), (product(x, W, unit), product(y, W, unit)))
    N, D = dot(line.U, offset), product(dot(line.U, line.U), w)
    return reduced((N, D)) if any(N) else ((0,), (1,))  # type: ignore[return-value]


def _ranges(
    lines: Sequence[MovingLine], edges: list[Form], is_on_edges: Callable[[tuple[int, ...]], bool]
) -> tuple[AngleInterval, ...]:
    if any(line.is_empty for line in lines):
        return ()
    Phi = [phi for line in lines for phi in line.Phi]
    count = len(Phi)

    def is_inside(signs: tuple[int, ...]) -> bool:
        return min(signs[:count], default=0) >= 0 and is_on_edges(signs[count:])

    places = signs_around([*Phi, *edges])
    return closed_intervals(places, [(is_inside(there), is_inside(after)) for _, there, after in places])
