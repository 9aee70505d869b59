"""Taking apart: orders, proofs, blocking parts, missing gaps."""

from __future__ import annotations

import random
from itertools import permutations

import pytest

import cfree
from cfree.analysis.leaving import leave
from cfree.curves.similar import moved_shape
from cfree.disassembly import Assembly, can_leave, missing_gap, removal_order, what_blocks

FRAME = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
LID, PEG = [(0, 3), (4, 3), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 2), (1, 2)]
PARTS = Assembly({"frame": FRAME, "peg": PEG, "lid": LID}, fixed=["frame"])
HOOK = [(0, 0), (6, 0), (6, 4), (4, 4), (4, 3), (5, 3), (5, 1), (1, 1), (1, 3), (2, 3), (2, 4), (0, 4)]
SLIDER = [("3/2", "3/2"), ("9/2", "3/2"), ("9/2", 2), ("7/2", 2), ("7/2", 5), ("5/2", 5), ("5/2", 2), ("3/2", 2)]


def loaded(name: str, *fixed: str) -> Assembly:
    shapes = cfree.load_shapes(f"examples/cages/{name}.geojson").shapes
    return Assembly({str(shape.name): shape.polygon for shape in shapes}, fixed=fixed)


def test_the_lid_leaves_first_and_then_a_peg_as_wide_as_its_slot() -> None:
    found = removal_order(PARTS)
    assert found and found.order == ("lid", "peg") and found.assembly_order == ("peg", "lid") and found.verified()


@pytest.mark.slow
def test_the_three_parts_of_the_frame_come_out_in_one_order_only() -> None:
    parts = loaded("frame", "frame")
    found = removal_order(parts)
    assert found and found.order[0] == "wedge" and len(found.order) == 3 and found.verified()
    held = [name for name in parts.movable if not can_leave(name, parts)]
    assert held == ["left block", "right block"]


def test_the_key_of_the_puzzle_leaves_only_with_a_turn() -> None:
    out = can_leave("key", loaded("puzzle", "housing"))
    assert out and out.path is not None and out.path.turning > 1 and out.verified()
    cut = cfree.boundary(out.scene).slice(0)
    (region,) = (part for part in getattr(cut.forbidden, "geoms", [cut.forbidden]) if part.interiors)
    import shapely

    assert out.scene.start is not None
    place = shapely.Point(float(out.scene.start.x), float(out.scene.start.y))
    assert any(shapely.Polygon(hole).contains(place) for hole in region.interiors)


def test_a_part_that_no_order_takes_out_has_a_proof_that_names_those_that_hold_it() -> None:
    closed = removal_order(Assembly({"frame": FRAME, "peg": PEG, "lid": LID}, fixed=["frame", "lid"]))
    assert not closed and closed.order == () and closed.verified()
    (held,) = closed.held
    assert held.part == "peg" and held.holding == ("frame", "lid")
    assert held.proof is not None and held.proof.of == "closed"


def test_what_blocks_are_single_parts_whose_removal_lets_it_out() -> None:
    blocking = what_blocks("peg", PARTS)
    assert blocking.single == ("frame", "lid")
    for name, path in zip(blocking.single, blocking.paths, strict=True):
        assert path.is_free(cfree.MotionChecker(PARTS.scene("peg", gone=[name])))
    with pytest.raises(ValueError, match="'lid' can leave"):
        what_blocks("lid", PARTS)


def test_a_part_of_several_shapes_blocks_and_moves_as_one() -> None:
    halves = [[(0, 0), (1, 0), (1, 3), (0, 3)], [(3, 0), (4, 0), (4, 3), (3, 3)]]
    bars = Assembly({"sides": halves, "floor": [(0, -1), (4, -1), (4, 0), (0, 0)], "lid": LID, "peg": PEG})
    blocking = what_blocks("peg", bars)
    assert blocking.single == ("sides", "floor", "lid")
    assert can_leave("sides", bars, gone=["peg"])


def test_the_missing_gap_is_the_least_inset_with_which_the_part_leaves() -> None:
    parts = Assembly({"slot": HOOK, "slider": SLIDER}, fixed=["slot"])
    miss = missing_gap("slider", parts)
    assert miss is not None and 0 < miss.lo < miss.hi < 1.02 * miss.lo and miss.bottlenecks
    from fractions import Fraction

    from cfree.polygons.offset import inset

    for by, leaves in ((miss.lo, False), (miss.hi, True)):
        smaller = inset(cfree.Polygon(SLIDER), Fraction(by))
        assert bool(can_leave("slider", Assembly({"slot": HOOK, "slider": smaller}, fixed=["slot"]))) == leaves
    with pytest.raises(ValueError, match="no gap is missing"):
        missing_gap("lid", PARTS)


def test_round_parts_are_taken_apart_as_they_are() -> None:
    ball = cfree.Curved.circle((2, "3/2"), "1/2")
    found = removal_order(Assembly({"frame": FRAME, "ball": ball, "lid": LID}, fixed=["frame"]))
    assert found.order == ("lid", "ball") and found.verified()
    assert not can_leave("ball", Assembly({"frame": FRAME, "ball": ball, "lid": LID}))


@pytest.mark.parametrize(
    ("ask", "text"),
    [
        (lambda: Assembly({}), "parts: there are none"),
        (
            lambda: Assembly({"a": [(0, 0), ("1e200", 0), (0, 1)]}),
            "part a: a coordinate is larger than 1e150; scale it",
        ),
        (lambda: Assembly({"a": PEG}, fixed=["b"]), "fixed: 'b' is the name of no part"),
        (lambda: can_leave("pag", PARTS), "did you mean 'peg'"),
        (lambda: can_leave("peg", PARTS, gone=["lud"]), "gone: 'lud' is the name of no part; did you mean 'lid'"),
        (
            lambda: can_leave("a", Assembly({"a": FRAME, "b": [(0, 0), (1, 0), (1, 1)]})),
            "part 'a' overlaps another one",
        ),
    ],
)
def test_faults_name_the_part_and_the_remedy(ask: object, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        ask()  # type: ignore[operator]


def test_an_assembly_of_fixed_parts_has_nothing_to_take_out() -> None:
    found = removal_order(Assembly({"frame": FRAME}, fixed=["frame"]))
    assert found and found.order == ()


@pytest.mark.slow
def test_paths_are_as_short_far_from_the_origin_as_near_it() -> None:
    shapes = {str(s.name): s.polygon for s in cfree.load_shapes("examples/cages/frame.geojson").shapes}
    far = cfree.Pose(10**6, -(10**6))
    moved = {name: moved_shape(shape, far) for name, shape in shapes.items()}
    paths = [can_leave("wedge", Assembly(parts, fixed=["frame"])).path for parts in (shapes, moved)]
    assert all(path is not None and path.length < 3 * 6.5 for path in paths)  # three times its own height
    key = {str(s.name): s.polygon for s in cfree.load_shapes("examples/cages/puzzle.geojson").shapes}
    turned = can_leave("key", Assembly({k: moved_shape(v, far) for k, v in key.items()}, fixed=["housing"]))
    near = can_leave("key", Assembly(key, fixed=["housing"]))
    assert turned.path is not None and near.path is not None and turned.verified()
    assert turned.path.length < 2 * near.path.length


def test_a_part_for_which_time_runs_out_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    def late(scene: cfree.Scene, *_: object, **how: object) -> cfree.Path:
        if how["max_seconds"] == 0 and len(scene.obstacles) > 1:
            raise cfree.IncompleteError("0 seconds were not enough")
        return leave(scene, *_, **how)  # type: ignore[arg-type, return-value]

    monkeypatch.setattr("cfree.disassembly.leaving.leave", late)
    found = removal_order(PARTS, max_seconds=0)
    assert not found and dict(found.undecided) == dict.fromkeys(("peg", "lid"), "0 seconds were not enough")
    assert removal_order(PARTS, max_seconds=1)


def boxes(seed: int) -> Assembly:
    """Boxes on a grid, a few of them with a notch, packed so that some hold others."""
    rng = random.Random(seed)
    cells = {(x, y): rng.randrange(4) for x in range(3) for y in range(3)}
    squares: dict[int, list[tuple[int, int]]] = {}
    for place, part in cells.items():
        squares.setdefault(part, []).append(place)
    return Assembly(
        {
            f"part {k}": [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x, y in places]
            for k, places in squares.items()
        }
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
def test_an_order_is_found_if_any_permutation_is_one(seed: int) -> None:
    parts = boxes(seed)
    found = removal_order(parts)
    if found.undecided:
        pytest.skip("parts that fit exactly are undecided")
    assert found.verified()
    orders = [
        order
        for order in permutations(parts.names)
        if all(can_leave(name, parts, gone=order[:k]) for k, name in enumerate(order))
    ]
    assert bool(found) == bool(orders) and (not found or found.order in orders)
