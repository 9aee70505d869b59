"""What `cfree film` shows: scenes by a storyboard, or the answer to one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cfree.cli.files import answer_for, bar, computed, read_source

if TYPE_CHECKING:
    from cfree.film import Storyboard
    from cfree.scene.scene import Scene


def film_scenes(
    sources: Sequence[Path],
    output: Path,
    storyboard: Storyboard,
    seconds: float | None,
    fps: int,
    size: tuple[int, int],
) -> dict[str, Any]:
    """Film scenes one after the other.

    Raises
    ------
    ValueError
        Before anything is computed, if an option has no sense, or a scene lacks what the storyboard needs.
    """
    from cfree.film import length_of, save_film
    from cfree.film.reel import check_options
    from cfree.forbidden.boundary import Boundary

    seconds = length_of(storyboard, output) if seconds is None else seconds
    check_options(len(sources), seconds, fps, size)
    given = [read_source(source) for source in sources]
    if storyboard != "turntable":
        for source, found in zip(sources, given, strict=True):
            _check_ends(source, found.scene if isinstance(found, Boundary) else found)
    boundaries = [computed(found, None) for found in given]
    with bar("film") as progress:
        save_film(boundaries, output, seconds=seconds, fps=fps, size=size, storyboard=storyboard, progress=progress)
    return {"frames": round(seconds * fps), "size": "x".join(map(str, size))}


def _check_ends(source: Path, scene: Scene) -> None:
    missing = " and ".join(f"no {name}" for name in ("start", "goal") if getattr(scene, name) is None)
    if not missing:
        return
    remedy = "put it into the scene" if "and" not in missing else "put them into the scene"
    if scene.start is not None and scene.goals:
        missing, remedy = "several goals, or a place for one", "plan, and give the answer after the scene"
    raise ValueError(f"{source}: {missing}; {remedy}, or film its boundary: --storyboard turntable")


def film_answer(
    source: Path, file: Path, output: Path, seconds: float | None, fps: int, size: tuple[int, int]
) -> dict[str, Any]:
    """Film a path beside its configuration space, or a proof; of several proofs the first.

    Raises
    ------
    ValueError
        Before anything is computed, if an option has no sense, or the answer is for another scene.
    """
    from cfree.film import film_path, film_separation, length_of
    from cfree.film.reel import check_frames, check_options
    from cfree.film.way import REST
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path as Motions
    from cfree.planning.separation import Separated

    check_frames(fps, size)
    given = read_source(source)
    scene = given.scene if isinstance(given, Boundary) else given
    answer = answer_for(scene, file)
    if scene.curved:  # the answer has the polygons among which it was found
        if answer.scene is None:
            raise ValueError(f"{file}: no polygons for the round shapes of the scene; plan anew")
        given = answer.scene
    if isinstance(answer, Motions):
        moving = None if seconds is None else round(seconds - sum(REST), 9)
        if moving is not None and moving <= 0:
            raise ValueError(f"--seconds: {seconds:g}; give more than {sum(REST):g}, for which the robot rests")
        boundary = computed(given, None)
        with bar("film") as progress:
            film_path(
                answer, boundary.scene, output, boundary=boundary, seconds=moving, fps=fps, size=size, progress=progress
            )
        return {"answer": "a path", "size": "x".join(map(str, size))}
    shown = answer if isinstance(answer, Separated) else answer.proofs[0]
    seconds = length_of("separation", output) if seconds is None else seconds
    check_options(1, seconds, fps, size)
    boundary = computed(given, None)
    with bar("film") as progress:
        film_separation(shown, boundary, output, seconds=seconds, fps=fps, size=size, progress=progress)
    return {"answer": "a proof", "frames": round(seconds * fps), "size": "x".join(map(str, size))}
