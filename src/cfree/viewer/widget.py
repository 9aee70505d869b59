"""The page in a notebook's cell, with the dragged poses back in Python. Needs the extra ``notebook``."""

from __future__ import annotations

from importlib.resources import files
from itertools import pairwise
from typing import Any

try:
    from anywidget import AnyWidget
    from traitlets import Instance, Int, Unicode, Union, default
except ImportError as error:
    message = "cfree.widget needs anywidget; install it: pip install 'cfree[notebook]'"
    raise ImportError(message, name="anywidget") from error

from cfree.collision.motion import motion_between
from cfree.collision.motion_checker import is_free_motion
from cfree.exact.pose import Pose
from cfree.formats.scene_file import scene_from_text
from cfree.formats.scenes.scene_values import vehicle as vehicle_of
from cfree.formats.scenes.scene_values import vehicle_record
from cfree.paths.driving import is_drivable
from cfree.paths.path import STILL, Path
from cfree.planning.plan import plan
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.scene.frame import frame_of
from cfree.scene.scene import Scene, with_ends, with_vehicle
from cfree.vehicles.vehicle import Car, DifferentialDrive
from cfree.viewer.page_text import hosted_page, poses_text, text_for_page, words
from cfree.viewer.pictures import picture


def _pose() -> Any:
    """Make a trait that is an exact pose on both sides."""
    return Instance(Pose, allow_none=True).tag(
        sync=True,
        to_json=lambda pose, widget: pose and words(pose),
        from_json=lambda given, widget: given and Pose(given["x"], given["y"], {"tau": given["tau"]}),
    )


def _vehicle() -> Any:
    """Make a trait that is a vehicle, as a record on the page's side."""
    return Union([Instance(Car), Instance(DifferentialDrive)], allow_none=True).tag(
        sync=True,
        to_json=lambda vehicle, widget: vehicle and vehicle_record(vehicle),
        from_json=lambda given, widget: given and vehicle_of(given),
    )


class Widget(AnyWidget):
    """The page in a cell; `cfree.widget` makes it.

    Attributes
    ----------
    source : str
        The scene as JSON; see `scene`.
    robot, start, goal : Pose, optional
        Their exact poses as dragged; set new ones, and the page follows. `observe` reports changes.
    vehicle : Car or DifferentialDrive, optional
        The vehicle that the page's switch and handles describe; None if the robot moves in any direction.
    poses : str
        Poses of the path that is shown, one a line.
    height : int
        Height of the cell, in pixels.
    """

    _esm = files("cfree.viewer").joinpath("widget.mjs").read_text(encoding="utf-8")
    page = Unicode().tag(sync=True)
    source = Unicode().tag(sync=True)
    robot, start, goal = _pose(), _pose(), _pose()
    vehicle = _vehicle()
    poses = Unicode(allow_none=True).tag(sync=True)
    height = Int(600).tag(sync=True)

    def __init__(self, scene: Scene, answer: Path | Separated | None = None) -> None:
        ends = (scene.start, scene.goal) if answer is None else (answer.start, answer.goal)
        vehicle = answer.vehicle if isinstance(answer, Path) else scene.vehicle
        shown = {"start": ends[0], "goal": ends[1], "vehicle": vehicle, "poses": poses_text(answer)}
        super().__init__(source=text_for_page(scene), **shown)
        question = None if answer is None else self._question
        self._answer: tuple[object, Path | Separated | Stuck | None] = question, answer

    @default("page")
    def _default_page(self) -> str:
        return hosted_page()

    @property
    def _question(self) -> tuple[object, ...]:
        return self.source, self.start, self.goal, self.vehicle

    @property
    def scene(self) -> Scene:
        """The scene of the page, with its present start, goal and vehicle; set another one, and the page follows."""
        scene = with_ends(scene_from_text("the scene of the widget", self.source), self.start, self.goal)
        return with_vehicle(scene, self.vehicle)

    @scene.setter
    def scene(self, scene: Scene) -> None:
        with self.hold_sync():
            self.source, self.robot, self.start, self.goal = text_for_page(scene), None, scene.start, scene.goal
            self.vehicle = scene.vehicle

    @property
    def answer(self) -> Path | Separated | Stuck | None:
        """The answer for `scene`: the shown path, proved free again, or that of `cfree.plan`; None without a goal.

        The robot moves as on the page: in any direction, or as `vehicle` drives.

        Raises
        ------
        ForbiddenPoseError
            If start or goal has been dragged into an obstacle.
        UndecidedError
            If contacts leave the question open for the vehicle, or it needs too many manoeuvres.
        """
        if self.start is None or self.goal is None:
            return None
        question, answer = self._answer
        if question != self._question:
            question, scene = self._question, self.scene
            answer = self._shown(scene)
            answer = plan(scene, self.start, self.goal, vehicle=self.vehicle or "any") if answer is None else answer
            self._answer = question, answer
        return answer

    def _shown(self, scene: Scene) -> Path | None:
        """Return the page's path, if it consists of rotations and translations, is free and driven; else None."""
        poses = [Pose(x, y, {"tau": tau}) for x, y, tau in map(str.split, (self.poses or "").splitlines())]
        if not poses or (poses[0], poses[-1]) != (self.start, self.goal):
            return None
        motions = [motion_between(a, b) for a, b in pairwise(poses)]
        of_scene: dict[str, Any] = {"curved" if scene.curved else "scene": scene, "vehicle": self.vehicle}
        path = Path(poses[0], motions, scene.units, frame_of(scene), **of_scene)
        is_driven = self.vehicle is None or is_drivable(path, self.vehicle)
        moves = zip(path.poses, path.motions or (STILL,), strict=False)
        return path if is_driven and all(is_free_motion(scene, pose, motion) for pose, motion in moves) else None

    def _repr_mimebundle_(self, **options: Any) -> Any:
        """Add a picture for viewers without a kernel."""
        bundle = super()._repr_mimebundle_(**options)
        if bundle is None:
            return None
        data, metadata = bundle
        return data | {"image/svg+xml": picture(self.scene)}, metadata
