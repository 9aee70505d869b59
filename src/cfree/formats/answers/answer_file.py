"""Answers in files: a path, or a proof that there is none. `docs/answer-format.md` describes them."""

from __future__ import annotations

import math
from os import PathLike
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Literal

from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.errors import UnsupportedError
from cfree.exact.half_angle import Rate, to_rate
from cfree.formats.text.atomic import replacing
from cfree.paths.leeway import keeps_leeway
from cfree.paths.path import Path
from cfree.paths.stops import Stops
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.scene.digest import Stamp, stamp_for
from cfree.scene.scene import Scene, robot_radius
from cfree.scene.smooth import smooth

if TYPE_CHECKING:
    from cfree.formats.answers.answer_format import Read
    from cfree.paths.timing import Limits, Timed


PARTS_OF_RADIUS, PARTS_OF_LENGTH = 20, 100  # default steps: robot radius and path length divided by these
Form = Literal["json", "csv", "ros", "geojson"]
FORMS: dict[str, Form] = {".json": "json", ".csv": "csv", ".yaml": "ros", ".geojson": "geojson"}  # by suffix
ALSO = {"ros": (".yml",), "geojson": (".json",)}  # further suffixes of a requested form
ANY = ("", ".txt")  # suffixes that fit every form


@checked
def load_answer(path: str | PathLike[str]) -> Path | Proof | AllSeparated:
    """Read a path or a separation, or several separations, from a JSON file.

    Raises
    ------
    FormatError
        If the file has faults, with place, value and remedy of each. It is a fault if the motions of a path do not
        lead to the goal, or the decimals beside exact numbers put the robot elsewhere.

    Examples
    --------
    >>> import tempfile
    >>> from cfree import Pose, Scene, Translation
    >>> square = Scene([(0, 0), (1, 0), (1, 1), (0, 1)])
    >>> way = Path(Pose(0, 0, {"tau": "1/3"}), [Translation(("1/3", 2))], scene=square)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_path(way, f"{folder}/way.json")
    ...     load_answer(f"{folder}/way.json") == way
    True
    """
    return read_answer(path).answer


def read_answer(path: str | PathLike[str]) -> Read:
    """Read an answer, and what its file states about its decimals."""
    from cfree.formats.answers.answer_format import answer_from_json
    from cfree.formats.text.findings import Findings, read_text
    from cfree.formats.text.json_text import read_json

    file = FilePath(path)
    findings = Findings(str(file), read_text(file))
    with collection_paused():
        return answer_from_json(findings, read_json(findings))


def is_answer(path: str | PathLike[str]) -> bool:
    """True if a file is JSON with the key ``answer``.

    Examples
    --------
    >>> is_answer("examples/scenes/paper_fig9.json")
    False
    """
    from cfree.errors import FormatError
    from cfree.formats.readers import is_drawing
    from cfree.formats.text.archive import is_archive
    from cfree.formats.text.findings import Findings, read_text
    from cfree.formats.text.json_text import read_literals

    if is_archive(path) or is_drawing(path):
        return False
    file = FilePath(path)
    try:
        data = read_literals(Findings(str(file), read_text(file)))
    except FormatError:
        return False
    return isinstance(data, dict) and "answer" in data


def save_path(
    path: Path,
    file: str | PathLike[str],
    *,
    step: float | None = None,
    turn: float = math.radians(5),
    speed: float | None = None,
    acceleration: float | None = None,
    steer_rate: Rate | None = None,
    wheelbase: float | None = None,
    stops: Stops = "all",
    per_gear: bool = False,
    scene: Scene | None = None,
    form: Form | None = None,
) -> None:
    """Write a path to a file, whole or not at all.

    Parameters
    ----------
    path : Path
    file : path
        ``.json`` holds the exact motions. ``.csv`` holds poses x, y, theta (not wrapped), ``.yaml`` the same as a
        ROS nav_msgs/Path. ``.geojson`` holds the path of the reference point, and the robot's outlines at these poses.
    step, turn : float
        Sampling steps, see `Path.sample`. The default step is a twentieth of the robot's radius, or a hundredth of
        the path length if the path has no robot.
    speed : float, optional
        Maximum speed of any point of the robot, in lengths a second. It adds times to the poses, in seconds.
    acceleration, steer_rate, wheelbase, stops
        Further limits of a vehicle, see `timed`; with `speed` only.
    per_gear : bool
        Write a ROS nav_msgs/Path for each run of a vehicle in one gear: ``way-1-forward.yaml``,
        ``way-2-backward.yaml``. A file of an earlier path with more runs stays.
    scene : Scene, optional
        The path's scene, if the path has none; needed for ``.json`` and ``.geojson``, and for times.
    form : "json", "csv", "ros" or "geojson", optional
        The form for file names with the suffix ``.txt`` or none.

    Raises
    ------
    UnsupportedError
        If the suffix is another or belongs to another form.
    ValueError
        If the scene is missing, or a limit is not positive or does not fit the vehicle.
    """
    limits = limits_of(speed, acceleration, steer_rate, wheelbase, stops)
    form = form_of(file, form)
    texts = texts_of(path, file, step=step, turn=turn, limits=limits, scene=scene, form=form, per_gear=per_gear)
    for name, text in texts.items():
        with replacing(name) as unfinished:
            unfinished.write_text(text, encoding="utf-8", newline="\n")


def limits_of(
    speed: float | None,
    acceleration: float | None = None,
    steer_rate: Rate | None = None,
    wheelbase: float | None = None,
    stops: Stops = "all",
) -> Limits | None:
    """Return the limits of a drive; None without a speed.

    Raises
    ------
    ValueError
        If there are others without a speed, or one is not positive.
    """
    if speed is not None:
        from cfree.paths.timing import Limits

        return Limits(speed, acceleration, to_rate(steer_rate, "steer_rate"), wheelbase, stops)
    others = {"acceleration": acceleration, "steer_rate": steer_rate, "wheelbase": wheelbase}
    names = [name for name, value in others.items() if value is not None] + (["stops"] if stops != "all" else [])
    if names:
        raise ValueError(f"{', '.join(names)}: only with a speed; give speed as well")
    return None


def texts_of(
    path: Path,
    file: str | PathLike[str],
    *,
    step: float | None,
    turn: float,
    limits: Limits | None,
    scene: Scene | None,
    form: Form,
    per_gear: bool,
) -> dict[str, str]:
    """Return the names and texts of the files that `save_path` writes."""
    if not per_gear:
        return {str(file): text_of(path, file, step=step, turn=turn, limits=limits, scene=scene, form=form)}
    from cfree.formats.answers.poses_text import ros_texts_by_gear

    if form != "ros":
        raise ValueError(f"{file}: per_gear: only for ROS messages; name the file .yaml or leave it out")
    if path.vehicle is None:
        raise ValueError(f"{file}: per_gear: of a vehicle's path only; give a vehicle, or leave it out")
    step = usual_step(path, scene) if step is None else step
    runs = ros_texts_by_gear(path, step, turn, in_time(path, file, limits, scene))
    place, width = FilePath(file), len(str(len(runs)))
    names = (f"{place.stem}-{k:0{width}}-{gear}{place.suffix}" for k, (gear, _) in enumerate(runs, 1))
    return {str(place.with_name(name)): text for name, (_, text) in zip(names, runs, strict=True)}


def in_time(path: Path, file: object, limits: Limits | None, scene: Scene | None) -> Timed | None:
    """Return a path in time, to be written to a file; None without limits."""
    if limits is None:
        return None
    from cfree.paths.timing import timed_by

    if scene is None and path.scene is None and path.curved is None:
        raise ValueError(f"{file}: no scene; give the one whose robot moves")
    return timed_by(path, scene, limits)


def text_of(
    path: Path,
    file: object,
    *,
    step: float | None,
    turn: float,
    limits: Limits | None,
    scene: Scene | None,
    form: Form,
) -> str:
    """Return the text that `save_path` writes."""
    from cfree.formats.answers.path_text import path_text
    from cfree.formats.answers.poses_text import csv_text, geojson_text, ros_text

    if path.scene is None and path.curved:
        scene = path.curved  # the path is free among these shapes, not only among polygons near them
    scene = scene or path.scene
    if form == "json":
        stamp = _stamp(file, path, scene)
        scene = path.scene or scene  # that of the polygons, if there are some
        return path_text(path, stamp, lambda leeway: scene is not None and keeps_leeway(path, scene, leeway))
    step = usual_step(path, scene) if step is None else step
    timed = in_time(path, file, limits, scene)
    if form == "csv":
        return csv_text(path, step, turn, timed)
    if form == "ros":
        return ros_text(path, step, turn, timed)
    if scene is None:
        raise ValueError(f"{file}: no scene; give the one whose robot moves")
    return geojson_text(path, smooth(scene), step, turn, timed)


def usual_step(path: Path, scene: Scene | None) -> float:
    """Return a twentieth of the robot's radius; without a robot, a hundredth of the path length.

    Examples
    --------
    >>> from cfree import Pose, Scene, Translation
    >>> way = Path(Pose(0, 0), [Translation((4, 0))])
    >>> usual_step(way, None), usual_step(way, Scene([(0, 0), (3, 0), (3, 4)]))
    (0.04, 0.25)
    """
    if scene is None or scene.curved:
        scene = path.scene or scene or path.curved
    if scene is not None:
        return robot_radius(smooth(scene)) / PARTS_OF_RADIUS
    if path.stamp is not None:
        return float(path.stamp.reach) / PARTS_OF_RADIUS
    return path.length / PARTS_OF_LENGTH or 1.0


def text_of_proof(proof: Proof | AllSeparated, file: object) -> str:
    """Return the text that `save_separation` writes."""
    from cfree.formats.answers.separation_text import all_separated_text, proof_text

    stamp = _stamp(file, proof, proof.scene)
    return all_separated_text(proof, stamp) if isinstance(proof, AllSeparated) else proof_text(proof, stamp)


def _stamp(file: object, answer: Path | Proof | AllSeparated, scene: Scene | None) -> Stamp:
    """Return the stamp of the answer's scene: the one with round shapes, if there is one."""
    if answer.curved is None and answer.scene is not None and answer.stamp is not None:
        return answer.stamp
    return stamp_for(file, answer.curved or scene, answer.stamp)


def save_separation(proof: Proof | AllSeparated, file: str | PathLike[str]) -> None:
    """Write a separation, or several, to a ``.json`` file, exactly, whole or not at all.

    Raises
    ------
    UnsupportedError
        If the suffix is another.
    ValueError
        If there is no scene.
    """
    if FilePath(file).suffix.lower() != ".json":
        raise UnsupportedError(f"{file}: separations are written as .json; name the file so")
    text = text_of_proof(proof, file)
    with replacing(file) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")


def form_of(file: str | PathLike[str], form: Form | None) -> Form:
    """Return the form to write a path in: the requested one, else that of the file's suffix.

    Raises
    ------
    UnsupportedError
        If the suffix belongs to another form, or to none.

    Examples
    --------
    >>> form_of("way.csv", None), form_of("way.txt", "ros")
    ('csv', 'ros')
    >>> form_of("way.stl", "csv")
    Traceback (most recent call last):
        ...
    cfree.errors.UnsupportedError: way.stl: the form is "csv"; name the file .csv or .txt
    """
    suffix = FilePath(file).suffix.lower()
    if form is None:
        if suffix not in FORMS:
            names = ", ".join(FORMS)
            raise UnsupportedError(f"{file}: paths are written as {names}; name the file so, or give the form")
        return FORMS[suffix]
    own = {name: ending for ending, name in FORMS.items()}
    if form not in own:
        names = " or ".join(f'"{name}"' for name in own)
        raise UnsupportedError(f"{form!r} is no form of a path; give {names}")
    fitting = (own[form], *ALSO.get(form, ()), *ANY)
    if suffix not in fitting:
        *others, last = filter(None, fitting)
        raise UnsupportedError(f'{file}: the form is "{form}"; name the file {", ".join(others)} or {last}')
    return form
