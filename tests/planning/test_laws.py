"""Laws of answers: back as there, moved, turned, scaled, mirrored, with less or more to get past."""

from __future__ import annotations

import json
import random
from fractions import Fraction
from pathlib import Path as FilePath

import pytest

import fuzz
from cfree import MotionChecker, Path, Pose, Rotation, Scene, Translation, save
from fuzz_answers import examined
from laws import Law, broken, laws
from questions import Question, question
from replay import CLOSE, collisions, deviation
from shapes import PlainScene, box

SQUARE, WALL = box(0, 0, 1, 1), box(2, -1, 3, 2)
HARD = [  # exact fits and hairs, turned by long rationals and far away; the last ones touch or are apart
    ("slot", 1), ("slot", 2), ("channel", 0), ("channel", 1), ("peg", 1), ("key", 1), ("corner", 0),
    ("corner", 2), ("gap", 1), ("gap", 2), ("mazes", 3), ("mazes", 5), ("rims", 11), ("crowds", 22), ("parts", 21),
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("family", "number"), HARD)
def test_hard_questions_have_the_same_answer_in_other_words(family: str, number: int) -> None:
    """The known one if there is; verified, and replayed from its decimals."""
    outcome = examined(asked(family, number), f"laws {family} {number}", 1)
    assert outcome.verdicts and not outcome.faults, outcome.faults


@pytest.mark.slow
@pytest.mark.parametrize("family", fuzz.KINDS)
def test_random_questions_have_the_same_answer_in_other_words(family: str) -> None:
    number = next(number for number in range(10) if question(family, number))
    outcome = examined(asked(family, number), f"laws {family} {number}", 1)
    assert outcome.verdicts and not outcome.faults, outcome.faults


def asked(family: str, number: int) -> Question:
    found = question(family, number)
    assert found
    return found


# --- the laws themselves ---


def before_a_wall() -> Question:
    return Question(PlainScene([SQUARE], [WALL]), Pose(1, 0), Pose(4, 0, "90deg"), "path")


def test_a_law_is_broken_by_answers_that_contradict_it() -> None:
    same, less, more = (Law("", before_a_wall(), relation) for relation in ("same", "no harder", "no easier"))
    assert broken(same, "path", "closed") and broken(same, "closed", "interior")
    assert broken(less, "path", "closed") and not broken(less, "closed", "path")
    assert broken(more, "closed", "path") and not broken(more, "path", "closed")
    assert not broken(same, "path", "path")


def test_what_touches_touches_still_in_other_words() -> None:
    """A pose in contact is free and stays so; one a hair further on is not."""
    for law in laws(random.Random(0), before_a_wall()):
        if law.relation == "same":
            scene, start = law.other.scene, law.other.start if law.name != "reversed" else law.other.goal
            checker = MotionChecker(scene)
            assert checker.joins([start, start]), law.name
            towards = [Translation((Fraction(x, 10**40), Fraction(y, 10**40))) for x in (1, -1) for y in (1, -1)]
            assert not all(checker.is_free(start, hair) for hair in towards), law.name


# --- the replay ---


def test_decimals_that_lead_astray_are_noticed(tmp_path: FilePath) -> None:
    scene = Scene([(0, 0), (2, 0), (2, 1)], [])
    path = Path(Pose(0, 0), [Translation((Fraction(1, 3), 1)), Rotation((5, "1/7"), {"tau": "1/3"})], scene=scene)
    file = tmp_path / "way.json"
    save(path, file)
    good = json.loads(file.read_text())
    assert deviation(scene, path, file) <= CLOSE
    for place, key in ((0, "vector"), (1, "pole"), (1, "to")):
        bad = json.loads(json.dumps(good))
        bad["motions"][place][key][1] += 1e-8
        file.write_text(json.dumps(bad))
        assert deviation(scene, path, file) > CLOSE


def test_decimals_that_collide_are_noticed(tmp_path: FilePath) -> None:
    scene = Scene(SQUARE[0], [WALL[0]])
    for x, hits in ((Fraction(9, 10), 0), (Fraction(5, 2), 2)):  # of three poses
        path = Path(Pose(0, 0), [Translation((x, 0))], scene=scene)
        file = tmp_path / "way.json"
        save(path, file)
        file.write_text(json.dumps(json.loads(file.read_text()) | {"decimals": "free"}))
        assert collisions(scene, file) == hits
