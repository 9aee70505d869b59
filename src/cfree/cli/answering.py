"""What `cfree plan` does with an answer: written, drawn, filmed, put into words."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cfree.cli.faults import BAD_INPUT, INCOMPLETE, REFUTED, fail
from cfree.cli.files import bar
from cfree.cli.terminal import printable
from cfree.scene.naming import all_placed

if TYPE_CHECKING:
    from cfree.analysis.blockers import Blocker
    from cfree.exact.pose import Pose
    from cfree.formats.answers.answer_file import Form
    from cfree.paths.path import Path as Motions
    from cfree.paths.preferences import Unwanted
    from cfree.planning.goals import AllSeparated
    from cfree.planning.planner import Planner
    from cfree.planning.separation import Separated


@dataclass
class Sampling:
    """In which form a path is written, and with which poses.

    Attributes
    ----------
    form : "json", "csv", "ros" or "geojson"
    step, speed : float or None
    turn : float, radians
    """

    form: Form
    step: float | None
    turn: float
    speed: float | None

    @classmethod
    def of(
        cls, output: Path | None, form: Form | None, step: str | None, turn: str | None, speed: str | None
    ) -> Sampling:
        """From the options of the command line.

        Raises
        ------
        ValueError
            If there are no poses for them.
        """
        from cfree.cli.values import read_length, read_turn
        from cfree.formats.answers.answer_file import form_of

        form = "json" if output is None or (str(output) == "-" and form is None) else form_of(output, form)
        given = {name: text for name, text in (("--step", step), ("--turn", turn), ("--speed", speed)) if text}
        if form == "json" and given:
            wrong = ", ".join(given)
            raise ValueError(f"{wrong}: of sampled poses; give -o with .csv, .yaml or .geojson, or --format")
        kinds = {"--step": "a length", "--speed": "a speed"}
        length, most = (
            float(read_length(given[name], name, what)) if name in given else None for name, what in kinds.items()
        )
        return cls(form, length, read_turn(turn) if turn else math.radians(5), most)


@dataclass
class Answering:
    """A question about a scene, and its answer in all forms that are asked for.

    Attributes
    ----------
    planner : Planner
    start : Pose
    goal : Pose or None
        None if any of several will do.
    files : dict
        Names of the files to write; those that there is nothing to write into are taken out.
    answer : Path, Separated or AllSeparated
    """

    planner: Planner
    start: Pose
    goal: Pose | None
    files: dict[str, str]
    answer: Motions | Separated | AllSeparated
    first: Motions | Separated | AllSeparated | None = None  # before it was improved

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
        """The answer, with options of `Planner.plan`, unless a limit leaves the command without one."""
        from cfree.cli.folders import FolderPlanner
        from cfree.collision.nearest_free import ForbiddenPoseError
        from cfree.errors import IncompleteError
        from cfree.exact.pose import Pose
        from cfree.scene.scene import required

        given, goals = ends[0], ends[1] or planner.scene.goals
        is_one = not goals or (len(goals) == 1 and isinstance(goals[0], Pose))
        start, goal = required(planner.scene, given, goals[0] if is_one and goals else None if is_one else Pose(0, 0))
        free = None
        if nearest_free:
            from cfree.planning.moved_ends import free_ends
            from cfree.scene.goals import to_goals

            with bar("nearest free poses"):
                several = goal if is_one else to_goals(goals)
                asked = [several] if isinstance(several, Pose) else several
                free = free_ends(planner.scene, start, asked, options["clearance"])
            start, goals = free.start, free.goals
            goal = goals[0] if isinstance(goals[0], Pose) else goal
        try:
            answers = [
                planner.plan(start, goal, **wanted) if is_one else planner.plan_any(start, goals, **wanted)
                for wanted in (options, *([options | {"improve": 0.0}] if options["improve"] else []))
            ]
            answers = [free.marked(answer) if free else answer for answer in answers]
            return cls(planner, start, goal if is_one else None, files, *answers)
        except IncompleteError as error:
            fail(str(error), INCOMPLETE)
        except ForbiddenPoseError as error:
            is_folder = isinstance(planner, FolderPlanner)  # which moves nothing
            fail(str(error) if is_folder else f"{error}; or give --nearest-free", BAD_INPUT)

    @property
    def path(self) -> Motions | None:
        """The answer, if it is a path."""
        from cfree.paths.path import Path as Motions

        return self.answer if isinstance(self.answer, Motions) else None

    @property
    def exit_code(self) -> int:
        """0 for a path, 1 for a proof that there is none; 3 if one that touches may exist."""
        of = getattr(self.answer, "of", None)
        return {None: 0, "closed": REFUTED}.get(of, INCOMPLETE)

    def write(self, output: Path, poses: Sampling) -> None:
        """A path in any form, a proof as JSON; to a file or to standard output."""
        from cfree.formats.answers.answer_file import text_of, text_of_proof
        from cfree.formats.text.atomic import replacing
        from cfree.paths.path import Path as Motions

        if isinstance(self.answer, Motions):
            scene = self.planner.scene
            text = text_of(
                self.answer, output, step=poses.step, turn=poses.turn, speed=poses.speed, scene=scene, form=poses.form
            )
        elif poses.form == "json":
            text = text_of_proof(self.answer, output)
        else:
            self._leave_out("answer", output, f"there is no path to write as {poses.form}; a proof is written as .json")
            return
        if str(output) == "-":
            print(text, end="")
        else:
            with replacing(output) as unfinished:
                unfinished.write_text(text, encoding="utf-8", newline="\n")

    @cached_property
    def blockers(self) -> tuple[Blocker, ...]:
        """Obstacles that, taken away, open a way from start to goal."""
        from cfree.analysis.blockers import blockers

        clearance = getattr(self.answer, "clearance", None) or None
        with bar("what if") as progress:
            return blockers(self.planner.scene, self.start, self.goal, clearance=clearance, progress=progress)

    def draw(self, picture: Path, *, what_if: bool) -> None:
        """The picture, with the configuration space, of several proofs that of the first; or what opens a way."""
        from cfree.paths.path import Path as Motions
        from cfree.planning.separation import Separated
        from cfree.plot.answer import picture as drawn
        from cfree.plot.boundary import save_figure

        preferences = self.planner.preferences
        if what_if and self.path is None and self.goal and self.blockers:
            from cfree.plot.blockers import plot_blockers

            with bar("picture"):
                save_figure(plot_blockers(self.blockers, self.planner.scene, preferences=preferences), picture)
            return
        space = self.planner.free_space
        shown = self.answer if isinstance(self.answer, Motions | Separated) else self.answer.proofs[0]
        with bar("picture"):
            figure = drawn(shown, self.planner.scene, space.boundary, preferences=preferences)
            save_figure(figure, picture)

    def film(self, film: Path) -> None:
        """The film of a path, or of a proof; of several proofs that of the first."""
        from cfree.film import film_path, film_separation
        from cfree.paths.path import Path as Motions
        from cfree.planning.separation import Separated

        if isinstance(self.answer, Motions):
            with bar("film") as progress:
                film_path(self.answer, self.planner.scene, film, progress=progress)
            return
        shown = self.answer if isinstance(self.answer, Separated) else self.answer.proofs[0]
        if not len(shown.pieces):
            self._leave_out("film", film, "start and goal are parted by no surface, but by what fits exactly")
            return
        boundary = self.planner.free_space.boundary
        with bar("film") as progress:
            film_separation(shown, boundary, film, progress=progress)

    def rows(self, *, for_machines: bool, nearest_miss: bool, what_if: bool) -> dict[str, Any]:
        """The answer in words and numbers."""
        from cfree.cli.report import answer_facts, answer_rows, moved_facts, moved_rows

        with bar("least clearance"):
            said = (answer_facts if for_machines else answer_rows)(self.answer, self.planner.scene)
        moved = moved_facts(self.answer) if for_machines else moved_rows(self.answer)
        rows: dict[str, Any] = {"answer": said["answer"], **moved, **said}
        if self.path is not None and self.first is not None:
            facts = answer_facts(self.first, self.planner.scene)
            now = answer_facts(self.answer, self.planner.scene)
            kept = ("length", "turning", "clearance")
            rows["before it was improved"] = {name: facts[name] for name in kept} if for_machines else _before(facts)
            rows["gained"] = _gained(facts, now) if for_machines else _in_words(_gained(facts, now))
        if self.path is not None and self.planner.preferences.matter:
            from cfree.paths.preferences import unwanted

            found = unwanted(self.path, self.planner.scene, self.planner.preferences)
            rows["rather not"] = [asdict(part) for part in found] if for_machines else self._unwanted(found)
        if self.goal is None and self.path is not None:
            goal = self.path.goal
            x, y, theta = float(goal.x), float(goal.y), goal.theta
            text = f"{x:g}, {y:g}, {math.degrees(theta):g} degrees"
            rows["goal reached"] = [x, y, theta] if for_machines else text
        if nearest_miss and self.path is None:
            rows["nearest miss"] = self._nearest_miss() if self.goal else "not of several goals; give one, with theta"
        if what_if and self.path is None:
            rows["what if"] = self._what_if(for_machines) if self.goal else "not of several goals; give one, with theta"
        return rows

    def _what_if(self, for_machines: bool) -> str | list[int]:
        found = [blocker.obstacle for blocker in self.blockers]
        if for_machines:
            return found
        if not found:
            return "no single obstacle, taken away, opens a way"
        either = "one of these: " * (len(found) > 1)
        return f"there is a way without {either}{all_placed(self.planner.scene, found)}"

    def _unwanted(self, found: Sequence[Unwanted]) -> str:
        units = self.planner.scene.units
        return "; ".join(part.text(units) for part in found) or "nothing of it"

    def _nearest_miss(self) -> str:
        from cfree.analysis.margins import nearest_miss

        with bar("nearest miss") as progress:
            found = nearest_miss(self.planner.scene, self.start, self.goal, progress=progress)
        return str(found) if found is not None else "no smaller robot gets there either"

    def _leave_out(self, name: str, file: Path, why: str) -> None:
        self.files.pop(name, None)
        print(printable(f"{file} is not written: {why}"), file=sys.stderr)


def _gained(before: dict[str, Any], now: dict[str, Any]) -> dict[str, float]:
    """How much shorter, how much less turning, how much more clearance."""
    gained = {name: before[name] - now[name] for name in ("length", "turning")}
    if before["clearance"] and now["clearance"]:
        gained["clearance"] = now["clearance"]["found"] - before["clearance"]["found"]
    return gained


def _in_words(gained: dict[str, float]) -> str:
    def signed(name: str, more: str, less: str, scale: float = 1.0) -> str:
        value = scale * gained[name]
        return f"{abs(value):.4g} {more if value >= 0 else less}"

    texts = [signed("length", "less way", "more way"), signed("turning", "degrees less", "degrees more", 180 / math.pi)]
    if "clearance" in gained:
        texts.append(signed("clearance", "more clearance", "less clearance"))
    return ", ".join(texts)


def _before(facts: dict[str, Any]) -> str:
    least = f", least clearance {facts['clearance']['found']:.6g}" if facts["clearance"] else ""
    return f"way {facts['length']:.6g}, turning {math.degrees(facts['turning']):.6g} degrees{least}"
