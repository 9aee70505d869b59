"""Labels of places in pictures: they touch no other label and, if there is room, nothing else that is drawn.

Places around an anchor are tried from near to far. Each costs by the shapes that the label would cover, and by its
distance. Labels in the plane stay within the axes: so they never touch the numbers and names beside these. A label far
from its anchor has a leader.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from cfree.palette import GREY
from cfree.plot.workspace import Window, rings_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from mpl_toolkits.mplot3d.axes3d import Axes3D
    from shapely.geometry.base import BaseGeometry

    from cfree.exact.pose import Pose
    from cfree.scene.scene import Scene

Floats = NDArray[np.float64]

ALL_AROUND = tuple(math.radians(15 * k) for k in (18, 0, 12, 6, *range(24)))  # below, right, left, above, and the rest
ACROSS = tuple(math.radians(90 * k) for k in range(4))
GAPS = tuple(5 * 1.35**k for k in range(14))  # typographic points from an anchor to its label
LEADER = 16.0  # points from an anchor from which on a label has a leader
SMALL, CLEAR = 12.0, 4.0  # points: smaller shapes are pointed at; distance of the ring around them
PAD = 2.0  # points kept clear around a label
LABEL, WALL, BODY, LINE, GHOST = 1000.0, 40.0, 25.0, 8.0, 5.0
"""Costs of covering other labels and leaders, obstacles, robots at rest, lines, ghosts."""
FARTHEST = 40.0  # points from the numbers of an axis to its name
EDGE = 0.3  # share of the cost if a shape is only touched
CLOSER = 24  # cheapest places, which are examined closely
FAR = 0.08  # cost of a point of distance
CORNERS = 6  # corners of a robot that its name may be beside, about
FRAME, MAY = "reference point stays inside", "the reference point may be"


@dataclass(frozen=True, slots=True)
class Place:
    """The place of a label, in pixels: its anchor, its middle, and half its size.

    `covers` is true if it covers an obstacle or a robot at rest, `free` if it touches no label and is within the frame.
    """

    anchor: Floats
    centre: Floats
    half: Floats
    covers: bool
    free: bool

    @property
    def box(self) -> BaseGeometry:
        return _boxes(self.centre[None], self.half)[0]


@dataclass
class Room:
    """The room for labels, in pixels.

    Attributes
    ----------
    frame : four floats
        Left, bottom, right, top of the axes.
    point : float
        Pixels of a typographic point.
    shapes : list of (tree of geometries, float)
        Shapes to keep clear, and the costs of covering them.
    """

    frame: Window
    point: float
    shapes: list[tuple[shapely.STRtree, float]] = field(default_factory=list)

    def keep(self, shapes: Iterable[BaseGeometry], cost: float) -> None:
        """Keep clear of shapes; invalid ones count as the rectangles around them."""
        valid = np.array([*shapes], dtype=np.object_)
        valid = np.where(shapely.is_valid(valid), valid, shapely.envelope(valid))
        if len(valid):
            self.shapes.append((shapely.STRtree(valid), cost))

    def best(self, anchors: Floats, half: Floats, directions: Iterable[float], gaps: Iterable[float]) -> Place:
        """Return the cheapest place for a label of half this size, near any one of some anchors."""
        x0, y0, x1, y1 = self.frame
        half = half + PAD * self.point
        seen = (anchors >= (x0, y0)).all(axis=1) & (anchors <= (x1, y1)).all(axis=1)
        anchors = anchors[seen] if seen.any() else np.clip(anchors, (x0, y0), (x1, y1))
        angles, gap = np.array([*directions]), np.array([*gaps])
        u = np.column_stack((np.cos(angles), np.sin(angles)))
        reach = gap[:, None, None] * self.point + np.abs(u * half).sum(axis=1)[None, :, None]
        centres = (anchors[:, None, None] + reach * u).reshape(-1, 2)
        anchors = np.repeat(anchors, len(gap) * len(u), axis=0)
        cost = FAR * np.tile(np.repeat(gap, len(u)), len(anchors) // (len(gap) * len(u)))
        outside = np.maximum((x0, y0) - (centres - half), centres + half - (x1, y1)).max(axis=1)
        cost += np.where(outside > 0, 10 * LABEL + outside, 0)
        boxes, leaders = _boxes(centres, half), shapely.linestrings(np.stack((anchors, centres), axis=1))
        covers = np.zeros(len(boxes), dtype=bool)
        for tree, price in self.shapes:
            hit = np.unique(tree.query(boxes, predicate="intersects")[0])
            cost[hit] += EDGE * price
            covers[hit] |= price in (WALL, BODY)
            if price == LABEL:
                cost[np.unique(tree.query(leaders, predicate="intersects")[0])] += LABEL / 2
        near = np.argsort(cost, kind="stable")[:CLOSER]  # covered areas are computed for these only
        for tree, price in self.shapes:
            if price in (LABEL, LINE):
                continue
            box, shape = tree.query(boxes[near], predicate="intersects")
            share = np.zeros(len(near))
            np.add.at(share, box, shapely.area(shapely.intersection(boxes[near[box]], tree.geometries[shape])))
            cost[near] += price * np.minimum(1.0, share / shapely.area(boxes[near]))
        k = int(near[cost[near].argmin()])
        return Place(anchors[k], centres[k], half, bool(covers[k]), bool(cost[k] < LABEL / 2))


class Labels:
    """Labels on axes of the plane, whose limits and place are final.

    Parameters
    ----------
    ax : matplotlib axes
    scene : Scene
        Its obstacles and the outside of its workspace are kept clear.
    """

    def __init__(self, ax: Axes, scene: Scene) -> None:
        self._ax: Any = ax
        locator: Any = ax.get_axes_locator()
        self._ax.apply_aspect(locator(ax, None) if locator else None)
        box = ax.get_window_extent()
        self._room = Room((box.x0, box.y0, box.x1, box.y1), self._ax.figure.dpi / 72)
        walls = [obstacle.to_shapely() for obstacle in scene.obstacles]
        if scene.workspace is not None:
            (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
            walls.append(shapely.box(x0, y0, x1, y1).difference(scene.workspace.to_shapely()))
        self.avoid(walls, WALL)

    def avoid(self, shapes: Iterable[BaseGeometry], cost: float) -> None:
        """Keep clear of shapes of the plane, if there is room elsewhere."""
        self._room.keep(shapely.transform(np.array([*shapes]), self._ax.transData.transform), cost)

    def avoid_robot(self, scene: Scene, poses: Iterable[Pose], cost: float) -> None:
        """Keep clear of the robot in some poses."""
        self.avoid((shapely.Polygon(ring) for pose in poses for ring in _placed(scene, pose)), cost)

    def put(
        self, text: str, anchors: ArrayLike, *, directions: Iterable[float] = ALL_AROUND, leader: bool = True,
        needed: bool = True, ring: float = 0.0, **style: Any,
    ) -> None:  # fmt: skip
        """Write a label at the cheapest place, in two lines if there is no room for one.

        Parameters
        ----------
        text : str
        anchors : (n, 2) array_like
            Points of the plane, any of which will do. Those outside the axes count only if there are no others.
        directions : iterable of float, radians
            Directions from an anchor to its label.
        leader : bool
            True if the label may be far from its anchor, with a line to it.
        needed : bool
            False to leave the label out if there is no room.
        ring : float
            Radius of the mark around the anchor, in points; a label of a mark always has a leader.
        **style
            Style of the text.
        """
        from matplotlib.patheffects import withStroke

        halo = [withStroke(linewidth=2.5, foreground="white")]
        note = self._ax.annotate(
            text, (0.0, 0.0), (0.0, 0.0), textcoords="offset points", ha="center", va="center", path_effects=halo,
            annotation_clip=False, **{"zorder": 9} | style,
        )  # fmt: skip
        pixels = self._ax.transData.transform(np.asarray(anchors, dtype=np.float64).reshape(-1, 2))
        gaps = [gap + ring for gap in (GAPS if leader else GAPS[:1])]
        for form in (text, fill(text, 2 + len(text) // 2)):
            note.set_text(form)
            place = self._room.best(pixels, _half(note), tuple(directions), gaps)
            if place.free:
                break
        if not (place.free or needed):
            note.remove()
            return
        note.xy = tuple(self._ax.transData.inverted().transform(place.anchor).tolist())
        note.set_position(tuple(((place.centre - place.anchor) / self._room.point).tolist()))
        if place.covers:
            note.set_bbox({"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.9})
        taken = place.box
        if leader and (ring or shapely.distance(taken, shapely.Point(place.anchor)) > LEADER * self._room.point):
            self._lead(place, note.get_color(), ring)
            taken = shapely.union(taken, shapely.LineString([place.anchor, place.centre]))
        self._room.keep([taken], LABEL)

    def name_robot(self, scene: Scene, pose: Pose, name: str) -> None:
        """Write a name beside the robot in a pose."""
        points = shapely.get_coordinates(shapely.MultiPoint(np.concatenate(_placed(scene, pose))).convex_hull)
        self.put(name, points[:: 1 + len(points) // CORNERS])

    def point_at(self, box: Window, text: str, colour: str) -> None:
        """Name a shape that is too small to be seen, with a ring around it and a line to its name."""
        corners = self._ax.transData.transform(np.reshape(box, (2, 2)))
        size = float(np.abs(corners[1] - corners[0]).max()) / self._room.point
        if size >= SMALL:
            return
        middle, radius = np.reshape(box, (2, 2)).mean(axis=0), size / 2 + CLEAR
        style: Any = {"markerfacecolor": "none", "color": colour, "markeredgewidth": 1.4}
        self._ax.plot(*middle, "o", markersize=2 * radius, zorder=6, label="pointed at", **style)
        self.put(text, middle, ring=radius, color=colour, fontsize=9)

    def name_bounds(self, scene: Scene) -> None:
        """Name the frame of the bounds, along a visible part of it."""
        if scene.bounds is None:
            return
        x0, y0, x1, y1 = map(float, scene.bounds)
        self.avoid([shapely.box(x0, y0, x1, y1).exterior], LINE)
        shares = np.linspace(0.02, 0.98, 25)
        x, y = x0 + shares * (x1 - x0), y0 + shares * (y1 - y0)
        along = [(x, np.full(25, y1)), (x, np.full(25, y0)), (np.full(25, x0), y), (np.full(25, x1), y)]
        anchors = np.concatenate([np.column_stack(edge) for edge in along])
        (left, right), (bottom, top) = self._ax.get_xlim(), self._ax.get_ylim()
        if ((anchors >= (left, bottom)) & (anchors <= (right, top))).all(axis=1).any():
            self.put(FRAME, anchors, directions=ACROSS, leader=False, needed=False, color=GREY, fontsize=9)

    def _lead(self, place: Place, colour: Any, ring: float) -> None:
        """Draw a line from an anchor to its label, visible on any ground."""
        from matplotlib.patheffects import Normal, withStroke

        way = place.centre - place.anchor
        begin = place.anchor + way / np.linalg.norm(way) * ring * self._room.point
        end = place.centre - way * float(np.min(place.half / np.maximum(np.abs(way), 1e-9)))
        x, y = self._ax.transData.inverted().transform([begin, end]).T
        halo = [withStroke(linewidth=3.4, foreground="white"), Normal()]
        self._ax.plot(x, y, color=colour, linewidth=1.3, zorder=8.5, path_effects=halo, label="_leader")


def name_in_space(ax: Axes3D, names: Iterable[tuple[Floats, str]], line: Floats | None = None) -> None:
    """Write names beside points in space, clear of all texts and, if there is room, of a line (n, 3)."""
    from matplotlib.patheffects import withStroke
    from matplotlib.transforms import ScaledTranslation
    from mpl_toolkits.mplot3d import proj3d

    figure, axes = ax.figure, ax
    seen = [artist for artist in axes.collections if artist.get_visible()]
    for artist in seen:  # the layout of texts needs no faces
        artist.set_visible(False)
    written = _written(axes)
    own = axes.xaxis, axes.yaxis, axes.zaxis
    while own[0].labelpad < FARTHEST and any(_touches(axis.label, written) for axis in own):
        for axis in own:
            axis.labelpad += 4
        written = _written(axes)
    for artist in seen:
        artist.set_visible(True)

    def pixels(points: Floats) -> Floats:
        x, y, _ = proj3d.proj_transform(*points.reshape(-1, 3).T, axes.get_proj())
        return np.asarray(axes.transData.transform(np.column_stack((x, y))))

    box, point = axes.get_window_extent(), figure.dpi / 72
    room = Room((box.x0, box.y0, box.x1, box.y1), point)
    room.keep((shape for _, shape in written), LABEL)
    if line is not None:
        room.keep([shapely.LineString(pixels(line))], LINE)
    halo = [withStroke(linewidth=2.5, foreground="white")]
    for where, name in names:
        text = axes.text(*where.tolist(), name, ha="center", va="center", zorder=22, path_effects=halo)
        place = room.best(pixels(where), _half(text), ALL_AROUND, GAPS[:6])
        dx, dy = ((place.centre - place.anchor) / point / 72).tolist()
        text.set_transform(axes.transData + ScaledTranslation(dx, dy, figure.dpi_scale_trans))
        room.keep([place.box], LABEL)


def _written(ax: Axes3D) -> list[tuple[Any, BaseGeometry]]:
    """Return all texts of axes but those with a halo, and their boxes in pixels, by drawing the axes.

    Axes with three dimensions place their texts only then.
    """
    from matplotlib.backends.backend_agg import RendererAgg

    texts: list[tuple[Any, BaseGeometry]] = []

    class Noting(RendererAgg):
        def draw_text(self, *arguments: Any, mtext: Any = None, **options: Any) -> None:
            if mtext is not None:
                texts.append((mtext, _box(mtext)))

    figure: Any = ax.figure
    width, height = figure.bbox.size
    ax.draw(Noting(width, height, figure.dpi))  # type: ignore[no-untyped-call]
    return texts


def _touches(text: Any, written: list[tuple[Any, BaseGeometry]]) -> bool:
    """True if the text touches another one."""
    (own,) = (box for other, box in written if other is text)
    return any(own.intersects(box) for other, box in written if other is not text)


def _box(text: Any) -> BaseGeometry:
    """Return the box of a text in pixels, with the text's slant."""
    from shapely.affinity import rotate

    around, angle = text.get_window_extent(), text.get_rotation()
    text.set_rotation(0)
    half = _half(text)
    text.set_rotation(angle)
    middle = np.array([around.x0 + around.x1, around.y0 + around.y1]) / 2
    return rotate(_boxes(middle[None], half)[0], angle, origin=tuple(middle))


def _half(text: Any) -> Floats:
    """Return half the size of a text, in pixels."""
    box = text.get_window_extent()
    return np.array([box.width, box.height]) / 2


def _placed(scene: Scene, pose: Pose) -> list[Floats]:
    """Return rings of the robot in a pose."""
    return [pose.apply(ring) for ring in rings_of(scene.robot)]


def _boxes(centres: Floats, half: Floats) -> NDArray[np.object_]:
    low, high = (centres - half).T, (centres + half).T
    return np.asarray(shapely.box(*low, *high))
