"""Better paths than one that was found: in a number of attempts, or in some time on all cores.

Given a time, each core looks for other ways in half of it, with random numbers of its own, and makes its best better
in the rest. The best of all is taken.
"""

from __future__ import annotations

import math
import os
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from itertools import pairwise
from typing import Any

import cfree._core as _core
from cfree.collision.motion import motion_between
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.paths.clearance import clearance
from cfree.paths.path import Path
from cfree.paths.preferences import Preferences
from cfree.planning.core_ways import end_of, from_numbers
from cfree.scene.scene import Scene

REFINE = 400  # motions checked to improve a path if no time is given
BALANCE = 50  # the same for each pose, before and after, of a path that keeps a distance,
MOST = 300  # but for no more poses before: each takes the longer the longer the path is
DEAR = 3  # times as many where something is preferred: there is more to try
OTHERS = 30  # other ways looked for by each core
SEARCH = 50_000  # motions guessed about for one of them
BLOCK = 200  # motions checked, or guessed about, between two looks at the clock and at Ctrl-C
LESS = 0.9  # of a distance kept: more is not given for a shorter way

Better = Any  # the core's, of one path: run(checks), merge(), length(), path()


class Improver:
    """Of paths in one scene.

    Parameters
    ----------
    scene : Scene
    checker : MotionChecker
        Of the scene.
    searcher : _core.Searcher
    preferences : Preferences
    stop : Event
        Ends all of it, without a result.
    """

    def __init__(
        self,
        scene: Scene,
        checker: MotionChecker,
        searcher: _core.Searcher,
        preferences: Preferences,
        stop: threading.Event,
    ) -> None:
        self.scene, self.checker, self.searcher, self.stop = scene, checker, searcher, stop
        self._prefers = preferences.matter
        self._enough = threading.Event()

    def shortened(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        """A shorter path."""
        if seconds == 0 or len(poses) < (2 if self._prefers else 3):
            return poses
        return self._best(self._shorter, poses, seconds, lambda _: True)

    def balanced(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        """A path that keeps its distance where there is room, and is short among those; see `cfree.plan`."""
        if seconds == 0 or len(poses) < 2:
            return poses

        first: list[float] = []

        def will_do(better: Better) -> bool:
            return self._least(better) >= LESS * first[0]

        def make(way: Sequence[Pose], seed: int) -> Better:
            better = self._balanced(way, seed)
            if seed == 0 and seconds:
                first.append(self._least(better))
            return better

        found = self._best(make, poses, seconds, will_do)
        same_ends = found[0] == poses[0] and found[-1] == poses[-1]
        return found if same_ends and self.checker.joins(found) else poses  # doubles guided it

    def _shorter(self, poses: Sequence[Pose], seed: int) -> Better:
        found = self.searcher.shortener([*map(end_of, poses)], seed)
        found.run((DEAR if self._prefers else 1) * REFINE)
        return found

    def _balanced(self, poses: Sequence[Pose], seed: int) -> Better:
        found = self.searcher.balanced([*map(end_of, poses)], seed)
        found.run((DEAR if self._prefers else 1) * BALANCE * (len(found.path()) + min(MOST, len(poses))))
        return found

    def _least(self, found: Better) -> float:
        """The least clearance."""
        poses = [*map(from_numbers, found.path())]
        place = clearance(Path(poses[0], [motion_between(a, b) for a, b in pairwise(poses)]), self.scene)
        return place.least if place else math.inf

    def _best(
        self,
        make: Callable[[Sequence[Pose], int], Better],
        poses: Sequence[Pose],
        seconds: float | None,
        will_do: Callable[[Better], bool],
    ) -> Sequence[Pose]:
        """The shortest of what is made of these poses, and in some time of other ways that will do."""
        begin = time.perf_counter()
        try:
            found = [make(poses, 0)]
            if seconds:
                # other threads have work of their own
                cores = os.cpu_count() or 1 if threading.current_thread() is threading.main_thread() else 1
                half, end = begin + seconds / 2, begin + seconds

                def work(core: int) -> list[Better]:
                    own = found[:1] if core == 0 else []
                    for seed in range(core + 1, OTHERS * cores, cores):
                        if way := self._other(poses, seed, half):
                            own += filter(will_do, [make(way, seed)])
                    if not own and not self._is_over(half):
                        own = [make(poses, core)]
                    best = min(own, key=_length, default=None)
                    while best and not self._is_over(end):
                        best.run(BLOCK)
                    return own

                with ThreadPoolExecutor(cores) as pool:
                    futures = [pool.submit(work, core) for core in range(cores)]
                    try:
                        wait(futures)
                    except KeyboardInterrupt:  # enough: there is a path
                        self._enough.set()
                found = [better for future in futures for better in future.result()]
        except KeyboardInterrupt:
            if self.stop.is_set():
                raise
            return poses
        if self.stop.is_set():
            raise KeyboardInterrupt
        best = min(found, key=_length)
        best.merge()
        return [*map(from_numbers, best.path())]

    def _other(self, poses: Sequence[Pose], seed: int, end: float) -> Sequence[Pose] | None:
        """Another way from the first to the last, if one is found in time."""
        search = self.searcher.search(end_of(poses[0]), end_of(poses[-1]), seed)
        for _ in range(0, SEARCH, BLOCK):
            if self._is_over(end):
                return None
            if found := search.run(BLOCK):
                return [*map(from_numbers, found)]
        return None

    def _is_over(self, end: float) -> bool:
        return self.stop.is_set() or self._enough.is_set() or time.perf_counter() > end


def _length(found: Better) -> float:
    return float(found.length())
