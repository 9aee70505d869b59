"""Check that contacts hold a vehicle: all first motions from each pose of its rail, by the polynomials of its points.

Along a line or a turn about a pole, the height of a point over an edge is a polynomial of degree 2 in the length, or in
the tangent of half the angle, over a positive one. Its sign from 0 on is that of its first coefficient that is not 0.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

from cfree.exact.pose import Pose
from cfree.verify.motions import fault_at
from cfree.verify.result import Finding

if TYPE_CHECKING:
    from cfree.planning.stuck import Stuck
    from cfree.verify.world import World

HELD = "held by contacts"
ZERO, ONE = Fraction(0), Fraction(1)
BOUNDS, WORKSPACE = -1, -2  # numbers of obstacles

Point = tuple[Fraction, Fraction]
Ring = list[Point]
Control = tuple[Fraction, Fraction]  # speed along forward, rate of turning


@dataclass(frozen=True)
class Height:
    """A point on the line of an edge: `sense` is 1 if the point moves with the robot, -1 if the edge does."""

    edge: Point
    point: Point
    sense: int

    def rate(self, control: Control) -> Fraction:
        """The first derivative of its height outside."""
        (ex, ey), (x, y), (v, w) = self.edge, self.point, control
        return -self.sense * (ex * (w * x) - ey * (v - w * y))

    def sign(self, control: Control) -> int:
        """Sign of its height from 0 on: of the first coefficient that is not 0."""
        (ex, ey), (x, y), (v, w) = self.edge, self.point, control
        if w == 0:
            coefficients = [self.sense * ey * v]
        else:
            sense = self.sense if w > 0 else -self.sense
            dx, dy = x, y - v / w  # from the pole
            along, across = ex * dy - ey * dx, ex * dx + ey * dy
            coefficients = [-2 * sense * across, 2 * along]
        first = next((c for c in coefficients if c), ZERO)
        return (first > 0) - (first < 0)


def stuck_findings(proof: Stuck, world: World) -> Iterator[Finding]:
    """Findings about a proof that a vehicle is stuck."""
    if not proof.rail or proof.rail[0] != proof.pose:
        yield Finding(HELD, "rail", f"it does not begin at the {proof.at}")
        return
    held = _Held(proof, world)
    obstacles = set[int]()
    for k, pose in enumerate(proof.rail):
        if fault_at(pose, world) is not None:
            yield Finding(HELD, f"rail {k}", "it is forbidden")
            return
        pairs = held.pairs(pose)
        obstacles |= {pair[0] for pair in pairs}
        if not pairs:
            yield Finding(HELD, f"rail {k}", "the robot touches nothing there")
            return
        for control in held.controls(pairs):
            sign = held.sign(pairs, control)
            v, w = control
            how = f"{'ahead' if v > 0 else 'back' if v < 0 else 'in place'}, turning {float(w):g} on {abs(float(v)):g}"
            if sign > 0:
                yield Finding(HELD, f"rail {k}", f"it can leave: {how}")
                return
            if sign == 0 and (w != 0 or not held.goes_on(pose, control)):
                yield Finding(HELD, f"rail {k}", f"it can go on along its contacts, which is not in the proof: {how}")
                return
    if proof.of == "paths":
        pairs = held.pairs(proof.pose)
        for control in held.controls(pairs, any_vehicle=True):
            if all(any(all(h.rate(control) >= 0 for h in edge) for edge in edges) for _, edges in pairs):
                yield Finding(HELD, "of", "it is of finitely many pieces only, not of all paths")
                return
    if tuple(sorted(obstacles)) != proof.obstacles:
        yield Finding(HELD, "obstacles", f"it touches {sorted(obstacles)}")


class _Held:
    """Contacts of a vehicle's robot in a world, in the frame of its axle."""

    def __init__(self, proof: Stuck, world: World) -> None:
        self.vehicle, self.at, self.world = proof.vehicle, proof.at, world
        self.rail = set(proof.rail)
        scale = world.scale
        back = proof.vehicle.frame.inverse()
        self.robot = [list(back.apply_exact(_fractions(ring, scale))) for ring in world.parts]
        self.reference = back.apply_exact([(ZERO, ZERO)])[0]
        self.reach = max(abs(float(x)) + abs(float(y)) for ring in self.robot for x, y in ring)
        owners = [k for k, shape in enumerate(world.scene.obstacles) for _ in shape.pieces]
        names = [*owners, *[WORKSPACE] * (len(world.obstacle_pieces) - len(owners))]
        self.others = [(name, _fractions(ring, scale)) for name, ring in zip(names, world.obstacle_pieces, strict=True)]

    def around(self, pose: Pose, within: float) -> Iterator[tuple[int, Ring]]:
        """Yield the pieces near a pose, by obstacle, in the frame of the axle."""
        axle = pose @ self.vehicle.frame
        back, x, y, reach = axle.inverse(), float(axle.x), float(axle.y), self.reach + within + 1e-6 * self.reach
        for name, ring in self.others:
            xs, ys = [float(p) for p, _ in ring], [float(q) for _, q in ring]
            if min(xs) <= x + reach and max(xs) >= x - reach and min(ys) <= y + reach and max(ys) >= y - reach:
                yield name, list(back.apply_exact(ring))

    def pairs(self, pose: Pose) -> list[tuple[int, list[list[Height]]]]:
        """Return the pairs in contact, with the points on each edge that separates them."""
        pairs = list[tuple[int, list[list[Height]]]]()
        for name, other in self.around(pose, 0):
            for part in self.robot:
                edges = _edges(other, part, 1) + _edges(part, other, -1)
                if edges and [] not in edges:
                    pairs.append((name, edges))
        for edge, room in self.rooms(pose):
            if room == 0:
                pairs.append((BOUNDS, [[Height(edge, self.reference, 1)]]))
        return pairs

    def rooms(self, pose: Pose) -> Iterator[tuple[Point, Fraction]]:
        """Yield the sides of the bounds, in the frame of the axle, with the room left there."""
        if not self.world.scene.bounds:
            return
        x0, y0, x1, y1 = self.world.scene.bounds
        axle = pose @ self.vehicle.frame
        c, s = axle.cos, axle.sin
        for (ex, ey), room in (((ZERO, ONE), pose.x - x0), ((ZERO, -ONE), x1 - pose.x), ((-ONE, ZERO), pose.y - y0),
                               ((ONE, ZERO), y1 - pose.y)):  # fmt: skip
            yield (ex * c + ey * s, ey * c - ex * s), room

    def controls(self, pairs: list[tuple[int, list[list[Height]]]], *, any_vehicle: bool = False) -> Iterator[Control]:
        """Yield every control at which a sign may change, and one between each two."""
        curvatures = {ZERO}
        for height in (h for _, edges in pairs for edge in edges for h in edge):
            straight, turning = height.rate((ONE, ZERO)), height.rate((ZERO, ONE))
            if turning:
                curvatures.add(-straight / turning)
            if height.point[1]:
                curvatures.add(1 / height.point[1])
        is_car = self.vehicle.kind == "car" and not any_vehicle
        if is_car:
            low, high = -1 / self.vehicle.radii[1], 1 / self.vehicle.radii[0]
            curvatures = {k for k in curvatures if low < k < high} | {low, high}
        ordered = sorted(curvatures)
        middle = [(a + b) / 2 for a, b in pairwise(ordered)]
        beyond = [] if is_car else [ordered[0] - 1, ordered[-1] + 1]
        gears = (1, -1) if self.vehicle.gears == "both" or any_vehicle else (1,) if self.at == "start" else (-1,)
        for gear in gears:
            yield from ((Fraction(gear), gear * k) for k in (*ordered, *middle, *beyond))
        if not is_car:
            yield ZERO, ONE
            yield ZERO, -ONE

    def goes_on(self, pose: Pose, control: Control) -> bool:
        """True if the rail has a pose ahead on a line, and no other motion begins between the two."""
        axle = pose @ self.vehicle.frame
        c, s = axle.cos * control[0], axle.sin * control[0]
        others = [(other.x - pose.x, other.y - pose.y) for other in self.rail if other.tau == pose.tau]
        ahead = [c * x + s * y for x, y in others if c * y == s * x]
        end = min((length for length in ahead if length > 0), default=None)
        if end is None:
            return False
        events = sorted({ZERO, end, *(e for e in self._events(pose, control[0], end) if 0 < e < end)})
        lengths = [*events[1:-1], *((a + b) / 2 for a, b in pairwise(events))]
        return all(
            self._is_held(Pose(pose.x + c * length, pose.y + s * length, {"tau": pose.tau})) for length in lengths
        )

    def _is_held(self, pose: Pose) -> bool:
        """True if no motion but a straight one begins at a pose."""
        pairs = self.pairs(pose)
        return bool(pairs) and all(
            sign < 0 or (sign == 0 and w == 0) for (v, w) in self.controls(pairs) for sign in [self.sign(pairs, (v, w))]
        )

    def sign(self, pairs: list[tuple[int, list[list[Height]]]], control: Control) -> int:
        """1 if a control parts all pairs, 0 if some keep touching, -1 if some overlap; from 0 on."""
        return min(max(min(h.sign(control) for h in edge) for edge in edges) for _, edges in pairs)

    def _events(self, pose: Pose, gear: Fraction, end: Fraction) -> Iterator[Fraction]:
        """Yield the lengths of straight ways, up to an end, at which a sign of a pair may change.

        Signs of a pair matter only where the boxes of its pieces meet.
        """
        for other in (ring for _, ring in self.around(pose, float(end))):
            for part in self.robot:
                if not _is_beside(part, other):
                    continue
                events = [x / gear for x, _ in other]
                for ring, points, sense in ((other, part, 1), (part, other, -1)):
                    for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
                        if by != ay:
                            speed = -sense * gear * (by - ay)
                            events += [-((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / speed for x, y in points]
                (x0, x1), (u0, u1) = ((min(x for x, _ in ring), max(x for x, _ in ring)) for ring in (part, other))
                first, last = sorted(((u0 - x1) / gear, (u1 - x0) / gear))
                yield from (length for length in events if first <= length <= last)
        yield from (-room / (gear * ey) for (_, ey), room in self.rooms(pose) if ey)


def _is_beside(part: Ring, other: Ring) -> bool:
    """True if the boxes of two rings meet somewhere when one moves along the x-axis."""
    (low, high), (least, most) = ((min(y for _, y in ring), max(y for _, y in ring)) for ring in (part, other))
    return low <= most and least <= high


def _edges(ring: Ring, points: Ring, sense: int) -> list[list[Height]]:
    """Return the points on the line of each edge of a ring that has none of them inside."""
    edges = list[list[Height]]()
    for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
        ex, ey = bx - ax, by - ay
        inside = [ex * (y - ay) - ey * (x - ax) for x, y in points]
        if max(inside) <= 0:
            edges.append([Height((ex, ey), p, sense) for p, size in zip(points, inside, strict=True) if size == 0])
    return edges


def _fractions(ring: Iterable[tuple[int, int]], scale: int) -> Ring:
    return [(Fraction(x, scale), Fraction(y, scale)) for x, y in ring]
