"""Pictures of values in a notebook, for cells that end with a value."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from io import BytesIO
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from cfree import palette
from cfree.curves.curved import Curved
from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.kinds import COLOURS, PatchKind
from cfree.forbidden.mesh import Mesh
from cfree.forbidden.slice import Slice, outlines
from cfree.free.space import Cell, FreeSpace
from cfree.palette import paler
from cfree.paths.path import Path
from cfree.paths.travel import Travel, ghosts
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.plot.gears import GEARS, Gears
from cfree.plot.labels import BODY, CORNERS, LINE, MAY, WALL
from cfree.plot.workspace import roomiest
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.scene import Bounds, Scene, robot_radius
from cfree.scene.smooth import EDGES, smooth
from cfree.viewer.svg import Floats, Panel, Window, drawing, text

WIDTH, HEIGHT = 640.0, 400.0
PANELS = (0, 60, 120, 180, 240, 300)  # degrees
FINEST, SHARP = 2_000, 2  # triangles drawn as vectors; more become an image with this many dots a pixel

OBSTACLE = f'fill="{palette.OBSTACLE}" stroke="{palette.OBSTACLE_RIM}" stroke-width="8"'
OUTLINE = f'fill="none" stroke="{palette.GREY}" stroke-width="10" stroke-dasharray="50 40"'
ROBOT = f'fill="{palette.ROBOT}" fill-opacity=".85" stroke="{palette.ROBOT}" stroke-width="16"'
END = f'fill="{palette.GHOST}" fill-opacity=".85" stroke="{palette.ROBOT}" stroke-width="14" stroke-dasharray="50 30"'
GHOST = f'fill="{palette.GHOST}" fill-opacity=".3" stroke="{palette.ROBOT}" stroke-opacity=".6" stroke-width="8"'
TRACE = f'stroke="{palette.PATH}" stroke-width="24"'
BARRIER = f'fill="{paler(palette.BARRIER, 0.7)}" stroke="{palette.BARRIER}" stroke-width="16"'
BARRIER_LINE = f'fill="none" stroke="{palette.BARRIER}" stroke-width="30"'
FORBIDDEN = f'fill="{palette.FORBIDDEN}" fill-opacity=".8"'
INK = f'fill="{palette.INK}" font-weight="600"'
POINT = f'fill="#fff" stroke="{palette.INK}" stroke-width="12"'
CELLS = palette.CATEGORIES
EAST, UP = math.radians(32), math.radians(24)  # direction of the camera of a mesh


def picture(value: object) -> str | None:
    """Draw a value as SVG; None if it has nothing to show."""
    match value:
        case Scene():
            return _workspace(smooth(value), [value.start], [value.goal, *value.goals], (), repr(value))
        case Path():
            return _path(value)
        case Separated() | Stuck() | Unreachable() | AllSeparated():
            return _apart(value)
        case Slice():
            panel = _plane(smooth(value.boundary.scene), WIDTH, HEIGHT)
            _draw_slice(panel, value)
            _draw_inside(panel, value, words=True)
            return drawing([panel], WIDTH, HEIGHT, repr(value))
        case Boundary():
            return _slices(value, None, repr(value))
        case FreeSpace():
            return _slices(value.surfaces, value, repr(value))
        case Cell():
            return _slices(value.free_space.surfaces, value.free_space, repr(value), value.index)
        case Mesh():
            return _mesh(value)
        case Polygon() | Curved():
            rings = _rings([value] if isinstance(value, Polygon) else value.outer(value.size / EDGES))
            panel = Panel(_around(rings), WIDTH, HEIGHT / 2)
            panel.shapes(rings, OBSTACLE)
            return drawing([panel], WIDTH, HEIGHT / 2, repr(value))
    raise TypeError(f"no picture of a {type(value).__name__}")


def _rings(polygons: Iterable[Polygon]) -> list[Floats]:
    return [ring for polygon in polygons for ring in polygon.rings]


def _around(rings: Iterable[Floats]) -> Window:
    """Return a window with a margin around all rings."""
    points = np.concatenate(list(rings))
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    margin = 0.04 * max(x1 - x0, y1 - y0) or 1.0
    return float(x0 - margin), float(y0 - margin), float(x1 + margin), float(y1 + margin)


def _box(scene: Scene) -> list[Floats]:
    """Return the rings of a scene without its robot."""
    if scene.bounds is not None:
        return [_rectangle(scene.bounds)]
    return _rings(scene.obstacles if scene.workspace is None else [scene.workspace])


def _rectangle(bounds: Bounds) -> Floats:
    x0, y0, x1, y1 = map(float, bounds)
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def _plane(scene: Scene, width: float, height: float, left: float = 0.0, top: float = 0.0) -> Panel:
    """Make a panel for slices of a scene."""
    r = robot_radius(scene)
    seen = _box(scene) or [np.array([(-r, -r), (r, r)])]
    if scene.bounds is None and scene.workspace is None:  # contacts are around the obstacles
        seen = [ring + by for ring in seen for by in (-r, r)]
    return Panel(_around(seen), width, height, left, top)


def _workspace(
    scene: Scene,
    starts: Sequence[Pose | None],
    goals: Sequence[object],
    marked: Sequence[int],
    caption: str,
    rows: Floats | None = None,
    gears: Gears | None = None,
) -> str:
    """Draw the plane with the robot at its start and goals, and along rows (n, 3) of x, y and theta, by its gears."""
    robot = _rings(scene.robot)
    poses = [(pose, "start") for pose in starts if pose is not None]
    poses += [(pose, "goal") for pose in goals if isinstance(pose, Pose)]
    places = [np.array([[float(c) for c in place]]) for place in goals if isinstance(place, tuple)]
    placed = [([pose.apply(ring) for ring in robot], pose, name) for pose, name in poses]
    seen = _box(scene) + places + [ring for rings, _, _ in placed for ring in rings]
    if rows is not None:
        r = robot_radius(scene)
        seen += [rows[:, :2] - r, rows[:, :2] + r]
    aside = [] if starts[0] is not None else _aside(robot, seen)
    panel = Panel(_around(seen + aside), WIDTH, HEIGHT)
    panel.shapes(_rings(scene.obstacles), OBSTACLE)
    panel.shapes(_rings(scene.obstacles[k] for k in marked if k >= 0), BARRIER)
    if scene.workspace is not None:
        panel.shapes(scene.workspace.rings, BARRIER_LINE if WORKSPACE in marked else OUTLINE)
    if scene.bounds is not None:
        panel.shapes([_rectangle(scene.bounds)], BARRIER_LINE if BOUNDS in marked else OUTLINE)
    if rows is not None:
        _draw_way(panel, scene, robot, rows, gears)
    panel.shapes(aside, ROBOT)
    for rings, pose, name in reversed(placed):
        panel.shapes(rings, ROBOT if name == "start" else END)
        if gears is None:
            panel.dot(pose.apply(np.zeros((1, 2))), 3, POINT)
    for place in places:
        panel.dot(place, 6, END)
    panel.avoid(_rings(scene.obstacles), WALL)
    panel.avoid((ring for rings, _, _ in placed for ring in rings), BODY)
    for rings, _, name in placed:
        points = np.concatenate(rings)
        panel.label(name, points[:: 1 + len(points) // CORNERS], INK)
    return drawing([panel], WIDTH, HEIGHT, caption)


def _aside(robot: list[Floats], seen: list[Floats]) -> list[Floats]:
    """Return a robot without a pose, placed left of everything."""
    if not seen:
        return robot
    (x0, y0, _, y1), (_, v0, u1, v1) = _around(seen), _around(robot)
    away = np.array([x0 - u1, (y0 + y1) / 2 - (v0 + v1) / 2])
    return [ring + away for ring in robot]


def _draw_way(panel: Panel, scene: Scene, robot: list[Floats], rows: Floats, gears: Gears | None) -> None:
    """Draw the robot at even steps of its path, and the trace of its reference point, or of a vehicle's axle point."""
    for x, y, theta in rows[ghosts(rows, scene)].tolist():
        pose = Pose(x, y, theta)
        panel.shapes([pose.apply(ring) for ring in robot], GHOST)
    trace = rows[:, :2] if gears is None else gears.axle(rows)
    if gears is None:
        panel.line(trace, TRACE)
    else:
        for part, track in zip(gears.parts, gears.tracks, strict=True):
            panel.line(track, f'stroke="{GEARS[part.gear][0]}" stroke-width="28" stroke-linecap="round"')
        for dot in gears.dots:
            panel.dot(dot, 3, POINT)
    panel.room.keep([shapely.LineString(panel.pixels(trace))], LINE)


def _path(path: Path) -> str:
    scene, caption = path.scene, repr(path)
    if scene is None:
        step = path.length / 400 or 1.0
        way = path.sample(step).xy
        panel = Panel(_around([way]), WIDTH, HEIGHT)
        panel.line(way, TRACE)
        for name, end in (("start", way[0]), ("goal", way[-1])):
            panel.dot(end, 5, END)
            panel.label(name, end[None], INK)
        return drawing([panel], WIDTH, HEIGHT, caption)
    travel = Travel(path, scene)
    rows = travel.at(np.linspace(0, travel.total, 600))
    return _workspace(scene, [path.start], [path.goal], (), caption, rows, Gears.of(path, scene, travel))


def _apart(proof: Proof | AllSeparated) -> str | None:
    if proof.scene is None:
        return None
    proofs = proof.proofs if isinstance(proof, AllSeparated) else (proof,)
    goals = proof.goals if isinstance(proof, AllSeparated) else (proof.goal,)
    marked = sorted({k for each in proofs for k in each.obstacles})
    return _workspace(proof.scene, [proof.start], goals, marked, repr(proof))


def _draw_slice(panel: Panel, cut: Slice, colour_of: NDArray[np.int64] | None = None) -> None:
    """Draw forbidden positions and the contacts around them, coloured by kind, or by the number of each trapezoid."""
    points, start, shell, _ = outlines(cut.boundary, [cut._place])
    rings = [points[i:j] for i, j in pairwise(start)]
    panel.shapes(rings, FORBIDDEN, frame=bool((shell == -1).any()))
    scene = smooth(cut.boundary.scene)
    panel.shapes(_rings(scene.obstacles), OBSTACLE)
    if scene.workspace is not None:
        panel.shapes(scene.workspace.rings, OUTLINE)
    if colour_of is None:
        kinds = cut.boundary.patch_kind[cut.patches]
        for kind, colour in COLOURS.items():
            panel.segments(_segments(cut, kinds == kind), f'stroke="{colour}" stroke-width="14"')
    else:
        cells = colour_of[cut.trapezoids]
        for cell in np.unique(cells[cells >= 0]).tolist():
            style = f'stroke="{CELLS[cell % len(CELLS)]}" stroke-width="18"'
            panel.segments(_segments(cut, cells == cell), style)


def _segments(cut: Slice, chosen: NDArray[np.bool_]) -> Floats:
    """Return the parts of some contacts, (n, 2, 2); arcs have several."""
    if not cut.boundary.scene.curved:
        return cut.segments[chosen]
    lines = [cut.lines[k] for k in np.flatnonzero(chosen)]
    parts = [np.stack((line[:-1], line[1:]), axis=1) for line in lines]
    return np.concatenate([np.empty((0, 2, 2)), *parts])


def _draw_inside(panel: Panel, cut: Slice, *, words: bool) -> None:
    """Draw the robot where its reference point has most room in a slice, unless that takes long to compute."""
    pose = roomiest(cut, panel.window) if len(cut.segments) <= FINEST else None
    if pose is None:
        return
    scene = smooth(cut.boundary.scene)
    rings = [pose.apply(ring) for ring in _rings(scene.robot)]
    panel.shapes(rings, END)
    place = pose.apply(np.zeros((1, 2)))
    panel.dot(place, 3, POINT)
    if words:
        panel.avoid(_rings(scene.obstacles), WALL)
        panel.avoid(rings, BODY)
        panel.label(f"{MAY} here", place, INK)


def _slices(boundary: Boundary, space: FreeSpace | None, caption: str, only: int | None = None) -> str | None:
    """Draw slices at six orientations."""
    if not boundary.complete:
        return None
    cells = None if space is None else space.cell_of[space.component].astype(np.int64)
    if cells is not None and only is not None:
        cells = np.where(cells == only, cells, -1)
    width, height, panels = WIDTH / 3, 190.0, []
    for k, angle in enumerate(PANELS):
        panel = _plane(smooth(boundary.scene), width - 8, height - 24, k % 3 * width + 4, k // 3 * height + 20)
        cut = boundary.slice(f"{angle}deg")
        _draw_slice(panel, cut, cells)
        _draw_inside(panel, cut, words=False)
        x, y = panel.corner.tolist()
        panel.parts.append(
            text(f"θ = {angle}°", x + 6, y + 14, f'{INK} paint-order="stroke" stroke="#fff" stroke-width="30"')
        )
        panels.append(panel)
    return drawing(panels, WIDTH, 2 * height, caption)


def _mesh(mesh: Mesh) -> str:
    """Draw the triangles that face the camera, from back to front."""
    xyz, corners, kind = mesh.vertices, mesh.triangles, mesh.kind
    if not len(corners):
        return drawing([], WIDTH, 0, repr(mesh))
    low, high = xyz.min(axis=0), xyz.max(axis=0)
    turn = np.array([[math.cos(EAST), math.sin(EAST), 0], [-math.sin(EAST), math.cos(EAST), 0], [0, 0, 1]])
    tilt = np.array([[1, 0, 0], [0, math.sin(UP), math.cos(UP)], [0, -math.cos(UP), math.sin(UP)]])
    seen = (xyz - (low + high) / 2) @ turn.T @ tilt.T  # x to the right, y upwards, z to the camera
    a, b, c = (seen[corners[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    facing = np.flatnonzero(normal[:, 2] > 1e-9 * length)
    order = facing[np.argsort((a + b + c)[facing, 2], kind="stable")]
    shade = np.rint(4 * (normal[order] @ (-0.3, 0.5, 0.81)) / length[order]).clip(0, 4).astype(int) / 4
    panel = Panel(_around([seen[:, :2]]), WIDTH, HEIGHT)
    colours = [_shaded(COLOURS[PatchKind(k)], s) for k, s in zip(kind[order].tolist(), shade.tolist(), strict=True)]
    if len(order) > FINEST:
        panel.image(_painted(SHARP * panel.pixels(seen[corners[order], :2].reshape(-1, 2)), colours))
    else:
        for k, colour in zip(order.tolist(), colours, strict=True):
            panel.shapes([seen[corners[k], :2]], f'fill="{colour}" stroke="{colour}" stroke-width="4"')
    return drawing([panel], WIDTH, HEIGHT, repr(mesh))


def _shaded(colour: str, share: float) -> str:
    """Shade a colour from half dark to full."""
    return "#" + "".join(f"{round(c * (0.5 + 0.5 * share)):02x}" for c in bytes.fromhex(colour[1:]))


def _painted(corners: Floats, colours: Sequence[str]) -> bytes:
    """Paint triangles over each other, as PNG."""
    from PIL import Image, ImageDraw

    places = {colour: k for k, colour in enumerate(["white", *dict.fromkeys(colours)])}
    image = Image.new("P", (round(SHARP * WIDTH), round(SHARP * HEIGHT)))
    image.putpalette(b"\xff\xff\xff" + bytes.fromhex("".join(places).removeprefix("white").replace("#", "")))
    brush = ImageDraw.Draw(image)
    for triangle, colour in zip(corners.reshape(-1, 6).tolist(), colours, strict=True):
        brush.polygon(triangle, fill=places[colour])
    file = BytesIO()
    image.save(file, "PNG")
    return file.getvalue()
