"""Motions through places where a robot with round edges fits exactly: along a line, about a point, or on a circle.

A path among polygons inside of the shapes passes such a place nearly. The contacts near it give the exact one: two
contacts that oppose each other hold the robot on a line, an arc in an arc of its own radius turns about its center, and
between two arcs about one center an arc goes around.
Each is tried if its numbers are rational; the motion through it is proved free, and searches join its ends.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import chain, islice, pairwise, product
from typing import TYPE_CHECKING

from cfree.collision.motion import Translation
from cfree.exact.half_angle import sum_of_angles, theta_from
from cfree.exact.number import ExactPoint, simplest_between
from cfree.exact.pose import Pose, pose_at
from cfree.libraries import np

if TYPE_CHECKING:
    from cfree.paths.path import Path
    from cfree.planning.arc_planner import ArcPlanner
    from cfree.planning.contact_fits import Center, Ring
    from cfree.planning.options import Options

SAMPLES = 600  # poses at which a path is looked at
MOST_PLACES = 8  # free parts of a path that are tried, and as many motions through fits
MOST_TRIES, FEW_TRIES = 80, 20  # searches that join them; in one of many queries
MOST_WAYS = 8  # motions out of a contact
MOST_PAIRS = 12  # searches between motions out of contacts
LOOKS = 5  # poses of a forbidden part of a path near which fits are looked for
LEAST_RUN = 3  # poses of one
NEAR = 16  # errors of polygons within which a contact counts as near
TOUCHING = 1e-9  # largest distance of a contact, relative to the robot
FAR = 100  # of these: distances are not bounded beyond
WIDELY = 1.2  # radians by which a robot is turned about the center of an arc that is held on a line
FARTHER = (1.25, 2.0, 1.0, 0.5)  # lengths of a motion through a place, relative
BEYOND = (0.02, 0.1)  # shares of a turn around a channel at both ends
NEAR_END = 0.2  # radians from the end of a channel
LARGEST_TURN = 1.5  # radians, of one motion
IN_ORDER = 1e-6  # of a path: places of one run of poses, one after another

Way = list[Pose]


def way_through_fits(
    planner: ArcPlanner, path: Path, options: Options, error: float, *, thorough: bool = True
) -> Way | None:
    """Return a way near one among polygons inside of the shapes, through places where the robot fits exactly.

    Parameters
    ----------
    planner : ArcPlanner
    path : Path
        It is free among the polygons, not among the shapes.
    options : Options
    error : float
        That of the polygons.
    thorough : bool
        False leaves out most searches.

    Returns
    -------
    list of Pose or None
        None if no such place is found, or the searches do not join them.
    """
    links = _links(planner, path, error)
    ways: dict[int, Way] = {-1: [path.start]}  # by the link at whose end they are
    todo, tries, most = [-1], 0, MOST_TRIES if thorough else FEW_TRIES
    while todo and tries < most:
        k = todo.pop()
        for n in range(len(links), k, -1):
            if n in ways:
                continue
            tries += 1
            target = [path.goal] if n == len(links) else links[n]
            here = ways[k][-1]
            joined = [here] if here == target[0] else planner.quick(here, target[0], options)
            if joined:
                ways[n] = [*ways[k], *joined[1:], *target[1:]]
                if n == len(links):
                    return ways[n]
                todo.append(n)
    return None


def _links(planner: ArcPlanner, path: Path, error: float) -> list[Way]:
    """Return ways that are free among the shapes, along a path: its longest free parts, and motions through fits."""
    parts = [(position, travel, _lengthened(planner, part)) for position, travel, part in _free_parts(planner, path)]
    lines = dict[tuple[object, ...], tuple[float, float, Way]]()
    for position, run in _narrow_runs(planner, path):
        steps = math.hypot(*(run[-1, :2] - run[0, :2]))
        for number, portal in enumerate(_portals(planner, run, NEAR * error)):
            key, is_back = _line_of(planner, *portal)
            own = portal[::-1] if is_back else portal
            first, ahead, way = lines.get(key, (position + number * IN_ORDER, 0.0, own))
            lines[key] = first, ahead + (-steps if is_back else steps), _joined(planner, way, own)
    through = list[tuple[float, float, Way]]()
    for position, ahead, way in lines.values():  # in the direction in which the path passes the line
        through.append((position, math.hypot(*map(float, _apart(*way))), way[::-1] if ahead < 0 else way))
    longest = [link for links in (parts, through) for link in sorted(links, key=lambda link: -link[1])[:MOST_PLACES]]
    between = [way for _, _, way in sorted(longest, key=lambda link: link[0])]
    begins = ways_out(planner, path.start, path.goal)
    ends = ([*reversed(way)] for way in ways_out(planner, path.goal, path.start))
    return [*begins, *between, *ends]


def _lengthened(planner: ArcPlanner, way: Way) -> Way:
    """Return a way that goes on straight at both ends, if its first and last motions are straight."""
    lengths = [2 * planner.angle_scale * share for share in FARTHER]
    for _ in range(2):
        way = [*reversed(way)]
        one, other = way[-2:]
        along = _apart(one, other)
        if one.tau == other.tau and any(along):
            beyond = _beyond(planner, other, along, lengths)
            way = way if beyond == other else [*way[:-1], beyond]
    return way


def _apart(one: Pose, other: Pose) -> ExactPoint:
    return other.x - one.x, other.y - one.y


def _free_parts(planner: ArcPlanner, path: Path) -> Iterator[tuple[float, float, Way]]:
    """Yield the position on the path, the length and the poses of each part of it that is free among the shapes."""
    part, length, position = list[Pose](), 0.0, 0.0
    whole = max(path.length, 1e-300)
    for one, other in pairwise(path.poses):
        step = math.hypot(*map(float, _apart(one, other)))
        if planner.checker.joins([one, other]):
            part, length = [*(part or [one]), other], length + step
        else:
            if length > 0:
                yield position / whole, length, part
            part, length = [], 0.0
        position += step
    if length > 0:
        yield position / whole, length, part


def _narrow_runs(planner: ArcPlanner, path: Path) -> Iterator[tuple[float, np.ndarray]]:
    """Yield the position, as a share, and rows x, y, theta of each run of poses that are forbidden among the shapes."""
    samples = path.sample(max(path.length, 1e-300) / SAMPLES, max(path.turning, 1e-9) / SAMPLES)
    rows = np.column_stack([samples.xy, samples.theta])
    turned = rows.copy()
    turned[:, 2] = np.mod(turned[:, 2], 2 * math.pi)
    is_free = planner.arcs.are_free(turned)
    travel = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(rows[:, :2], axis=0).T))])
    edges = np.flatnonzero(np.diff(np.concatenate([[True], is_free, [True]]).astype(int)))
    for begin, end in edges.reshape(-1, 2).tolist():
        middle = float(travel[(begin + end) // 2] / max(travel[-1], 1e-300)) if begin + end < 2 * len(travel) else 1.0
        yield middle, rows[max(0, begin - 1) : end + 1]


def _joined(planner: ArcPlanner, one: Way, other: Way) -> Way:
    """Return the motion from the first to the last pose of two on one line, if it is free; else the longer one."""
    if one == other or one[0].tau != one[-1].tau:
        return one
    x, y = _apart(*one)
    poses = sorted([*one, *other], key=lambda pose: pose.x * x + pose.y * y)
    whole = [poses[0], poses[-1]]
    if planner.checker.joins(whole):
        return whole
    return max(one, other, key=lambda way: math.hypot(*map(float, _apart(*way))))


def _portals(planner: ArcPlanner, run: np.ndarray, near: float) -> Iterator[Way]:
    """Yield motions through exact fits near some poses, proved free; of a channel those before, in and after it."""
    looks = [
        ((_about(x, near), _about(y, near)), planner.fits.angles(x, y, theta, near))  # few digits: decided faster
        for x, y, theta in run[[len(run) * k // (2 * LOOKS) for k in (5, 3, 7, 1, 9)]].tolist()
    ]
    around = (_around(planner, place, tau, run, near) for place, taus in looks for tau in taus)
    if channel := next(chain.from_iterable(around), None):
        inside, ways = channel
        for part, own in ((run[: inside.start + 1], ways), (run[inside.stop - 1 :], [])):
            if LEAST_RUN <= len(part) < len(run):
                yield from _portals(planner, part, near)
            yield from map(list, own)
        return
    for place, taus in looks:
        for tau in taus:
            portal = next(chain(_turns(planner, place, tau, run, near), _lines(planner, place, tau, run, near)), None)
            if portal is not None:
                yield [*portal]
                break


def _about(x: float, near: float) -> Fraction:
    return simplest_between(Fraction(x - near / 8), Fraction(x + near / 8))


def _line_of(planner: ArcPlanner, begin: Pose, end: Pose) -> tuple[tuple[object, ...], bool]:
    """Return values that two parts of a line have in common, and True if this one leads back along it."""
    x, y = _apart(begin, end)
    travel = math.hypot(x, y)
    if begin.tau != end.tau or not travel:
        return (begin, end), False
    u, v = round(float(x) / travel, 6), round(float(y) / travel, 6)
    is_back = (u, v) < (0, 0)
    height = round(float(begin.x * y - begin.y * x) / travel / planner.angle_scale, 6)
    return (begin.tau, *((-u, -v, -height) if is_back else (u, v, height))), is_back


def _turns(
    planner: ArcPlanner, place: ExactPoint, tau: Fraction | None, run: np.ndarray, near: float
) -> Iterator[tuple[Pose, Pose]]:
    """Yield turns about a center of two arcs, from and to the orientations of a run."""
    taus = [Pose(0, 0, float(_about(row[2], 2.0**-10))).tau for row in (run[0], run[-1])]
    for center in planner.fits.centers(place, tau, near):
        begin, end = map(center.pose, taus)
        if begin != end and planner.checker.joins([begin, end]):
            yield begin, end


def _around(
    planner: ArcPlanner, place: ExactPoint, tau: Fraction | None, run: np.ndarray, near: float
) -> Iterator[tuple[slice, list[tuple[Pose, Pose]]]]:
    """Yield the part of a run that is in a channel, and turns one after another about its center, about so far."""
    for ring in planner.fits.rings(place, tau, near):
        seen = np.array([ring.seen(*row) for row in run.tolist()])
        here = int(np.argmin(np.hypot(run[:, 0] - float(place[0]), run[:, 1] - float(place[1]))))
        (out,) = np.nonzero(abs(abs(seen) - float(ring.radius)) > near)
        before, after = out[out < here], out[out > here]
        inside = slice(before[-1] if len(before) else 0, (after[0] if len(after) else len(seen) - 1) + 1)
        directions = np.unwrap(np.angle(seen[inside]))
        first, last, theta = float(directions[0]), float(directions[-1]), float(_about(run[0, 2], 2.0**-10))
        for begin, end in _ends_of_turn(ring, first, last):
            start = Pose(0, 0, theta).tau
            center, stop = ring.turning(begin, start), sum_of_angles(start, sum_of_angles(end, begin and -begin))
            ways = [*pairwise([center.pose(start), *_stops(center, theta, last - first, stop)])]
            if all(one != other and planner.checker.joins([one, other]) for one, other in ways):
                sense = math.copysign(1.0, last - first)
                least = sense * math.remainder(theta_from(begin) - first, math.tau)
                most = sense * (last - first + math.remainder(theta_from(end) - last, math.tau))
                ahead = sense * (directions - first)
                (rows,) = np.nonzero((least <= ahead) & (ahead <= most))
                if len(rows):
                    yield slice(inside.start + int(rows[0]), inside.start + int(rows[-1]) + 1), ways
                break


def _stops(center: Center, theta: float, angle: float, stop: Fraction | None) -> Way:
    """Return the poses of a turn by an angle from an orientation on, to one that is given exactly."""
    steps = 1 + int(abs(angle) / LARGEST_TURN)
    taus = [Pose(0, 0, theta + angle * k / steps).tau for k in range(1, steps)]
    return [*map(center.pose, [*taus, stop])]


def _ends_of_turn(ring: Ring, first: float, last: float) -> Iterator[tuple[Fraction | None, Fraction | None]]:
    """Yield directions of a turn: beyond the given ones; where the channel may end if that is near; or before."""

    def end_near(angle: float) -> Fraction | None:
        apart = [abs(math.remainder(theta_from(end) - angle, math.tau)) for end in ring.ends]
        return ring.ends[int(np.argmin(apart))] if min(apart, default=math.pi) < NEAR_END else Pose(0, 0, angle).tau

    for share in BEYOND:
        more = share * (last - first)
        yield Pose(0, 0, first - more).tau, Pose(0, 0, last + more).tau
    yield end_near(first), end_near(last)
    less = BEYOND[0] * (last - first)
    yield Pose(0, 0, first + less).tau, Pose(0, 0, last - less).tau


def _lines(
    planner: ArcPlanner, place: ExactPoint, tau: Fraction | None, run: np.ndarray, near: float
) -> Iterator[tuple[Pose, Pose]]:
    """Yield translations along a line between contacts, about as long as the run, or longer.

    A line that holds the center of an arc holds it at all orientations: the longest translation is that of one of them.
    """
    x, y, theta = float(place[0]), float(place[1]), Pose(0, 0, {"tau": tau}).theta
    for line in planner.fits.lines(place, tau, near):
        ways = [_along(planner, line.pose, line.along, run)]
        if ways[0] and line.center:
            others = [Fraction(0), *planner.fits.angles(x, y, theta, near, WIDELY)]
            ways += [_along(planner, line.center.pose(other), line.along, run) for other in others if other != tau]
        if free := [way for way in ways if way]:
            yield max(free, key=lambda way: _length_and_simplicity(planner, *way))


def _length_and_simplicity(planner: ArcPlanner, begin: Pose, end: Pose) -> tuple[float, int]:
    """Return the rounded length of a translation, and a number that is larger for simpler orientations."""
    length, tau = math.hypot(*map(float, _apart(begin, end))), begin.tau
    return round(length / planner.angle_scale, 6), 0 if tau is None else -tau.denominator - abs(tau.numerator)


def _along(planner: ArcPlanner, middle: Pose, along: ExactPoint, run: np.ndarray) -> tuple[Pose, Pose] | None:
    """Return a translation through a pose, about as long as a run of poses, or longer; None if there is none."""
    if not planner.arcs.is_free(middle):
        return None
    (u, v), steps = along, run[-1, :2] - run[0, :2]
    if float(u) * steps[0] + float(v) * steps[1] < 0:
        u, v = -u, -v
    whole = math.hypot(u, v)
    lengths = [
        abs((x - float(middle.x)) * float(u) + (y - float(middle.y)) * float(v)) / whole
        for x, y in (run[0, :2], run[-1, :2])
    ]
    least = max(sum(lengths) / 4, 1e-9 * planner.angle_scale)
    back, ahead = (
        _as_far(planner, middle, (sign * u, sign * v), [share * max(length, least) for share in FARTHER])
        for sign, length in zip((-1, 1), lengths, strict=True)
    )
    return (back, ahead) if back != ahead else None


def _as_far(planner: ArcPlanner, pose: Pose, along: ExactPoint, lengths: Sequence[float]) -> Pose:
    """Return the pose of `_beyond`; or the one at which something stops the translation, if that place is rational.

    Two lines that hold the robot meet at such a place.
    """
    beyond = _beyond(planner, pose, along, lengths[:1])
    if beyond != pose:
        return beyond
    share = simplest_between(*(Fraction(max(lengths) / math.hypot(*along) * part) for part in (0.99, 1.01)))
    motion = Translation((share * along[0], share * along[1]))
    if stop := planner.arcs.first_contact(pose, motion):
        end = motion.at(pose, simplest_between(*stop[:2]))
        if end != pose and planner.checker.joins([pose, end]):
            return end
    return _beyond(planner, pose, along, lengths[1:])


def _beyond(planner: ArcPlanner, pose: Pose, along: ExactPoint, lengths: Sequence[float]) -> Pose:
    """Return the pose at the first length along a vector to which a translation is free; the pose if none is."""
    whole = math.hypot(*along)
    for length in lengths:
        share = simplest_between(Fraction(length / whole * 0.99), Fraction(length / whole * 1.01))
        other = pose_at(pose.x + share * along[0], pose.y + share * along[1], pose.tau)
        if planner.checker.joins([pose, other]):
            return other
    return pose


def ways_out(planner: ArcPlanner, pose: Pose, other: Pose) -> list[Way]:
    """Return free motions from a pose in contact, along its contacts or about a center; [] if it touches nothing.

    Parameters
    ----------
    planner : ArcPlanner
    pose, other : Pose
        The other end of the path: turns may go to its orientation.
    """
    near = TOUCHING * planner.angle_scale
    if planner.arcs.distance(pose, FAR * near)[0] > near:
        return []
    place, ways = (pose.x, pose.y), list[Way]()
    lengths = [planner.angle_scale * 2.0**k for k in range(3, -5, -1)]
    directions = dict.fromkeys(planner.fits.tangents(pose, near))
    for x, y in islice(dict.fromkeys(d for u, v in directions for d in ((u, v), (-u, -v))), MOST_WAYS):
        beyond = _beyond(planner, pose, (x, y), lengths)
        ways += [[pose, beyond]] if beyond != pose else []
    for center in islice(planner.fits.centers(place, pose.tau, near), MOST_PLACES):
        taus = [other.tau, *(Pose(0, 0, pose.theta + k * math.pi / 4).tau for k in (2, -2, 1, -1, 4))]
        turned = (center.pose(tau) for tau in taus if tau != pose.tau)
        ways += [[pose, end] for end in turned if planner.checker.joins([pose, end])]
    across = list[Way]()
    for ring in islice(dict.fromkeys(planner.fits.rings(place, pose.tau, near)), MOST_PLACES):
        for here in ring.directions(pose):
            center, goals = ring.turning(here, pose.tau), ring.directions(other)
            for end in dict.fromkeys([*goals, *ring.ends]):
                found = [way for way in _both_ways(center, pose, here, end) if planner.checker.joins(way)]
                (across if end in goals else ways).extend(found)
    return across + sorted(ways, key=lambda way: -math.hypot(*map(float, _apart(way[0], way[-1]))))[:MOST_WAYS]


def _both_ways(center: Center, pose: Pose, here: Fraction | None, end: Fraction | None) -> Iterator[Way]:
    """Yield turns about the center of a channel from one direction to another, either way around."""
    turn = sum_of_angles(end, here and -here)
    short = math.remainder(theta_from(turn), math.tau)
    if not short:
        return
    stop = sum_of_angles(pose.tau, turn)
    for angle in (short, short - math.copysign(math.tau, short)):
        yield [pose, *_stops(center, pose.theta, angle, stop)]


def way_out_of_contacts(
    planner: ArcPlanner, start: Pose, goal: Pose, options: Options, guesses: int | None = None
) -> Way | None:
    """Return a way between poses of which one or both are in contact, if a search joins motions out of these."""
    begins, ends = ways_out(planner, start, goal), ways_out(planner, goal, start)
    if not begins and not ends:
        return None
    for begin in begins:
        if planner.checker.joins([begin[-1], goal]):
            return [*begin, goal]
    pairs = product(begins or [[start]], ends or [[goal]])
    for begin, end in islice(pairs, MOST_PAIRS):
        joined = [begin[-1]] if begin[-1] == end[-1] else planner.quick(begin[-1], end[-1], options, guesses)
        if joined:
            return [*begin, *joined[1:], *reversed(end[:-1])]
    return None
