"""Every public function, method and constructor: an argument of a wrong type is one error that names it."""

import inspect
import math
import pkgutil
import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, get_args, get_origin, get_type_hints

import numpy as np
import pytest
from matplotlib.figure import Figure

import cfree
import cfree.figures
import cfree.verify
from cfree import Pose, Rotation, Translation
from cfree.arguments import checked, fits
from public import NAMES, PACKAGES

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
DISC = cfree.Curved.circle((0, 0), 1)
SCENE = cfree.Scene(SQUARE, [[(3, 0), (4, 0), (4, 1)]], bounds=(-2, -2, 6, 6), start=(0, 0, 0), goal=(1, 2, "90deg"))
MEETING = cfree.arrangements.intersection(
    *(
        cfree.contact.contact_surface(cfree.Polygon(SQUARE), SCENE.obstacles[0], cfree.contact.VertexEdge(0, j))
        for j in (0, 1)
    )
)
# made by cfree, and not by users
RESULTS = """
    AlgebraicAngle AngleInterval AngleRange ArcArcSurface ArcFeature ArcGeometry ArcLine Arrangement
    ArrangementStatistics Audit BezierNet BezierPatch Blocking Bottleneck Boundary BoxGrid Cage Cell CellComplex
    Clearance Compacted Contact ContactEdge Critical DepthCell Disassembly Door EdgeEdgeSegment EdgeFeature Escape
    FewestFingers FirstContact Fit FreeSpace Gap GaussBonnet Geodesic Helix Homology Immobility InnerFit
    Intersection IntersectionCurve Interval Leaving LocalGeometry Loop Mesh NFP NearestMiss OffsetSurface Overlap
    NarrowPlace PartMotion Pieces Puncture RationalHelix RationalRange RationalSegment RationalSurface ReachMap
    RoundedFit Separated ShapeFeatures Shapes SharedLine Slice Stuck Surface Tiling Timed TopologyChange Triple
    TripleContact Unreachable
""".split()  # noqa: SIM905


def callables() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Of the package by name: functions, constructors, methods."""
    for prefix, module in PACKAGES.items():
        for name in module.__all__:
            value = getattr(module, name)
            if inspect.isfunction(value):
                yield prefix + name, value
            if inspect.isclass(value) and not issubclass(value, Exception):
                if name not in (*RESULTS, "Check", "Finding", "Verification"):
                    yield prefix + name, value.__init__
                for member, method in inspect.getmembers_static(value):
                    function = getattr(method, "__func__", method)
                    if inspect.isfunction(function) and not member.startswith("_"):
                        yield f"{prefix}{name}.{member}", function
    for name in cfree.figures.__all__:
        if inspect.isfunction(value := getattr(cfree.figures, name)):
            yield f"figures.{name}", value


PARAMETERS = [
    (name, function, parameter.name)
    for name, function in callables()
    for parameter in inspect.signature(function).parameters.values()
    if parameter.name not in ("self", "cls") and not parameter.name.startswith("_")
    if parameter.kind is not inspect.Parameter.VAR_KEYWORD
]


def words_of(hint: Any) -> tuple[Any, ...]:
    """The words that an argument may be, if there are few."""
    return sum((get_args(part) for part in (hint, *get_args(hint)) if get_origin(part) is Literal), ())


@pytest.fixture(scope="module")
def pool() -> list[Any]:
    """One value of each type."""
    boundary = cfree.boundary(SCENE, threads=1)
    space = cfree.free_space(boundary)
    triangle = cfree.Polygon([(0, 0), (2, 0), (0, 1)])
    contact, corner = cfree.contact.VertexEdge(0, 0), cfree.contact.VertexVertex(0, 1)
    path = cfree.Path(Pose(0, 0), [Translation((1, 0))])
    touch = cfree.collision.Touch("vertex-edge", (0, 0), (0, 2))
    return [
        1, 0.5, (0, 0), (0, 0, 0), SCENE, boundary, space, space.cells[0], triangle, contact, corner, path, Pose(0, 0),
        [], True,
        Translation((1, 0)), (touch, touch), "1", b"", {}, len, [[0, 0, 0]], cfree.contact.EdgeEdge(0, 0), np.zeros(3),
        cfree.rational.rational_surface(triangle, triangle, cfree.contact.VertexEdge(1, 2)), boundary.mesh(1.0),
        space.complex, cfree.Poses([[0, 0]], [0]), cfree.contact.contact_surface(triangle, triangle, contact),
        cfree.MotionChecker(SCENE), boundary.slice(0), boundary.trapezoids, triangle.to_shapely(), Fraction(1),
        cfree.exact.Surd(1), cfree.Preferences(), cfree.exact.AngleInterval(None, None),
        cfree.exact.AlgebraicAngle.of(Pose(0, 0)), MEETING, cfree.arrangements.arrangement(SCENE),
        cfree.contact.ArcArc(0, 0), cfree.contact.arc_surface(DISC, DISC, cfree.contact.ArcArc(0, 0)),
        (part := cfree.nesting.Part(SQUARE)), [part], (placed := cfree.nesting.Placed(part, (0, 0, 0))),
        cfree.nesting.Nesting([], [placed]),
        cfree.Car(1), Figure().add_subplot(), Figure().add_subplot(projection="3d"),
        cfree.reach(SCENE, orientations=1), cfree.audit(SCENE, openings={}),
        *caged_and_taken_apart(),
        cfree.plan(cfree.Scene(SQUARE, [[(3, -9), (4, -9), (4, 9)]], bounds=(0, 0, 7, 2)), (0, 0, 0), (6, 0, 0)),
    ]  # fmt: skip


def caged_and_taken_apart() -> list[Any]:
    """One answer of each kind about cages and assemblies."""
    assembly = cfree.disassembly.Assembly({"a": SQUARE, "b": [(3, 0), (4, 0), (4, 1)]})
    return [
        cfree.caging.is_caged(SQUARE, [(2, 2)]),
        cfree.caging.immobility(SQUARE, [(1, 1)]),
        assembly,
        cfree.disassembly.can_leave("a", assembly),
        cfree.disassembly.removal_order(assembly),
    ]


def fitting(name: str, function: Callable[..., Any], pool: list[Any]) -> dict[str, Any]:
    """What a function takes, of the right types."""
    hints = get_type_hints(function)
    arguments: dict[str, Any] = {}
    for other in inspect.signature(function).parameters.values():
        if other.name == "self":
            owner = NAMES.get(name) or NAMES[name.rpartition(".")[0]]
            arguments["self"] = owner.__new__(owner)
        elif other.default is inspect.Parameter.empty and other.kind is not inspect.Parameter.VAR_KEYWORD:
            hint = hints.get(other.name, Any)
            words = words_of(hint)
            value = words[0] if words else SQUARE if hint is Any else next(v for v in pool if fits(hint, v))
            arguments[other.name] = value
    return arguments


@pytest.mark.parametrize(("name", "function", "parameter"), PARAMETERS, ids=[f"{x[0]}-{x[2]}" for x in PARAMETERS])
def test_an_argument_of_a_wrong_type_is_named(
    name: str, function: Callable[..., Any], parameter: str, pool: list[Any]
) -> None:
    hints, arguments = get_type_hints(function), fitting(name, function, pool)
    for wrong in (object(), 1j, None, "a text", {1: 2}):
        if (wrong is not None and not isinstance(wrong, str | dict)) or not fits(hints.get(parameter, Any), wrong):
            with pytest.raises((TypeError, ValueError), match=rf"\b{parameter}\b") as caught:
                function(**{**arguments, parameter: wrong})
            assert "\n" not in str(caught.value) and len(str(caught.value)) < 400


WORDS = [(*x, words_of(get_type_hints(x[1])[x[2]])) for x in PARAMETERS if words_of(get_type_hints(x[1]).get(x[2]))]


@pytest.mark.parametrize(("name", "function", "parameter", "words"), WORDS, ids=[f"{x[0]}-{x[2]}" for x in WORDS])
def test_a_word_that_is_no_option_is_refused_with_those_that_are(
    name: str, function: Callable[..., Any], parameter: str, words: tuple[Any, ...], pool: list[Any]
) -> None:
    """Whatever the word: misspelled, in capital letters, a part of one that is right, or empty."""
    arguments = fitting(name, function, pool)
    wrong: list[Any] = ["occupied", "", " ", words[0], f"{words[0]} ", *words]
    wrong = [word.upper() if word in words else word for word in wrong] if isinstance(words[0], str) else [0, -1, 10**9]
    for word in (word for word in wrong if word not in words):
        with pytest.raises(ValueError, match=rf"^{parameter}: ") as caught:
            function(**{**arguments, parameter: word})
        assert str(caught.value).startswith(f"{parameter}: {word!r}; give ")
        said = str(caught.value).partition("; give ")[2]
        assert re.findall(r'"(\w[\w-]*)"' if isinstance(words[0], str) else r"(\d+)", said) == [*map(str, words)]


def test_the_options_of_words_are_found() -> None:
    found = {(name, parameter) for name, _, parameter, _ in WORDS}
    assert found >= {
        ("load_shapes", "unknown"), ("plan", "objective"), ("plan_many", "objective"), ("save", "form"),
        ("formats.Shapes.of", "role"), ("film.save_film", "storyboard"), ("figures.draw_all", "renderer"),
        ("plot.painted", "by"), ("collision.Touch", "kind"), ("distributed.Sharded.plan", "objective"),
    }  # fmt: skip


@pytest.mark.parametrize(("name", "function", "parameter"), PARAMETERS, ids=[f"{x[0]}-{x[2]}" for x in PARAMETERS])
def test_an_argument_documented_by_words_takes_only_them(
    name: str, function: Callable[..., Any], parameter: str
) -> None:
    owner = NAMES[name] if function.__name__ == "__init__" else function
    documented = re.search(rf"^ +(?:\w+, )*{parameter}(?:, \w+)* : (\"\w.*)$", owner.__doc__ or "", re.MULTILINE)
    if documented:
        words = tuple(re.findall(r'"([\w-]+)"', documented[1]))
        assert words_of(get_type_hints(function)[parameter]) == words


@pytest.mark.parametrize("role", ["robots", "Obstacle", "part", ""])
def test_a_role_that_is_none_is_refused_with_those_that_are(role: str) -> None:
    with pytest.raises(ValueError, match=f'^roles: walls: \'{role}\'; give "robot", .* or "ignore"$'):
        cfree.load_shapes("examples/scenes/flat.json", roles={"walls": role})


@pytest.mark.parametrize("suffix", ["bmp", "SVG", ".svg", ""])
def test_a_format_of_figures_that_is_none_is_refused_with_those_that_are(suffix: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=f'^formats: \'{suffix}\'; give "svg", "pdf" or "png"$'):
        cfree.figures.draw_all(tmp_path, only=[1], formats=["svg", suffix])
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: cfree.plan("scene.json"), "scene: 'scene.json' is a str; give a Scene or a FreeSpace"),
        (lambda: cfree.plan(SCENE, improve="2s"), "improve: '2s' is a str; give a number or None"),
        (lambda: cfree.boundary(SCENE, threads="2"), "threads: '2' is a str; give an int or None"),
        (lambda: cfree.boundary(SCENE, threads=True), "threads: True is a bool; give an int or None"),
        (lambda: cfree.boundary(SCENE, max_seconds=-1), "max_seconds: -1; give 0 or more"),
        (lambda: cfree.boundary(SCENE, max_memory=float("nan")), "max_memory: nan; give 0 or more"),
        (lambda: cfree.narrowest(cfree.Path(Pose(0, 0), []), SCENE, -1), "count: -1; give 0 or more"),
        (lambda: cfree.Scene(SQUARE, bounds=(0, 0, 1)), "bounds: (0, 0, 1) has 3 numbers; give xmin, ymin, xmax, ymax"),
        (lambda: cfree.Scene(SQUARE, bounds=(0, 0, 1, "x")), "bounds: 'x' is no number"),
        (lambda: cfree.Scene(SQUARE, start=(0, 0)), "start: (0, 0) is no pose; give a Pose, or x, y and theta"),
        (lambda: cfree.Scene(SQUARE, goal="abc"), "goal: 'abc' is a str; give a Pose"),
        (lambda: cfree.plan(SCENE, (0, 0, "north")), "start: theta: 'north' is no number"),
        (lambda: cfree.plan_many(SCENE, [((0, 0, 0), 1)]), "queries: "),
        (lambda: cfree.plan_many(SCENE, [((0, 0, 0), (1, 2))]), "query 0: goal: (1, 2) is no pose"),
        (lambda: cfree.is_free(SCENE, [(0, 0, 0), (0, 0, "x")]), "poses[1]: theta: 'x' is no number"),
        (lambda: cfree.Path(Pose(0, 0), [Translation((1, 0)), 1]), "motions: "),
        (lambda: cfree.max_scale(cfree.Scene(SQUARE)), "no start: the scene has none"),
        (lambda: Rotation((0, 0), "north"), "angle: 'north' is no number"),
    ],
)
def test_the_message_says_what_is_there_and_what_to_give(ask: Callable[[], object], said: str) -> None:
    with pytest.raises((TypeError, ValueError)) as caught:
        ask()
    assert str(caught.value).startswith(said)


def test_a_pose_is_what_a_scene_takes_for_one() -> None:
    """Everywhere: (x, y, theta) of any numbers, theta in degrees or as a tangent."""
    start, goal, same = (0, "0", "0°"), [1, Fraction(2), "90°"], (Pose(0, 0), Pose(1, 2, "90deg"))
    scene = cfree.Scene(SQUARE, SCENE.obstacles, bounds=(-2, -2, 6, 6), start=start, goal=goal)
    assert scene == SCENE and (scene.start, scene.goal) == same
    space, checker = cfree.free_space(cfree.boundary(scene)), cfree.MotionChecker(scene)
    path = cfree.plan(scene, start, goal)
    assert path == cfree.plan(scene, *same) == cfree.plan(scene) == cfree.Planner(scene).plan(start, goal)
    assert [path] == cfree.plan_many(space, [(start, goal)]) == [cfree.plan(space, start, goal)]
    assert space.locate(start) == space.reachable(start).index == space.common_cell(start, goal)
    assert space.locate([start, goal]).tolist() == [space.locate(pose) for pose in same]
    motion = cfree.motion_between(start, goal)
    assert motion == cfree.motion_between(*same) and motion.apply(start) == same[1] == motion.at(start, 1)
    assert checker.is_free(start, motion) == cfree.is_free_motion(scene, start, motion)
    assert checker.first_contact(start, motion) == cfree.first_contact(scene, same[0], motion)
    assert cfree.Path(start, [motion]) == cfree.Path(same[0], [motion])
    assert cfree.turn_in_place(scene, start) == cfree.turn_in_place(scene, same[0])
    assert cfree.collision.free_nearby(scene, goal) == cfree.collision.free_nearby(scene, same[1])
    cfree.require_free(scene, start)
    assert cfree.contact.is_contact(scene.robot[0], scene.obstacles[0], (2, 0, 0))
    assert cfree.max_margin(scene, tolerance=0.5) == cfree.max_margin(scene, start, goal, tolerance=0.5)
    assert cfree.max_scale(scene, tolerance=0.5) == cfree.max_scale(scene, *same, tolerance=0.5)


def test_one_pose_has_one_verdict() -> None:
    for pose in (Pose(0, 0), (0, 0, 0), [0, "0", "0°"], np.zeros(3), (Fraction(1, 3), 0, 0.5)):
        assert cfree.is_free(SCENE, pose) is True
    rows = [(0, 0, 0), (3, 0, 0)]
    exact = [Pose(*row) for row in rows]
    for poses in (rows, np.array(rows), exact, [(0, 0, "0°"), (3, 0, "0°")], cfree.Poses.from_poses(exact)):
        assert cfree.is_free(SCENE, poses).tolist() == [True, False]
    assert not len(cfree.is_free(SCENE, np.zeros((0, 3))))


def test_numbers_may_be_of_any_kind() -> None:
    assert cfree.boundary(SCENE, threads=np.int64(1), max_seconds=Fraction(100)).complete
    assert Rotation((0, 0), np.float32(0.5)).angle == Rotation((0, 0), np.float32(0.5)).turn == pytest.approx(0.5)


def test_the_decorated_are_what_they_were() -> None:
    @checked
    def twice(length: float, *, name: str = "") -> float:
        """Twice."""
        return 2 * length

    assert (twice.__name__, twice.__doc__) == ("twice", "Twice.")
    assert str(inspect.signature(twice)) == "(length: float, *, name: str = '') -> float"
    assert twice(length=math.pi, name="x") == math.tau
    with pytest.raises(TypeError, match="positional"):
        twice(1, 2)  # type: ignore[misc]


# names and hints


def test_only_what_is_public_is_listed() -> None:
    assert dir(cfree) == sorted({*cfree.__all__, *cfree._PACKAGES.split()} - {"__version__"})


def test_no_module_hides_a_name() -> None:
    assert not set(cfree.__all__) & {module.name for module in pkgutil.iter_modules(cfree.__path__)}


@pytest.mark.parametrize("name", NAMES)
def test_type_hints_resolve(name: str) -> None:
    value = NAMES[name]
    functions = [value] if inspect.isfunction(value) else []
    if inspect.isclass(value):  # its fields
        assert set(vars(value).get("__annotations__", {})) <= set(get_type_hints(value))
        assert not any(isinstance(hint, str) for hint in get_type_hints(value).values())
    for _, member in inspect.getmembers_static(value) if inspect.isclass(value) else ():
        function = getattr(member, "fget", None) or getattr(member, "func", None) or getattr(member, "__func__", member)
        if inspect.isfunction(function) and not function.__name__.startswith("_"):
            functions.append(function)
    for function in functions:  # every parameter has one, and it says something now, not only as text
        named = {name for name in inspect.signature(function).parameters if name not in ("self", "cls")}
        hints = get_type_hints(function)
        assert named | {"return"} == set(hints), function.__qualname__
        assert not any(isinstance(hint, str) for hint in hints.values()), function.__qualname__
