"""The JSON path, version 1, as pydantic models, and texts of sampled paths; `docs/answer-format.md` describes them.

Where `exact` is given it counts, and the decimals beside it are for people. Import this module inside functions.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, cast

from pydantic import Field, PlainValidator, PrivateAttr, model_validator

from cfree.errors import InvalidPoseError
from cfree.formats.contact_format import ContactModel
from cfree.formats.scene_format import Configuration, Coordinate, Point, Strict, Text, Version, fault
from cfree.motion import Motion, Rotation, Translation, motion_between, rotations
from cfree.outlines import rings_of
from cfree.path import Path
from cfree.pose import Pose, Poses
from cfree.slide import Slide, Touch

if TYPE_CHECKING:
    from cfree.scene import Scene

CLOSE = Fraction(1, 10**9)  # of their size: how far decimals may be from what they stand for
NEAR = 1e-6  # of the path's size: how far decimals alone may lead from the goal


def _turning(value: Any) -> Any:
    """What `rotations` takes as an angle."""
    try:
        rotations((0, 0), value)
        return value
    except (ValueError, OverflowError):
        raise fault('expected radians or "90deg", got {got}') from None


def _half_tangent(value: Any) -> Any:
    try:
        Rotation((0, 0), {"tau": value})
        return value
    except InvalidPoseError:
        raise fault('expected the tangent of half the angle, "p/q", "inf" or "-inf", got {got}') from None


def agree(decimals: Iterable[Any], exact: Iterable[Any]) -> None:
    """See that decimals are what exact numbers beside them are: other programs go by them."""
    pairs = [(Fraction(d), Fraction(e)) for d, e in zip(decimals, exact, strict=True)]
    size = max(max(abs(d), abs(e)) for d, e in pairs)
    for d, e in pairs:
        if abs(d - e) > CLOSE * size:
            raise fault(f"{_shown(d)} beside the exact {_shown(e)}: correct one of them")


def agree_as_poses(decimals: Pose, exact: Pose) -> None:
    """The same for poses."""
    agree((decimals.x, decimals.y), (exact.x, exact.y))
    if abs(math.remainder(decimals.theta - exact.theta, math.tau)) > CLOSE:
        raise fault(f"{decimals.theta!r} radians beside the exact {exact.theta!r}: correct one of them")


def _agree_as_turns(angle: Any, exact: float) -> None:
    """The same for angles turned."""
    given = sum(motion.turn for motion in rotations((0, 0), angle))
    if abs(given - exact) > CLOSE:
        raise fault(f"an angle of {given!r} beside the exact {exact!r}: correct one of them")


def _shown(value: Fraction) -> str:
    return f"{float(value)!r}" if abs(value) < 10**300 else "a number beyond 1e300"


class ExactTranslation(Strict):
    """The vector as it is."""

    vector: Point


class TranslationModel(Strict):
    """Straight motion."""

    type: Literal["translation"]
    vector: Point
    exact: ExactTranslation | None = None

    @model_validator(mode="after")
    def _agrees(self) -> TranslationModel:
        if self.exact:
            agree(self.vector, self.exact.vector)
        return self

    @property
    def motions(self) -> tuple[Motion, ...]:
        return (Translation((self.exact or self).vector),)


class ExactRotation(Strict):
    """Pole and half-angle tangent as they are."""

    pole: Point
    tau: Annotated[Any, PlainValidator(_half_tangent)]


class RotationModel(Strict):
    """Turn about a pole."""

    type: Literal["rotation"]
    pole: Point
    angle: Annotated[Any, PlainValidator(_turning)]
    exact: ExactRotation | None = None

    @model_validator(mode="after")
    def _agrees(self) -> RotationModel:
        if self.exact:
            agree(self.pole, self.exact.pole)
            _agree_as_turns(self.angle, Rotation(self.exact.pole, {"tau": self.exact.tau}).turn)
        return self

    @property
    def motions(self) -> tuple[Motion, ...]:
        if self.exact:
            return (Rotation(self.exact.pole, {"tau": self.exact.tau}),)
        return rotations(self.pole, self.angle)


class ExactSlide(Strict):
    """Coefficients of the curve, and the half-angle tangent."""

    x: list[Coordinate]
    y: list[Coordinate]
    d: list[Coordinate]
    tau: Coordinate


class SlideModel(Strict):
    """Turn along two contacts."""

    type: Literal["slide"]
    contacts: Annotated[list[ContactModel], Field(min_length=2, max_length=2)]
    vector: Point
    angle: Annotated[Any, PlainValidator(_turning)]
    exact: ExactSlide
    _slide: Slide = PrivateAttr()

    @model_validator(mode="after")
    def _agrees(self) -> SlideModel:
        first, last = (Touch(contact.kind, contact.robot, contact.obstacle) for contact in self.contacts)
        try:
            self._slide = Slide((first, last), self.exact.x, self.exact.y, self.exact.d, self.exact.tau)
        except InvalidPoseError as error:
            raise fault(str(error)) from None
        agree(self.vector, self._slide.moved(self._slide.tau))
        _agree_as_turns(self.angle, self._slide.turn)
        return self

    @property
    def motions(self) -> tuple[Motion, ...]:
        return (self._slide,)


class ExactEnds(Strict):
    """Start and goal as they are."""

    start: Configuration
    goal: Configuration


class AnswerModel(Strict):
    """What every answer has: the question."""

    version: Version = 1
    units: Text = ""
    frame: Text = "world"
    answer: str
    start: Configuration
    goal: Configuration
    exact: ExactEnds | None = None

    @model_validator(mode="after")
    def _ends_agree(self) -> Self:
        if self.exact:
            for decimals, exact in zip((self.start, self.goal), self.ends, strict=True):
                agree_as_poses(cast(Pose, decimals), exact)
        return self

    @property
    def ends(self) -> tuple[Pose, Pose]:
        """Start and goal, exact where they are given so."""
        ends: Any = self.exact or self
        return ends.start, ends.goal


class PathModel(AnswerModel):
    """A start, motions, and the goal they lead to."""

    answer: Literal["path"]
    motions: list[Annotated[TranslationModel | RotationModel | SlideModel, Field(discriminator="type")]]

    @model_validator(mode="after")
    def _arrives(self) -> PathModel:
        path, goal = self._moved, self.ends[1]
        if self.exact and all(motion.exact for motion in self.motions):
            if path.goal != goal:
                raise fault("the motions do not lead to the exact goal; correct one of them")
            return self
        size = 1 + max(abs(float(c)) for q in path.poses for c in (q.x, q.y))
        apart = abs(float(path.goal.x - goal.x)), abs(float(path.goal.y - goal.y))
        turned = abs(math.remainder(path.goal.theta - goal.theta, math.tau))
        if max(*apart, turned * size) > NEAR * size:
            x, y, theta = float(path.goal.x), float(path.goal.y), path.goal.theta
            raise fault(f"the motions lead to [{x:.9g}, {y:.9g}, {theta:.9g}] and not to the goal; correct one of them")
        return self

    @property
    def _moved(self) -> Path:
        return Path(self.ends[0], (m for model in self.motions for m in model.motions), self.units, self.frame)

    @property
    def result(self) -> Path:
        """What is left to the goal as it is written is one motion more."""
        path, goal = self._moved, self.ends[1]
        last = [] if path.goal == goal else [motion_between(path.goal, goal)]
        return Path(path.start, [*path.motions, *last], path.units, path.frame)


def path_text(path: Path) -> str:
    """JSON of a path; an equal one is read from it."""
    head = {
        "version": 1,
        "units": path.units,
        "frame": path.frame,
        "answer": "path",
        "start": configuration(path.start),
        "goal": configuration(path.goal),
        "exact": {"start": exact_configuration(path.start), "goal": exact_configuration(path.goal)},
    }
    lines = ",\n".join(f"  {json.dumps(_record(motion))}" for motion in path.motions)
    members = [*(f'"{key}": {json.dumps(value)}' for key, value in head.items()), f'"motions": [\n{lines}\n]']
    return "{" + ",\n ".join(members) + "}\n"


def csv_text(poses: Poses) -> str:
    """Poses as lines x,y,theta."""
    rows = zip(poses.xy.tolist(), poses.theta.tolist(), strict=True)
    return "x,y,theta\n" + "".join(f"{x!r},{y!r},{theta!r}\n" for (x, y), theta in rows)


def ros_text(poses: Poses, frame: str) -> str:
    """Poses as a ROS 2 message nav_msgs/Path in YAML; all stamps are zero."""
    header = f"{{stamp: {{sec: 0, nanosec: 0}}, frame_id: {_quoted(frame)}}}"
    lines = [f"header: {header}", "poses:"]
    for (x, y), theta in zip(poses.xy.tolist(), poses.theta.tolist(), strict=True):
        z, w = math.sin(theta / 2), math.cos(theta / 2)
        lines += [
            f"- header: {header}",
            "  pose:",
            f"    position: {{x: {_decimal(x)}, y: {_decimal(y)}, z: 0.0}}",
            f"    orientation: {{x: 0.0, y: 0.0, z: {_decimal(z)}, w: {_decimal(w)}}}",
        ]
    return "\n".join(lines) + "\n"


def geojson_text(path: Path, scene: Scene, step: float, turn: float) -> str:
    """The way of the reference point and the robot's outlines, as a GeoJSON feature collection."""
    poses = path.sample(step, turn)
    places = [(0, 0.0), *((k, s) for k, shares in enumerate(path.shares(step, turn)) for s in shares.tolist())]
    if not path.motions:
        poses, places = Poses.from_poses([path.start] * 2), places * 2
    roles = ["start", *["pose"] * (len(places) - 2), "goal"]
    way = {"type": "LineString", "coordinates": poses.xy.tolist()}
    features = [_feature(way, role="trace", length=path.length, turning=path.turning)]
    outlines = [poses.apply(ring).tolist() for ring in rings_of(scene.robot)]
    parts = [len(part.ring_offsets) - 1 for part in scene.robot]
    for n, (role, (motion, share)) in enumerate(zip(roles, places, strict=True)):
        rings = iter([*outline[n], outline[n][0]] for outline in outlines)
        polygons = [[next(rings) for _ in range(count)] for count in parts]
        kind: str = "Polygon" if len(polygons) == 1 else "MultiPolygon"
        coordinates: list[Any] = polygons[0] if len(polygons) == 1 else polygons
        (x, y), theta = poses.xy[n].tolist(), float(poses.theta[n])
        shape = {"type": kind, "coordinates": coordinates}
        features.append(_feature(shape, role=role, x=x, y=y, theta=theta, motion=motion, share=share))
    lines = ",\n".join(f"  {json.dumps(feature)}" for feature in features)
    head = f'"type": "FeatureCollection", "units": {json.dumps(path.units)}, "frame": {json.dumps(path.frame)}'
    return f'{{{head},\n "features": [\n{lines}\n]}}\n'


def _feature(geometry: dict[str, Any], **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def _decimal(value: float) -> str:
    """A number that YAML 1.1 does not take for text: 1e-07 has no point."""
    text = repr(value)
    return text if "." in text or "e" not in text else text.replace("e", ".0e")


def _quoted(text: str) -> str:
    """Text in quotes as YAML reads it, whatever is in it."""
    plain = ((c, c.isascii() and c.isprintable()) for c in text)
    return '"' + "".join(json.dumps(c)[1:-1] if is_plain else f"\\U{ord(c):08x}" for c, is_plain in plain) + '"'


def _record(motion: Motion) -> dict[str, Any]:
    if isinstance(motion, Translation):
        vector = motion.vector
        return {"type": "translation", "vector": [*map(float, vector)], "exact": {"vector": [*map(str, vector)]}}
    if isinstance(motion, Slide):
        vector, terms = motion.moved(motion.tau), {"x": motion.x, "y": motion.y, "d": motion.d}
        return {
            "type": "slide",
            "contacts": [asdict(contact) for contact in motion.contacts],
            "vector": [*map(float, vector)],
            "angle": motion.turn,
            "exact": {name: [*map(str, c)] for name, c in terms.items()} | {"tau": str(motion.tau)},
        }
    tau = ("-inf" if motion.clockwise else "inf") if motion.tau is None else str(motion.tau)
    exact = {"pole": [*map(str, motion.pole)], "tau": tau}
    return {"type": "rotation", "pole": [*map(float, motion.pole)], "angle": motion.turn, "exact": exact}


def configuration(pose: Pose) -> list[float]:
    return [float(pose.x), float(pose.y), pose.theta]


def exact_configuration(pose: Pose) -> list[Any]:
    return [str(pose.x), str(pose.y), {"tau": _tau(pose.tau)}]


def _tau(tau: Fraction | None) -> str:
    return "inf" if tau is None else str(tau)
