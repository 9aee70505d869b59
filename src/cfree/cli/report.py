"""Reports of the commands, for a terminal or for machines."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from cfree.cli.reading import AS_READ, facts, last_line
from cfree.cli.terminal import columns, print_json, printable, terminal_width
from cfree.exact.pose import Pose
from cfree.scene.goals import Goal, Moved, text_of
from cfree.scene.naming import all_placed
from cfree.scene.scene import round_count, shapes_of
from cfree.words import counted

if TYPE_CHECKING:
    from cfree.forbidden.boundary import Boundary
    from cfree.paths.path import Path
    from cfree.paths.timing import Timed
    from cfree.planning.goals import AllSeparated
    from cfree.planning.proof import Proof
    from cfree.scene.scene import Scene
    from cfree.verify import Verification

ENDS_OF_BOXES = {"start": "from the start", "goal": "back in time from the goal"}
COUNTS = ("polygons", "vertices", "convex", "reflex", "holes", "pieces")


def print_scene(facts: Mapping[str, Any]) -> None:
    """Print the facts of `cfree.cli.describe.describe`."""
    counts = [
        [row, *(f"{facts[row][column]:,}" for column in COUNTS)]
        for row in ("robot", "obstacles", "workspace")
        if facts[row]
    ]
    _print(facts["name"] or facts["file"], *columns([["", *COUNTS], *counts], "<" + ">" * len(COUNTS)), *_lines(facts))


def _lines(facts: Mapping[str, Any]) -> Iterator[str]:
    patches = facts["patches"]
    contacts = patches["v-e"] + patches["e-v"] + patches.get("arc-arc", 0)
    bounds = f"; and {patches['bound']:,} sides of the bounds" if patches["bound"] else ""
    kinds = ", ".join(f"{patches[kind]:,} {kind}" for kind in ("v-e", "e-v", "arc-arc") if kind in patches)
    yield f"patches    {contacts:,} contact patches before trimming: {kinds}{bounds}"
    if facts.get("round"):
        others = facts["round"] - facts["exact"]
        parts = [f"{facts['exact']:,} exact, counted as cores"] if facts["exact"] else []
        parts += [f"{others:,} counted as polygons around them"] if others else []
        parts += [facts["healing"]] if facts["healing"] else []
        yield f"round      {counted(facts['round'], 'shape')}: {'; '.join(parts)}"
    if facts["bounds"]:
        x0, y0, x1, y1 = facts["bounds"]
        yield f"bounds     x from {x0:g} to {x1:g}, y from {y0:g} to {y1:g}"
    goals = {f"goal {k}": pose for k, pose in enumerate(facts["goals"])}
    for name, pose in {"start": facts["start"], "goal": facts["goal"], **goals}.items():
        if pose:
            verdict = {True: "free", False: "FORBIDDEN", None: "undecided"}[pose["free"]]
            theta = "any theta" if pose["degrees"] is None else f"theta {pose['degrees']:g} degrees"
            yield f"{name:<10} x {pose['x']:g}, y {pose['y']:g}, {theta}: {verdict}"
    for point in facts["removed"]:
        place = "outer ring" if point["ring"] == 0 else f"hole {point['ring'] - 1}"
        yield f"removed    {point['shape']}: {place}, point {point['index']}: {point['reason']}"
    if facts["format"] != "scene":
        yield f"read as    {facts['format']}"
    for name in ("units", "note"):
        if facts[name]:
            yield f"{name:<10} {facts[name]}"
    for name, value in facts["source"].items():
        yield f"source     {name}: {value}"
    for name, file in facts.get("files", {}).items():
        yield f"{name:<10} {file}"
    if line := last_line():
        yield line


def boundary_rows(boundary: Boundary, *, verbose: bool) -> dict[str, int | float | str]:
    """Describe a boundary in words, with the counters of the work if `verbose`."""
    stats, counts = boundary.stats, boundary.patch_counts
    bounds = (
        {"sides of the bounds": counts.bounds, "live sides of the bounds": counts.live_bounds} if counts.bounds else {}
    )
    rows: dict[str, int | float | str] = {
        "contact patches": counts.contacts,
        "live contact patches": counts.live_contacts,
        **bounds,
        "trapezoids": stats.trapezoids,
        **_exactness(boundary),
    }
    return (
        rows
        if not verbose
        else rows
        | {
            "patch and pillar pairs": stats.pairs,
            "decided by equal features": stats.decided_by_identity,
            "decided by doubles with a bound": stats.decided_by_filter,
            "decided by intervals": stats.decided_by_intervals,
            "decided by exact integers": stats.decided_exactly,
            **{f"seconds, {phase}": f"{value:.4f}" for phase, value in stats.seconds.items()},
        }
    )


def _exactness(boundary: Boundary) -> dict[str, int]:
    rounds = {"round shapes, exact": round_count(shapes_of(boundary.scene))} if boundary.scene.curved else {}
    return {**rounds, "isolated parts (exact fits)": len(boundary.isolated)}


def boundary_facts(boundary: Boundary) -> dict[str, Any]:
    """Describe a boundary by numbers, for machines."""
    return asdict(boundary.stats) | {
        "isolated": len(boundary.isolated),
        "round": round_count(shapes_of(boundary.scene)),
    }


@dataclass(frozen=True)
class Shapes:
    """The scene of an answer, and the shapes that its obstacles stand for: polygons may replace round ones.

    Attributes
    ----------
    scene : Scene
        The scene of polygons, or the one that was asked about.
    asked : Scene
        The one that was asked about.
    own : callable
        Returns its obstacles for those of an answer.
    """

    scene: Scene
    asked: Scene
    own: Callable[[Iterable[int]], list[int]]

    def placed(self, obstacles: Iterable[int]) -> str:
        """Return the numbers, names, sizes and places of the obstacles of an answer."""
        return all_placed(self.asked, self.own(obstacles))


def answer_rows(answer: Path | Proof | AllSeparated, shapes: Shapes) -> dict[str, int | float | str]:
    """Describe an answer in words and numbers."""
    from cfree.paths.clearance import own_clearance, rounded_down
    from cfree.paths.path import Path
    from cfree.planning.separation import Separated
    from cfree.planning.stuck import Stuck
    from cfree.planning.unreachable import Unreachable

    scene = shapes.scene
    unit = f" {scene.units}" if scene.units else ""
    if not isinstance(answer, Path):
        if isinstance(answer, Stuck):
            return {
                "answer": answer_text(answer, scene),
                "poses along contacts": f"{len(answer.rail):,}",
                "touched obstacles": shapes.placed(answer.obstacles),
            }
        if isinstance(answer, Unreachable):
            grid = answer.grid
            return {
                "answer": answer_text(answer, scene),
                "boxes": f"{answer.count:,} of {grid.count:,} hold what it reaches {ENDS_OF_BOXES[answer.at]}",
                "size of a box": f"{float(grid.side):.3g}{unit}, {math.degrees(grid.turn):.3g} degrees",
            }
        if not isinstance(answer, Separated):
            return {
                "answer": answer_text(answer, scene),
                "goals": f"{len(answer.goals):,}",
                "proofs": f"{len(answer.proofs):,}",
                "blocking obstacles": shapes.placed(answer.obstacles),
            }
        return {
            "answer": answer_text(answer, scene),
            "separating surface": f"{counted(len(answer.pieces), 'piece')} of contact surfaces",
            "blocking obstacles": shapes.placed(answer.obstacles),
        }
    rows: dict[str, int | float | str] = {
        "answer": answer_text(answer, scene),
        **{name: count for name, count in motion_counts(answer).items() if count or name != "slides"},
        "path length": f"{answer.length:.6g}{unit}",
        "total rotation": f"{math.degrees(answer.turning):.6g} degrees",
    }
    if answer.vehicle:
        facts = driving_facts(answer)
        radius = facts["least radius"]
        rows |= {
            "changes of direction": facts["cusps"],
            "stops": facts["stops"],
            "backward": f"{facts['backward']:.6g}{unit} of {facts['travel']:.6g}{unit}, at the axle point",
            "least radius": "none, all motions are straight" if radius is None else f"{radius:.6g}{unit}",
            "shortest motion": f"{facts['shortest']:.6g}{unit}",
        }
        if answer.vehicle.kind == "differential":
            rows["turned in place"] = f"{math.degrees(facts['in place']):.6g} degrees"
    if least := own_clearance(answer, scene):
        name = shapes.placed(least.obstacle[:1])
        rows["least clearance"] = f"{least.found:.6g}{unit}, in motion {least.motion}, to {name}"
        rows["proved lower bound"] = f"{rounded_down(max(least.least, float(answer.clearance)), 6)}{unit}"
    return rows


def answer_text(answer: Path | Proof | AllSeparated, scene: Scene) -> str:
    """Return the statement of an answer."""
    from cfree.paths.path import Path
    from cfree.planning.separation import Separated
    from cfree.planning.stuck import Stuck
    from cfree.planning.unreachable import Unreachable
    from cfree.vehicles.vehicle import described

    if isinstance(answer, Stuck):
        return f"stuck, proved: {answer.sentence()}"
    if isinstance(answer, Unreachable):
        return f"unreachable, proved: {answer.sentence()}"
    keeping = f"{float(answer.clearance):g}{f' {scene.units}' if scene.units else ''}" if answer.clearance else ""
    if isinstance(answer, Path):
        drives = f", which {described(answer.vehicle, scene.units)} can drive" if answer.vehicle else ""
        return f"a path, each motion proved free{f' and to keep {keeping}' if keeping else ''}{drives}"
    verdict = {
        "closed": "no path at all, proved",
        "interior": "no path of positive clearance, proved",
        "pieces": "no path of finitely many lines and arcs of the vehicle, proved",
    }[answer.of]
    if keeping:
        verdict = f"no path that keeps {keeping}, proved"
    return verdict if isinstance(answer, Separated) else f"to none of the goals: {verdict}"


def answer_facts(answer: Path | Proof | AllSeparated, shapes: Shapes) -> dict[str, Any]:
    """Describe an answer by numbers, for machines: lengths in the scene's unit, angles in radians."""
    from cfree.paths.clearance import own_clearance
    from cfree.paths.path import Path
    from cfree.planning.goals import AllSeparated
    from cfree.planning.stuck import Stuck
    from cfree.planning.unreachable import Unreachable

    numbers: dict[str, Any]
    if isinstance(answer, AllSeparated):
        numbers = {"answer": "all separated", "of": answer.of, "goals": len(answer.goals), "proofs": len(answer.proofs)}
        return numbers | {"obstacles": shapes.own(answer.obstacles)}
    if isinstance(answer, Stuck):
        numbers = {"answer": "stuck", "at": answer.at, "of": answer.of, "poses": len(answer.rail)}
        return numbers | {"obstacles": shapes.own(answer.obstacles)}
    if isinstance(answer, Unreachable):
        grid = answer.grid
        return {
            "answer": "unreachable",
            "at": answer.at,
            "boxes": answer.count,
            "side": float(grid.side),
            "turn": grid.turn,
        }
    if not isinstance(answer, Path):
        facts: dict[str, Any] = {"of": answer.of, "pieces": len(answer.pieces)}
        facts |= {"asked clearance": float(answer.clearance)} if answer.clearance else {}
        return {"answer": "separated"} | facts | {"obstacles": shapes.own(answer.obstacles)}
    numbers = {"answer": "path", **motion_counts(answer)}
    numbers |= {"length": answer.length, "turning": answer.turning, "clearance": None}
    if answer.vehicle:
        numbers["driving"] = {"vehicle": answer.vehicle.kind, **driving_facts(answer)}
    if answer.clearance:
        numbers["asked clearance"] = float(answer.clearance)
    if least := own_clearance(answer, shapes.scene):
        proved = max(least.least, float(answer.clearance))
        place = {"motion": least.motion, "obstacle": shapes.own(least.obstacle[:1])[0]}
        numbers["clearance"] = {"found": least.found, "proved": proved, **place}
    return numbers


def driving_facts(path: Path) -> dict[str, Any]:
    """Describe how a vehicle drives a path: cusps, travel of the axle point, least radius, shortest part."""
    parts = path.driving
    lengths = [part.length for part in parts if part.gear != "turning"]
    radii = [abs(float(part.radius)) for part in parts if part.radius]
    return {
        "cusps": path.cusps,
        "stops": path.stops,
        "travel": math.fsum(lengths),
        "backward": math.fsum(part.length for part in parts if part.gear == "backward"),
        "in place": math.fsum(abs(part.angle) for part in parts if part.gear == "turning"),
        "least radius": min(radii, default=None),
        "shortest": min(lengths, default=0.0),
    }


def drive_rows(drive: Timed, scene: Scene) -> dict[str, str]:
    """Describe the times of a path in words, and the error of driving through jumps of curvature."""
    unit = f" {scene.units}" if scene.units else ""
    facts = drive_facts(drive, scene)["drive"]
    standing = f", {facts['standing']:.4g} s of it standing" if facts["standing"] else ""
    rows = {"drive time": f"{facts['duration']:.6g} s{standing}"}
    passed = drive.path.stops - len(drive.stops)
    if not drive.through and passed > 0 and drive.limits.steer_rate is None:
        remedy = "give --steer-rate and --wheelbase for the error of this"
        return rows | {"driven through": f"{counted(passed, 'jump')} of curvature; {remedy}"}
    if not drive.through:
        return rows
    off, centred = ((f"{d:.4g}{unit} and {math.degrees(a):.3g} degrees") for d, a in (facts["off"], facts["centred"]))
    rows["driven through"] = (
        f"{counted(len(drive.through), 'jump')} of curvature; until the wheels have turned it is off by at most {off}, "
        f"by {centred} if they turn half before each joint"
    )
    room, proved = facts["room"], facts["proved clearance"]
    rows["clearance for that"] = f"{room:.4g}{unit} suffices, {proved or 0:.4g}{unit} is proved: " + (
        f"at up to {drive.limits.speed:.4g}{unit} a second each jump stays clear of obstacles"
        if proved is None or proved >= room
        else f"lower --speed, leave out --stops, or give --clearance {room:.3g}"
    )
    return rows


def drive_facts(drive: Timed, scene: Scene) -> dict[str, Any]:
    """Describe the times of a path by numbers, for machines: seconds, lengths and radians."""
    from cfree.paths.clearance import own_clearance

    facts: dict[str, Any] = {
        "duration": drive.duration,
        "standing": math.fsum(stop.pause for stop in drive.stops),
        "stops": [asdict(stop) for stop in drive.stops],
    }
    if drive.through:
        least = own_clearance(drive.path, scene)
        facts |= {
            "through": [asdict(ramp) for ramp in drive.through],
            "off": [max(r.sideways for r in drive.through), max(r.heading for r in drive.through)],
            "centred": [
                max(r.centred_sideways for r in drive.through),
                max(r.centred_heading for r in drive.through),
            ],
            "room": drive.room,
            "proved clearance": max(least.least, float(drive.path.clearance)) if least else None,
        }
    return {"drive": facts}


def moved_rows(answer: Path | Proof | AllSeparated) -> dict[str, str]:
    """Describe moves of start and goals, in words."""
    return {f"{name} moved": f"from {text_of(asked)} to {text_of(end)}" for name, asked, end in _moves(answer)}


def moved_facts(answer: Path | Proof | AllSeparated) -> dict[str, Any]:
    """Describe moves of start and goals by numbers: x, y and radians; a place has x and y alone."""
    moves = {name: {"from": _row(asked), "to": _row(end)} for name, asked, end in _moves(answer)}
    return {"moved": moves} if moves else {}


def _moves(answer: Path | Proof | AllSeparated) -> list[tuple[str, Goal, Goal]]:
    from cfree.planning.goals import AllSeparated

    if isinstance(answer, AllSeparated):
        first, goals = answer.proofs[0].moved, answer.moved_goals
        moves: list[tuple[str, Goal | None, Goal]] = [("start", first.start if first else None, answer.start)]
        moves += [("goal" if len(goals) == 1 else f"goal {k}", goals[end], end) for k, end in enumerate(goals)]
    else:
        moved, goal = answer.moved or Moved(), answer.goal
        end: Goal = (goal.x, goal.y) if isinstance(moved.goal, tuple) else goal
        moves = [("start", moved.start, answer.start), ("goal", moved.goal, end)]
    return [(name, asked, end) for name, asked, end in moves if asked is not None]


def _row(end: Goal) -> list[float]:
    return [float(end.x), float(end.y), end.theta] if isinstance(end, Pose) else [*map(float, end)]


def motion_counts(path: Path) -> dict[str, int]:
    """Count the motions of each kind."""
    kinds = [motion.kind for motion in path.motions]
    return {f"{kind}s": kinds.count(kind) for kind in ("translation", "rotation", "slide")}


def print_result(
    title: str, source: os.PathLike[str], rows: dict[str, Any], files: dict[str, str], as_json: bool
) -> None:
    """Print the result and the files written: as a table, or as JSON."""
    if as_json:
        print_json({"file": str(source), **rows, "files": files, **facts()})
    else:
        print_rows(title, rows, files)


def print_rows(title: str, rows: Mapping[str, int | float | str], files: Mapping[str, str]) -> None:
    """Print a title, names with values, the files written, and the worst note of reading."""
    table = []
    for name, value in rows.items():
        if name == AS_READ:
            continue
        text = f"{value:,}" if isinstance(value, int) else f"{value:,.6g}" if isinstance(value, float) else value
        table.append([name, printable(text)])
    sizes = ((name, path, os.stat(path).st_size / 1000) for name, path in files.items())
    _print(
        title,
        *columns(table, "<<", terminal_width()),
        *(f" {name:<8} {path} ({size:,.1f} kB)" for name, path, size in sizes),
        *filter(None, [str(rows[AS_READ]) if AS_READ in rows else last_line()]),
    )


def print_verification(title: str, result: Verification) -> None:
    """Print a row for each check, then the findings and the verdict."""
    from cfree.verify import result as verify

    checks = [[check.name, check.how, printable(check.extent)] for check in result.checks]
    table = columns([["check", "", "of what"], *checks], "<<<", terminal_width())
    last = filter(None, [result.as_read])
    _print(title, *table, *map(str, result.findings[: verify.SHOWN]), result.verdict, *last)


def _print(*lines: str) -> None:
    for line in lines:
        print(printable(line))
