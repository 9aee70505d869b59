"""Answers of `cfree plan`: write, draw and film them, and put them into words."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cfree.cli import drawing
from cfree.cli.faults import BAD_INPUT, INCOMPLETE, REFUTED, fail
from cfree.cli.files import bar, computed
from cfree.cli.reading import AS_READ
from cfree.cli.terminal import printable
from cfree.scene.naming import all_placed
from cfree.scene.smooth import smoothed

if TYPE_CHECKING:
    from cfree.analysis.blockers import Blockers
    from cfree.cli.report import Shapes
    from cfree.errors import IncompleteError
    from cfree.exact.pose import Pose
    from cfree.formats.answers.answer_file import Form
    from cfree.paths.path import Path as Motions
    from cfree.paths.preferences import Unwanted
    from cfree.paths.timing import Limits
    from cfree.planning.goals import AllSeparated
    from cfree.planning.planner import Planner
    from cfree.planning.proof import Proof
    from cfree.scene.scene import Scene
    from cfree.vehicles.vehicle import Vehicle


def _is_rounded(answer: Motions | Proof | AllSeparated) -> bool:
    """True for a proof by a surface among rounded shapes, or several of them."""
    return getattr(getattr(answer, "proofs", (answer,))[0], "rounded", None) is not None


@dataclass
class Sampling:
    """The form in which a path is written, and the spacing of its sampled poses.

    Attributes
    ----------
    form : "json", "csv", "ros" or "geojson"
    step : float or None
    turn : float, radians
    limits : Limits or None
        None for poses without times.
    per_gear : bool
    """

    form: Form
    step: float | None
    turn: float
    limits: Limits | None
    per_gear: bool

    @classmethod
    def of(
        cls,
        output: Path | None,
        form: Form | None,
        step: str | None,
        turn: str | None,
        limits: dict[str, str | None],
        per_gear: bool = False,
    ) -> Sampling:
        """Read the options of the command line; `limits` has the texts of those that `timed` takes.

        Raises
        ------
        ValueError
            If an option needs sampled poses, and the form has none; or needs a speed.
        """
        from cfree.cli.values import read_length, read_turn
        from cfree.exact.half_angle import to_rate
        from cfree.formats.answers.answer_file import form_of, limits_of

        form = "json" if output is None or (str(output) == "-" and form is None) else form_of(output, form)
        texts = {name: text for name, text in {"step": step, "turn": turn, **limits}.items() if text}
        if form == "json" and texts:
            wrong = ", ".join(map(_option, texts))
            raise ValueError(f"{wrong}: only for sampled poses; give -o with .csv, .yaml or .geojson, or --format")
        if per_gear and form != "ros":
            raise ValueError("--per-gear: only for ROS messages; give -o with .yaml")
        if per_gear and str(output) == "-":
            raise ValueError("--per-gear: it writes several files; give -o with the name of a .yaml")
        others = [name for name in limits if name in texts]
        if others and "speed" not in texts:
            raise ValueError(f"{', '.join(map(_option, others))}: only with a speed; give --speed as well")
        kinds = {"step": "a length", "speed": "a speed", "acceleration": "an acceleration", "wheelbase": "a length"}
        values: dict[str, Any] = {
            name: float(read_length(texts[name], _option(name), what)) if name in texts else None
            for name, what in kinds.items()
        }
        length = values.pop("step")
        values["steer_rate"] = to_rate(texts.get("steer_rate"), "--steer-rate")
        its = limits_of(**values, stops="cusps" if texts.get("stops") == "cusps" else "all")
        return cls(form, length, read_turn(turn) if turn else math.radians(5), its, per_gear)

    def require_fit(self, vehicle: Vehicle | None) -> None:
        """Raise a ValueError if an option does not fit the vehicle."""
        if self.per_gear and vehicle is None:
            raise ValueError("--per-gear: of a vehicle's path only; give --vehicle, or leave it out")
        if self.limits and (fault := self.limits.fault(vehicle)):
            names, why = fault
            raise ValueError(f"{', '.join(map(_option, names))}: {why}")


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


@dataclass
class Answering:
    """A planning query for a scene, and its answer in all forms wanted.

    Attributes
    ----------
    planner : Planner
    start : Pose
    goal : Pose or None
        None if there are several goals, any of which will do.
    files : dict
        Names of the files to write; files without content are removed from it.
    answer : Path, Separated or AllSeparated
    """

    planner: Planner
    start: Pose
    goal: Pose | None
    files: dict[str, str]
    answer: Motions | Proof | AllSeparated
    first: Motions | Proof | AllSeparated | None = None  # the first path, before its improvement

    @classmethod
    def of(
        cls,
        planner: Planner,
        ends: tuple[Pose | None, Sequence[Any]],
        files: dict[str, str],
        options: dict[str, Any],
        *,
        nearest_free: bool = False,
    ) -> Answering:
        """Plan, with options of `Planner.plan`; end the command if a limit leaves no answer."""
        from cfree.cli.folders import FolderPlanner
        from cfree.collision.nearest_free import ForbiddenPoseError
        from cfree.errors import IncompleteError
        from cfree.exact.pose import Pose
        from cfree.scene.scene import required

        requested_start, goals = ends[0], ends[1] or planner.scene.goals
        is_one = not goals or (len(goals) == 1 and isinstance(goals[0], Pose))
        start, goal = required(
            planner.scene, requested_start, goals[0] if is_one and goals else None if is_one else Pose(0, 0)
        )
        free = None
        if nearest_free:
            from cfree.planning.moved_ends import free_ends
            from cfree.scene.goals import to_goals

            with bar("nearest free poses"):
                several = goal if is_one else to_goals(goals)
                requested = [several] if isinstance(several, Pose) else several
                free = free_ends(planner.scene, start, requested, options["clearance"])
            start, goals = free.start, free.goals
            goal = goals[0] if isinstance(goals[0], Pose) else goal
        try:
            answers = [
                planner.plan(start, goal, **wanted) if is_one else planner.plan_any(start, goals, **wanted)
                for wanted in (*([options | {"improve": 0.0}] if options["improve"] else []), options)
            ]  # the wanted one comes last: the planner keeps the polygons of its last answer
            answers = [free.marked(answer) if free else answer for answer in answers]
            return cls(planner, start, goal if is_one else None, files, *reversed(answers))
        except IncompleteError as error:
            _draw_undecided(error, planner.scene, files.get("picture"))
            fail(str(error), INCOMPLETE)
        except ForbiddenPoseError as error:
            is_folder = isinstance(planner, FolderPlanner)  # it moves no pose
            both = [start, *([goal] if goal else [])]
            remedy = drawing.remedy_for_solids(planner.scene, [pose for pose in both if isinstance(pose, Pose)])
            fail(str(error) if is_folder else f"{error}; or give --nearest-free{remedy}", BAD_INPUT)

    @property
    def path(self) -> Motions | None:
        """The answer, if it is a path."""
        from cfree.paths.path import Path as Motions

        return self.answer if isinstance(self.answer, Motions) else None

    @property
    def exit_code(self) -> int:
        """0 for a path, 1 for a proof that there is none; 3 if a path that touches may exist."""
        proved = getattr(self.answer, "of", None)
        return {None: 0, "interior": INCOMPLETE}.get(proved, REFUTED)

    def write(self, output: Path, poses: Sampling) -> None:
        """Write a path in any form, or a proof as JSON, to a file or to standard output."""
        from cfree.formats.answers.answer_file import text_of_proof, texts_of
        from cfree.formats.text.atomic import replacing
        from cfree.paths.path import Path as Motions

        if isinstance(self.answer, Motions):
            texts = texts_of(
                self.answer,
                output,
                step=poses.step,
                turn=poses.turn,
                limits=poses.limits,
                scene=self.planner.scene,
                form=poses.form,
                per_gear=poses.per_gear,
            )
            if poses.per_gear:
                self.files.pop("answer", None)
                self.files |= {f"run {k}": name for k, name in enumerate(texts, 1)}
        elif poses.form == "json":
            texts = {str(output): text_of_proof(self.answer, output)}
        else:
            self._leave_out("answer", output, f"there is no path to write as {poses.form}; a proof is written as .json")
            return
        for name, text in texts.items():
            if name == "-":
                print(text, end="")
                continue
            with replacing(name) as unfinished:
                unfinished.write_text(text, encoding="utf-8", newline="\n")

    @property
    def scene(self) -> Scene:
        """The scene that was asked about, with its round shapes."""
        scene: Scene = getattr(self.planner, "exact", self.planner.scene)
        return scene

    @property
    def _shapes(self) -> Shapes:
        from cfree.cli.report import Shapes

        return Shapes(self.planner.scene, self.scene, self._own)

    def _own(self, obstacles: Iterable[int]) -> list[int]:
        """Return the obstacles of the scene that was asked about for those of the answer."""
        owner, path = getattr(self.planner, "obstacle_of", None), self.path
        if path is not None and path.scene is None and path.curved:  # it is among the shapes themselves
            return [smoothed(path.curved, k) for k in obstacles]
        if _is_rounded(self.answer):
            return [*obstacles]
        return [*dict.fromkeys(owner(k, outward=path is not None) for k in obstacles)] if owner else [*obstacles]

    @cached_property
    def blockers(self) -> Blockers:
        """Single obstacles whose removal opens a path from start to goal."""
        from cfree.analysis.blockers import blockers

        clearance = getattr(self.answer, "clearance", None) or None
        with bar("what if") as progress:
            return blockers(self.scene, self.start, self.goal, clearance=clearance, progress=progress)

    def draw(self, picture: Path, *, what_if: bool) -> None:
        """Draw the answer with the configuration space (the first of several proofs), or the blockers for `what_if`."""
        from cfree.planning.stuck import Stuck
        from cfree.planning.unreachable import Unreachable
        from cfree.plot.answer import picture as drawn
        from cfree.plot.boundary import save_figure

        preferences = self.planner.preferences
        if what_if and self.path is None and self.goal and self.blockers:
            from cfree.plot.blockers import plot_blockers

            with bar("picture"):
                save_figure(plot_blockers(self.blockers, self.scene, preferences=preferences), picture)
            return
        if isinstance(self.answer, Stuck | Unreachable) or _is_rounded(self.answer):
            with bar("picture"):
                save_figure(drawn(self.answer, self.scene if _is_rounded(self.answer) else self.planner.scene), picture)
            return
        space = self.planner.free_space
        shown = self.answer
        with bar("picture"):
            figure = drawn(shown, self.planner.scene, space.boundary, preferences=preferences)
            save_figure(figure, picture)

    def film(self, film: Path) -> None:
        """Film a path or a proof, the first of several proofs."""
        from cfree.film import film_path, film_separation
        from cfree.paths.path import Path as Motions
        from cfree.planning.goals import AllSeparated
        from cfree.planning.stuck import Stuck
        from cfree.planning.unreachable import Unreachable
        from cfree.scene.rounded import rounded_shapes

        if isinstance(self.answer, Motions):
            with bar("film") as progress:
                film_path(self.answer, self.planner.scene, film, progress=progress)
            return
        shown = self.answer.proofs[0] if isinstance(self.answer, AllSeparated) else self.answer
        if isinstance(shown, Stuck):
            self._leave_out("film", film, "contacts hold the vehicle, and no surface separates start and goal")
            return
        if isinstance(shown, Unreachable):
            self._leave_out("film", film, "boxes hold the car, and no surface separates start and goal")
            return
        if not len(shown.pieces):
            self._leave_out("film", film, "no surface separates start and goal, but exact fits do")
            return
        is_exact = self.scene.curved and rounded_shapes(self.scene) is not None
        boundary = computed(self.scene, None) if is_exact else self.planner.free_space.boundary
        with bar("film") as progress:
            film_separation(shown, boundary, film, progress=progress)

    def rows(
        self, limits: Limits | None = None, *, for_machines: bool, nearest_miss: bool, what_if: bool
    ) -> dict[str, Any]:
        """Describe the answer in words and numbers, with its times if there are limits."""
        from cfree.cli.report import answer_facts, answer_rows, drive_facts, drive_rows, moved_facts, moved_rows
        from cfree.formats.answers.answer_file import in_time

        with bar("least clearance"):
            described = (answer_facts if for_machines else answer_rows)(self.answer, self._shapes)
        moved = moved_facts(self.answer) if for_machines else moved_rows(self.answer)
        rows: dict[str, Any] = {"answer": described["answer"], **moved, **described}
        rows[AS_READ] = self._as_read()
        if self.path is not None and self.first is not None:
            facts, now = (answer_facts(answer, self._shapes) for answer in (self.first, self.answer))
            compared = ("length", "turning", "clearance")
            rows["before it was improved"] = (
                {name: facts[name] for name in compared} if for_machines else _before(facts)
            )
            rows["gained"] = _gained(facts, now) if for_machines else _in_words(_gained(facts, now))
        if self.path is not None and self.planner.preferences.matter:
            from cfree.paths.preferences import unwanted

            parts = unwanted(self.path, self.planner.scene, self.planner.preferences)
            if for_machines:
                rows["rather not"] = [asdict(part) for part in parts]
            else:
                rows["penalised motions"] = self._unwanted(parts)
        if self.path is not None and (drive := in_time(self.path, "times", limits, self.planner.scene)):
            rows |= (drive_facts if for_machines else drive_rows)(drive, self.planner.scene)
        if self.goal is None and self.path is not None:
            goal = self.path.goal
            x, y, theta = float(goal.x), float(goal.y), goal.theta
            text = f"{x:g}, {y:g}, {math.degrees(theta):g} degrees"
            rows["goal reached"] = [x, y, theta] if for_machines else text
        if nearest_miss and self.path is None:
            rows["nearest miss"] = self._nearest_miss() if self.goal else "not of several goals; give one, with theta"
        if what_if and self.path is None and self.goal:
            rows |= self._what_if(for_machines)
        elif what_if and self.path is None:
            rows["what if"] = "not of several goals; give one, with theta"
        return rows

    def _as_read(self) -> str:
        """Return the answer with the worst note of the scene's record, if one harms it."""
        from cfree.cli.report import answer_text
        from cfree.scene.reading_lines import qualified

        scene = self.planner.scene
        return qualified(answer_text(self.answer, scene), scene.reading, "no path" if self.path is None else "path")

    def _what_if(self, for_machines: bool) -> dict[str, Any]:
        obstacles, undecided = [blocker.obstacle for blocker in self.blockers], [*self.blockers.undecided]
        if for_machines:
            return {"what if": obstacles, **({"what if, undecided": undecided} if undecided else {})}
        either = "one of these: " * (len(obstacles) > 1)
        text = f"there is a path without {either}{all_placed(self.scene, obstacles)}"
        if not obstacles:
            text = "no single obstacle, taken away, opens a path" + ("; some are undecided" if undecided else "")
        rows = {"what if": text}
        if undecided:
            rows["what if, undecided"] = all_placed(self.scene, undecided)
        return rows

    def _unwanted(self, parts: Sequence[Unwanted]) -> str:
        units = self.planner.scene.units
        return "; ".join(part.text(units) for part in parts) or "none"

    def _nearest_miss(self) -> str:
        from cfree.analysis.margins import nearest_miss

        try:
            with bar("nearest miss") as progress:
                miss = nearest_miss(self.scene, self.start, self.goal, progress=progress)
        except (ValueError, IncompleteError) as error:  # the answer stands: it may be about a vehicle or a clearance
            return str(error)
        return str(miss) if miss is not None else "no smaller robot gets there either"

    def _leave_out(self, name: str, file: Path, why: str) -> None:
        self.files.pop(name, None)
        print(printable(f"{file} is not written: {why}"), file=sys.stderr)


def _draw_undecided(error: IncompleteError, scene: Scene, file: str | None) -> None:
    """Draw the path that proves that a vehicle has one, if there is such a path, and a picture is wanted."""
    from cfree.errors import UndecidedError
    from cfree.plot.answer import picture
    from cfree.plot.boundary import save_figure

    if file is not None and isinstance(error, UndecidedError) and error.path is not None:
        with bar("picture"):
            save_figure(picture(error, scene), file)
        print(printable(f"picture {file}"), file=sys.stderr)


def _gained(before: dict[str, Any], now: dict[str, Any]) -> dict[str, float]:
    """Gains of the improvement: less length, less rotation, more clearance."""
    gained = {name: before[name] - now[name] for name in ("length", "turning")}
    if before["clearance"] and now["clearance"]:
        gained["clearance"] = now["clearance"]["found"] - before["clearance"]["found"]
    return gained


def _in_words(gained: dict[str, float]) -> str:
    def signed(name: str, more: str, less: str, scale: float = 1.0) -> str:
        value = scale * gained[name]
        return f"{abs(value):.4g} {more if value >= 0 else less}"

    texts = [signed("length", "shorter", "longer"), signed("turning", "degrees less", "degrees more", 180 / math.pi)]
    if "clearance" in gained:
        texts.append(signed("clearance", "more clearance", "less clearance"))
    return ", ".join(texts)


def _before(facts: dict[str, Any]) -> str:
    least = f", least clearance {facts['clearance']['found']:.6g}" if facts["clearance"] else ""
    return f"length {facts['length']:.6g}, total rotation {math.degrees(facts['turning']):.6g} degrees{least}"
