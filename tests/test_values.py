"""Every public class: equal by content, copied and pickled, whatever has been asked before; its text is one line."""

import copy
import inspect
import pickle
import zlib
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cfree
import cfree.verify
from cfree import Pose, Rotation, Translation
from cfree.contact import (
    ArcArc,
    ArcEdge,
    EdgeArc,
    EdgeEdge,
    EdgeVertex,
    VertexEdge,
    VertexVertex,
    arc_surface,
    shape_features,
)
from cfree.curves import Arc, Bezier, Circle, Ellipse, Spline
from cfree.exact import Surd
from cfree.formats.shapes import Shape
from cfree.rational import rational_helix, rational_range, rational_segment, rational_surface
from cfree.rational.bezier import bezier_patches
from public import NAMES

TRIANGLE, SQUARE = cfree.Polygon([(0, 0), (2, 0), (1, 1)]), cfree.Polygon([(0, 0), (2, 0), (2, 2), (0, 2)])
ROOM = [(0, 0), (9, 0), (9, 9), (0, 9)]
ROBOT = [(0, 0), (2, 0), (0, 1)]


def scene_of(x: int) -> cfree.Scene:
    """Two halves of a room, the wall between them at x."""
    wall = [(x, 0), (x + 1, 0), (x + 1, 9), (x, 9)]
    ends = {"start": (1, 1, 0), "goal": (x + 2, 1, 0)}
    return cfree.Scene(ROBOT, [wall], workspace=ROOM, name="a room", check={"of": [1]}, **ends)


def samples(x: int, folder: Path) -> dict[str, Any]:
    """One of each class, for a wall at x: never equal to that of another x."""
    scene, step = scene_of(x), Fraction(1, x)
    boundary = cfree.boundary(scene, threads=x % 2 + 1)
    space = cfree.free_space(boundary)
    separated = cfree.plan(scene)
    path = cfree.Path(Pose(1, 1), [Translation((step, 0))])
    grid = cfree.planning.BoxGrid((step, step), step, step, x, x, 8)
    forward = cfree.Car(1, gears="forward")
    rod = cfree.Scene([(-5, -1), (5, -1), (5, 1), (-5, 1)], [[(-20, x), (20, x), (20, 9), (-20, 9)]])
    interval = cfree.turn_in_place(rod, Pose(0, 0))[0]
    surface = rational_surface(TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (x, 2), (0, 2)]), VertexEdge(1, 2))
    ruled = boundary.ruled[:1] * x
    walls = cfree.Polygon([(0, 0), (x, 0), (0, 3)])
    floor, below, slope = (
        cfree.contact.contact_surface(TRIANGLE, walls, VertexEdge(i, j)) for i, j in ((0, 0), (1, 0), (2, 1))
    )
    meeting = cfree.arrangements.intersection(floor, slope)
    three = cfree.arrangements.triple(floor, below, slope)
    tile = cfree.nesting.Part([(0, 0), (x, 0), (0, 2)], "tile", x)
    tiles = cfree.nesting.Nesting([ROOM], [cfree.nesting.Placed(tile, (1, 1, 0))])
    compacted = cfree.nesting.compact(tiles, (x, 1), turning=False)
    rounded = cfree.nesting.nfp(TRIANGLE, cfree.Curved.circle((0, 0), x))
    slot = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (3, 2), (3, 3), (0, 3)]
    turning = cfree.nesting.RotationalNFP([(a * x, b * x) for a, b in slot], [(0, 0), (x, 0), (x, x), (0, x)])
    hold = [(1, 0), (2, 1), (1, 2), (0, 1)]
    cage = cfree.caging.is_caged(SQUARE, [*hold, (x, x)])
    post = [(x, 0), (x + 1, 0), (x, 1)]
    assembly = cfree.disassembly.Assembly({"part": SQUARE, "post": post})
    leaving = cfree.disassembly.can_leave("part", assembly)
    held = cfree.caging.immobility(SQUARE, [*hold, (x, x)])
    return {
        "Assembly": assembly,
        "Blocking": cfree.disassembly.Blocking("part", leaving, ("post",), ()),
        "Cage": cage,
        "Contact": cfree.caging.Contact(x, (1.0, 0.0), (Fraction(1), Fraction(0)), (), ()),
        "Critical": cfree.caging.Critical("size", float(x), None, cage),
        "Disassembly": cfree.disassembly.removal_order(assembly),
        "Escape": cfree.caging.Escape(path, (x,)),
        "FewestFingers": cfree.caging.FewestFingers((0, 1, 2, 3), cage, ()),
        "Gap": cfree.caging.Gap((Fraction(1), Fraction(0), Fraction(x))),
        "Immobility": held,
        "Leaving": leaving,
        "Puncture": cfree.caging.Puncture(Pose(x, 0), (0, 1), 0.5),
        "AlgebraicAngle": interval.start,
        "AllSeparated": cfree.AllSeparated((separated,), ((step, step),), "closed"),
        "AngleInterval": interval,
        "AngleRange": cfree.contact.AngleRange(float(step), 1.0, (1, 0), (0, x)),
        "ArcArc": ArcArc(0, x),
        "ArcArcSurface": arc_surface(TRIANGLE, cfree.Curved.circle((0, 0), x), ArcArc(0, 0)),
        "ArcEdge": ArcEdge(0, x),
        "ArcFeature": shape_features(cfree.Curved.circle((0, 0), x)).arcs[0],
        "ArcGeometry": cfree.geometry.arc_geometry([0, 0, 1, 0, x], [0.5], [0.1]),
        "ArcLine": cfree.geometry.line_of_curvature([0, 0, 1, 0, x], 0.5, 0.1, 0.3, "least"),
        "Arrangement": cfree.arrangements.arrangement(cfree.Scene(ROBOT, [ROBOT, [(x, 0), (9, 0), (9, 9)]])),
        "ArrangementStatistics": cfree.arrangements.arrangement(cfree.Scene(ROBOT, [ROBOT] * (x - 3))).statistics,
        "BezierNet": cfree.rational.arc_bezier_net(
            arc_surface(TRIANGLE, cfree.Curved.circle((0, 0), x), ArcArc(0, 0)), 0, 1, 0, 1
        ),
        "BezierPatch": bezier_patches(surface, bits=8)[0],
        "Boundary": boundary,
        "Cell": space.cells[0],
        "CellComplex": boundary.complex,
        "Census": cfree.arrangements.Census(three.surfaces, {"points": 1}, three.poses[:1], (), x),
        "PoseChecker": cfree.PoseChecker(scene),
        "Clearance": cfree.clearance(path, scene),
        "DepthCell": cfree.arrangements.DepthCell(x, ((0, 0),), 1, 1, 2.0),
        "EdgeArc": EdgeArc(0, x),
        "EdgeEdge": EdgeEdge(0, x),
        "EdgeEdgeSegment": cfree.contact.contact_segment(
            TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (0, x)]), EdgeEdge(0, 0)
        ),
        "EdgeFeature": shape_features(cfree.Curved([(0, 0), (x, 0), (0, 1)])).edges[0],
        "EdgeVertex": EdgeVertex(0, x),
        "ExactAngle": cfree.exact.ExactAngle(1, x),
        "FirstContact": cfree.first_contact(scene, Pose(1, 1), Translation((9, 0))),
        "Fit": cfree.fits(ROBOT, [*ROOM[:2], (x, 9)])[0],
        "FreeSpace": space,
        "GaussBonnet": cfree.geometry.gauss_bonnet(boundary),
        "GaussMap": cfree.geometry.gauss_map(cfree.boundary(cfree.Scene([(0, 0), (x, 1), (0, 1)], [ROBOT]))),
        "Geodesic": cfree.geometry.geodesic(ruled, 0.5, 0.1, 0.3, x),
        "Audit": cfree.audit(scene_of(x), {"robot": [(0, 0), (1, 0), (0, 1)]}),
        "Door": cfree.analysis.Door(f"door {x}", "bed", ((0, 0), (0, 1)), 1.0, ("hall", "ward"), "passes"),
        "ReachMap": cfree.reach(scene, orientations=2),
        "Homology": cfree.free.Homology(1, x, 0),
        "Loop": cfree.free.Loop(0, np.array([x], np.int32), np.zeros((2, 3)), 0),
        "Helix": cfree.contact.contact_helix(TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (0, x)]), VertexVertex(0, 1)),
        "Intersection": meeting,
        "IntersectionCurve": meeting.curve,
        "Interval": cfree.analysis.Interval(0.0, float(x), exact=cfree.exact.Surd(0, 1, x)),
        "LocalGeometry": cfree.geometry.local_geometry(ruled, [0.5], [0.1]),
        "Mesh": boundary.mesh(1.0),
        "MotionChecker": cfree.MotionChecker(scene),
        "Moved": cfree.planning.Moved(Pose(x, 0), (step, step)),
        "NearestMiss": cfree.analysis.NearestMiss(0.0, float(x), (cfree.analysis.Bottleneck(None, (0, x)),)),
        "OffsetSurface": arc_surface(TRIANGLE, cfree.Curved.circle((0, 0), x), EdgeArc(0, 0)),
        "Path": path,
        "Pieces": separated.pieces,
        "Blocker": cfree.analysis.Blocker(x, path),
        "NarrowPlace": cfree.planning.NarrowPlace((0.0, float(x)), (0, -2), ("obstacle 0", "the workspace")),
        "Bottleneck": cfree.analysis.Bottleneck(Pose(x, 0), (0, 1)),
        "Planner": cfree.Planner(scene),
        "Car": cfree.Car(x),
        "DifferentialDrive": cfree.DifferentialDrive((x, 0)),
        "Drivable": cfree.paths.Drivable(x, "it moves sideways"),
        "Driven": cfree.paths.Driven("forward", None, 1.0, 0.0, 0, x),
        "Ramp": cfree.paths.Ramp(x, 0.5, 0.25),
        "Stop": cfree.paths.Stop(x, "cusp", 0.5),
        "Stuck": cfree.Stuck(Pose(x, 0), Pose(1, 0), cfree.Car(1), "start", "pieces", (Pose(x, 0),), (0,)),
        "BoxGrid": grid,
        "Unreachable": cfree.Unreachable(Pose(x, 0), Pose(1, 0), forward, "start", (), grid, zlib.compress(b"1")),
        "Arc": Arc((x, 0), (0, 1)),
        "Bezier": Bezier([(x, 0), (0, 1)]),
        "Circle": Circle((x, 0), 1),
        "Curved": cfree.Curved.circle((x, 0), 1),
        "Ellipse": Ellipse((x, 0), (1, 2), "30deg"),
        "Spline": Spline([(x, 0), (0, 1), (1, 1)]),
        "Polygon": cfree.Polygon([(0, 0), (x, 0), (x + 1, 0), (0, 9)]),
        "Pose": Pose(x, 0, 1.5),
        "Poses": cfree.Poses([[x, 0], [0, 1]], [0.1, 3]),
        "Preferences": cfree.Preferences(sideways=float(x)),
        "RationalHelix": rational_helix(TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (0, 1)]), VertexVertex(0, 1)),
        "RationalRange": surface.Phi if x == 4 else rational_range(TRIANGLE, SQUARE, EdgeVertex(0, 2)),
        "RationalSegment": rational_segment(TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (0, 1)]), EdgeEdge(0, 0)),
        "RationalSurface": surface,
        "Rotation": Rotation((x, 0), "30deg"),
        "Scene": scene,
        "Separated": separated,
        "Sharded": cfree.distributed.boundary(scene, folder=folder, tile=x),
        "ShapeFeatures": shape_features(cfree.Curved.circle((0, 0), x)),
        "Shapes": cfree.formats.Shapes("SVG", (Shape("robot", str(x), TRIANGLE),), {"units": str(x)}),
        "SharedLine": cfree.arrangements.intersection(floor, below).lines[0],
        "Slice": boundary.slice({"tau": step}),
        "Slide": cfree.Slide((TOUCH, TOUCH), [0, 0, x], [0, 2], [1, 0, 1], 1),
        "Surd": Surd(1, step, 2),
        "Surface": cfree.contact.contact_surface(TRIANGLE, cfree.Polygon([(0, 0), (x, 0), (0, 1)]), VertexEdge(0, 0)),
        "Timed": cfree.timed(path, scene, speed=float(x)),
        "Tiling": cfree.contact.Tiling(x, 2 * x, 4 * x, 7 * x),
        "Touch": cfree.collision.Touch("vertex-edge", (0, 0), (0, x)),
        "Translation": Translation((x, 0)),
        "Triple": three,
        "TripleContact": three.poses[0],
        "Unwanted": cfree.paths.Unwanted("sideways", 1.0, 0, x),
        "VertexEdge": VertexEdge(0, x),
        "VertexVertex": VertexVertex(0, x),
        "Part": tile,
        "Placed": tiles.placed[0],
        "Nesting": tiles,
        "Overlap": cfree.nesting.overlaps(cfree.nesting.Nesting([], [tiles.placed[0]] * 2))[0],
        "Compacted": compacted,
        "PartMotion": compacted.motions[0],
        "NFP": cfree.nesting.nfp(walls, TRIANGLE),
        "InnerFit": cfree.nesting.inner_fit(ROOM, walls),
        "RoundedFit": rounded,
        "ContactEdge": rounded.edges[0],
        "RotationalNFP": turning,
        "TopologyChange": turning.topology_changes[x - 4],
        # not named in `cfree`, but what its values hold
        "IsolatedParts": cfree.boundary(cfree.Scene(ROBOT, [], bounds=(0, 0, 1, 1), name=str(x))).isolated
        if x == 4
        else boundary.isolated.rows(slice(0)),
        "Patches": boundary.patches,
        "Trapezoids": boundary.trapezoids,
        "Verification": cfree.verify.answer(scene, separated),
    }


TOUCH = cfree.collision.Touch("vertex-edge", (0, 0), (0, 2))


@pytest.fixture(scope="module")
def values(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return samples(4, tmp_path_factory.mktemp("values"))


@pytest.fixture(scope="module")
def again(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """The same, made anew, and asked for everything."""
    made = samples(4, tmp_path_factory.mktemp("again"))
    for value in made.values():
        ask(value)
    return made


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return samples(5, tmp_path_factory.mktemp("others"))


def ask(value: Any) -> None:
    """Everything that a value computes when asked."""
    for name, member in inspect.getmembers_static(type(value)):
        if isinstance(member, (property, cached_property)) and not name.startswith("_"):
            getattr(value, name)
    if isinstance(value, cfree.Boundary):
        value.slice(0.3).forbidden  # noqa: B018
        value.is_free = value.checker.is_free(Pose(1, 1))  # type: ignore[attr-defined]


CLASSES = [
    name.split(".")[-1]
    for name, kind in NAMES.items()
    if inspect.isclass(kind) and not issubclass(kind, cfree.CfreeError) and not name.startswith("verify.")
]


def test_all_public_classes_are_here(values: dict[str, Any]) -> None:
    assert {name: type(values.get(name)).__name__ for name in CLASSES} == {name: name for name in CLASSES}


MORE = ["Patches", "Trapezoids", "IsolatedParts"]


@pytest.mark.parametrize("name", CLASSES + MORE)
def test_values_compare_by_content(
    name: str, values: dict[str, Any], again: dict[str, Any], others: dict[str, Any]
) -> None:
    value, same, other = values[name], again[name], others[name]
    assert (value == same, value != same) == (True, False)
    assert (value == "a text", value != "a text") == (False, True)
    if name not in ("IsolatedParts", "Pieces", "RationalRange", "Trapezoids"):  # these are alike
        assert (value == other, value != other) == (False, True)
    assert hash(value) == hash(same)


@pytest.mark.parametrize("name", [*CLASSES, *MORE, "Verification"])
def test_values_are_copied_and_pickled_whatever_was_asked_before(
    name: str, values: dict[str, Any], again: dict[str, Any]
) -> None:
    for value in (values[name], again[name]):
        for copied in (pickle.loads(pickle.dumps(value)), copy.copy(value), copy.deepcopy(value)):
            assert type(copied) is type(value) and copied == value == values[name]
            assert repr(copied) == repr(value)


@pytest.mark.parametrize("name", [*CLASSES, *MORE])
def test_public_attributes_hold_no_handles_of_the_core(name: str, again: dict[str, Any]) -> None:
    value = again[name]
    public = {name: getattr(value, name) for name in dir(value) if not name.startswith("_")}
    parts = [
        (name, part) for name, held in public.items() for part in (held if type(held) in (list, tuple) else [held])
    ]
    assert [name for name, part in parts if type(part).__module__.startswith("cfree._core")] == []


def test_what_was_pickled_answers_as_before(values: dict[str, Any]) -> None:
    for name in ("Boundary", "FreeSpace", "Planner", "PoseChecker", "MotionChecker"):
        copied = pickle.loads(pickle.dumps(values[name]))
        ask(copied)
    boundary, space = (pickle.loads(pickle.dumps(values[name])) for name in ("Boundary", "FreeSpace"))
    assert np.array_equal(boundary.slice(0.5).segments, values["Boundary"].slice(0.5).segments)
    asked = [Pose(1, 1), Pose(6, 1)]
    assert space.locate(asked).tolist() == values["FreeSpace"].locate(asked).tolist()
    assert pickle.loads(pickle.dumps(values["Planner"])).plan(Pose(1, 1), Pose(6, 1)) == values["Separated"]
    with pytest.raises(ValueError, match="read-only"):
        boundary.trapezoids.patch[0] = 1


@pytest.mark.parametrize("name", CLASSES)
def test_a_value_is_shown_in_one_line(name: str, values: dict[str, Any]) -> None:
    text = repr(values[name])
    assert "\n" not in text and " at 0x" not in text and len(text) < 1000


@pytest.mark.parametrize(
    "error",
    [
        cfree.CfreeError("a"),
        cfree.InvalidPolygonError("a", ring=1, edges=(2, 3)),
        cfree.ForbiddenPoseError("a", free=Pose(1, 2)),
        cfree.FormatError("a", path="b", line=3, column=4),
        cfree.UnsupportedError("a"),
        cfree.IncompleteError("a"),
        cfree.InvariantError("a", state=Pose(1, 2)),
    ],
    ids=lambda error: type(error).__name__,
)
def test_errors_are_pickled_with_all_that_they_carry(error: cfree.CfreeError) -> None:
    copied = pickle.loads(pickle.dumps(error))
    assert (type(copied), str(copied), vars(copied)) == (type(error), str(error), vars(error))
