"""Check an answer beyond its form: it leads to the goal, and its decimals keep the rule of effect."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from typing import Any

from cfree.collision.motion import motion_between
from cfree.exact.pose import Pose
from cfree.formats.answers.effect import PART, Effect, Term, Written, decimal_near
from cfree.formats.answers.path_format import AnswerModel, PathModel
from cfree.formats.text.json_positions import Path as Place
from cfree.formats.text.json_positions import shortened
from cfree.paths.path import Path

NEAR = Fraction(1, 10**6)
"""How far decimals alone may lead from the goal: a share of the largest distance from the start, and radians."""

Faults = Iterator[tuple[Place, str]]


def path_faults(model: PathModel, data: Any) -> Faults:
    """Yield the faults of a path, each with its place."""
    if bool(model.decimals) != bool(model.exact):
        yield (), 'only one of "exact" and "decimals" is here; give both, or neither'
    for k, motion in enumerate(model.motions):
        if bool(motion.exact) != bool(model.exact):
            yield ("motions", k), '"exact" belongs here and beside start and goal, or nowhere; add it, or leave it out'
        elif model.exact and not motion.to:
            yield ("motions", k), 'key "to" is missing; add the pose [x, y, theta] that the motion leads to'
        else:
            continue
        return
    if not model.exact:
        yield from _missed(model)
    elif model.driven.goal != model.ends[1]:
        yield (), "the motions do not lead to the exact goal; correct one of them"
    else:
        yield from effect_faults(model, model.driven, data)


def effect_faults(model: AnswerModel, path: Path, data: Any) -> Faults:
    """Yield the decimal with the largest effect, if the effects exceed the limit."""
    if not (model.exact and model.stamp):
        return
    effect, literals = Effect(path, model.ends[1], model.stamp), literals_of(data)
    wrong = [place for place, value in literals.items() if not isinstance(value, (int, Decimal))]
    for place in wrong:
        yield place, 'expected a number, as everywhere beside "exact", got {got}'
    if wrong:
        return
    decimals = {place: Fraction(value) for place, value in literals.items()}
    for terms in (list(effect.terms(decimals)), *effect.poses(decimals)):
        total = sum(term.effect(decimals) for term in terms)
        if total > effect.limit:
            worst = max(terms, key=lambda term: term.effect(decimals))
            yield worst.place, _said(worst, worst.effect(decimals), effect.limit)
            return


def _said(term: Term, effect: Fraction, limit: Fraction) -> str:
    exact = decimal_near(term.value, min(effect, limit) / 1000 / term.weight)
    much, most = (f"{float(value):.3g}" for value in (min(effect, Fraction(10**300)), limit))
    return (
        f"{{got}} beside the exact {shortened(str(exact))} moves the robot by {much}, and all decimals may by "
        f"{most}, {float(PART):.0e} of its size; correct one of them"
    )


def literals_of(data: Any) -> dict[Place, Any]:
    """Return the decimals of a decoded answer by their places."""
    literals: dict[Place, Any] = {(name, k): value for name in ("start", "goal") for k, value in enumerate(data[name])}
    for k, record in enumerate(data.get("motions", ())):
        for name in ("vector", "pole", "to"):
            literals |= {("motions", k, name, i): value for i, value in enumerate(record.get(name, ()))}
        if "angle" in record:
            literals["motions", k, "angle"] = record["angle"]
    return literals


def leeway_of(model: PathModel, data: Any) -> Fraction | None:
    """Return `Effect.leeway` for the decimals of a path in a file."""
    assert model.stamp
    literals: Written = literals_of(data)
    return Effect(model.driven, model.ends[1], model.stamp).leeway(literals)


# --- decimals alone ---


def _missed(model: PathModel) -> Faults:
    """Yield the first pose that the motions miss."""
    pose, goal = model.ends
    theta, poses = pose.theta, [(pose, pose.theta)]
    for motion in model.motions:
        for part in motion.motions:
            pose, theta = part.apply(pose), theta + part.turn
        poses.append((pose, theta))
    way = max(_apart(q, poses[0][0]) for q, _ in poses)
    for k, (motion, (q, turned)) in enumerate(zip(model.motions, poses[1:], strict=True)):
        if motion.to and not _is_near(q, (motion.to[0], motion.to[1]), abs(turned - float(motion.to[2])), way):
            yield ("motions", k, "to"), f"it leads to {_shown(q, turned)}, not to {{got}}; correct one of them"
            return
    if not _is_near(pose, (goal.x, goal.y), abs(math.remainder(pose.theta - goal.theta, math.tau)), way):
        yield (), f"the motions lead to {_shown(pose, pose.theta)} and not to the goal; correct one of them"


def _is_near(pose: Pose, place: tuple[Fraction, Fraction], turned: float, way: Fraction) -> bool:
    return _apart(pose, Pose(*place)) <= NEAR * way and turned <= NEAR


def _apart(one: Pose, other: Pose) -> Fraction:
    return abs(one.x - other.x) + abs(one.y - other.y)


def _shown(pose: Pose, theta: float) -> str:
    return f"[{float(pose.x):.9g}, {float(pose.y):.9g}, {theta:.9g}]"


def completed(model: PathModel) -> Path:
    """Return the path, with one motion more if its decimals end short of the written goal."""
    path, goal = model.driven, model.ends[1]
    if path.goal == goal:
        return path
    return replace(path, motions=(*path.motions, motion_between(path.goal, goal)))
