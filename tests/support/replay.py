"""Apply the decimals of an answer file motion by motion, like a program without fractions, and check where they lead.

Numbers are read in their own digits, and applied with 900 bits, so that only the file's own errors are measured.
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
from cfree.collision.pose_checker import PoseChecker

BITS = 900
CLOSE = 1e-9  # of the robot's size: largest error of decimals

Placed = tuple[arb, arb, arb]  # x, y, theta


def deviation(scene: Scene, path: Path, file: FilePath) -> float:
    """Largest distance of a vertex of the robot from its exact place, after any motion, in robot sizes."""
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


def collisions(scene: Scene, file: FilePath) -> int:
    """Number of forbidden poses, of some on the decimals' path, read as doubles, if the file claims there are none."""
    old, ctx.prec = ctx.prec, BITS
    try:
        read = json.loads(file.read_text())
        poses = [_pose(*placed) for placed in _along(read)] if read.get("decimals") == "free" else []
        checker = PoseChecker(scene)
        return sum(not checker.is_free(pose) for pose in poses)
    finally:
        ctx.prec = old


def _along(read: dict[str, Any]) -> Iterator[Placed]:
    """The start, and three poses on each motion, its end the last."""
    x, y, theta = (_arb(v) for v in read["start"])
    yield x, y, theta
    for motion in read["motions"]:
        for share in (Fraction(3, 8), Fraction(7, 8), Fraction(1)):  # in binary: some paths touch all along
            here = _after(motion, _arb(share), x, y, theta)
            yield here
        x, y, theta = here


def _after(motion: dict[str, Any], share: arb, x: arb, y: arb, theta: arb) -> Placed:
    """Pose after a share of a motion; after all of a slide, whose decimals give no more."""
    angle = share * _arb(motion.get("angle", 0))
    if motion["type"] == "rotation":
        u, v = (_arb(c) for c in motion["pole"])
        c, s = angle.cos(), angle.sin()
        return u + c * (x - u) - s * (y - v), v + s * (x - u) + c * (y - v), theta + angle
    u, v = (share * _arb(c) for c in motion["vector"])
    return x + u, y + v, theta + angle


def _pose(x: arb, y: arb, theta: arb) -> Pose:
    half = theta / 2
    c, s = half.cos(), half.sin()
    tau = None if float(abs(c)) < 1e-60 else _fraction(s / c)
    return Pose(_fraction(x), _fraction(y), {"tau": tau})


def _fraction(value: arb) -> Fraction:
    """Fraction near the middle: the error sought is far larger than 2^-200 of it."""
    mantissa, exponent = value.mid().man_exp()
    exact = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    digits = max(0, 200 - exact.numerator.bit_length() + exact.denominator.bit_length())
    return Fraction(round(exact * 2**digits), 2**digits)


def _both(path: Path, read: dict[str, Any]) -> Iterator[tuple[Pose, Placed]]:
    """Robot's pose after each motion, the sum of the decimals, and the pose in the file."""
    x, y, theta = (_arb(v) for v in read["start"])
    yield path.start, (x, y, theta)
    for motion, pose in zip(read["motions"], path.poses[1:], strict=True):
        x, y, theta = _after(motion, arb(1), x, y, theta)
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
