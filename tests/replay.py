"""The decimals of an answer file, applied motion by motion as a program without fractions would: do they lead along?

Numbers are read as they are written, and applied with 900 bits, so that what is measured is what the file says.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from flint import arb, ctx, fmpq

from cfree import Path, Pose, Scene

BITS = 900
CLOSE = 1e-9  # of the robot's size: how far decimals may lead astray

Placed = tuple[arb, arb, arb]  # x, y, theta


def deviation(scene: Scene, path: Path, file: FilePath) -> float:
    """The largest distance of a vertex of the robot from where it exactly is, after any motion, in robot sizes."""
    old, ctx.prec = ctx.prec, BITS
    try:
        corners = [(_arb(x), _arb(y)) for part in scene.robot for x, y in part.exact_vertices]
        size = max(max(c) - min(c) for c in zip(*(p for part in scene.robot for p in part.exact_vertices), strict=True))
        read = json.loads(file.read_text(), parse_float=Fraction, parse_int=Fraction)
        worst = 0.0
        for exact, decimal in _both(path, read):
            for (x, y), (u, v) in zip(_exactly(exact, corners), _decimally(decimal, corners), strict=True):
                squared = ((x - u) ** 2 + (y - v) ** 2) / _arb(size) ** 2
                worst = max(worst, math.sqrt(squared.abs_upper()))
        return worst
    finally:
        ctx.prec = old


def _both(path: Path, read: dict[str, Any]) -> Iterator[tuple[Pose, Placed]]:
    """After each motion: where the robot is, where adding up leads, and where the file says it is."""
    x, y, theta = (_arb(v) for v in read["start"])
    yield path.start, (x, y, theta)
    for motion, pose in zip(read["motions"], path.poses[1:], strict=True):
        if motion["type"] == "rotation":
            u, v = (_arb(c) for c in motion["pole"])
            c, s = _turn(_arb(motion["angle"]))
            x, y = u + c * (x - u) - s * (y - v), v + s * (x - u) + c * (y - v)
        else:
            x, y = x + _arb(motion["vector"][0]), y + _arb(motion["vector"][1])
        theta = theta + _arb(motion.get("angle", 0))
        yield pose, (x, y, theta)
        if "to" in motion:
            u, v, w = (_arb(c) for c in motion["to"])
            yield pose, (u, v, w)
            if float(abs(w - theta)) > 1e-6:
                raise AssertionError(f"theta is not continuous: {motion['to'][2]} after turning to {theta.str(12)}")
    yield path.goal, tuple(_arb(v) for v in read["goal"])  # type: ignore[misc]


def _arb(value: Any) -> arb:
    exact = Fraction(value)
    return arb(fmpq(exact.numerator, exact.denominator))


def _turn(theta: arb) -> tuple[arb, arb]:
    return theta.cos(), theta.sin()


def _exactly(pose: Pose, corners: list[tuple[arb, arb]]) -> list[tuple[arb, arb]]:
    return _moved(corners, _arb(pose.x), _arb(pose.y), (_arb(pose.cos), _arb(pose.sin)))


def _decimally(pose: Placed, corners: list[tuple[arb, arb]]) -> list[tuple[arb, arb]]:
    x, y, theta = pose
    return _moved(corners, x, y, _turn(theta))


def _moved(corners: list[tuple[arb, arb]], x: arb, y: arb, turn: tuple[arb, arb]) -> list[tuple[arb, arb]]:
    c, s = turn
    return [(x + c * a - s * b, y + s * a + c * b) for a, b in corners]
