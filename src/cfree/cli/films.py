"""Films of `cfree film`: scenes by a storyboard, or an answer for one scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cfree.cli.files import answer_for, bar, computed, read_source, without_curves

if TYPE_CHECKING:
    from cfree.film import Storyboard
    from cfree.scene.scene import Scene

INSIDE = "give what cfree convert --inner writes: a proof among polygons inside the shapes holds for these"


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
        Before any computation, if an option makes no sense, or a scene lacks start or goal that the storyboard needs.
    UnsupportedError
        Then as well, if a separation is wanted and a shape is neither a polygon nor rounded.
    """
    from cfree.errors import UnsupportedError
    from cfree.film import length_of, save_film
    from cfree.film.montage import check_options
    from cfree.forbidden.boundary import Boundary
    from cfree.scene.rounded import rounded_shapes, why_not_rounded

    seconds = length_of(storyboard, output) if seconds is None else seconds
    check_options(len(sources), seconds, fps, size)
    inputs = [read_source(source, "all" if storyboard == "separation" else "rounded") for source in sources]
    if storyboard != "turntable":
        for source, data in zip(sources, inputs, strict=True):
            scene = data.scene if isinstance(data, Boundary) else data
            _check_ends(source, scene)
            if scene.curved and rounded_shapes(scene) is None:  # only for a separation
                raise UnsupportedError(f"{source}: {why_not_rounded(scene, INSIDE)}")
    boundaries = [computed(data, None) for data in inputs]
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
        Before any computation, if an option makes no sense, or the answer is for another scene.
    """
    from cfree.film import film_path, film_separation, length_of
    from cfree.film.montage import check_frames, check_options
    from cfree.film.path_film import REST
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path as Motions
    from cfree.planning.goals import AllSeparated
    from cfree.planning.separation import Separated
    from cfree.scene.rounded import rounded_shapes
    from cfree.scene.scene import Scene

    check_frames(fps, size)
    data = read_source(source, "all")
    scene = data.scene if isinstance(data, Boundary) else data
    answer = answer_for(scene, file)
    if isinstance(answer, Motions):
        data = without_curves(data, source, keep_rounded=True) if isinstance(data, Scene) else data
        moving = None if seconds is None else round(seconds - sum(REST), 9)
        if moving is not None and moving <= 0:
            raise ValueError(f"--seconds: {seconds:g}; give more than {sum(REST):g}, for which the robot rests")
        boundary = computed(data, None)
        with bar("film") as progress:
            film_path(answer, scene, output, boundary=boundary, seconds=moving, fps=fps, size=size, progress=progress)
        return {"answer": "a path", "size": "x".join(map(str, size))}
    shown = answer.proofs[0] if isinstance(answer, AllSeparated) else answer
    if not isinstance(shown, Separated):
        raise ValueError(f"{file}: a proof about a vehicle has no surface to film; leave the answer out")
    seconds = length_of("separation", output) if seconds is None else seconds
    check_options(1, seconds, fps, size)
    if scene.curved and not shown.rounded and shown.scene is None:
        raise ValueError(f"{file}: no polygons for the round shapes of the scene; plan anew")
    if scene.curved and rounded_shapes(scene) is None and shown.scene is not None:
        data = shown.scene  # a proof contains the polygons it was computed with
    boundary = computed(data, None)
    with bar("film") as progress:
        film_separation(shown, boundary, output, seconds=seconds, fps=fps, size=size, progress=progress)
    return {"answer": "a proof", "frames": round(seconds * fps), "size": "x".join(map(str, size))}
