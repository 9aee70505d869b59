"""Films of a robot that moves among obstacles, and of its point in the configuration space."""

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
SIZE, SIZES = (1280, 720), {".gif": (640, 360)}  # default pixels of answers' films
SECONDS, SECONDS_OF = 30.0, {"separation": 12.0, "turntable": 8.0}  # default lengths of films
GIF_SECONDS = 6.0  # default length of any GIF: it is large and held in memory


def length_of(storyboard: str, path: str | PathLike[str]) -> float:
    """Default length of a film in this file, in seconds.

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
        The storyboard "paper" shows slices, a helix, a v-e and an e-v patch, the whole boundary and a path of the
        first, and the last two of these of the others; among rounded shapes an arc-arc patch, too.
    path : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    seconds : float, optional
        Length of the film: by default 6 for a GIF, else 30, 12 for a separation, 8 for a turntable.
    fps : int
        Frames a second.
    size : (int, int)
        Width and height in pixels; even, as video codecs require.
    storyboard : "paper", "path", "separation" or "turntable"
        "paper"; "path" for a motion from start to goal alone; "separation" for the separating surface and the robot's
        attempts to pass it; "turntable" for the boundary, which turns once around.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If an option makes no sense, or a scene has nothing to show: no contact, or no surface that separates its ends.
    UndecidedError
        If a separation is wanted, and among round shapes neither a path nor a proof is found.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    Poses at contacts are exact and on the contact surface; those of free motions are exact and on a path proved free.
    A frame of 1280 x 720 takes some tenths of a second. A GIF is kept in memory until it is written.

    Examples
    --------
    >>> import tempfile, cfree
    >>> pair = cfree.boundary(cfree.load_scene("examples/scenes/paper_fig9.json"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_film([pair], f"{folder}/pair.gif", seconds=1, fps=6, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.montage import check_options, pictures

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
    """Write a film of the robot along a path, its clearance, and the configuration space if its boundary is given.

    A path of a vehicle has the colours of its gears instead of those of its clearance, and the robot has wheels.

    Parameters
    ----------
    path : Path
    scene : Scene
        The scene in which the path is free.
    file : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    boundary : Boundary, optional
        The boundary of that scene.
    seconds : float, optional
        Duration of the motion, a minute at most. The default is one second for each of its own radii that the robot
        travels, 4 to 20; a GIF is 6 seconds long in all. The robot rests for about a second before and after.
    fps : int
        Frames a second.
    size : (int, int), optional
        Width and height in pixels, even; by default 1280 x 720, for a GIF 640 x 360.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If the path is not free, or its vehicle cannot drive it, or an option makes no sense.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    The speed of the robot's fastest point is constant. Poses between frames are not shown, but the path is proved free
    before the first frame is drawn. Distances are computed in doubles.

    Examples
    --------
    >>> import tempfile, cfree
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (2, 1)], obstacles=[(4, 2), (6, 2), (6, 4)])
    >>> path = cfree.Path(cfree.Pose(0, 0), [cfree.Translation((4, 0))])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     film_path(path, scene, f"{folder}/path.gif", seconds=1, fps=5, size=(320, 180))
    """
    from cfree.film.encode import check_film_path, write
    from cfree.film.montage import check_frames
    from cfree.film.path_film import REST, path_frames
    from cfree.plot.looks import of_polygons, own
    from cfree.plot.path import Track

    suffix = check_film_path(file)
    size = size or SIZES.get(suffix, SIZE)
    check_frames(fps, size)
    if seconds is None and suffix == ".gif":
        seconds = GIF_SECONDS - sum(REST)
    if seconds is not None and not 0 < seconds <= MOST:
        raise ValueError(f"{seconds} seconds; give more than 0, and {MOST:g} at most")
    track = Track.of(own(path, scene), of_polygons(path, scene))
    write(path_frames(track, boundary, seconds, fps, size, progress), file, fps)


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
    """Write a film of a proof: the robot tries to reach its goal, and the separating surface closes around it.

    Parameters
    ----------
    answer : Separated
    boundary : Boundary
        The boundary of the scene that the answer is for. If its shapes are round, that of the polygons in the answer
        will do as well.
    file : path
        ``.mp4`` (needs ``pip install cfree[video]``) or ``.gif``; a file there is replaced once the film is complete.
    seconds : float, optional
        Length of the film: by default 12, for a GIF 6.
    fps : int
        Frames a second.
    size : (int, int), optional
        Width and height in pixels, even; by default 1280 x 720, for a GIF 640 x 360.
    progress : callable, optional
        Called with the share that is done, from 0 to 1.

    Raises
    ------
    ValueError
        If an option makes no sense, or no surface separates start and goal, but exact fits do.
    UnsupportedError
        If the format is unknown, or PyAV is missing.

    Notes
    -----
    The robot moves along paths of the planner. They lead to the poses nearest to the goal and farthest from it, chosen
    from some thousand reachable poses. If the answer is for a clearance, the robot keeps it.

    A proof among round shapes has the surface of slightly smaller shapes, or of polygons inside them. The film then
    says so.

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
    from cfree.film.montage import check_options, splice
    from cfree.film.separation_film import separation_film

    suffix = check_film_path(file)
    size = size or SIZES.get(suffix, SIZE)
    seconds = length_of("separation", file) if seconds is None else seconds
    check_options(1, seconds, fps, size)
    write(splice([separation_film(boundary, answer, round(seconds * fps), size, fps)], fps, progress), file, fps)
