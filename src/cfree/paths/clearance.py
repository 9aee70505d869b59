"""Least distances along a path; the core measures (`edge_distances.cpp`)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from decimal import ROUND_FLOOR, Context
from fractions import Fraction

from cfree.arguments import checked
from cfree.collision.arcs import ArcScene, arcs_of
from cfree.collision.distance import EdgeDistances
from cfree.collision.motion import Motion
from cfree.collision.motion_checker import is_free_motion
from cfree.exact.pose import Pose
from cfree.libraries import Floats, Ints, np
from cfree.paths.path import STILL, Path
from cfree.paths.travel import Travel
from cfree.scene.scene import Scene
from cfree.scene.smooth import smooth
from cfree.value import kept

MOST_SAMPLES = 20_000  # samples that separate narrow places of a path
SAMPLES = 65  # poses of a motion at which distances among round shapes are looked up, again and again
SHORTEST = 2.0**-24  # share of a motion


@dataclass(frozen=True)
class Clearance:
    """The least distance between robot and obstacles along a path.

    Attributes
    ----------
    least : float
        A certified lower bound over the whole path. 0 if the path touches, or comes closer than the tolerance.
    found : float
        The distance at the closest pose found, correct up to rounding.
    motion : int
    share : float
        The share of that motion at which the pose is.
    robot : (polygon, edge)
    obstacle : (obstacle, edge)
        The two closest edges there; -2 stands for the workspace.
    """

    least: float
    found: float
    motion: int
    share: float
    robot: tuple[int, int]
    obstacle: tuple[int, int]


def rounded_down(bound: float, digits: int) -> str:
    """Round a lower bound down to a number of digits, 6 at most.

    Examples
    --------
    >>> rounded_down(0.125 - 1e-12, 3), rounded_down(0.125, 3)
    ('0.124', '0.125')
    """
    return f"{float(Context(prec=digits, rounding=ROUND_FLOOR).create_decimal(bound)):g}"


@checked
def clearance(path: Path, scene: Scene, tolerance: float | None = None) -> Clearance | None:
    """Return the least distance of a path from obstacles and workspace, with a certified lower bound.

    Parameters
    ----------
    path : Path
    scene : Scene
        The path must be free in it. Bounds are no bodies and have no distance. Distances of segments and circular arcs
        are their own; their edges are then named as those of polygons that look round.
    tolerance : float, optional
        Greatest difference of `least` from the true distance, if that does not take too many steps. By default a
        thousandth of the robot's radius, or a quarter of the distance found if that is less.

    Returns
    -------
    Clearance, or None if there are no obstacles and no workspace

    Raises
    ------
    ValueError
        If the path is not free, or the tolerance not positive.

    Notes
    -----
    For a translation it is the distance of the area that the robot's edges and vertices sweep. Other motions are halved
    until no part can have a distance that is smaller than the least one found by more than the tolerance. A distance
    changes at most by the travel of the robot's farthest vertex. A motion at an even distance from a wall takes as long
    as about (length / tolerance) distances; most take much less.

    Examples
    --------
    >>> from cfree import Pose, Scene, Translation
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> scene = Scene(robot=square, obstacles=[(2, "1.25"), (5, "1.25"), (5, 3), (2, 3)])
    >>> found = clearance(Path(Pose(0, 0), [Translation((7, 0))]), scene, tolerance=1e-3)
    >>> found.found, found.least > 0.249, found.obstacle
    (0.25, True, (0, 0))
    """
    if tolerance is not None and not tolerance > 0:
        raise ValueError(f"tolerance {tolerance}: give a positive one")
    arcs = arcs_of(scene) if scene.curved else None
    if arcs is None:
        return least_clearance(path, distances_beside(path, scene), tolerance)
    return _among_arcs(path, scene, arcs, tolerance)


def own_clearance(path: Path, scene: Scene) -> Clearance | None:
    """Return the least clearance of a path: among its own round shapes if it is free among these, else in a scene."""
    return clearance(path, own_scene(path, scene))


def own_scene(path: Path, scene: Scene) -> Scene:
    """Return the round shapes among which a path is free without polygons; for other paths, a scene."""
    return path.curved if path.scene is None and path.curved else scene


def _among_arcs(path: Path, scene: Scene, arcs: ArcScene, tolerance: float | None) -> Clearance | None:
    """Return the least clearance of a path among segments and arcs; see `clearance`."""
    distances = distances_beside(path, scene)
    if not distances.names:
        return None
    legs = [*zip(path.poses, path.motions or (STILL,), strict=False)]

    def bounds(width: float) -> list[tuple[float, float]]:
        return [arcs.clearance(pose, motion, width) for pose, motion in legs]

    each = bounds(1e-3 * distances.radius if tolerance is None else float(tolerance))
    least, most = min(low for low, _ in each), min(high for _, high in each)
    if tolerance is None and least == 0 < most:
        each = bounds(most / 4)
        least, most = min(low for low, _ in each), min(high for _, high in each)
    found, share, motion = min((*_closest(arcs, *legs[k]), k) for k, (low, _) in enumerate(each) if low <= most)
    pose = legs[motion][1].sample(legs[motion][0], [share])
    _, (edge,), (other,) = distances.nearest(distances.at(pose))
    return Clearance(min(least, found), found, motion, share, distances.robot_names[edge], distances.names[other])


def _closest(arcs: ArcScene, pose: Pose, motion: Motion) -> tuple[float, float]:
    """Return the least distance at poses of a motion, sampled finer and finer about the closest, and its share."""
    low, high, best = 0.0, 1.0, (math.inf, 0.0)
    while high - low > SHORTEST:
        shares = np.linspace(low, high, SAMPLES)
        poses = motion.sample(pose, shares)
        bounds = (arcs.distance(poses[k]) for k in range(SAMPLES))
        distances = ((low + high) / 2 if low else 0.0 for low, high in bounds)
        best = min(best, min(zip(distances, shares.tolist(), strict=True)))
        width = (high - low) / (SAMPLES - 1)
        low, high = max(0.0, best[1] - width), min(1.0, best[1] + width)
    return best


def distances_beside(path: Path, scene: Scene) -> EdgeDistances:
    """Return the edges from which a path keeps its distance; round shapes are polygons that look round.

    Raises
    ------
    ValueError
        If the path is not free.
    """
    if not all(is_free_motion(scene, *leg) for leg in zip(path.poses, path.motions or (STILL,), strict=False)):
        raise ValueError("the path is not free: it has no clearance; see MotionChecker.first_contact")
    return kept(smooth(scene), EdgeDistances)


def least_clearance(path: Path, distances: EdgeDistances, tolerance: float | None) -> Clearance | None:
    """Return the least clearance of a free path; see `clearance`."""
    if not distances.names:
        return None
    motions, poses = (path.motions, path.poses) if path.motions else ((STILL,), 2 * path.poses)
    result = distances.least(poses, motions, 1e-3 * distances.radius if tolerance is None else float(tolerance))
    if tolerance is None and result[0] == 0 < result[1]:
        result = distances.least(poses, motions, result[1] / 4)
    least, there, motion, share, edge, other = result
    return Clearance(least, there, motion, share, distances.robot_names[edge], distances.names[other])


@checked
def narrowest(path: Path, scene: Scene, count: int = 3) -> tuple[Clearance, ...]:
    """Return the narrowest places of a path, at which its distance from obstacles is less than before and after.

    Parameters
    ----------
    path : Path
        Must be free in the scene.
    scene : Scene
    count : int
        Greatest number of places.

    Returns
    -------
    tuple of Clearance
        The narrowest first, each with a certified lower bound for a part of the path around it. A part ends where the
        path is twice as wide, or at the widest place before another part. Empty without obstacles and workspace.

    Raises
    ------
    ValueError
        If the path is not free, or the count negative.

    Notes
    -----
    Samples separate the parts, one at each hundredth of the robot's radius that it travels; 20,000 at most. Around a
    contact, a part ends at a distance of a hundredth of the radius.

    Examples
    --------
    >>> from cfree import Pose, Scene, Translation
    >>> gates = [[(x, -9), (x + 1, -9), (x + 1, -gap), (x, -gap)] for x, gap in ((3, 1), (9, 2), (15, 1.5))]
    >>> scene = Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=gates)
    >>> [(place.found, place.obstacle[0]) for place in narrowest(Path(Pose(0, 0), [Translation((20, 0))]), scene)]
    [(1.0, 0), (1.5, 2), (2.0, 1)]
    """
    if count < 0:
        raise ValueError(f"count: {count}; give 0 or more")
    distances, travel = distances_beside(path, scene), Travel(path, scene)
    if not path.motions or not distances.names:
        whole = least_clearance(path, distances, None)
        return () if whole is None else (whole,)
    steps = np.linspace(0, travel.total, min(math.ceil(100 * travel.total / distances.radius) + 2, MOST_SAMPLES))
    distance, _, _ = distances.nearest(distances.placed(travel.at(steps)))
    around = np.concatenate(([np.inf], distance, [np.inf]))
    lows = np.where((distance <= around[:-2]) & (distance <= around[2:]), distance, np.inf)
    places: list[Clearance] = []
    taken = np.zeros(len(steps), bool)
    while len(places) < count and np.isfinite(lows).any():
        k = int(lows.argmin())
        wide = np.flatnonzero(taken | (distance >= max(2 * distance[k], distances.radius / 100)))
        first, last = wide[wide < k].max(initial=0), wide[wide > k].min(initial=len(steps) - 1)
        first, last = first + int(distance[first : k + 1].argmax()), k + int(distance[k : last + 1].argmax())
        if place := _least_between(path, distances, *travel.places(steps[[first, last]])):
            places.append(place)
        taken[first : last + 1], lows[first : last + 1] = True, np.inf
    return tuple(sorted(places, key=lambda place: place.found))


def _least_between(path: Path, distances: EdgeDistances, motion: Ints, share: Floats) -> Clearance | None:
    """Return the least clearance between two places of a path; motion and share count in the whole path."""
    (i, j), (u, v) = motion.tolist(), map(Fraction, share.tolist())
    ends = [(u if k == i else Fraction(0), v if k == j else Fraction(1)) for k in range(i, j + 1)]
    start = path.motions[i].at(path.poses[i], u)
    part = Path(start, [path.motions[i + k].between(*both) for k, both in enumerate(ends)])
    place = least_clearance(part, distances, None)
    if place is None:
        return None
    k, s = i + place.motion, place.share
    begin = path.motions[k].share(u) if k == i else 0.0
    end = path.motions[k].share(v) if k == j else 1.0
    return replace(place, motion=k, share=begin + s * (end - begin))
