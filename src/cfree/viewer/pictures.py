"""What a notebook shows where a cell ends with a value."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from io import BytesIO
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from cfree.exact.pose import Pose
from cfree.forbidden.boundary import Boundary
from cfree.forbidden.kinds import PatchKind
from cfree.forbidden.mesh import Mesh
from cfree.forbidden.slice import Slice
from cfree.free.space import Cell, FreeSpace
from cfree.paths.path import Path
from cfree.paths.travel import Travel
from cfree.planning.goals import AllSeparated
from cfree.planning.separation import Separated
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BOUNDS, WORKSPACE
from cfree.scene.scene import Bounds, Scene, robot_radius
from cfree.viewer.svg import Floats, Panel, Window, drawing, text

WIDTH, HEIGHT = 640.0, 400.0
PANELS = (0, 60, 120, 180, 240, 300)  # degrees
GHOSTS, APART = 60, 0.35  # robots along a path at most, and how far apart in robot's radii
FINEST, SHARP = 2_000, 2  # triangles drawn as such, of more an image with so many dots a pixel

OBSTACLE = 'fill="#59626f" stroke="#2e343d" stroke-width="8"'
OUTLINE = 'fill="none" stroke="#5a6472" stroke-width="10" stroke-dasharray="50 40"'
ROBOT = 'fill="#00966d" fill-opacity=".5" stroke="#00966d" stroke-width="16"'
END = 'fill="#a23b88" fill-opacity=".12" stroke="#a23b88" stroke-width="14" stroke-dasharray="50 30"'
GHOST = 'fill="#a23b88" fill-opacity=".06" stroke="#a23b88" stroke-opacity=".35" stroke-width="7"'
TRACE = 'stroke="#a23b88" stroke-width="24"'
BARRIER = 'fill="#d9572b" fill-opacity=".8" stroke="#8a2c0d" stroke-width="14"'
BARRIER_LINE = 'fill="none" stroke="#d9572b" stroke-width="30"'
FORBIDDEN = 'fill="#8a94a5" fill-opacity=".28"'
INK = 'fill="#1b2028" font-weight="600"'
KINDS = {PatchKind.VERTEX_EDGE: "#d55e00", PatchKind.EDGE_VERTEX: "#2b8cd6", PatchKind.BOUND: "#8a92a0"}
CELLS = ("#00845f", "#a23b88", "#c99700", "#5a4fcf", "#c3201f", "#1b8aa5", "#7a5c3e", "#5f7d1c")
EAST, UP = math.radians(32), math.radians(24)  # from where a mesh is seen


def picture(value: object) -> str | None:
    """A value as SVG; None if there is nothing to be seen of it."""
    match value:
        case Scene():
            return _workspace(value, [value.start], [value.goal, *value.goals], (), repr(value))
        case Path():
            return _path(value)
        case Separated() | AllSeparated():
            return _apart(value)
        case Slice():
            panel = _plane(value.boundary.scene, WIDTH, HEIGHT)
            _draw_slice(panel, value)
            return drawing([panel], WIDTH, HEIGHT, repr(value))
        case Boundary():
            return _slices(value, None, repr(value))
        case FreeSpace():
            return _slices(value.surfaces, value, repr(value))
        case Cell():
            return _slices(value.free_space.surfaces, value.free_space, repr(value), value.index)
        case Mesh():
            return _mesh(value)
        case Polygon():
            panel = Panel(_around(value.rings), WIDTH, HEIGHT / 2)
            panel.shapes(value.rings, OBSTACLE)
            return drawing([panel], WIDTH, HEIGHT / 2, repr(value))
    raise TypeError(f"no picture of a {type(value).__name__}")


def _rings(polygons: Iterable[Polygon]) -> list[Floats]:
    return [ring for polygon in polygons for ring in polygon.rings]


def _around(rings: Iterable[Floats]) -> Window:
    """A window with a margin around all rings."""
    points = np.concatenate(list(rings))
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    margin = 0.04 * max(x1 - x0, y1 - y0) or 1.0
    return float(x0 - margin), float(y0 - margin), float(x1 + margin), float(y1 + margin)


def _box(scene: Scene) -> list[Floats]:
    """What is to be seen of a scene without its robot."""
    if scene.bounds is not None:
        return [_rectangle(scene.bounds)]
    return _rings(scene.obstacles if scene.workspace is None else [scene.workspace])


def _rectangle(bounds: Bounds) -> Floats:
    x0, y0, x1, y1 = map(float, bounds)
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def _plane(scene: Scene, width: float, height: float, left: float = 0.0, top: float = 0.0) -> Panel:
    """Obstacles, bounds and workspace, faint: positions of the reference point are what matters."""
    r = robot_radius(scene)
    seen = _box(scene) or [np.array([(-r, -r), (r, r)])]
    if scene.bounds is None and scene.workspace is None:  # contacts are around the obstacles
        seen = [ring + by for ring in seen for by in (-r, r)]
    panel = Panel(_around(seen), width, height, left, top)
    panel.shapes(_rings(scene.obstacles), 'fill="#59626f" fill-opacity=".75"')
    if scene.workspace is not None:
        panel.shapes(scene.workspace.rings, OUTLINE)
    return panel


def _workspace(
    scene: Scene,
    starts: Sequence[Pose | None],
    goals: Sequence[object],
    marked: Sequence[int],
    caption: str,
    rows: Floats | None = None,
) -> str:
    """The plane with the robot at its start and goals, and on rows (n, 3) of x, y and theta."""
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
        _draw_way(panel, scene, robot, rows)
    panel.shapes(aside, ROBOT)
    for rings, pose, name in reversed(placed):
        panel.shapes(rings, ROBOT if name == "start" else END)
        panel.dot(pose.apply(np.zeros((1, 2))), 3, 'fill="#fff" stroke="#1b2028" stroke-width="12"')
    for place in places:
        panel.dot(place, 6, END)
    for rings, _, name in placed:
        points = np.concatenate(rings)
        panel.label(name, np.array([(points[:, 0].min() + points[:, 0].max()) / 2, points[:, 1].max()]), INK)
    return drawing([panel], WIDTH, HEIGHT, caption)


def _aside(robot: list[Floats], seen: list[Floats]) -> list[Floats]:
    """A robot that is nowhere yet, left of everything."""
    if not seen:
        return robot
    (x0, y0, _, y1), (_, v0, u1, v1) = _around(seen), _around(robot)
    away = np.array([x0 - u1, (y0 + y1) / 2 - (v0 + v1) / 2])
    return [ring + away for ring in robot]


def _draw_way(panel: Panel, scene: Scene, robot: list[Floats], rows: Floats) -> None:
    """The robot at even steps of its way, and the line of its reference point."""
    r = robot_radius(scene)
    steps = np.hypot(*np.diff(rows[:, :2], axis=0).T) + 0.6 * r * np.abs(np.diff(rows[:, 2]))
    until = np.concatenate([[0.0], np.cumsum(steps)])
    count = int(min(GHOSTS, until[-1] / (APART * r)))
    for k in np.searchsorted(until, np.linspace(0, until[-1], count + 2)[1:-1]).tolist():
        x, y, theta = rows[k].tolist()
        pose = Pose(x, y, theta)
        panel.shapes([pose.apply(ring) for ring in robot], GHOST)
    panel.line(rows[:, :2], TRACE)


def _path(path: Path) -> str:
    scene, caption = path.scene, repr(path)
    if scene is None:
        step = path.length / 400 or 1.0
        way = path.sample(step).xy
        panel = Panel(_around([way]), WIDTH, HEIGHT)
        panel.line(way, TRACE)
        for name, end in (("start", way[0]), ("goal", way[-1])):
            panel.dot(end, 5, END)
            panel.label(name, end, INK)
        return drawing([panel], WIDTH, HEIGHT, caption)
    travel = Travel(path, scene)
    rows = travel.at(np.linspace(0, travel.total, 600))
    return _workspace(scene, [path.start], [path.goal], (), caption, rows)


def _apart(proof: Separated | AllSeparated) -> str | None:
    if proof.scene is None:
        return None
    proofs = proof.proofs if isinstance(proof, AllSeparated) else (proof,)
    goals = proof.goals if isinstance(proof, AllSeparated) else (proof.goal,)
    marked = sorted({k for each in proofs for k in each.obstacles})
    return _workspace(proof.scene, [proof.start], goals, marked, repr(proof))


def _draw_slice(panel: Panel, cut: Slice, colour_of: NDArray[np.int64] | None = None) -> None:
    """Forbidden positions, and the contacts around them: coloured by kind, or as is said of each trapezoid."""
    xy, start, shell = cut.boundary.slicer.rings(*cut._place)
    points = xy.reshape(-1, 2)
    rings = [points[i:j] for i, j in pairwise(start)]
    panel.shapes(rings, FORBIDDEN, frame=bool((shell == -1).any()))
    if colour_of is None:
        kinds = cut.boundary.patch_kind[cut.patches]
        for kind, colour in KINDS.items():
            panel.segments(cut.segments[kinds == kind], f'stroke="{colour}" stroke-width="14"')
    else:
        cells = colour_of[cut.trapezoids]
        for cell in np.unique(cells[cells >= 0]).tolist():
            style = f'stroke="{CELLS[cell % len(CELLS)]}" stroke-width="18"'
            panel.segments(cut.segments[cells == cell], style)


def _slices(boundary: Boundary, space: FreeSpace | None, caption: str, only: int | None = None) -> str | None:
    """Slices at six orientations."""
    if not boundary.complete:
        return None
    cells = None if space is None else space.cell_of[space.component].astype(np.int64)
    if cells is not None and only is not None:
        cells = np.where(cells == only, cells, -1)
    width, height, panels = WIDTH / 3, 190.0, []
    for k, angle in enumerate(PANELS):
        panel = _plane(boundary.scene, width - 8, height - 24, k % 3 * width + 4, k // 3 * height + 20)
        _draw_slice(panel, boundary.slice(f"{angle}deg"), cells)
        x, y = panel.corner.tolist()
        panel.parts.append(
            text(f"θ = {angle}°", x + 6, y + 14, f'{INK} paint-order="stroke" stroke="#fff" stroke-width="30"')
        )
        panels.append(panel)
    return drawing(panels, WIDTH, 2 * height, caption)


def _mesh(mesh: Mesh) -> str:
    """The triangles that face the eye, from back to front."""
    xyz, corners, kind = mesh.vertices, mesh.triangles, mesh.kind
    if not len(corners):
        return drawing([], WIDTH, 0, repr(mesh))
    low, high = xyz.min(axis=0), xyz.max(axis=0)
    turn = np.array([[math.cos(EAST), math.sin(EAST), 0], [-math.sin(EAST), math.cos(EAST), 0], [0, 0, 1]])
    tilt = np.array([[1, 0, 0], [0, math.sin(UP), math.cos(UP)], [0, -math.cos(UP), math.sin(UP)]])
    seen = (xyz - (low + high) / 2) @ turn.T @ tilt.T  # x to the right, y upwards, z to the eye
    a, b, c = (seen[corners[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    facing = np.flatnonzero(normal[:, 2] > 1e-9 * length)
    order = facing[np.argsort((a + b + c)[facing, 2], kind="stable")]
    shade = np.rint(4 * (normal[order] @ (-0.3, 0.5, 0.81)) / length[order]).clip(0, 4).astype(int) / 4
    panel = Panel(_around([seen[:, :2]]), WIDTH, HEIGHT)
    colours = [_shaded(KINDS[PatchKind(k)], s) for k, s in zip(kind[order].tolist(), shade.tolist(), strict=True)]
    if len(order) > FINEST:
        panel.image(_painted(SHARP * panel.pixels(seen[corners[order], :2].reshape(-1, 2)), colours))
    else:
        for k, colour in zip(order.tolist(), colours, strict=True):
            panel.shapes([seen[corners[k], :2]], f'fill="{colour}" stroke="{colour}" stroke-width="4"')
    return drawing([panel], WIDTH, HEIGHT, repr(mesh))


def _shaded(colour: str, share: float) -> str:
    """A colour from half dark to full."""
    return "#" + "".join(f"{round(c * (0.5 + 0.5 * share)):02x}" for c in bytes.fromhex(colour[1:]))


def _painted(corners: Floats, colours: Sequence[str]) -> bytes:
    """Triangles one over the other, as PNG."""
    from PIL import Image, ImageDraw

    palette = {colour: k for k, colour in enumerate(["#ffffff", *dict.fromkeys(colours)])}
    image = Image.new("P", (round(SHARP * WIDTH), round(SHARP * HEIGHT)))
    image.putpalette(bytes.fromhex("".join(palette).replace("#", "")))
    brush = ImageDraw.Draw(image)
    for triangle, colour in zip(corners.reshape(-1, 6).tolist(), colours, strict=True):
        brush.polygon(triangle, fill=palette[colour])
    file = BytesIO()
    image.save(file, "PNG")
    return file.getvalue()
