"""Improvement of a path: in a number of attempts, or in some time on all cores.

With a time, each core searches for other paths in half of it, with its own random numbers, and improves its best one
in the rest. The best of all is the result.
"""

from __future__ import annotations

import math
import os
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import cfree._core as _core
from cfree.collision.motion import joining
from cfree.collision.motion_checker import MotionChecker
from cfree.exact.pose import Pose
from cfree.paths.clearance import clearance
from cfree.paths.path import Path
from cfree.paths.preferences import Preferences
from cfree.planning.core_ways import end_of, from_numbers
from cfree.scene.scene import Scene

REFINE = 400  # motions checked to improve a path without a time limit
BALANCE = 30  # motions checked for each pose of a path that keeps a distance, counted before and after balancing
LEAST = 1000  # least motions checked: paths of few poses are cheap
MOST = 300  # most poses counted before balancing: a check takes longer the longer the path is
DEAR = 3  # factor of these numbers with preferences: there is more to try
OTHERS = 30  # other paths that each core searches for
SEARCH = 50_000  # motions tried, without proof, in one search
BLOCK = 200  # motions checked or tried between two checks of the clock and of Ctrl-C
PUSHED = 1 / 16  # radii up to which a path is pushed away from obstacles to be free of them
LESS = 0.9  # least share of the first path's clearance that a shorter path must keep

Better = Any  # the core's improver of one path: run(checks), merge(), length(), path()


class Improver:
    """Improver of paths in one scene.

    Parameters
    ----------
    scene : Scene
    checker : MotionChecker
        A checker of the scene.
    searcher : _core.Searcher
    preferences : Preferences
    stop : Event
        Ends all work without a result.
    has_center : bool
        True if the searcher has a center, about which it turns poses so that paths turn less.
    """

    def __init__(
        self,
        scene: Scene,
        checker: MotionChecker,
        searcher: _core.Searcher,
        preferences: Preferences,
        stop: threading.Event,
        has_center: bool = False,
    ) -> None:
        self.scene, self.checker, self.searcher, self.stop = scene, checker, searcher, stop
        self._has_center = has_center
        self._prefers = preferences.matter
        self._enough = threading.Event()

    def shortened(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        """Return a shorter path."""
        if seconds == 0 or len(poses) < (2 if self._prefers else 3):
            return poses
        return self._best(self._shorter, poses, seconds, lambda _: True)

    def balanced(self, poses: Sequence[Pose], seconds: float | None) -> Sequence[Pose]:
        """Return a short path that keeps its distance where there is room; see `cfree.plan`."""
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

        return self._checked(poses, self._best(make, poses, seconds, will_do))

    def balanced_once(self, poses: Sequence[Pose]) -> Sequence[Pose]:
        """Return `balanced` without a time limit; Ctrl-C ends it without a result."""
        if len(poses) < 2:
            return poses
        return self._finished(poses, self._balanced(poses, 0))

    def farther(self, poses: Sequence[Pose]) -> Iterator[Sequence[Pose]]:
        """Yield a path with the same ends farther from obstacles, unchecked; then `balanced_once`."""
        better = self.searcher.balanced([*map(end_of, poses)], 0, math.inf)
        yield [*map(from_numbers, better.path())]
        yield self._finished(poses, self._run(poses, better))

    def pushed(self, poses: Sequence[Pose], motions: Sequence[int]) -> Iterator[Sequence[Pose]]:
        """Yield a path farther from obstacles, unchecked, after checks of so many motions, and of more."""
        better, before = self.searcher.balanced([*map(end_of, poses)], 0, PUSHED), 0
        for count in motions:
            better.run(count - before)
            before = count
            yield [*map(from_numbers, better.path())]

    def turning_less(self, poses: Sequence[Pose]) -> Sequence[Pose]:
        """Return a path through the same places that turns less, if there is one."""
        if not self._has_center or len({pose.tau for pose in poses}) == 1:
            return poses
        better = self.searcher.shortener([*map(end_of, poses)], 0)
        better.turn_less()
        return self._checked(poses, [*map(from_numbers, better.path())])

    def _finished(self, poses: Sequence[Pose], better: Better) -> Sequence[Pose]:
        better.merge()
        return self._checked(poses, [*map(from_numbers, better.path())])

    def _checked(self, poses: Sequence[Pose], best: Sequence[Pose]) -> Sequence[Pose]:
        """Return the better path if it is free, exactly."""
        same_ends = best[0] == poses[0] and best[-1] == poses[-1]
        return best if same_ends and self.checker.joins(best) else poses  # the search is in doubles

    def _shorter(self, poses: Sequence[Pose], seed: int) -> Better:
        better = self.searcher.shortener([*map(end_of, poses)], seed)
        better.run((DEAR if self._prefers else 1) * REFINE)
        return better

    def _balanced(self, poses: Sequence[Pose], seed: int) -> Better:
        return self._run(poses, self.searcher.balanced([*map(end_of, poses)], seed, math.inf))

    def _run(self, poses: Sequence[Pose], better: Better) -> Better:
        """Balance a path in the usual number of attempts."""
        checks = max(LEAST, BALANCE * (len(better.path()) + min(MOST, len(poses))))
        better.run((DEAR if self._prefers else 1) * checks)
        return better

    def _least(self, better: Better) -> float:
        """Return the least clearance of a path."""
        poses = [*map(from_numbers, better.path())]
        place = clearance(Path(poses[0], [joining(a, b) for a, b in pairwise(poses)]), self.scene)
        return place.least if place else math.inf

    def _best(
        self,
        make: Callable[[Sequence[Pose], int], Better],
        poses: Sequence[Pose],
        seconds: float | None,
        will_do: Callable[[Better], bool],
    ) -> Sequence[Pose]:
        """Return the shortest improvement of this path, and of other acceptable paths found within the time limit."""
        begin = time.perf_counter()
        try:
            candidates = [make(poses, 0)]
            if seconds:
                # several cores only if called in the main thread: other threads share the cores already
                cores = os.cpu_count() or 1 if threading.current_thread() is threading.main_thread() else 1
                half, end = begin + seconds / 2, begin + seconds

                def work(core: int) -> list[Better]:
                    own = candidates[:1] if core == 0 else []
                    for seed in range(core + 1, OTHERS * cores, cores):
                        if way := self._other(poses, seed, half):
                            own += filter(will_do, [make(self.turning_less(way), seed)])
                    if not own and not self._is_over(half):
                        own = [make(poses, core)]
                    best = min(own, key=_length, default=None)
                    while best and not self._is_over(end):
                        best.run(BLOCK)
                    return own

                from concurrent.futures import ThreadPoolExecutor, wait

                with ThreadPoolExecutor(cores) as pool:
                    futures = [pool.submit(work, core) for core in range(cores)]
                    try:
                        wait(futures)
                    except KeyboardInterrupt:  # there is a path already
                        self._enough.set()
                candidates = [better for future in futures for better in future.result()]
        except KeyboardInterrupt:
            if self.stop.is_set():
                raise
            return poses
        if self.stop.is_set():
            raise KeyboardInterrupt
        best = min(candidates, key=_length)
        best.merge()
        return [*map(from_numbers, best.path())]

    def _other(self, poses: Sequence[Pose], seed: int, end: float) -> Sequence[Pose] | None:
        """Search for another path from the first pose to the last; None if none is found in time."""
        search = self.searcher.search(end_of(poses[0]), end_of(poses[-1]), seed)
        for _ in range(0, SEARCH, BLOCK):
            if self._is_over(end):
                return None
            if numbers := search.run(BLOCK):
                return [*map(from_numbers, numbers)]
        return None

    def _is_over(self, end: float) -> bool:
        return self.stop.is_set() or self._enough.is_set() or time.perf_counter() > end


def _length(better: Better) -> float:
    return float(better.length())
