"""Ask questions in both directions and in other words; save, load, verify and replay the answers, until a time is up.

    python tests/support/fuzz_answers.py --seconds 600 --seed 7 --families slot room tiny
    python tests/support/fuzz_answers.py SCENE.json

Question k of family f is the same for ever. The first have the number `--seed`, and the last line gives the next one. A
fault is shown when its kind is new in a family, and made small when it is new at all; the summary counts it.
"""

from __future__ import annotations

import argparse
import contextlib
import random
import re
import sys
import tempfile
import time
import traceback
from collections import Counter, defaultdict
from dataclasses import dataclass, field, replace
from pathlib import Path as FilePath
from typing import Any

import fuzz
import second_opinion
from cfree import Path, Scene, Separated, load_scene, plan, save
from cfree.errors import InvalidPolygonError, InvalidPoseError, UnsupportedError
from cfree.formats.answers.answer_file import load_answer
from cfree.formats.scene_file import scene_text
from laws import broken, laws
from questions import FAMILIES, Question, question
from replay import CLOSE, collisions, deviation
from shapes import PlainScene
from workers import Lost, Worker, limited

PATIENCE = 20.0  # seconds of CPU for one answer with all its checks
SHRINKING = 15.0  # seconds of CPU for making a question small
EVERY = 300.0  # seconds between two summaries
LAWS = 2  # other questions for each, beside the way back, and its origin
WAYS: tuple[dict[str, Any], ...] = ({"improve": 0}, {"objective": "short"}, {"objective": "clear", "improve": 0})

Fault = tuple[str, str]  # kind, for counting; details


@dataclass
class Outcome:
    """Results of a question and its relatives."""

    verdicts: list[str] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)


def examined(asked: Question, seed: str, most: int = LAWS) -> Outcome:
    """Ask the question, its way back, and a few of its other relatives."""
    rng, outcome = random.Random(seed), Outcome()
    verdict = _answered(asked, outcome, **rng.choices(WAYS, [8, 1, 1])[0])
    if asked.known and verdict and verdict not in (asked.known, "refused"):
        outcome.faults.append((f"known: {asked.known}, answer: {verdict}", ""))
    if verdict not in ("path", "closed", "interior"):
        return outcome
    related = list(laws(rng, asked))
    first, others = (related[:2], related[2:]) if asked.origin else (related[:1], related[1:])
    for law in [*first, *rng.sample(others, min(most, len(others)))]:
        other = _answered(law.other, outcome)
        if other in ("path", "closed", "interior") and (wrong := broken(law, verdict, other)):
            outcome.faults.append((wrong, f"the other: {scene_text(law.other.scene)}"))
        elif other == "forbidden":
            outcome.faults.append((f"{law.name}: {verdict}, then a forbidden pose", ""))
    return outcome


def _answered(asked: Question, outcome: Outcome, **way: Any) -> str | None:
    """Verdict, after its evidence was checked; None if there was a fault instead."""
    try:
        with limited(PATIENCE):
            scene = asked.scene
            answer = plan(scene, **(way or WAYS[0]))
            outcome.faults += evidence(scene, answer)
            verdict = "path" if isinstance(answer, Path) else answer.of
    except InvalidPoseError:
        verdict = "forbidden"
    except UnsupportedError:
        verdict = "refused"
    except Exception as error:
        outcome.verdicts.append("error")
        outcome.faults.append((_kind(error), traceback.format_exc()))
        return None
    outcome.verdicts.append(verdict)
    return verdict


def evidence(scene: Scene, answer: Path | Separated) -> list[Fault]:
    """Faults of an answer in a file."""
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder) / "answer.json"
        save(answer, file)
        faults = [] if load_answer(file) == answer else [("another answer after loading", "")]
        result = second_opinion.verified(scene, file)
        if not result.verified:
            kinds = sorted({finding.kind for finding in result.findings})
            faults.append((f"not verified: {', '.join(kinds)}", "; ".join(map(str, result.findings[:2]))))
        if isinstance(answer, Path) and (astray := deviation(scene, answer, file)) > CLOSE:
            faults.append(("decimals lead astray", f"by {astray:.3g} robot sizes"))
        if isinstance(answer, Path) and (count := collisions(scene, file)):
            faults.append(("decimals collide", f"{count} poses of those that are called free"))
        return faults


def _kind(error: Exception) -> str:
    """Name of the error, and the innermost place in the package."""
    places = [frame for frame in traceback.extract_tb(error.__traceback__) if "cfree" in frame.filename]
    place = f" in {FilePath(places[-1].filename).stem}.{places[-1].name}" if places else ""
    return f"{type(error).__name__}{place}: {re.sub(r'[0-9]+|[^ ]*/[^ ]*', '.', str(error))[:60]}"


# --- making a question small ---


def reduced(asked: Question, seed: str, kind: str) -> Question:
    """Smaller question with the same fault, found in time."""
    end = time.process_time() + SHRINKING

    def fails(plain: PlainScene) -> bool:
        with contextlib.suppress(InvalidPolygonError):
            faults = (
                examined(replace(asked, plain=plain, origin=None), seed).faults if time.process_time() < end else []
            )
            return any(fault[0] == kind for fault in faults)
        return False

    if kind.startswith(("known", "decimals")):  # nothing smaller is known to be wrong, or is of use
        return asked
    small = fuzz.reduced(asked.plain, fails)
    return asked if small == asked.plain else replace(asked, plain=small, origin=None)


# --- the run ---


def work(name: tuple[str, int, str | None]) -> tuple[Outcome | None, str]:
    """Results of a question, and its scene; with a kind of fault, of the question made small."""
    family, number, kind = name
    asked, seed = question(family, number), f"laws {family} {number}"
    if asked is None:
        return None, ""
    if kind is None:
        return examined(asked, seed), scene_text(asked.scene)
    small = reduced(asked, seed, kind)
    return examined(small, seed), scene_text(small.scene)


@dataclass
class Tally:
    """Counts by family."""

    verdicts: defaultdict[str, Counter[str]] = field(default_factory=lambda: defaultdict(Counter))
    faults: defaultdict[str, Counter[str]] = field(default_factory=lambda: defaultdict(Counter))

    @property
    def scenes(self) -> int:
        return sum(sum(counts.values()) for counts in self.verdicts.values())

    def __str__(self) -> str:
        lines = [f"{self.scenes:,} scenes"]
        for family, counts in self.verdicts.items():
            lines.append(f"  {family}: {sum(counts.values()):,}; " + _listed(counts))
            lines += [f"    {n} x {kind}" for kind, n in self.faults[family].most_common()]
        return "\n".join(lines)


def _listed(counts: Counter[str]) -> str:
    return ", ".join(f"{n:,} {name}" for name, n in sorted(counts.items()))


def run(families: list[str], seed: int, seconds: float, most: int) -> int:
    """Ask until a time is up or so many scenes are done; families share the time alike. Return 1 after a fault."""
    end, tally, worker = time.monotonic() + seconds, Tally(), Worker(work, 10 * PATIENCE)
    numbers, spent = dict.fromkeys(families, seed), dict.fromkeys(families, 0.0)
    shown = time.monotonic()
    while time.monotonic() < end and tally.scenes < most:
        family = min(families, key=spent.__getitem__)
        number, begin = numbers[family], time.monotonic()
        numbers[family] += 1
        try:
            outcome, text = worker.ask((family, number, None))
        except Lost as error:
            outcome, text = Outcome(["error"], [(str(error), "")]), ""
        spent[family] += time.monotonic() - begin
        if outcome:
            _report(outcome, text, (family, number), tally, worker)
        if time.monotonic() > shown + EVERY:
            shown = time.monotonic()
            print(f"{time.strftime('%H:%M')} {tally}", flush=True)
    print(f"{tally}\ngo on with --seed {max(numbers.values())}")
    return int(any(tally.faults.values()))


def _report(outcome: Outcome, text: str, name: tuple[str, int], tally: Tally, worker: Worker) -> None:
    """Count the results of a question; show new faults."""
    family, seen = name[0], {kind for counts in tally.faults.values() for kind in counts}
    if "interior" in outcome.verdicts and not tally.verdicts[family]["interior"]:
        print(f"--- {family} {name[1]}: interior", text, sep="\n", flush=True)
    tally.verdicts[family].update(outcome.verdicts)
    for kind, what in outcome.faults:
        tally.faults[family][kind] += 1
        if tally.faults[family][kind] == 1:
            if kind not in seen and text:
                with contextlib.suppress(Lost):
                    small, text = worker.ask((*name, kind))
                    what = next((what for other, what in small.faults if other == kind), what)
            print(f"--- {family} {name[1]}: {kind}", what, text, sep="\n", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", type=FilePath, help="files with start and goal, instead of random ones")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--count", type=int, default=sys.maxsize, help="scenes at most, relatives counted")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--families", nargs="+", default=list(FAMILIES), choices=FAMILIES)
    options = parser.parse_args()
    if not options.scenes:
        return run(options.families, options.seed, options.seconds, options.count)
    outcomes = {path: examined(Question.of(load_scene(path)), "0", 99) for path in options.scenes}
    for path, outcome in outcomes.items():
        print(path, *outcome.verdicts, *(": ".join(fault) for fault in outcome.faults), sep="\n  ")
    return int(any(outcome.faults for outcome in outcomes.values()))


if __name__ == "__main__":
    sys.exit(main())
