"""Turn shots into frames: the state of each frame, the camera's motion, and the fades."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from cfree.film.camera import AZIMUTHS
from cfree.film.frame import TRAIL, Stage, View
from cfree.film.separation_film import answer_of, separation_film
from cfree.film.storyboard import SECONDS, STORYBOARDS, Shot, storyboard
from cfree.film.turntable import turntable_frames

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

FADE = 0.4  # seconds of the fade between scenes, or over a cut
TURN = 1.6  # seconds over which the camera turns from one shot to the next
SWAY = math.radians(7), 11.0  # the camera always sways a little: amplitude, and period in seconds
LEAST = 6  # frames of a scene
LATER = ("pillar", "path")  # shots of a second scene: the first scene has shown the rest
KEPT = ("slices", "helix", "path", "separation")  # shots whose line stays


def check_options(scenes: int, seconds: float, fps: int, size: tuple[int, int]) -> None:
    """Raise a ValueError that names the fault if an option is wrong.

    Examples
    --------
    >>> check_options(1, 10.0, 25, (1281, 720))
    Traceback (most recent call last):
        ...
    ValueError: size 1281x720; give even numbers from 160x90 to 7680x4320
    """
    if not scenes:
        raise ValueError("no scene; give at least one")
    check_frames(fps, size)
    if not (0 < seconds < math.inf) or round(seconds * fps) < scenes * LEAST:
        raise ValueError(f"{seconds} seconds; give enough for {LEAST} frames of each scene at least")


def check_frames(fps: int, size: tuple[int, int]) -> None:
    """Raise a ValueError that names the fault if the rate or the size of frames is wrong."""
    if not 1 <= fps <= 100:
        raise ValueError(f"{fps} frames a second; give 1 to 100")
    width, height = size
    if width % 2 or height % 2 or not (160 <= width <= 7680 and 90 <= height <= 4320):
        raise ValueError(f"size {width}x{height}; give even numbers from 160x90 to 7680x4320")


def shots_of(boundaries: Sequence[Boundary], frames: int, name: str) -> list[list[Shot]]:
    """Return the shots of each scene.

    Raises
    ------
    ValueError
        If a scene has nothing to show.
    """
    kinds = [STORYBOARDS[name]] + [tuple(k for k in STORYBOARDS[name] if k in LATER)] * (len(boundaries) - 1)
    weights = [sum(SECONDS[kind] for kind in chosen) for chosen in kinds]
    result, left = [], frames
    for k, (boundary, chosen) in enumerate(zip(boundaries, kinds, strict=True)):
        count = max(1, round(left * weights[k] / sum(weights[k:])))
        shots = storyboard(boundary, count, chosen)
        if not shots:
            title = boundary.scene.name or f"scene {k}"
            raise ValueError(f"{title}: nothing to show: no contact, and no free pose with room around it")
        result.append(shots)
        left -= sum(len(shot.moments) for shot in shots)
    return result


def pictures(
    boundaries: Sequence[Boundary],
    seconds: float,
    fps: int,
    size: tuple[int, int],
    name: str,
    progress: Callable[[float], object] | None,
) -> Iterator[Image]:
    """Yield all frames of a film."""
    total = round(seconds * fps)
    if name == "turntable":
        counts = np.diff(np.rint(np.linspace(0, total, len(boundaries) + 1))).astype(int).tolist()
        turns = (turntable_frames(b, count, size) for b, count in zip(boundaries, counts, strict=True))
        yield from _counted(chain.from_iterable(turns), total, progress)
        return
    if name == "separation":
        count = total // len(boundaries)
        films = [separation_film(boundary, answer_of(boundary), count, size, fps) for boundary in boundaries]
    else:
        scenes = shots_of(boundaries, total, name)
        films = [(Stage(b, size, fps), shots) for b, shots in zip(boundaries, scenes, strict=True)]
    yield from splice(films, fps, progress)


def splice(
    films: Sequence[tuple[Stage, Sequence[Shot]]], fps: int, progress: Callable[[float], object] | None
) -> Iterator[Image]:
    """Join films: yield their frames one after the other, with fades between films and over cuts."""
    total = sum(len(shot.moments) for _, shots in films for shot in shots)
    return _counted(_faded(films, fps), total, progress)


def _faded(films: Sequence[tuple[Stage, Sequence[Shot]]], fps: int) -> Iterator[Image]:
    fade = round(FADE * fps)
    last: Image | None = None
    for stage, shots in films:
        before, since = last, 0  # the frame that fades out, and the frames since
        for view, cut in views(stage, shots, fps):
            if cut:
                before, since = last, 0
            last = stage.draw(view)
            since += 1
            picture = last
            if before is not None and since <= fade:
                share = since / (fade + 1)
                picture = ((1 - share) * before + share * last + 0.5).astype(np.uint8)
            yield picture


def _counted(frames: Iterator[Image], total: int, progress: Callable[[float], object] | None) -> Iterator[Image]:
    for k, frame in enumerate(frames):
        yield frame
        if progress is not None:
            progress((k + 1) / total)


def views(stage: Stage, shots: Sequence[Shot], fps: int) -> Iterator[tuple[View, bool]]:
    """Yield the state of each frame, and True if it comes after a cut."""
    azimuth = _camera(shots, fps)
    ghost = _averaged(np.concatenate([np.full(len(shot.moments), shot.ghost) for shot in shots]), 0.5 * fps)
    shown = np.stack((stage.space.angles[:, 0], stage.space.angles[:, 0]), axis=1)
    old_lines: list[tuple[str, Floats]] = []
    stays = np.zeros(len(shown), dtype=np.bool_)
    frame = 0
    for shot in shots:
        line = np.array([(float(q.x), float(q.y), math.degrees(q.theta)) for q in (m.pose for m in shot.moments)])
        travels = shot.travels()
        for k in range(len(shot.moments)):
            shown = _more_shown(shown, stage.space.angles, shot, k, line[:, 2])
            # the free path to a shot is drawn while it lasts
            first = 0 if k < shot.link else shot.link
            driven = None if shot.gears is None or k < shot.link else (shot.gears, travels[k - shot.link])
            lines = [*old_lines, *_lines(shot, line[first : k + 1], None if driven is None else travels)]
            if shot.swept is not None:
                stays[list(shot.swept.parts)] = True
            state = float(azimuth[frame]), shown, float(ghost[frame])
            recent = shot.moments[max(0, k - round(TRAIL * fps)) : k + 1]
            view = View(shot.title, shot.note, recent, *state, lines, shot.goal, stays, driven, shot.surface)
            yield view, shot.cut and k == 0
            frame += 1
        if shot.kind in KEPT:
            old_lines = [*old_lines, (shot.colour, line[shot.link :])]
        if shot.kind == "pillar":
            old_lines = []


def _lines(shot: Shot, line: Floats, travels: Sequence[float] | None) -> list[tuple[str, Floats]]:
    """Return the line of a motion so far: in one colour, or in those of a vehicle's gears."""
    if travels is None or shot.gears is None:
        return [(shot.colour, line)]
    colours = [to_hex(colour) for colour in shot.gears.colours(np.array(travels[: len(line)]))]
    cuts = [k for k in range(1, len(line)) if colours[k] != colours[k - 1]]
    ends = zip([0, *cuts], [*cuts, len(line) - 1], strict=True)
    return [(colours[first], line[first : last + 1]) for first, last in ends]


def _more_shown(shown: Floats, angles: Floats, shot: Shot, k: int, degrees: Floats) -> Floats:
    """Return the ranges of angles in which the parts are visible at moment k of a shot."""
    if k < shot.link:
        return shown
    shown = shown.copy()
    if shot.swept is not None:
        parts = list(shot.swept.parts)
        low, high = sorted((degrees[shot.link], degrees[k]))
        if k == len(shot.moments) - 1:
            low, high = 0, 360
        shown[parts, 0] = np.clip(low, angles[parts, 0], angles[parts, 1])
        shown[parts, 1] = np.clip(high, angles[parts, 0], angles[parts, 1])
    if len(shot.level):
        whole = (shown[:, 0] == angles[:, 0]) & (shown[:, 1] == angles[:, 1])
        high = np.clip(shot.level[k], angles[:, 0], angles[:, 1])
        shown[:, 0] = angles[:, 0]
        shown[:, 1] = np.where(whole, angles[:, 1], high)
    if shot.kind == "path":
        shown = angles.copy()
    return shown


def _camera(shots: Sequence[Shot], fps: int) -> Floats:
    """Return the azimuth of each frame: a smooth motion from shot to shot, and a slow sway."""
    wanted = np.concatenate([np.full(len(shot.moments), shot.azimuth) for shot in shots])
    amplitude, seconds = SWAY
    sway = amplitude * np.sin(math.tau * np.arange(len(wanted)) / (seconds * fps))
    azimuth: Floats = np.clip(_averaged(wanted, TURN * fps) + sway, *AZIMUTHS)
    return azimuth


def _averaged(values: Floats, width: float) -> Floats:
    """Return the moving average with a smooth window of this half width, in frames."""
    half = max(1, round(width))
    window = np.hanning(2 * half + 1)
    padded = np.pad(values, half, mode="edge")
    return np.convolve(padded, window / window.sum(), mode="valid")
