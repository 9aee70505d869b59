"""Films of a robot that moves among obstacles, and of the point it is in the configuration space."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path as FilePath
from typing import Literal

from cfree.arguments import checked
from cfree.forbidden.boundary import Boundary
from cfree.paths.path import Path
from cfree.planning.separation import Separated
from cfree.scene.scene import Scene

__all__ = ["film_path", "film_separation", "save_film"]

Storyboard = Literal["paper", "path", "separation", "turntable"]
MOST = 60.0  # seconds of motion
SIZE, SIZES = (1280, 720), {".gif": (640, 360)}  # of answers' films, if not said otherwise
SECONDS, SECONDS_OF = 30.0, {"separation": 12.0, "turntable": 8.0}  # of a film, if not said otherwise
GIF_SECONDS = 6.0  # of any GIF, which is large and held in memory


def length_of(storyboard: str, path: str | PathLike[str]) -> float:
    """Seconds of a film in this file, if not said otherwise.

    Examples
    --------
    >>> length_of("turntable", "turn.mp4"), length_of("turntable", "turn.gif")
    (8.0, 6.0)
    """
    return GIF_SECONDS if FilePath(path).suffix.lower() == ".gif" else SECONDS_OF.get(storyboard, SECONDS)


@checked
def save_film(
    boundaries: Sequence[Boundary],
    path: str | PathLike[str],
    *,
    seconds: float | None = None,
    fps: int = 25,
    size: tuple[int, int] = SIZE,
    storyboard: Storyboard = "paper",
    progress: Callable[[float], object] | None = None,
) -> None:
    """Write a film of one scene, or of several one after the other.

    Parameters
    ----------
    boundaries : sequence of Boundary
        With the storyboard "paper" the first shows slices, a helix, a v-e and an e-v patch, the whole boundary and a
        path; the others the last two of these.
    path : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    seconds : float, optional
        Length of the film: 6 of a GIF if not given, else 30, 12 of a separation, 8 of a turntable.
    fps : int
        Frames a second.
    size : (int, int)
        Width and height in pixels; even, as video codecs want them.
    storyboard : "paper", "path", "separation" or "turntable"
        "paper"; "path" for a motion from start to goal alone; "separation" for the surface that parts these, and how
        the robot tries to pass; "turntable" for the boundary, which turns once around.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If an option has no sense, or there is nothing to show of a scene: no contact, or nothing that parts its ends.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    Poses at contacts are exact and on the contact surface, those of free motions exact and on a path proved free. Time
    is some tenths of a second a frame of 1280 x 720. A GIF is kept in memory until it is written.

    Examples
    --------
    >>> import tempfile, cfree
    >>> pair = cfree.boundary(cfree.load_scene("examples/scenes/paper_fig9.json"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_film([pair], f"{folder}/pair.gif", seconds=1, fps=6, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.reel import check_options, pictures

    check_film_path(path)
    seconds = length_of(storyboard, path) if seconds is None else seconds
    check_options(len(boundaries), seconds, fps, size)
    write(pictures(boundaries, seconds, fps, size, storyboard, progress), path, fps)


@checked
def film_path(
    path: Path,
    scene: Scene,
    file: str | PathLike[str],
    *,
    boundary: Boundary | None = None,
    seconds: float | None = None,
    fps: int = 25,
    size: tuple[int, int] | None = None,
    progress: Callable[[float], object] | None = None,
) -> None:
    """Write a film of the robot on its way, its clearance, and the configuration space if its boundary is given.

    Parameters
    ----------
    path : Path
    scene : Scene
        In which it is free.
    file : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    boundary : Boundary, optional
        Of that scene.
    seconds : float, optional
        Of motion, a minute at most. If not given, one for each of its own radii that the robot travels, 4 to 20; a GIF
        is 6 seconds long in all. The robot rests for about a second before and after.
    fps : int
        Frames a second.
    size : (int, int), optional
        Width and height in pixels, even; 1280 x 720, for a GIF 640 x 360, if not given.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If the path is not free, or an option has no sense.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    The robot moves at even speed: that of its farthest moving point. Between frames nothing is shown, but the path is
    proved free before the first is drawn. Distances are computed in doubles.

    Examples
    --------
    >>> import tempfile, cfree
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (2, 1)], obstacles=[(4, 2), (6, 2), (6, 4)])
    >>> path = cfree.Path(cfree.Pose(0, 0), [cfree.Translation((4, 0))])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     film_path(path, scene, f"{folder}/path.gif", seconds=1, fps=5, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.reel import check_frames
    from cfree.film.way import REST, path_frames
    from cfree.plot.path import Track

    suffix = check_film_path(file)
    size = size or SIZES.get(suffix, SIZE)
    check_frames(fps, size)
    if seconds is None and suffix == ".gif":
        seconds = GIF_SECONDS - sum(REST)
    if seconds is not None and not 0 < seconds <= MOST:
        raise ValueError(f"{seconds} seconds; give more than 0, and {MOST:g} at most")
    write(path_frames(Track.of(path, scene), boundary, seconds, fps, size, progress), file, fps)


@checked
def film_separation(
    answer: Separated,
    boundary: Boundary,
    file: str | PathLike[str],
    *,
    seconds: float | None = None,
    fps: int = 25,
    size: tuple[int, int] | None = None,
    progress: Callable[[float], object] | None = None,
) -> None:
    """Write a film of a proof: the robot tries to get to its goal, and the surface closes that it cannot pass.

    Parameters
    ----------
    answer : Separated
    boundary : Boundary
        Of the scene to which it is the answer.
    file : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    seconds : float, optional
        Length of the film: 12, of a GIF 6, if not given.
    fps : int
        Frames a second.
    size : (int, int), optional
        Width and height in pixels, even; 1280 x 720, for a GIF 640 x 360, if not given.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If an option has no sense, or start and goal are parted by no surface, but by what fits exactly.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    The robot's motions are paths of the planner to the poses nearest to the goal and farthest from it, of some thousand
    that can be reached.

    Examples
    --------
    >>> import tempfile, cfree
    >>> hall, wall = [(0, 0), (9, 0), (9, 3), (0, 3)], [(4, -1), (5, -1), (5, 4)]
    >>> scene = cfree.Scene(robot=[(0, 0), (1, 0), (1, 1), (0, 1)], obstacles=[wall], workspace=hall)
    >>> proof = cfree.plan(scene, cfree.Pose(1, 1), cfree.Pose(7, 1))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     film_separation(proof, cfree.boundary(scene), f"{folder}/proof.gif", seconds=1, fps=6, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.reel import apart, check_options, reel

    suffix = check_film_path(file)
    size = size or SIZES.get(suffix, SIZE)
    seconds = length_of("separation", file) if seconds is None else seconds
    check_options(1, seconds, fps, size)
    write(reel([apart(boundary, answer, round(seconds * fps), size, fps)], fps, progress), file, fps)
