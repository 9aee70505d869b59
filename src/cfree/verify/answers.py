"""Check answers: a path is free, or a separation is a proof. Each fault gives one finding."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from cfree.arguments import checked
from cfree.collector import collection_paused
from cfree.exact.number import ExactPoint
from cfree.exact.pose import Pose
from cfree.formats.answers.answer_file import read_answer
from cfree.paths.numbering import has_slides, renumbered
from cfree.paths.path import Path
from cfree.planning.goals import AllSeparated
from cfree.planning.proof import Proof
from cfree.planning.separation import Separated
from cfree.planning.stuck import Stuck
from cfree.planning.unreachable import Unreachable
from cfree.scene.digest import Stamp, Whole, stamp_of
from cfree.scene.goals import Moved, text_of, text_of_move
from cfree.scene.grown_cores import Cores
from cfree.scene.reading import Note, together
from cfree.scene.reading_lines import Claim
from cfree.scene.rounded import is_disc_about_reference
from cfree.scene.scene import Scene, round_count, shapes_of
from cfree.vehicles.vehicle import described
from cfree.verify.arc_motions import ArcWorld
from cfree.verify.arcs import is_of_arcs
from cfree.verify.boxes import REACH, box_findings
from cfree.verify.curves import mismatches
from cfree.verify.driving import DRIVABLE, driving_findings
from cfree.verify.leeway import is_around_disc, roomier, turning, with_disc
from cfree.verify.motions import (
    CLEARANCE,
    CONTINUOUS,
    DECIMALS,
    ENDS,
    FREE,
    KEPT,
    end_findings,
    fault_at,
    path_findings,
)
from cfree.verify.orientations import left_out
from cfree.verify.result import PROVED, REFUTED, SKIPPED, Check, Finding, Verification
from cfree.verify.round_answers import TEXTS, rounded_findings
from cfree.verify.separation import CLOSED, CONTACTS, INSIDE, SIDES, separation_findings
from cfree.verify.stuck import HELD, stuck_findings
from cfree.verify.whole import part_of, whole_of
from cfree.verify.world import World
from cfree.words import coordinate, counted

if TYPE_CHECKING:
    from cfree.exact.pose import Pose
    from cfree.formats.answers.answer_format import Read

SCENE, QUERY, PIECES, TURNS, ROUND = "scene", "query", "convex pieces", "orientations", "round shapes"
MOVED = "moved"
NO_ROOM = {
    DECIMALS: 'they are claimed to be "free", and no room is enough for that; say "approximate"',
    CLEARANCE: "its polygon is not convex, or not around a disc of that radius; correct one of them",
}


@checked
def answer(
    scene: Scene,
    answer: Path | Proof | AllSeparated | str | os.PathLike[str],
    *,
    progress: Callable[[float], object] | None = None,
) -> Verification:
    """Check a path, or a proof that there is none, from the scene's exact coordinates.

    Parameters
    ----------
    scene : Scene
        If it has a start and a goal, these must be the answer's.
    answer : Path, Separated, Stuck, Unreachable, AllSeparated or path
        A file written by `cfree.save`, or an answer in memory (its scene is then not compared).
    progress : callable, optional
        Function called with the share done, from 0 to 1.

    Returns
    -------
    Verification
        Its `proved` states the result in one sentence.

    Raises
    ------
    FormatError
        If the file cannot be read.

    Notes
    -----
    A separation takes about 0.1 ms a piece; a path takes a few for each motion and each convex piece near it.

    Examples
    --------
    >>> import cfree, cfree.verify
    >>> scene = cfree.Scene(robot=[(0, 0), (2, 0), (0, 1)], obstacles=[[(5, 5), (8, 5), (6, 7)]])
    >>> cfree.verify.answer(scene, cfree.Path(cfree.Pose(0, 0), [cfree.Translation((9, 2))])).proved
    'A path of 1 motion leads from (0, 0, 0 deg) to (9, 2, 0 deg), and is free of collisions.'
    >>> cfree.verify.answer(scene, cfree.Path(cfree.Pose(0, 0), [cfree.Translation((9, 9))])).verified
    False
    """
    begin = time.perf_counter()
    read = read_answer(answer) if isinstance(answer, (str, os.PathLike)) else None
    outcome = read.answer if read else answer
    assert not isinstance(outcome, (str, os.PathLike))
    whole = whole_of(scene, outcome)
    if read and (finding := other_scene(scene, outcome)):
        return _refuted(finding, begin)

    def report(done: float) -> None:
        if progress is not None:
            progress(done)

    if isinstance(outcome, AllSeparated):
        return _all_of(scene, outcome, report, begin)
    part = scene
    if whole is not None:
        part_scene = part_of(scene, outcome, whole)
        if part_scene is None:
            finding = Finding(SCENE, "whole", "its obstacles are not those that the answer is about; plan anew")
            return _refuted(finding, begin)
        part = part_scene
    if isinstance(outcome, Separated) and outcome.rounded is not None:
        return _of_rounded(scene, part, outcome, outcome.rounded, read, report, begin)
    if isinstance(outcome, Path):
        part = scene
        outcome = renumbered(outcome, whole.obstacles) if whole is not None and not scene.curved else outcome
    findings, its = _other_poses(scene, outcome), _scene_for(scene, outcome, is_of_part=whole is not None)
    if its is None or (its.curved and not isinstance(outcome, Path)):
        return _refuted(Finding(ROUND, "polygons", "the answer has none for the round shapes of the scene"), begin)
    if its.curved and not all(map(is_of_arcs, shapes_of(its))):
        text = "the answer has none for a shape of other curves than lines and circular arcs"
        return _refuted(Finding(ROUND, "polygons", text), begin)
    if scene.curved and its is not part:
        wrong = mismatches(part, its, outward=isinstance(outcome, Path))
        findings += [Finding(ROUND, where, text) for where, text in wrong]
    is_round = its.curved or (isinstance(outcome, Path) and outcome.clearance and not outcome.disc)
    with collection_paused():
        world = ArcWorld(its) if is_round else World(its)
        if isinstance(world, World):
            findings += [Finding(PIECES, name, "its convex pieces do not tile it") for name in world.untiled]
        findings += end_findings(outcome, world)
        findings += _needless(outcome, world)
    if isinstance(outcome, Path):
        larger: dict[str, World | ArcWorld | None] = {}
        if read and read.decimals == "free":
            larger[DECIMALS] = None if read.leeway is None else _roomier(world, read.leeway)
        if outcome.clearance:
            larger[CLEARANCE] = _with_clearance(world, outcome)
        findings += [Finding(name, name, NO_ROOM[name]) for name, there in larger.items() if there is None]
        findings += path_findings(outcome, world, report, {name: there for name, there in larger.items() if there})
        findings += driving_findings(outcome)
    else:
        assert isinstance(world, World)
        there = world if whole is None or scene.curved else World(part)
        if isinstance(outcome, Stuck):
            findings += stuck_findings(outcome, there)
        elif isinstance(outcome, Unreachable):
            findings += box_findings(outcome, there, report)
        else:
            with collection_paused():
                findings += separation_findings(outcome, there, report)
    report(1.0)
    extents = {
        **_of_scene(outcome if read else None, whole, len(scene.obstacles)),
        QUERY: "start and goal, where the scene has them",
        **_of_moved(outcome),
        **(_of_curves(part, its, outcome) if scene.curved else {}),
        **_of_pieces(world),
        ENDS: "both are free" + (" among the polygons" if scene.curved and not its.curved else ""),
        **_of_kind(outcome),
        **_of_decimals(read),
    }
    return _result(scene, outcome, read, extents, findings, begin)


def _scene_for(scene: Scene, outcome: Path | Proof, *, is_of_part: bool) -> Scene | None:
    """The scene in which an answer is checked: that of its polygons if there are round shapes, None without any."""
    if not scene.curved:
        return scene
    if not isinstance(outcome, Path):
        return outcome.scene
    # polygons for some of the shapes tell nothing about the others
    return scene if is_of_part and not has_slides(outcome) else outcome.scene or scene


def _of_rounded(
    scene: Scene,
    part: Scene,
    proof: Separated,
    cores: Cores,
    read: Read | None,
    report: Callable[[float], object],
    begin: float,
) -> Verification:
    """Check a separation among grown cores, which are those of a part of the scene."""
    if not all(map(is_of_arcs, shapes_of(scene))):
        return _refuted(Finding(ROUND, "shapes", "the scene has others than lines and circular arcs"), begin)
    findings = _other_poses(scene, proof)
    findings += rounded_findings(proof, cores, part, report)
    report(1.0)
    count, far = counted(len(proof.pieces), "piece"), f"with {float(proof.clearance):g} around the robot, "
    extents = {
        **_of_scene(proof if read else None, None if part is scene else proof.whole, len(scene.obstacles)),
        QUERY: "start and goal, where the scene has them",
        **_of_moved(proof),
        ENDS: "both are free",
        **{name: text.format(count=count, far=far if proof.clearance else "") for name, text in TEXTS.items()},
        CLOSED: f"{count} without a boundary mod 2, up to lengths far below the margin",
        SIDES: "start and goal are on two sides of it: rays meet it an even, and an odd, number of times",
        **_of_decimals(read),
    }
    return _result(scene, proof, read, extents, findings, begin)


def _result(
    scene: Scene,
    outcome: Path | Proof,
    read: Read | None,
    extents: dict[str, str],
    findings: Sequence[Finding],
    begin: float,
) -> Verification:
    """Return the result of checks of these extents."""
    refuted = {finding.kind for finding in findings}
    how = dict.fromkeys(extents, PROVED) | dict.fromkeys((CLOSED, SIDES), SKIPPED if CONTACTS in refuted else PROVED)
    how |= {MOVED: SKIPPED} if outcome.moved and _is_left(outcome) else {}
    how |= {DECIMALS: SKIPPED} if read and read.decimals == "approximate" else {}
    how |= dict.fromkeys(refuted, REFUTED)
    checks = tuple(Check(name, how[name], text) for name, text in extents.items())
    proved = "" if findings else _sentence(outcome, read)
    return Verification(checks, tuple(findings), (), _since(begin), proved, _record(scene, outcome), _claim(outcome))


def _refuted(finding: Finding, begin: float) -> Verification:
    """Return the result of a check that ends at its first finding."""
    return Verification((Check(finding.kind, REFUTED, "nothing else was checked"),), (finding,), (), _since(begin))


def _roomier(world: World | ArcWorld, leeway: Fraction) -> World | ArcWorld | None:
    return world.larger(leeway) if isinstance(world, ArcWorld) else roomier(world, leeway)


def _with_clearance(world: World | ArcWorld, path: Path) -> World | ArcWorld | None:
    if isinstance(world, ArcWorld):
        return world.with_robot(path.clearance)
    return with_disc(world, path.disc) if is_around_disc(path.disc, path.clearance) else None


def _record(scene: Scene, outcome: Path | Proof | AllSeparated) -> tuple[Note, ...]:
    """Return the records of reading of the scene and of the answer's file."""
    return together(scene.reading, outcome.stamp.reading if outcome.stamp else ())


def _claim(outcome: Path | Proof | AllSeparated) -> Claim:
    return "path" if isinstance(outcome, Path) else "no path"


def _all_of(scene: Scene, outcome: AllSeparated, report: Callable[[float], object], begin: float) -> Verification:
    """Check each proof by itself, and that at a place their goals stand for all orientations."""
    findings, checks = list[Finding](), list[Check]()
    polygons = outcome.scene if scene.curved else scene  # each proof checks that these are inside
    world = polygons and World(polygons)
    begun = outcome.proofs[0].moved
    requested_start = outcome.start if begun is None or begun.start is None else begun.start
    if scene.start not in (None, requested_start):
        findings.append(Finding(QUERY, "start", f"it is {text_of(requested_start)}, and another in the scene"))
    requested_goals = [outcome.moved_goals.get(goal, goal) for goal in outcome.goals]
    for goal in (scene.goal, *scene.goals):
        if goal is not None and goal not in requested_goals:
            findings.append(Finding(QUERY, "goal", f"{text_of(goal)} in the scene is none of them"))
    without = Scene(scene.robot, scene.obstacles, bounds=scene.bounds, workspace=scene.workspace)
    for k, proof in enumerate(outcome.proofs):
        report(k / len(outcome.proofs))
        result = answer(without, proof)
        findings += [Finding(fault.kind, f"proof {k}: {fault.where}", fault.text) for fault in result.findings]
        checks.append(Check(f"proof {k}", PROVED if result.verified else REFUTED, result.proved or "see below"))
        wrong_kind = {"closed": proof.of != "closed", "pieces": proof.of == "interior", "interior": False}
        if proof.start != outcome.start or wrong_kind[outcome.of]:
            findings.append(Finding(QUERY, f"proof {k}", "its start differs, or it proves less than all claim"))
    for place in outcome.places:
        there = [proof for proof in outcome.proofs if (proof.goal.x, proof.goal.y) == place]
        about = [proof for proof in there if isinstance(proof, Separated)]
        where = f"({coordinate(float(place[0]))}, {coordinate(float(place[1]))})"
        turned = world
        if world is None and not is_disc_about_reference(scene):
            findings.append(Finding(TURNS, where, "its proofs have no polygons in which the robot turns there"))
        has_clearance = bool(there) and bool(there[0].clearance)
        if world and has_clearance:
            turned = turning(world, about[0]) if about and _is_one_robot(about) else None
            if turned is None:
                text = "the smaller robots of its proofs differ, or one is not convex, or too large to turn there"
                findings.append(Finding(TURNS, where, text))
        intervals, single = left_out(turned, place, [proof.goal for proof in there]) if turned else (0, 0)
        # a robot that only just fits, and is nearer than a clearance, keeps none
        if intervals or (single and outcome.of == "closed" and not has_clearance):
            left = f"{counted(intervals, 'interval')} and {counted(single, 'single one')}"
            text = f"no proof for {left} of free orientations"
            findings.append(Finding(TURNS, where, text))
    if outcome.places:
        where = f"at {counted(len(outcome.places), 'place')}"
        text = f"{where} each free orientation is joined by turning to the goal of a proof"
        checks.append(Check(TURNS, PROVED, text))
    refuted = {finding.kind for finding in findings}
    checks = [replace(check, how=REFUTED) if check.name in refuted else check for check in checks]
    goals = ", ".join(text_of_move(outcome.moved_goals.get(goal), goal) for goal in outcome.goals)
    start = text_of_move(begun.start if begun else None, outcome.start)
    proved = "" if findings else _none_leads(outcome, f"leads from {start} to any of {goals}")
    report(1.0)
    record, claim = _record(scene, outcome), _claim(outcome)
    return Verification(tuple(checks), tuple(findings), (), _since(begin), proved, record, claim)


def _is_one_robot(proofs: Sequence[Separated]) -> bool:
    """True if all proofs about a clearance are of contacts of one smaller robot."""
    first = proofs[0]
    alike = all((p.clearance, p.robot, p.cores) == (first.clearance, first.robot, first.cores) for p in proofs)
    return alike and bool(first.clearance) and len(first.robot) == len(first.cores)


def _since(begin: float) -> float:
    return time.perf_counter() - begin


def _other_poses(scene: Scene, outcome: Path | Proof) -> list[Finding]:
    """Findings for a start and a goal that are not the scene's, or were moved from there."""
    requested = outcome.moved or Moved()
    pairs = {"start": (scene.start, outcome.start, requested.start), "goal": (scene.goal, outcome.goal, requested.goal)}
    findings = [
        Finding(QUERY, name, f"it is {text_of_move(moved, its)}, and {text_of(pose)} in the scene")
        for name, (pose, its, moved) in pairs.items()
        if pose is not None and pose != (its if moved is None else moved)
    ]
    reached = (outcome.goal, (outcome.goal.x, outcome.goal.y)) if requested.goal is None else (requested.goal,)
    if scene.goals and not any(goal in reached for goal in scene.goals):
        goals = ", ".join(map(text_of, scene.goals))
        findings.append(Finding(QUERY, "goal", f"it is {text_of(outcome.goal)}, and one of {goals} in the scene"))
    return findings


def _of_moved(outcome: Path | Proof) -> dict[str, str]:
    """Moves of start and goal, in words."""
    requested = outcome.moved or Moved()
    pairs = (("start", requested.start, outcome.start), ("goal", requested.goal, outcome.goal))
    texts = [f"{name} from {text_of(end)} to {text_of(to)}" for name, end, to in pairs if end is not None]
    why = "the need to move it was not checked" if _is_left(outcome) else "it is forbidden there"
    return {MOVED: f"{', '.join(texts)}; {why}; a nearer one is not excluded"} if texts else {}


def _has_room(world: World, place: ExactPoint) -> bool:
    """True if an orientation is free at a place."""
    x0, y0, x1, y1 = world.scene.bounds or (place * 2)
    return x0 <= place[0] <= x1 and y0 <= place[1] <= y1 and left_out(world, place, []) != (0, 0)


def _is_left(outcome: Path | Proof) -> bool:
    """True if it is not checked that the requested pose of a moved end is forbidden."""
    return (
        bool(outcome.clearance)
        or outcome.curved is not None
        or (outcome.scene is not None and outcome.stamp is not None)
    )


def _needless(outcome: Path | Proof, world: World | ArcWorld) -> list[Finding]:
    """Findings for ends that were moved although their poses are free."""
    requested, findings = outcome.moved or Moved(), list[Finding]()
    for name, end in (("start", requested.start), ("goal", requested.goal)):
        if end is None or _is_left(outcome):
            continue
        if isinstance(end, Pose):
            is_free = fault_at(end, world) is None
        else:
            is_free = isinstance(world, World) and _has_room(world, end)
        if is_free:
            findings.append(Finding(MOVED, name, f"{text_of(end)} is free, and it was moved; plan anew"))
    return findings


def other_scene(scene: Scene, outcome: Path | Proof | AllSeparated) -> Finding | None:
    """Return a finding if an answer is for another scene than this one, and not for a part of it."""
    if whole_of(scene, outcome) is not None or (its := outcome.stamp) is None or its == (stamp := stamp_of(scene)):
        return None
    if its.sha256 == stamp.sha256:
        return Finding(SCENE, "scene.robot", f"it is {_box(its)}, and {_box(stamp)} around the robot; correct it")
    text = f"the answer is for the one of sha256 {its.sha256[:12]}..., and this is {stamp.sha256[:12]}..."
    return Finding(SCENE, "another scene", f"{text}; give its own, or plan anew")


def _box(stamp: Stamp) -> str:
    return f"[{', '.join(map(str, stamp.robot))}]"


def _of_scene(outcome: Path | Proof | None, whole: Whole | None, count: int) -> dict[str, str]:
    """Statement about the scene, if a file names its scene or an answer is about some of the obstacles."""
    if whole is not None:
        return {SCENE: f"the answer is about {len(whole.obstacles):,} of its {count:,} obstacles, and true among all"}
    return {SCENE: "the one that the answer is for"} if outcome is not None and outcome.stamp else {}


def _of_curves(scene: Scene, its: Scene, outcome: Path | Proof) -> dict[str, str]:
    count, polygons = round_count(shapes_of(scene)), round_count(shapes_of(scene)) - round_count(shapes_of(its))
    exactly = f"{round_count(shapes_of(its)):,}: lines and circular arcs, exactly"
    if not polygons:
        return {ROUND: exactly}
    around, inside = ("around", "inside") if isinstance(outcome, Path) else ("inside", "around")
    what = f"{polygons:,}: the answer's polygons are {around} those of robot and obstacles, {inside} a workspace"
    return {ROUND: what if polygons == count else f"{exactly}; {what}"}


def _of_pieces(world: World | ArcWorld) -> dict[str, str]:
    if isinstance(world, ArcWorld):
        return {}
    return {PIECES: f"{len(world.parts)} of the robot, {len(world.obstacle_pieces)} of the obstacles tile them"}


def _of_decimals(read: Read | None) -> dict[str, str]:
    """Statement about decimals, if a file has them."""
    if read is None or read.decimals is None:
        return {}
    if read.decimals == "approximate":
        return {DECIMALS: "approximate: only the exact numbers are free of collisions"}
    room = 0 if read.leeway is None else float(read.leeway)
    return {DECIMALS: f"also free as doubles: the path keeps {room:.3g}, four times their error"}


def _of_kind(outcome: Path | Proof) -> dict[str, str]:
    if isinstance(outcome, Path):
        return _of_path(outcome)
    if isinstance(outcome, Stuck):
        return {HELD: f"{counted(len(outcome.rail), 'pose')}: no first motion of the vehicle leaves its contacts"}
    if isinstance(outcome, Unreachable):
        where = "in them, or where the robot overlaps something"
        other = "goal" if outcome.at == "start" else "start"
        return {REACH: f"{outcome.count:,}: a step of travel from each ends {where}; the {other} is in none"}
    return _of_separation(outcome)


def _of_path(path: Path) -> dict[str, str]:
    slides = sum(motion.kind == "slide" for motion in path.motions)
    texts = {KEPT: f"{counted(slides, 'slide')}: two vertices on their edges, all the way"} if slides else {}
    count = counted(len(path.motions), "motion")
    text = f"{count}: at least {float(path.clearance):g} from obstacles and workspace"
    texts |= {CLEARANCE: text} if path.clearance else {}
    return texts | {
        CONTINUOUS: f"{count} from the start to the goal, one after the other",
        FREE: f"{count}: at no pose does the robot overlap anything",
        **({DRIVABLE: f"{count}: {described(path.vehicle, path.units)} can do each"} if path.vehicle else {}),
    }


def _of_separation(proof: Separated) -> dict[str, str]:
    count = counted(len(proof.pieces), "piece")
    inside = f"{'everywhere nearer to' if proof.clearance else 'strictly inside'} the robot"
    inside += f" than {float(proof.clearance):g}" if proof.clearance else ""
    smaller = {INSIDE: f"{inside}; bounds, if any, are larger"} if proof.of == "closed" else {}
    return smaller | {
        CONTACTS: f"{count}: the robot touches something at every pose of them",
        CLOSED: f"{count} without a boundary mod 2",
        SIDES: "start and goal are on two sides of it, or one of them touches something"
        if proof.of == "interior"
        else "start and goal are on two sides of it: rays meet it an even, and an odd, number of times",
    }


def _sentence(outcome: Path | Proof, read: Read | None) -> str:
    requested, far = outcome.moved or Moved(), f"{float(outcome.clearance):g} from obstacles and workspace"
    ends = text_of_move(requested.start, outcome.start), text_of_move(requested.goal, outcome.goal)
    if isinstance(outcome, Path):
        count = counted(len(outcome.motions), "motion")
        only = "; its decimals are approximate" if read and read.decimals == "approximate" else ""
        keeps = f"keeps {far}" if outcome.clearance else "is free of collisions"
        drives = f"; {described(outcome.vehicle, outcome.units)} can drive it" if outcome.vehicle else ""
        return f"A path of {count} leads from {ends[0]} to {ends[1]}, and {keeps}{only}{drives}."
    if isinstance(outcome, Stuck):
        sentence = outcome.sentence()
        return f"From {ends[0]} to {ends[1]}: {sentence}."
    if isinstance(outcome, Unreachable):
        return f"No path of {described(outcome.vehicle, outcome.units)} leads from {ends[0]} to {ends[1]}."
    return _none_leads(outcome, f"leads from {ends[0]} to {ends[1]}")


def _none_leads(outcome: Separated | AllSeparated, anywhere: str) -> str:
    if outcome.clearance:
        return f"No path that keeps {float(outcome.clearance):g} from obstacles and workspace {anywhere}."
    if outcome.of == "closed":
        return f"No path {anywhere}, not even one that touches."
    if outcome.of == "pieces":
        return f"No path of finitely many lines and arcs of the vehicle {anywhere}."
    return f"No path that keeps a distance from everything {anywhere}; one that touches may."
