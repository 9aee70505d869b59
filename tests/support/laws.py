"""Relations between the answers to related questions."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Literal, NamedTuple

import fuzz
from cfree import Polygon, Pose, is_free
from compared import scene_of
from questions import Question, Verdict, carried
from shapes import PlainScene, Shape, mirrored

Relation = Literal["same", "no harder", "no easier"]


class Law(NamedTuple):
    """A related question: its answer is the same, or a path if the other is one, or none if the other is none."""

    name: str
    other: Question
    relation: Relation


def laws(rng: random.Random, question: Question) -> Iterator[Law]:
    """Laws in the order in which they should be tried; numbers of the same generator give the same laws."""
    yield Law("reversed", question.reversed, "same")
    if question.origin:
        yield Law("carried back", question.origin, "same")
    yield Law("mirrored", mirror_image(question), "same")
    for name, world in (("turned", _turn(rng, question)), ("moved", Pose(10**9, Fraction(-(2**40), 3)))):
        yield Law(name, carried(question, world), "same")
    for factor in (Fraction(2) ** rng.randint(-100, 100), abs(fuzz.rational(rng, 3))):
        yield Law("scaled", carried(question, Pose(0, 0), factor), "same")
    frame = Pose(0, 0, {"tau": fuzz.rational(rng, rng.randint(1, 12))})
    yield Law("robot's frame turned", carried(question, Pose(0, 0), body=frame), "same")
    if question.plain.bounds is None:
        away = Pose(rng.randint(-100, 100), rng.randint(-100, 100))
        yield Law("reference point moved", carried(question, Pose(0, 0), body=away), "same")
    plain = question.plain
    for k in rng.sample(range(len(plain.obstacles)), min(1, len(plain.obstacles))):
        fewer = [*plain.obstacles[:k], *plain.obstacles[k + 1 :]]
        yield Law("an obstacle less", _asked(question, plain._replace(obstacles=fewer)), "no harder")
    yield Law("a smaller robot", _asked(question, plain._replace(robot=part_of(rng, plain))), "no harder")
    more = _asked(question, plain._replace(obstacles=[*plain.obstacles, fuzz.placed(rng, fuzz.lattice(rng, 3))]))
    if all(is_free(scene_of(more.plain), pose) for pose in (question.start, question.goal)):
        yield Law("an obstacle more", more, "no easier")


def broken(law: Law, verdict: Verdict, other: Verdict) -> str | None:
    """Contradiction of a pair of answers, if there is one; "interior" is an answer that is not complete."""
    if law.relation == "same":
        return None if verdict == other else f"{law.name}: {verdict}, then {other}"
    easy, hard = (other, verdict) if law.relation == "no harder" else (verdict, other)
    return f"{law.name}: {verdict}, then {other}" if hard == "path" and easy != "path" else None


def mirror_image(question: Question) -> Question:
    """Mirror a question in the y-axis: of the world, and of the robot's frame."""
    plain = question.plain
    bounds = plain.bounds and (-plain.bounds[2], plain.bounds[1], -plain.bounds[0], plain.bounds[3])
    image = PlainScene(
        [*map(mirrored, plain.robot)], [*map(mirrored, plain.obstacles)], bounds,
        plain.workspace and mirrored(plain.workspace),
    )  # fmt: skip
    start, goal = (Pose(-q.x, q.y, {"tau": q.tau and -q.tau}) for q in (question.start, question.goal))
    return Question(image, start, goal, question.known)


def part_of(rng: random.Random, plain: PlainScene) -> list[Shape]:
    """A robot inside the robot: without a part, or a convex piece of it."""
    if len(plain.robot) > 1 and rng.random() < 0.5:
        k = rng.randrange(len(plain.robot))
        return [*plain.robot[:k], *plain.robot[k + 1 :]]
    part = Polygon(*rng.choice(plain.robot))
    piece = rng.choice(part.pieces)
    return [([part.exact_vertices[k] for k in piece], [])]


def _asked(question: Question, plain: PlainScene) -> Question:
    return replace(question, plain=plain, known=None, origin=None)


def _turn(rng: random.Random, question: Question) -> Pose:
    if question.plain.bounds:
        return Pose(0, 0, {"tau": rng.choice([Fraction(1), None, Fraction(-1)])})
    return Pose(0, 0, {"tau": fuzz.rational(rng, rng.randint(1, 15))})
