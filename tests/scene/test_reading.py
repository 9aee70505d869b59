"""The record of reading: notes that are counted, their lines, the claims they harm, and scenes that keep them."""

import pickle
from copy import copy
from dataclasses import replace

import pytest

import cfree
from cfree.scene.digest import stamp_of
from cfree.scene.reading import KINDS, MOST_ITEMS, MOST_POINTS, Item, Note, Notes, in_order, thinned, together
from cfree.scene.reading_lines import as_read, harms, lines, losses, qualified
from cfree.scene.scene import with_ends, with_obstacles

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
LOST = Note("lost", "open line", "less", 39, "A-WALL", (12.2, -2.3), 140.0, remedy="--join 0.0004")
MORE = Note("guess", "outline closed only by a join", "more", 2, "desk")
NEAR = Note("near", "outline with curves", "near", 61, size=0.08)
PLAIN = Note("info", "a user unit is 2 mm")


def test_notes_of_one_kind_and_place_are_one_with_the_worst_place() -> None:
    notes = Notes()
    notes.add(Note("lost", "open line", "less", 1, "a", (1, 1), 2.0, (Item("5", (1, 1), 2.0),)))
    notes.add(Note("lost", "open line", "less", 2, "a", (7, 7), 9.0, (Item("6", (7, 7), 9.0),)))
    notes.add(Note("lost", "open line", "less", 1, "b"))
    first, second = notes
    assert (first.count, first.at, first.size, [item.handle for item in first.items]) == (3, (7, 7), 9.0, ["5", "6"])
    assert (second.where, second.count) == ("b", 1)


def test_no_more_items_are_kept_than_a_picture_needs() -> None:
    notes = Notes()
    for k in range(MOST_ITEMS + 5):
        notes.add(Note("lost", "open line", "less", items=(Item(str(k)),)))
    (note,) = notes
    assert (note.count, len(note.items)) == (MOST_ITEMS + 5, MOST_ITEMS)
    assert len(thinned([(k, k) for k in range(10**4)])) == MOST_POINTS


def test_the_most_serious_notes_come_first_and_unknown_kinds_last() -> None:
    kinds = [note.kind for note in in_order([Note("zebra", "stripe"), *(Note(kind, "x") for kind in reversed(KINDS))])]
    assert kinds == [*KINDS, "zebra"]


def test_a_line_has_count_layer_size_place_and_remedy() -> None:
    assert lines([LOST]) == ["LOST      39 open lines of A-WALL (the largest 140 at 12.2, -2.3): --join 0.0004"]
    assert lines([replace(LOST, count=1, where="inner wall")]) == [
        'LOST      1 open line of "inner wall" (140 at 12.2, -2.3): --join 0.0004'
    ]
    assert lines([MORE]) == ["guess     2 outlines of desk closed only by a join"]
    joined = Note("joined", "end", "near", 12, at=(88.1, 20.4), size=1.4e-5)
    assert lines([joined]) == ["joined    12 ends, the widest gap 1.4e-05 at 88.1, 20.4"]
    assert lines([replace(LOST, at=(-6e-17, 499.0))])[0].endswith("(the largest 140 at 0, 499): --join 0.0004")
    assert lines([NEAR]) == ["near      61 outlines with curves within 0.08"]
    assert lines([Note("assumption", "hole", "less", 4, remedy="--join-holes")]) == ["assumed   4 holes: --join-holes"]


def test_notes_of_one_kind_and_layer_share_a_line() -> None:
    point = Note("lost", "point", "less", 3, "A-WALL")
    (line,) = lines([LOST, point])
    assert line == "LOST      39 open lines of A-WALL (the largest 140 at 12.2, -2.3); 3 points: --join 0.0004"
    assert len(lines([LOST, replace(point, where="B")])) == 2


def test_the_largest_loss_is_the_first() -> None:
    layout, short = Note("lost", "entity in paper space", "less", 2), Note("lost", "open line", "less", 1, size=3.0)
    assert in_order([MORE, layout, short, LOST]) == (LOST, short, layout, MORE)


def test_hidden_things_and_text_share_a_line() -> None:
    notes = [Note("paint", "text", count=14), Note("hidden", "line", count=30, where="off"), Note("paint", "dimension")]
    assert lines(notes) == ["left out  30 lines of off; 14 texts; 1 dimension"]


def test_lines_name_the_file_if_there_are_several() -> None:
    assert lines([replace(LOST, file="a.dxf")])[0].startswith("LOST      39 open")
    two = lines([replace(LOST, file="a.dxf"), replace(LOST, file="robot.svg")])
    assert [line.split()[1] for line in two] == ["a.dxf:", "robot.svg:"]


def test_names_of_a_file_stay_in_their_line() -> None:
    (line,) = lines([replace(LOST, where="a\nerror: b", file="x")])
    assert "\n" not in line and 'of "a\\nerror: b"' in line
    assert "\n" not in as_read([replace(LOST, where="a\n")])
    assert len(lines([replace(LOST, where="w" * 10**5)])[0]) < 200


@pytest.mark.parametrize(
    ("effect", "harmed"),
    [
        ("less", {"path", "scene"}),
        ("more", {"no path", "scene"}),
        ("unknown", {"path", "no path", "scene"}),
        ("near", {"path", "no path", "scene"}),
        ("none", set()),
        ("odd", {"path", "no path", "scene"}),
    ],
)
def test_the_harmed_claim_follows_from_the_effect_alone(effect: str, harmed: set[str]) -> None:
    for kind in (*KINDS, "zebra"):
        note = Note(kind, "thing", effect)
        assert {claim for claim in ("path", "no path", "scene") if harms([note], claim)} == harmed  # type: ignore[arg-type]


def test_an_answer_ends_with_the_worst_note_that_harms_it() -> None:
    free, none = "a path, each motion proved free", "no path, proved"
    assert (
        qualified(free, [NEAR, LOST], "path") == f"{free}, in the scene as read: 39 open lines of A-WALL are not in it"
    )
    assert qualified(none, [LOST], "no path") == f"{none}; what was left out could only forbid more"
    assert qualified(none, [LOST, MORE], "no path") == (
        f"{none}, in the scene as read: more may be forbidden than drawn (2 outlines of desk closed only by a join)"
    )
    assert qualified(free, [MORE, PLAIN], "path") == qualified(none, [PLAIN], "no path") == ""
    assert as_read([NEAR]) == "in the scene as read: 61 outlines with curves are within 0.08 of the drawn"
    assumed = Note("assumption", "speck", "less", 250)
    assert as_read([assumed], "path") == "in the scene as read: by assumption (250 specks)"


def test_losses_are_what_a_strict_reader_refuses() -> None:
    notes = [Note(kind, "thing") for kind in KINDS]
    assert [note.kind for note in losses(notes)] == ["lost", "guess", "warning"]


def test_records_of_several_files_have_each_note_once() -> None:
    with_places = replace(LOST, items=(Item("5"),))
    assert together([PLAIN, with_places], [LOST, MORE]) == (with_places, MORE, PLAIN)


# scenes


def scene(*notes: Note) -> cfree.Scene:
    return cfree.Scene(SQUARE, [[(3, 0), (4, 0), (4, 1)]], start=(0, 0, 0), goal=(1, 2, 0), reading=notes)


def test_the_record_is_no_part_of_the_scene() -> None:
    one, other = scene(PLAIN, LOST), scene()
    assert one.reading == (LOST, PLAIN) and other.reading == ()
    assert one == other and hash(one) == hash(other) and stamp_of(one) == stamp_of(other)
    assert stamp_of(one).sha256 == stamp_of(other).sha256
    assert stamp_of(one).reading == (LOST, PLAIN)


def test_scenes_made_from_a_scene_keep_its_record() -> None:
    one = scene(LOST)
    made = [
        copy(one),
        pickle.loads(pickle.dumps(one)),
        replace(one, name="b"),
        with_ends(one, None, cfree.Pose(5, 5)),
        with_obstacles(one, []),
        one.grown("1/2"),
        one.grown("1/2").outer(0.1),
        one.grown("1/2").inner(0.1),
    ]
    assert all(other.reading == (LOST,) for other in made)
    assert cfree.Scene(one.robot, one.obstacles).reading == ()


def test_the_text_of_a_scene_tells_the_worst_loss() -> None:
    assert repr(scene(PLAIN)) == "Scene(robot: 4 vertices; 1 obstacle: 3 vertices)"
    assert repr(scene(LOST)).endswith("; LOST: 39 open lines of A-WALL)")


def test_what_forbids_less_is_worse_than_what_forbids_more() -> None:
    notes = [Note("guess", "footprint", "more", 2), Note("warning", "free cell", "less", 4)]
    assert as_read(notes) == "in the scene as read: less may be forbidden than drawn (4 free cells)"
