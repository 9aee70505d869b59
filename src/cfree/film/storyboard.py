"""The storyboard of a scene: its shots, and every pose in them.

The storyboard "paper" illustrates the paper for one robot and one obstacle, by the scene's own contacts:

    slices    the robot slides around an obstacle without turning: twice, at two orientations
    helix     it turns about a vertex that stays on a vertex: a v-v helix (Lemma 1)
    v-e       it sweeps over a v-e patch (eq. 5) from the same helix
    e-v       it sweeps over an e-v patch (eq. 8)
    arc-arc   among rounded shapes, it sweeps over a patch of an arc on an arc
    pillar    it goes around the obstacle, or turns where it can, while theta goes from 0 to 360 degrees: everything
    path      it moves from start to goal, touching nothing

Within a shot the motion is continuous. A free path leads from one shot to the next; if there is none, there is a cut.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.film.camera import AZIMUTHS
from cfree.film.contact_motions import Column, Moment, Ring, across, along_helix, columns, outward, over_column, roll
from cfree.film.free_motions import FreeMotions
from cfree.forbidden.kinds import KINDS, PatchKind
from cfree.palette import HELIX, PATH, VIEW
from cfree.paths.path import Path
from cfree.paths.travel import Travel
from cfree.plot.boundary import extent
from cfree.plot.gears import Gears
from cfree.scene.scene import robot_radius

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]

STORYBOARDS = {
    "paper": ("slices", "helix", "v-e", "e-v", "pillar", "path"),
    "path": ("path",),
}
SECONDS = {"slices": 8.0, "helix": 3.5, "v-e": 5.5, "e-v": 6.5, "arc-arc": 6.0, "pillar": 9.0, "path": 8.0}
HOME = math.radians(VIEW[1])
FULL_TURN = math.tau - 1e-6
LOWER = math.radians(50)  # angle from the first slice up to the second
LINK = 0.45  # share of a shot that a free path to its beginning may take
TRIED = 30  # patches tried, best first, until the slice of one closes around an obstacle


@dataclass(frozen=True)
class Shot:
    """One shot of a film.

    Attributes
    ----------
    kind : str
        One of the names above.
    title, note : str
        Words and a formula.
    moments : list of Moment
        One for each frame.
    cut : bool
        True if the robot does not begin at the end of the previous shot.
    link : int
        Number of moments at the beginning that are a free path to the shot's first pose.
    swept : Column, optional
        The column that appears as the robot sweeps over it.
    level : (n,) float, degrees, optional
        Everything below this angle appears.
    azimuth : float, radians
        Best azimuth of the camera.
    ghost : float
        Opacity of everything above the plane of the current orientation.
    colour : str
        Colour of the motion's line in the configuration space.
    goal : Pose, optional
        The pose the robot moves to.
    gears : Gears, optional
        The path that a vehicle drives from `link` on.
    surface : str
        Describes a surface that is not the boundary's, in place of the contact.
    """

    kind: str
    title: str
    note: str
    moments: list[Moment]
    cut: bool = False
    link: int = 0
    swept: Column | None = None
    level: Floats = field(default_factory=lambda: np.zeros(0))
    azimuth: float = HOME
    ghost: float = 1.0
    colour: str = PATH
    goal: Pose | None = None
    gears: Gears | None = None
    surface: str = ""

    def travels(self) -> list[float]:
        """Return the robot's travel on the path that a vehicle drives, for each moment from `link` on."""
        count = len(self.moments) - self.link
        return [] if self.gears is None else (self.gears.travel.total * np.array(eased(0, 1, count))).tolist()


def storyboard(boundary: Boundary, frames: int, kinds: tuple[str, ...] = STORYBOARDS["paper"]) -> list[Shot]:
    """Return the shots of a scene.

    Parameters
    ----------
    boundary : Boundary
    frames : int
        Number of moments in all.
    kinds : tuple of str
        Shots wanted; those that the scene has no contacts for are left out.

    Examples
    --------
    >>> from cfree.forbidden.boundary import boundary
    >>> from cfree.formats.scene_file import load_scene
    >>> shots = storyboard(boundary(load_scene("examples/scenes/paper_fig9.json")), 60)
    >>> [shot.kind for shot in shots]
    ['slices', 'helix', 'v-e', 'e-v', 'pillar', 'path']
    >>> sum(len(shot.moments) for shot in shots), any(shot.cut for shot in shots)
    (60, False)
    """
    if boundary.scene.curved and "e-v" in kinds:
        place = kinds.index("e-v") + 1
        kinds = (*kinds[:place], "arc-arc", *kinds[place:])
    director = _Director(boundary)
    shots = director.shots(frames, kinds)
    if shots and sum(len(shot.moments) for shot in shots) < frames:
        # the last shot was not possible: its time goes to the others
        shots = director.shots(frames, tuple(shot.kind for shot in shots))
    return shots


class _Director:
    """Director: makes one shot after another, each from the end of the last one."""

    def __init__(self, boundary: Boundary) -> None:
        self.boundary = boundary
        self.window = extent(boundary)
        self.radius = robot_radius(boundary.scene)
        ranked = sorted(columns(boundary), key=self._worth, reverse=True)
        self.is_round = boundary.scene.curved
        with_helix = [c for c in ranked if c.side is not None]
        corners = [c for c in with_helix if self._kind(c) == "v-e"]
        turning = corners or [c for c in with_helix if self._kind(c) == "arc-arc"]
        self.corner = next((c for c in turning[:TRIED] if self._goes_round(c)), turning[0] if turning else None)
        self.line = self.corner
        if self.is_round and not corners:
            self.line = next((c for c in ranked if self._kind(c) == "v-e"), None)
        edges = [c for c in ranked if self._kind(c) == "e-v"]
        self.edge = next((c for c in edges if self._shares_obstacle(c)), edges[0] if edges else None)
        arcs = [c for c in ranked if self._kind(c) == "arc-arc"]
        self.arc = next((c for c in arcs if self._shares_obstacle(c)), arcs[0] if arcs else None)
        self.here: Moment | None = None
        self.free = FreeMotions(boundary, self.window)

    def shots(self, frames: int, kinds: tuple[str, ...]) -> list[Shot]:
        self.here = None
        makers: dict[str, Callable[[int], Shot | None]] = {
            "slices": self._slices,
            "helix": self._helix,
            "v-e": self._vertex_edge,
            "e-v": self._edge_vertex,
            "arc-arc": self._arc_arc,
            "pillar": self._pillar,
            "path": self._path,
        }
        needed = {"helix": self.corner, "slices": self.corner, "v-e": self.line, "e-v": self.edge, "arc-arc": self.arc}
        kinds = tuple(kind for kind in kinds if kind not in needed or needed[kind] is not None)
        shots: list[Shot] = []
        for k, kind in enumerate(kinds):
            share = SECONDS[kind] / sum(SECONDS[kind] for kind in kinds[k:])
            count = max(1, round((frames - sum(len(shot.moments) for shot in shots)) * share))
            shot = makers[kind](count)
            if shot is not None:
                shots.append(replace(shot, cut=shot.cut and bool(shots)))
                self.here = shot.moments[-1]
        return shots

    # shots

    def _slices(self, n: int) -> Shot | None:
        """Go around the obstacle at one orientation, then at the helix's first one, and to the helix."""
        column = self.corner
        assert column is not None and column.side is not None
        (begin,) = along_helix(self.boundary, column, _inside(column)[:1])
        goal, theta = _xy(begin.pose), begin.pose.theta
        last = Ring.near(self.boundary, theta, goal)
        if last is None:
            return None
        if (moments := self._two_slices(last, goal, n)) is not None:
            return Shot(
                "slices", "Translation in two slices, a turn in contact between them", _FORMULAS["slices"], moments
            )
        moments = [last.moment(s) for s in eased(0, last.perimeter, n)]
        return Shot("slices", "Translation: a slice at constant orientation", _FORMULAS["slices"], moments)

    def _two_slices(self, last: Ring, goal: tuple[float, float], n: int) -> list[Moment] | None:
        """Go around at a lower orientation, turn in contact up to the last one, go around there, and to the goal."""
        angle = last.theta - LOWER
        if angle < 0:
            return None
        first = Ring.near(self.boundary, angle, goal)
        if first is None:
            return None
        here = _xy(first.moment(0.0).pose)
        turning = roll(self.boundary, here, eased(angle, last.theta, max(n, 100)), 0.3 * last.perimeter)
        if turning is None:
            return None
        again = Ring.near(self.boundary, last.theta, _xy(turning[-1].pose))
        if again is None:
            return None
        rest = again.distance_to(goal) + again.perimeter
        turn = n // 5
        before = round((n - turn) * first.perimeter / (first.perimeter + rest))
        return [
            *(first.moment(s) for s in eased(0, first.perimeter, before)),
            *_thinned(turning, turn),
            *(again.moment(s) for s in eased(0, rest, n - turn - before)),
        ]

    def _helix(self, n: int) -> Shot:
        assert self.corner is not None
        low, high = _inside(self.corner)
        moments = along_helix(self.boundary, self.corner, eased(low, high, n))
        own, _ = _named(moments[0])
        about = "the centre of an arc" if own == "an arc" else own
        formula = _ROUND_FORMULAS["centre"] if self.is_round else _FORMULAS["v-v"]
        shot = Shot("helix", f"Rotation about {about}: a helix", formula, moments)
        return replace(shot, azimuth=self._azimuth(self.corner), colour=HELIX)

    def _vertex_edge(self, n: int) -> Shot:
        assert self.line is not None
        return self._sweep("v-e", self.line, n, self.line.side or 0)

    def _edge_vertex(self, n: int) -> Shot:
        assert self.edge is not None
        return self._sweep("e-v", self.edge, n, 0)

    def _arc_arc(self, n: int) -> Shot:
        assert self.arc is not None
        return self._sweep("arc-arc", self.arc, n, 0)

    def _sweep(self, kind: str, column: Column, n: int, side: int) -> Shot:
        """Move to and fro along the edge, down through the whole range: so the plane never covers the swept part."""
        low, high = _inside(column)

        def moments(count: int) -> list[Moment]:
            share = 0.5 - 0.5 * np.cos(5 * math.pi * np.linspace(0, 1, count))
            angles = np.linspace(high, low, count)
            return over_column(self.boundary, column, 1 - share if side else share, angles)

        linked, link, cut = self._linked(moments, n)
        own, other = _named(moments(1)[0])
        title = _TITLES[kind].format(own=own.capitalize(), other=other)
        shot = Shot(kind, title, (_ROUND_FORMULAS if self.is_round else _FORMULAS)[kind], linked)
        return replace(shot, swept=column, azimuth=self._azimuth(column), link=link, cut=cut)

    def _pillar(self, n: int) -> Shot | None:
        """Make a full turn: around the obstacle, or in place; else the robot rests."""
        if len(self.boundary.scene.obstacles) == 1:
            title, turn = "All contacts: the boundary of the forbidden space", self._around(n) or self._in_place(n)
        else:
            title, turn = "Several obstacles: all contacts, trimmed", self._in_place(n) or self._around(n)
        if turn is None:
            here = self.here or self._rest()
            if here is None:
                return None
            turn = [here] * n, 0, False
        moments, link, cut = turn
        level = np.append(np.zeros(link), np.degrees(eased(0, FULL_TURN, n - link)))
        shot = Shot("pillar", title, (_ROUND_FORMULAS if self.is_round else _FORMULAS)["pillar"], moments)
        return replace(shot, level=level, ghost=0.08, link=link, cut=cut)

    def _around(self, n: int) -> tuple[list[Moment], int, bool] | None:
        if self.corner is None:
            return None
        start = _xy(along_helix(self.boundary, self.corner, _inside(self.corner)[:1])[0].pose)
        ring = Ring.near(self.boundary, 0.0, start)
        if ring is None:
            return None
        dense = max(4 * n, 400)
        angles = eased(0, FULL_TURN, dense)
        motions = (roll(self.boundary, start, angles, turns * ring.perimeter) for turns in (2, 1, 3, 0))
        motion = next((motion for motion in motions if motion is not None), None)
        return None if motion is None else self._linked(lambda count: _thinned(motion, count), n)

    def _in_place(self, n: int) -> tuple[list[Moment], int, bool] | None:
        """Make a full turn at the roomiest place, if there is room for one."""
        turn = self.free.full_turn()
        return None if turn is None else self._linked(lambda count: self._along(turn, count, FULL_TURN / math.tau), n)

    def _path(self, n: int) -> Shot | None:
        """Move from start to goal; without a goal, or a path to it, from here to the farthest pose."""
        scene = self.boundary.scene
        start = self.here or self._rest() if scene.start is None else Moment(scene.start)
        if start is None:
            return None
        driven = None if scene.goal is None else self.free.driven(start.pose, scene.goal)
        path = driven or (None if scene.goal is None else self.free.path(start.pose, scene.goal))
        if path is None and (goal := self.free.farthest(start.pose)) is not None:
            path = self.free.path(start.pose, goal)
        if path is None:
            return None
        moments, link, cut = self._linked(lambda count: self._along(path, count), n)
        gears = None if driven is None else Gears.of(driven, scene, Travel(driven, scene))
        name = "through the free space" if gears is None else f"for a {_NAMES[gears.wheels.vehicle.kind]}"
        shot = Shot("path", f"A path {name}", _FORMULAS["path"], moments, gears=gears)
        return replace(shot, ghost=0.08, link=link, cut=cut, goal=moments[-1].pose)

    # tools of the shots

    def _linked(self, moments: Callable[[int], list[Moment]], n: int) -> tuple[list[Moment], int, bool]:
        """Return a motion after a free path to its beginning, that path's length in moments, and True for a cut."""
        if self.here is None:
            return moments(n), 0, False
        (begin,) = moments(1)
        path = self.free.path(self.here.pose, begin.pose)
        if path is None:
            return moments(n), 0, True
        length = self.free.travel(path)
        if length < 0.02 * self.radius:
            return moments(n), 0, False
        link = round(n * min(LINK, max(0.1, 0.4 * length / math.dist(self.window[:2], self.window[2:]))))
        # other moments show both ends
        return [*self._along(path, link + 2)[1:-1], *moments(n - link)], link, False

    def _along(self, path: Path, n: int, end: float = 1.0) -> list[Moment]:
        """Return poses at even travel of the robot, slower at both ends."""
        return [Moment(pose) for pose in self.free.poses(path, eased(0, end, n))]

    def _rest(self) -> Moment | None:
        """Return the roomiest pose; None if there is none."""
        pose = self.free.resting_pose()
        return None if pose is None else Moment(pose)

    def _kind(self, column: Column) -> str:
        return KINDS[PatchKind(self.boundary.patch_kind[column.patch])]

    def _worth(self, column: Column) -> float:
        """Rate a column by its area, less if it faces away, or if there are no lower orientations to begin at."""
        low, high = column.angles[0], column.angles[-1]
        area = (high - low) * self._length(column)
        seen = math.cos(self._facing(column) - HOME)
        return area * max(0.05, seen) * (0.5 if low < math.radians(55) else 1.0)

    def _length(self, column: Column) -> float:
        """Return the length of a column across, at the orientation in the middle; of an arc that of two chords."""
        k = len(column.trapezoids) // 2
        theta = 0.5 * (column.angles[k] + column.angles[k + 1])
        t = [across(self.boundary, column.trapezoids[k], theta, share) for share in (0.0, 0.5, 1.0)]
        begin, middle, end = self.boundary.evaluate([column.patch] * 3, t, [theta] * 3).tolist()
        return math.dist(begin, middle) + math.dist(middle, end)

    def _goes_round(self, column: Column) -> bool:
        (begin,) = along_helix(self.boundary, column, _inside(column)[:1])
        return Ring.near(self.boundary, begin.pose.theta, _xy(begin.pose)) is not None

    def _shares_obstacle(self, column: Column) -> bool:
        obstacle = self.boundary.patches[column.patch].obstacle.polygon
        return self.corner is None or obstacle == self.boundary.patches[self.corner.patch].obstacle.polygon

    def _facing(self, column: Column) -> float:
        (middle,) = over_column(self.boundary, column, [0.5], [0.5 * (column.angles[0] + column.angles[-1])])
        x, y = outward(self.boundary, column.patch, middle).tolist()
        return math.atan2(y, x)

    def _azimuth(self, column: Column) -> float:
        """Return an azimuth between the usual one and the one in front of a column."""
        turn = math.remainder(self._facing(column) - HOME, math.tau)
        return float(np.clip(HOME + 0.7 * turn, AZIMUTHS[0] + 0.1, AZIMUTHS[1] - 0.1))


_TITLES = {
    "v-e": "{own} slides on an edge: a v-e patch",
    "e-v": "An edge slides over {other}: an e-v patch",
    "arc-arc": "{own} slides over {other}: an arc-arc patch",
}
_FORMULAS = {
    "slices": r"the reference point goes around $O \oplus -R^{\theta}A$",
    "v-v": r"$q(\phi) = (b_j - R^{\phi} a_i,\ \phi)$",
    "v-e": r"$S(t, \phi) = (b_j + t\,E_j^O - R^{\phi} a_i,\ \phi)$",
    "e-v": r"$S(t, \phi) = (b_j - R^{\phi}(a_i + t\,E_i^A),\ \phi)$",
    "pillar": "v-e and e-v patches meet in v-v helices and e-e lines",
    "path": "everything above the current orientation is transparent",
}
_ROUND_FORMULAS = {
    "centre": "a point of the robot stays in its place",
    "v-e": r"$S(t, \phi) = (b_j + t\,E_j^O + \rho_i\,n_j - R^{\phi} a_i,\ \phi)$",
    "e-v": r"$S(t, \phi) = (b_j - R^{\phi}(a_i + t\,E_i^A + \rho_j\,n_i),\ \phi)$",
    "arc-arc": r"$S(\psi, \phi) = (b_j + (\rho_i + \rho_j)\,u(\psi) - R^{\phi} a_i,\ \phi)$",
    "pillar": "patches join smoothly where an edge meets an arc",
}


_NAMES = {"car": "car", "differential": "differential drive"}


def _named(moment: Moment) -> tuple[str, str]:
    """Name what touches, of the robot and of the obstacle, where it is no edge."""
    if moment.touch is None:
        return "a vertex", "a vertex"
    own, other = ("an arc" if len(points) > 1 else "a vertex" for points in (moment.touch.robot, moment.touch.obstacle))
    return own, other


def _xy(pose: Pose) -> tuple[float, float]:
    return float(pose.x), float(pose.y)


def _inside(column: Column) -> tuple[float, float]:
    """Return the range of a column without a little at both ends, where another contact begins."""
    low, high = column.angles[0], column.angles[-1]
    margin = min(2e-3, 0.01 * (high - low))
    return low + margin, high - margin


def eased(start: float, stop: float, n: int) -> list[float]:
    """Return n values from start to stop, slower at both ends."""
    s = np.linspace(0, 1, n) if n > 1 else np.zeros(n)
    s = np.where(s < 0.1, s * s / 0.18, np.where(s > 0.9, 1 - (1 - s) ** 2 / 0.18, (s - 0.05) / 0.9))
    return (start + (stop - start) * s).tolist()  # type: ignore[no-any-return]


def _thinned(moments: list[Moment], n: int) -> list[Moment]:
    return [moments[k] for k in np.rint(np.linspace(0, len(moments) - 1, n)).astype(int)] if n > 1 else moments[:n]
