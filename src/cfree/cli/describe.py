"""Facts about a scene, before any computation, and about a slice; for people and machines."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cfree.collision.approximations import Approximations
from cfree.collision.pose_checker import PoseChecker, is_free
from cfree.exact.pose import Pose
from cfree.forbidden.kinds import KINDS, PatchKind
from cfree.formats.conversion import as_exact
from cfree.free.turn_in_place import turn_in_place
from cfree.polygons.polygon import Polygon
from cfree.scene.features import BODY, SceneFeatures, ShapeFeatures, grown_features, scene_features
from cfree.scene.grown_cores import Rounded
from cfree.scene.naming import placed
from cfree.scene.rounded import rounded_shapes
from cfree.scene.scene import round_count, shapes_of

if TYPE_CHECKING:
    from cfree.forbidden.slice import Slice
    from cfree.scene.goals import Goal
    from cfree.scene.scene import Scene


def describe(scene: Scene) -> dict[str, Any]:
    """Describe a scene by facts for JSON.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    dict
        ``robot`` and ``obstacles`` hold counts; ``removed`` holds the points of the input that are no vertices.
        ``patches`` counts the contact patches before trimming, by kind, and the sides of the bounds. ``start`` and
        ``goal`` hold poses and True for free ones. ``round`` is the number of round shapes. ``exact`` of them are
        exact in boundaries, and counted as their cores; others are counted as polygons around them. ``healing`` is the
        option that makes more of them exact, if any.

    Examples
    --------
    >>> from cfree.formats.scene_file import load_scene
    >>> facts = describe(load_scene("examples/scenes/paper_fig9.json"))
    >>> facts["patches"]
    {'v-e': 9, 'e-v': 9, 'bound': 4, 'total': 22}
    >>> facts["goal"]
    {'x': 3.4, 'y': 2.2, 'degrees': 90.0, 'free': True}
    """
    if scene.curved:
        return _describe_curved(scene)
    features = scene_features(scene)
    checker = PoseChecker(scene, features) if scene.start or scene.goal else None
    shapes = [
        *(("robot" if len(scene.robot) == 1 else f"robot[{k}]", part) for k, part in enumerate(scene.robot)),
        *((placed(scene, k), obstacle) for k, obstacle in enumerate(scene.obstacles)),
        *([("workspace", scene.workspace)] if scene.workspace else []),
    ]
    return {
        "name": scene.name,
        "units": scene.units,
        "note": scene.note,
        "source": dict(scene.source),
        "robot": _counts(scene.robot),
        "obstacles": _counts(scene.obstacles),
        "workspace": _counts([scene.workspace]) if scene.workspace else None,
        "bounds": [float(value) for value in scene.bounds] if scene.bounds else None,
        "removed": [
            {"shape": name, "ring": point.ring, "index": point.index, "reason": point.reason}
            for name, shape in shapes
            for point in shape.removed
        ],
        "patches": expected_patches(scene, features),
        "start": _pose_facts(checker, scene.start),
        "goal": _pose_facts(checker, scene.goal),
        "goals": [_goal_facts(scene, goal) for goal in scene.goals],
    }


def _describe_curved(scene: Scene) -> dict[str, Any]:
    """Describe the cores of rounded shapes, and polygons around others, as the boundary takes them."""
    around = Approximations(scene).scene(outward=True)
    facts = describe(around) | {key: getattr(scene, key) for key in ("note", "source")}
    taken, notes = as_exact(scene, None)
    facts["healing"] = notes[0].remedy if notes else ""
    facts["round"], facts["exact"] = round_count(shapes_of(scene)), round_count(shapes_of(taken))
    if (cores := rounded_shapes(taken)) is not None:
        own = cores.obstacles[: len(cores.obstacles) - cores.frames]
        facts["robot"], facts["obstacles"] = _core_counts(cores.robot), _core_counts(own)
        facts["patches"] = expected_patches(taken, grown_features(taken))
    for key, pose in (("start", scene.start), ("goal", scene.goal)):
        if pose is not None:
            facts[key]["free"] = is_free(scene, pose)
    return facts


def describe_slice(cut: Slice) -> dict[str, int | float]:
    """Describe a slice: angle, contact segments, their lengths by kind, and an area.

    Returns
    -------
    dict
        ``free area`` if bounds or a workspace make it finite, else ``forbidden area``. Among round shapes also their
        number, and how far the chords in areas and files are from their arcs at most.
    """
    boundary = cut.boundary
    length = cut.lengths
    kinds = boundary.patch_kind[cut.patches]
    facts = {
        "theta": cut.theta,
        "degrees": float(np.degrees(cut.theta)),
        "segments": len(cut.segments),
        **{
            f"length {name}": float(length[kinds == kind].sum())
            for kind, name in KINDS.items()
            if kind != PatchKind.ARC_ARC or boundary.scene.curved
        },
    }
    if boundary.scene.curved:
        facts |= {"round shapes, exact": round_count(shapes_of(boundary.scene)), "chords of arcs within": cut.error}
    area, rim = float(cut.forbidden.area), boundary.features.rim
    if rim is None:
        return facts | {"forbidden area": area}
    x0, y0, x1, y1 = rim
    return facts | {"free area": (x1 - x0) * (y1 - y0) - area}


def expected_patches(scene: Scene, features: SceneFeatures) -> dict[str, int]:
    """Count patches before trimming: of contacts, convex vertices times edges, both ways; and of the bounds.

    Among rounded shapes also those of arcs: four for each two convex vertices, and for each concave arc and convex
    vertex of a smaller radius; one for each of an equal radius.
    """
    robot, obstacles = features.robot, features.obstacles
    a, b = robot.core.layer == BODY, (obstacles.core.layer == BODY) & (obstacles.core.emit > 0)
    convex_a, convex_b = a & (robot.core.convex > 0), b & (obstacles.core.convex > 0)
    edges_a, edges_b = (s.core.makes_surfaces() > 0 for s in (robot, obstacles))
    counts = {"v-e": _pairs(convex_a, b & edges_b), "e-v": _pairs(a & edges_a, convex_b)}
    if scene.curved:
        sharp_a, sharp_b = (s.radius[: len(s.previous)] == 0 for s in (robot, obstacles))
        sharp = _pairs(convex_a & sharp_a, convex_b & sharp_b)
        concave = [_concave_pairs(robot, convex_a, obstacles, b), _concave_pairs(obstacles, convex_b, robot, a)]
        below, equal = map(sum, zip(*concave, strict=True))
        counts["arc-arc"] = 4 * (_pairs(convex_a, convex_b) - sharp + below) + equal
    counts["bound"] = 4 if scene.bounds else 0
    return counts | {"total": sum(counts.values())}


def _pairs(some: NDArray[np.bool_], others: NDArray[np.bool_]) -> int:
    return int(some.sum()) * int(others.sum())


def _concave_pairs(
    some: ShapeFeatures, are_convex: NDArray[np.bool_], others: ShapeFeatures, may_be: NDArray[np.bool_]
) -> tuple[int, int]:
    """Count pairs of a convex vertex and of a concave arc whose radii, negative there, have a sum below 0, and of 0."""
    radii = Counter(some.core.radius[k] for k in np.flatnonzero(are_convex).tolist())
    negative = Counter(r for k in np.flatnonzero(may_be).tolist() if (r := others.core.radius[k]) < 0)
    sums = [(r + s, n * m) for r, n in radii.items() for s, m in negative.items()]
    return sum(n for s, n in sums if s < 0), sum(n for s, n in sums if s == 0)


def _core_counts(cores: Sequence[Rounded]) -> dict[str, int]:
    polygons = [part.core for part in cores if isinstance(part.core, Polygon)]
    thin = [part.core for part in cores if not isinstance(part.core, Polygon)]
    counts = _counts(polygons)
    vertices = sum(map(len, thin))
    return counts | {
        "polygons": len(cores),
        "vertices": counts["vertices"] + vertices,
        "convex": counts["convex"] + vertices,
        "pieces": counts["pieces"] + len(thin),
    }


def _counts(shapes: Sequence[Polygon]) -> dict[str, int]:
    vertices, convex = sum(map(len, shapes)), sum(int(shape.convex.sum()) for shape in shapes)
    return {
        "polygons": len(shapes),
        "vertices": vertices,
        "convex": convex,
        "reflex": vertices - convex,
        "holes": sum(len(shape.ring_offsets) - 2 for shape in shapes),
        "pieces": sum(len(shape.pieces) for shape in shapes),
    }


def _goal_facts(scene: Scene, goal: Goal) -> dict[str, Any]:
    """Describe a goal: a pose, or a place, which is free if some orientation is."""
    if isinstance(goal, Pose):
        return {**(_pose_facts(PoseChecker(scene), goal) or {})}
    x, y = map(float, goal)
    return {"x": x, "y": y, "degrees": None, "free": bool(turn_in_place(scene, Pose(*goal)))}


def _pose_facts(checker: PoseChecker | None, pose: Pose | None) -> dict[str, Any] | None:
    if pose is None or checker is None:
        return None
    degrees = float(np.degrees(pose.theta))
    return {"x": float(pose.x), "y": float(pose.y), "degrees": degrees, "free": checker.is_free(pose)}
