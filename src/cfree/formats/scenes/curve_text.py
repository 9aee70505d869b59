"""Write round shapes as JSON text; `docs/scene-format.md` describes them, `curve_format.py` reads them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from cfree.curves.curved import Curved
from cfree.curves.rings import Arc, Bezier, Circle, Ellipse, Spline
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose


def curved_text(shape: Curved, number: Callable[[Any], str], angle: Callable[[Pose], str], head: str = "") -> str:
    """Return the JSON of a round shape."""

    def point(p: ExactPoint) -> str:
        return f"[{number(p[0])}, {number(p[1])}]"

    def points(rows: tuple[ExactPoint, ...]) -> str:
        return f"[{', '.join(map(point, rows))}]"

    def segment(item: Any) -> str:
        match item:
            case Arc():
                named = {"to": item.to, "through": item.through, "center": item.center, "conjugate": item.conjugate}
                members = [f'"{name}": {point(p)}' for name, p in named.items() if p is not None]
                members += ['"clockwise": true'] if item.clockwise else []
                return f'{{"arc": {{{", ".join(members)}}}}}'
            case Bezier(rows) | Spline(rows):
                return f'{{"{type(item).__name__.lower()}": {points(rows)}}}'
            case _:
                return point(item)

    def ring(curve: Any) -> str:
        match curve:
            case Circle(center, radius):
                return f'"circle": {{"center": {point(center)}, "radius": {number(radius)}}}'
            case Ellipse(center, (a, b), turned):
                return (
                    f'"ellipse": {{"center": {point(center)}, "radii": [{number(a)}, {number(b)}], '
                    f'"angle": {angle(turned)}}}'
                )
            case _:
                return f'"path": [{", ".join(map(segment, curve))}]'

    members = [*([head] if head else []), ring(shape.path)]
    if shape.holes:
        members.append(f'"holes": [{", ".join(f"{{{ring(hole)}}}" for hole in shape.holes)}]')
    if shape.grown:
        members.append(f'"grown": {number(shape.grown)}')
    return f"{{{', '.join(members)}}}"
