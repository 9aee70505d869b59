"""`immobility`: does a body at a pose have any motion among its fingers, to first and to second order.

The first order compares velocities with the contact normals (form closure). The second adds the curvatures of body and
fingers (Rimon and Burdick). All numbers are exact. docs/theory/immobility.md has the argument.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import prod
from typing import Any, Literal

from cfree.arguments import checked
from cfree.caging.contacts import ZERO, Contact, Gap, Velocity, bend, contacts_at, slope
from cfree.caging.fingers import FIRST, Finger, setting, to_body, to_fingers
from cfree.collision.motion import Motion, Rotation, Translation
from cfree.collision.motion_checker import is_free_motion
from cfree.exact.pose import Pose, PoseLike
from cfree.scene.scene import AnyShape, size_of
from cfree.value import Value
from cfree.words import counted

MOST = 4096  # choices among the alternatives of corners
ONE = Fraction(1)
SHARES = Fraction(1, 2), Fraction(1), Fraction(2), Fraction(1, 5), Fraction(5)
"""Ratios of two velocities that are tried for a free one."""
SMALL = Fraction(1, 2**12)  # a short motion, in shares of the body's size or as tau


@dataclass(frozen=True, eq=False, repr=False)
class Immobility(Value):
    """The answer of `immobility`; true if the body is immobile.

    Attributes
    ----------
    verdict : "immobile", "mobile" or "undecided"
    order : 1, 2 or None
        The order that decides: 1 by velocities (form closure), 2 by curvatures; None if an exact free motion decides,
        or nothing.
    contacts : tuple of Contact
    velocity : (3,) Fraction or None
        If mobile: velocity of the reference point and rate of turning of a free motion.
    motion : Translation, Rotation or None
        If an exact motion decides: it is free.
    body, fingers, pose
        As given.
    units : str
        Unit of lengths, for pictures; ``cfree cage`` has that of the scene.
    """

    verdict: Literal["immobile", "mobile", "undecided"]
    order: Literal[1, 2] | None
    contacts: tuple[Contact, ...]
    velocity: Velocity | None
    motion: Motion | None
    body: tuple[AnyShape, ...]
    fingers: tuple[Finger, ...]
    pose: Pose
    units: str = ""

    def __bool__(self) -> bool:
        return self.verdict == "immobile"

    def __repr__(self) -> str:
        return f"Immobility({self.sentence()})"

    def sentence(self) -> str:
        """Return the answer in words."""
        touching = counted(len(self.contacts), "contact")
        if self.verdict == "undecided":
            return f"undecided: curvatures at {touching} balance, and no short motion was found free"
        if self.verdict == "immobile":
            why = "the contact normals alone" if self.order == 1 else "curvature"
            return f"immobile to order {self.order}: {touching}, by {why}"
        if not self.contacts:
            return "mobile: no finger touches it"
        x, y, turning = map(float, self.velocity or (ZERO, ZERO, ZERO))
        return f"mobile: it can move with velocity ({x:.4g}, {y:.4g}) and turn at {turning:.4g}, at {touching}"

    def plot(self) -> Any:
        """Draw the body with its contacts and their normals, and the free motion if there is one.

        Returns
        -------
        matplotlib figure
        """
        from cfree.lazy import registered

        return registered("immobility figure")(self)


@checked
def immobility(body: Any, fingers: Sequence[Any], pose: PoseLike = (0, 0, 0)) -> Immobility:
    """Decide if a body is immobile: if no motion leads from its pose, not even a short one.

    Parameters
    ----------
    body : shape or sequence of shapes
        Segments and circular arcs.
    fingers : sequence of points and shapes
        As in `is_caged`.
    pose : Pose or (x, y, theta)
        Must be free. Contacts are exact: a finger that misses the body by any distance does not touch it.

    Returns
    -------
    Immobility

    Raises
    ------
    ForbiddenPoseError, InvalidPoseError
        If the body overlaps a finger.
    UnsupportedError
        If a shape has other curves.

    Notes
    -----
    A velocity v is free to first order if no gap closes: g_i . v >= 0. If only 0 is, the body is immobile to first
    order. Else it is immobile to second order if for each free v some balance of the contacts that it leaves touching,
    sum l_i g_i = 0 with l_i >= 0, has sum l_i v.H_i v < 0. If all balances are positive for some v, there is a motion.
    Where curvatures balance, short exact motions are tried: a disc among fingers turns about its center.

    Examples
    --------
    >>> triangle = [(0, 0), (12, 0), (0, 5)]
    >>> incircle = [(2, 0), (0, 2), ("36/13", "50/13")]      # the normals meet in its center, (2, 2)
    >>> immobility(triangle, incircle)
    Immobility(immobile to order 2: 3 contacts, by curvature)
    >>> immobility(triangle, [*incircle[:2], ("24/13", "55/13")]).verdict
    'mobile'
    """
    shapes, start = to_body(body, pose)
    tips = to_fingers(fingers)
    contacts = tuple(contacts_at(shapes, tips, start))
    scene = setting(shapes, tips, start, FIRST).scene
    sides = [contact.any_of for contact in contacts]

    def made(verdict: Any, order: Any, velocity: Velocity | None = None, motion: Motion | None = None) -> Immobility:
        return Immobility(verdict, order, contacts, velocity, motion, shapes, tips, start)

    if prod(map(len, sides)) > MOST:
        return made("undecided", None)
    verdicts = [_decided([gap for side in choice for gap in side]) for choice in product(*sides)]
    if all(verdict == "immobile" for verdict, _, _ in verdicts):
        return made("immobile", max(order for _, order, _ in verdicts))
    for choice in product(*(contact.enough for contact in contacts)):
        verdict, order, velocity = _decided([gap for side in choice for gap in side])
        if verdict == "mobile":
            return made("mobile", order, velocity)
    for choice in product(*sides):
        for velocity in _generators([gap for side in choice for gap in side]):
            motion = _short_motion(shapes, start, velocity)
            if is_free_motion(scene, start, motion):
                return made("mobile", None, velocity, motion)
    return made("undecided", None)


def _short_motion(body: Sequence[AnyShape], pose: Pose, v: Velocity) -> Motion:
    """Return a short motion with a velocity."""
    x, y, turning = v
    if turning:
        return Rotation((pose.x - y / turning, pose.y + x / turning), {"tau": SMALL if turning > 0 else -SMALL})
    share = SMALL * Fraction(max(map(size_of, body))) / max(abs(x), abs(y))
    return Translation((share * x, share * y))


Verdict = tuple[Literal["immobile", "mobile", "undecided"], Literal[1, 2], Velocity | None]


def _decided(gaps: Sequence[Gap]) -> Verdict:
    """Decide for gaps all of which must stay open."""
    if not gaps:
        return "mobile", 1, (ONE, ZERO, ZERO)
    rays = _generators(gaps)
    if not rays:
        return "immobile", 1, None
    inner = _sum(rays)
    if all(slope(gap, inner) > 0 for gap in gaps):
        return "mobile", 1, inner
    span = _rank(rays)
    if span == 1:
        for v in rays:
            if _least(gaps, v) > 0:
                return "mobile", 2, v
        return ("immobile" if all(_least(gaps, v) < 0 for v in rays) else "undecided"), 2, None
    wedges = list(_wedges(rays))
    for u, w in wedges:
        for share in (*SHARES, ZERO):
            v = _add(u, w, share)
            if _least(gaps, v) > 0:
                return "mobile", 2, v
    return ("immobile" if all(_is_blocked(gaps, u, w) for u, w in wedges) else "undecided"), 2, None


# --- the cone of free velocities ---


def _generators(gaps: Sequence[Gap]) -> list[Velocity]:
    """Return vectors whose combinations with numbers of 0 and more are the velocities that close no gap."""
    normals = list(dict.fromkeys(gap.gradient for gap in gaps))
    candidates = [_cross(a, b) for a, b in combinations(normals, 2)]
    rank = _rank(normals)
    axes: list[Velocity] = [(ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE)]
    if rank == 2:
        along = next(v for v in candidates if any(v))
        candidates = [along, *(_cross(along, n) for n in normals)]
    elif rank == 1:
        candidates = [*(_cross(normals[0], axis) for axis in axes), normals[0]]
    elif rank == 0:
        candidates = axes
    result = list[Velocity]()
    for v in candidates:
        for sign in (1, -1):
            ray = _short((sign * v[0], sign * v[1], sign * v[2]))
            if any(ray) and ray not in result and all(_dot(n, ray) >= 0 for n in normals):
                result.append(ray)
    return result


def _wedges(rays: Sequence[Velocity]) -> Iterator[tuple[Velocity, Velocity]]:
    """Yield pairs of rays in a plane: the wedges between neighbours cover the cone of all of them."""
    across = next(_cross(u, v) for u, v in combinations(rays, 2) if any(_cross(u, v)))
    for u in rays:
        lefts = [w for w in rays if _dot(_cross(u, w), across) > 0]
        if lefts:
            first = lefts[0]
            for w in lefts[1:]:
                if _dot(_cross(w, first), across) > 0:
                    first = w
            yield u, first


def _balances(gaps: Sequence[Gap]) -> Iterator[list[tuple[Gap, Fraction]]]:
    """Yield the smallest balances: gaps with weights above 0 whose gradients sum up to 0."""
    for count in (1, 2, 3, 4):
        for chosen in combinations(gaps, count):
            weights = _weights([gap.gradient for gap in chosen])
            if weights and all(weight > 0 for weight in weights):
                yield list(zip(chosen, weights, strict=True))


def _least(gaps: Sequence[Gap], v: Velocity) -> Fraction:
    """Return the least second derivative of a balance of the gaps that a velocity leaves as they are; 1 without any."""
    touching = [gap for gap in gaps if not slope(gap, v)]
    bends = [sum((weight * bend(gap, v) for gap, weight in balance), ZERO) for balance in _balances(touching)]
    return min(bends, default=ONE)


def _is_blocked(gaps: Sequence[Gap], u: Velocity, w: Velocity) -> bool:
    """True if one balance blocks all velocities between two."""
    middle = _add(u, w, ONE)
    touching = [gap for gap in gaps if not slope(gap, middle)]
    for balance in _balances(touching):

        def total(v: Velocity, balance: list[tuple[Gap, Fraction]] = balance) -> Fraction:
            return sum((weight * bend(gap, v) for gap, weight in balance), ZERO)

        a, c = total(u), total(w)
        b = (total(middle) - a - c) / 2
        if a < 0 and c < 0 and (b <= 0 or b * b < a * c):
            return True
    return False


# --- vectors ---


def _dot(a: Velocity, b: Velocity) -> Fraction:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Velocity, b: Velocity) -> Velocity:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _add(a: Velocity, b: Velocity, share: Fraction) -> Velocity:
    x, y, z = (p + share * q for p, q in zip(a, b, strict=True))
    return x, y, z


def _sum(vectors: Sequence[Velocity]) -> Velocity:
    x, y, z = (sum(column, ZERO) for column in zip(*vectors, strict=True))
    return x, y, z


def _short(v: Velocity) -> Velocity:
    """Return a vector in the same direction, its largest number 1."""
    size = max(map(abs, v))
    if not size:
        return v
    x, y, z = (p / size for p in v)
    return x, y, z


def _rank(vectors: Sequence[Velocity]) -> int:
    rows, rank = [list(v) for v in vectors], 0
    for column in range(3):
        pivot = next((row for row in rows[rank:] if row[column]), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(rank, pivot)
        for k in range(rank + 1, len(rows)):
            share = rows[k][column] / pivot[column]
            rows[k] = [a - share * b for a, b in zip(rows[k], pivot, strict=True)]
        rank += 1
    return rank


def _weights(vectors: Sequence[Velocity]) -> list[Fraction] | None:
    """Return the numbers, 1 the first, with which vectors sum up to 0; None if there are none, or several choices."""
    count = len(vectors)
    if _rank(vectors) != count - 1:
        return None
    unknown = count - 1
    rows = [[vectors[k + 1][axis] for k in range(unknown)] + [-vectors[0][axis]] for axis in range(3)]
    solved = 0
    for column in range(unknown):
        pivot = next((k for k in range(solved, 3) if rows[k][column]), None)
        if pivot is None:
            return None
        rows[solved], rows[pivot] = rows[pivot], rows[solved]
        scale = rows[solved][column]
        rows[solved] = [x / scale for x in rows[solved]]
        for k in range(3):
            if k != solved and rows[k][column]:
                share = rows[k][column]
                rows[k] = [a - share * b for a, b in zip(rows[k], rows[solved], strict=True)]
        solved += 1
    if any(row[-1] for row in rows[solved:]):
        return None
    return [ONE, *(row[-1] for row in rows[:unknown])]
