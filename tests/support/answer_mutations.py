"""Answers with one thing wrong; `python answer_mutations.py` counts those that `verify.answer` rejects, by kind."""

from __future__ import annotations

import copy
import json
import random
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path as FilePath
from typing import Any

import second_opinion
from answers import corridor, distances, rounded, separations, tee, text_of
from cfree import (
    FormatError,
    FreeSpace,
    MotionChecker,
    Path,
    Pose,
    Rotation,
    Scene,
    Separated,
    Slide,
    Translation,
    boundary,
    clearance,
    free_space,
)
from cfree.collision import Touch
from cfree.collision.arcs import arcs_of
from cfree.collision.motion import Motion
from cfree.errors import InvalidPoseError
from cfree.formats.answers.answer_file import load_answer
from cfree.scene.dilation import grown
from cfree.scene.scene import with_robot

Answer = dict[str, Any]
# changes an answer; False if there is nothing to change
Mutation = Callable[[random.Random, Answer], bool]


def moved(rng: random.Random, number: str, by: Fraction | None = None) -> str:
    return str(Fraction(number) + (by or Fraction(rng.choice([-1, 1]), rng.choice([1, 8, 10**6]))))


# --- paths ---


def motions(answer: Answer, kind: str) -> list[Answer]:
    return [motion for motion in answer["motions"] if motion["type"] == kind]


def change_a_vector(rng: random.Random, answer: Answer) -> bool:
    vector = rng.choice(motions(answer, "translation"))["exact"]["vector"]
    k = rng.randrange(2)
    vector[k] = moved(rng, vector[k])
    return True


def change_two_vectors(rng: random.Random, answer: Answer) -> bool:
    """Change them by opposite amounts: the goal stays, if the robot does not turn between them."""
    (one, other), k = rng.sample(motions(answer, "translation"), 2), rng.randrange(2)
    by = Fraction(rng.choice([-1, 1]), rng.choice([1, 8, 10**6]))
    for motion, amount in ((one, by), (other, -by)):
        motion["exact"]["vector"][k] = moved(rng, motion["exact"]["vector"][k], amount)
    return True


def change_a_pole(rng: random.Random, answer: Answer) -> bool:
    pole, k = rng.choice(motions(answer, "rotation"))["exact"]["pole"], rng.randrange(2)
    pole[k] = moved(rng, pole[k])
    return True


def change_an_angle(rng: random.Random, answer: Answer) -> bool:
    exact = rng.choice(motions(answer, "rotation"))["exact"]
    exact["tau"] = "7" if "inf" in exact["tau"] else moved(rng, exact["tau"])
    return True


def turn_the_other_way(rng: random.Random, answer: Answer) -> bool:
    """Change the sense of a rotation; half a turn still ends in the same pose."""
    exact = rng.choice(motions(answer, "rotation"))["exact"]
    exact["tau"] = exact["tau"][1:] if exact["tau"].startswith("-") else f"-{exact['tau']}"
    return True


def drop_a_motion(rng: random.Random, answer: Answer) -> bool:
    answer["motions"].pop(rng.randrange(len(answer["motions"])))
    return True


def repeat_a_motion(rng: random.Random, answer: Answer) -> bool:
    k = rng.randrange(len(answer["motions"]))
    answer["motions"].insert(k, answer["motions"][k])
    return True


def swap_two_motions(rng: random.Random, answer: Answer) -> bool:
    listed = answer["motions"]
    i, j = rng.sample(range(len(listed)), 2)
    listed[i], listed[j] = listed[j], listed[i]
    return True


def change_an_end(rng: random.Random, answer: Answer) -> bool:
    end, k = answer["exact"][rng.choice(["start", "goal"])], rng.randrange(3)
    if k < 2:
        end[k] = moved(rng, end[k])
    else:
        end[k] = {"tau": "1/7" if end[k]["tau"] == "inf" else moved(rng, end[k]["tau"])}
    return True


def change_start_and_goal(rng: random.Random, answer: Answer) -> bool:
    """Change both alike, so that the path is one, of other poses."""
    k, by = rng.randrange(2), Fraction(rng.choice([-1, 1]), rng.choice([1, 8, 10**6]))
    for end in answer["exact"].values():
        end[k] = moved(rng, end[k], by)
    for motion in motions(answer, "rotation"):
        motion["exact"]["pole"][k] = moved(rng, motion["exact"]["pole"][k], by)
    return True


def change_a_decimal(rng: random.Random, answer: Answer) -> bool:
    """Change it by more than the rule of effect allows, and so little that no picture shows it."""
    record = rng.choice([answer, answer, *answer["motions"]])
    name = rng.choice([key for key in ("start", "goal", "vector", "pole", "angle", "to") if key in record])
    by = rng.choice([-1, 1]) * rng.choice([3e-7, 1e-3, 1])
    if name == "angle":
        record[name] += by
    else:
        record[name][rng.randrange(len(record[name]))] += by
    return True


def claim_that_decimals_are_free(rng: random.Random, answer: Answer) -> bool:
    """Claim it for the decimals of a path that touches."""
    answer["decimals"] = "free"
    return True


def change_the_hash_of_the_scene(rng: random.Random, answer: Answer) -> bool:
    digits = list(answer["scene"]["sha256"])
    digits[rng.randrange(64)] = rng.choice("0123456789abcdef")
    answer["scene"]["sha256"] = "".join(digits)
    return True


def change_the_box_of_the_robot(rng: random.Random, answer: Answer) -> bool:
    """Change the box that limits the error of decimals."""
    k = rng.randrange(4)
    answer["scene"]["robot"][k] = moved(rng, answer["scene"]["robot"][k])
    return True


# --- slides ---


def slide_of(rng: random.Random, answer: Answer) -> Answer:
    return rng.choice(motions(answer, "slide"))


def change_a_coefficient(rng: random.Random, answer: Answer) -> bool:
    terms = slide_of(rng, answer)["exact"][rng.choice("xyd")]
    k = rng.randrange(len(terms))
    terms[k] = moved(rng, terms[k])
    return True


def change_the_angle_of_a_slide(rng: random.Random, answer: Answer) -> bool:
    exact = slide_of(rng, answer)["exact"]
    exact["tau"] = moved(rng, exact["tau"])
    return True


def exchange_x_and_y(rng: random.Random, answer: Answer) -> bool:
    exact = slide_of(rng, answer)["exact"]
    exact["x"], exact["y"] = exact["y"], exact["x"]
    return True


def change_a_kept_contact(rng: random.Random, answer: Answer) -> bool:
    contact, name = rng.choice(slide_of(rng, answer)["contacts"]), rng.choice(["robot", "obstacle"])
    count = 4 if name == "robot" else 8
    contact[name] = [contact[name][0], (contact[name][1] + rng.randrange(1, count)) % count]
    return True


def change_the_kind_of_a_kept_contact(rng: random.Random, answer: Answer) -> bool:
    contact = rng.choice(slide_of(rng, answer)["contacts"])
    contact["kind"] = {"vertex-edge": "edge-vertex", "edge-vertex": "vertex-edge"}[contact["kind"]]
    return True


def change_the_decimals_of_a_slide(rng: random.Random, answer: Answer) -> bool:
    slide, by = slide_of(rng, answer), rng.choice([-1, 1]) * rng.choice([1, 1e-6])
    k = rng.randrange(3)
    if k < 2:
        slide["vector"][k] += by
    else:
        slide["angle"] += by
    return True


# --- separations ---


def piece_of(rng: random.Random, answer: Answer) -> Answer:
    return rng.choice(answer["surface"])


def drop_a_piece(rng: random.Random, answer: Answer) -> bool:
    answer["surface"].pop(rng.randrange(len(answer["surface"])))
    return True


def repeat_a_piece(rng: random.Random, answer: Answer) -> bool:
    answer["surface"].append(piece_of(rng, answer))
    return True


def drop_all_pieces(rng: random.Random, answer: Answer) -> bool:
    answer["surface"], answer["obstacles"] = [], []
    return True


def change_a_contact(rng: random.Random, answer: Answer) -> bool:
    contact, name = piece_of(rng, answer)["contact"], rng.choice(["robot", "obstacle"])
    old = list(contact[name])
    contact[name] = [old[0], (old[1] + rng.randrange(1, 4)) % 4]
    return contact[name] != old


def change_the_kind_of_a_contact(rng: random.Random, answer: Answer) -> bool:
    contact = piece_of(rng, answer)["contact"]
    contact["kind"] = {"vertex-edge": "edge-vertex", "edge-vertex": "vertex-edge"}[contact["kind"]]
    return True


def change_a_chart(rng: random.Random, answer: Answer) -> bool:
    piece = piece_of(rng, answer)
    piece["chart"] = 1 - piece["chart"]
    return True


def take_an_angle_of_another(rng: random.Random, answer: Answer) -> bool:
    one, other, end = piece_of(rng, answer), piece_of(rng, answer), rng.choice(["from", "to"])
    differs = one[end]["tau"] != other[end]["tau"]
    one[end] = other[end]
    return bool(differs)


def move_an_interval(rng: random.Random, answer: Answer) -> bool:
    angle = piece_of(rng, answer)[rng.choice(["from", "to"])]
    angle["tau"] = [tau + 1e-6 for tau in angle["tau"]]
    return True


def change_the_name_of_an_angle(rng: random.Random, answer: Answer) -> bool:
    names = piece_of(rng, answer)[rng.choice(["from", "to"])]["names"]
    if not names:
        return False
    name = rng.choice(names)
    k = rng.randrange(1, 3)
    name[k] = (name[k] + rng.randrange(1, 4)) % 4
    return True


def swap_from_and_to(rng: random.Random, answer: Answer) -> bool:
    piece = piece_of(rng, answer)
    piece["from"], piece["to"] = piece["to"], piece["from"]
    return True


def swap_lower_and_upper(rng: random.Random, answer: Answer) -> bool:
    piece = piece_of(rng, answer)
    piece["lower"], piece["upper"] = piece["upper"], piece["lower"]
    return True


def take_a_curve_of_another(rng: random.Random, answer: Answer) -> bool:
    one, other, side = piece_of(rng, answer), piece_of(rng, answer), rng.choice(["lower", "upper"])
    differs = one[side] != other[side]
    one[side] = other[side]
    return bool(differs)


def claim_more_or_less(rng: random.Random, answer: Answer) -> bool:
    """Claim another kind of proof, with the pieces unchanged."""
    if answer["of"] == "interior":
        return False
    answer["of"] = "interior"
    answer.pop("smaller_robot")
    answer.pop("larger_bounds", None)
    return True


def enlarge_the_robot(rng: random.Random, answer: Answer) -> bool:
    """Move one vertex by as much as it was moved, or far more."""
    if answer["of"] == "interior":
        return False
    ring = rng.choice(answer["smaller_robot"])["outer"]
    k, by = rng.randrange(len(ring)), rng.choice([Fraction(1, 2**17), Fraction(2), Fraction(100)])
    ring[k] = [str(Fraction(c) + (by if Fraction(c) > 0 else -by)) for c in ring[k]]
    return True


def shrink_the_bounds(rng: random.Random, answer: Answer) -> bool:
    if not answer.get("larger_bounds"):
        return False
    k = rng.randrange(4)
    answer["larger_bounds"][k] = str(round(Fraction(answer["larger_bounds"][k])))
    return True


def move_an_end(rng: random.Random, answer: Answer) -> bool:
    """Move it into something, or next to the other end."""
    one, other = rng.sample(["start", "goal"], 2)
    answer["exact"][one] = answer["exact"][other]
    if rng.random() < 0.5:
        answer["exact"][one] = [moved(rng, answer["exact"][one][0], Fraction(1, 99)), *answer["exact"][other][1:]]
    return True


# --- separations among rounded shapes ---


def arc_of(rng: random.Random, answer: Answer) -> tuple[Answer, int]:
    """A core, and the number of one of its arcs."""
    parts = [part for parts in answer["rounded"].values() for part in parts if part.get("arcs")]
    part = rng.choice(parts)
    return part, rng.randrange(len(part["arcs"]))


def drop_an_arc(rng: random.Random, answer: Answer) -> bool:
    part, k = arc_of(rng, answer)
    part["arcs"].pop(k)
    return True


def move_a_center(rng: random.Random, answer: Answer) -> bool:
    part, k = arc_of(rng, answer)
    center, by = part["arcs"][k]["center"], rng.choice([Fraction(1, 2**100), Fraction(1, 99)])
    center[rng.randrange(2)] = moved(rng, center[0], by)
    return True


def enlarge_an_arc(rng: random.Random, answer: Answer) -> bool:
    """Make its center, ends and radius larger in proportion, with the core's vertices."""
    part, k = arc_of(rng, answer)
    arc, factor = part["arcs"][k], 1 + rng.choice([Fraction(1, 2**60), Fraction(1, 9)])
    arc["radius"] = str(Fraction(arc["radius"]) * factor)
    for name in ("start", "end", "center"):
        larger = [str(Fraction(c) * factor) for c in arc[name]]
        part["outer"] = [larger if point == arc[name] else point for point in part["outer"]]
        arc[name] = larger
    return True


def grow_a_core(rng: random.Random, answer: Answer) -> bool:
    part = rng.choice([part for parts in answer["rounded"].values() for part in parts])
    part["radius"] = str(Fraction(part["radius"]) + rng.choice([Fraction(1, 2**60), Fraction(1, 9)]))
    return True


OF_PATHS: tuple[Mutation, ...] = (
    change_a_vector, change_two_vectors, change_a_pole, change_an_angle, turn_the_other_way, drop_a_motion,
    repeat_a_motion, swap_two_motions, change_an_end, change_start_and_goal, change_a_decimal,
    claim_that_decimals_are_free, change_the_hash_of_the_scene, change_the_box_of_the_robot,
)  # fmt: skip
OF_SLIDES: tuple[Mutation, ...] = (
    change_a_coefficient, change_the_angle_of_a_slide, exchange_x_and_y, change_a_kept_contact,
    change_the_kind_of_a_kept_contact, change_the_decimals_of_a_slide,
)  # fmt: skip
UNREPAIRED = change_an_end, change_a_decimal, change_the_decimals_of_a_slide
OF_SEPARATIONS: tuple[Mutation, ...] = (
    drop_a_piece, repeat_a_piece, drop_all_pieces, change_a_contact, change_the_kind_of_a_contact, change_a_chart,
    take_an_angle_of_another, move_an_interval, change_the_name_of_an_angle, swap_from_and_to, swap_lower_and_upper,
    take_a_curve_of_another, claim_more_or_less, enlarge_the_robot, shrink_the_bounds, move_an_end,
)  # fmt: skip


# --- clearances ---


def change_the_clearance(rng: random.Random, answer: Answer) -> bool:
    answer["clearance"] = str(Fraction(answer["clearance"]) * rng.choice([Fraction(9, 10), Fraction(11, 10), -1]))
    return True


def move_a_vertex_of_the_disc(rng: random.Random, answer: Answer) -> bool:
    """Move a vertex of the disc, or of a core of a proof."""
    ring = answer["disc"] if "disc" in answer else rng.choice(answer["cores"])["outer"]
    k, far = rng.randrange(len(ring)), rng.choice([Fraction(-1), Fraction(9, 10), Fraction(1001, 1000), Fraction(30)])
    ring[k] = [str(Fraction(c) * far) for c in ring[k]]
    return True


def turn_the_disc_round(rng: random.Random, answer: Answer) -> bool:
    """Reverse the disc, or exchange the cores of a proof."""
    (answer["disc"] if "disc" in answer else answer["cores"]).reverse()
    return True


def drop_a_vertex_of_the_disc(rng: random.Random, answer: Answer) -> bool:
    """Drop a vertex of the disc, or a core of a proof."""
    ring = answer["disc"] if "disc" in answer else answer["cores"]
    ring.pop(rng.randrange(len(ring)))
    return True


def repeat_the_disc(rng: random.Random, answer: Answer) -> bool:
    answer["disc"] = answer.get("disc", [["0", "1"], ["-1", "-1"], ["1", "-1"]]) * 2
    return True


OF_DISTANCES: tuple[Mutation, ...] = (
    change_the_clearance, move_a_vertex_of_the_disc, turn_the_disc_round, drop_a_vertex_of_the_disc, repeat_the_disc,
)  # fmt: skip


# --- trying them ---


def repaired(scene: Scene, answer: Answer) -> Answer:
    """Return the answer with the goal to which the motions lead, so that there is something left to verify."""
    x, y, theta = answer["exact"]["start"]
    moves = [moved_by(motion["type"], motion["exact"], motion.get("contacts", ())) for motion in answer["motions"]]
    return json.loads(text_of(Path(Pose(x, y, theta), moves, scene=scene)))  # type: ignore[no-any-return]


def moved_by(kind: str, exact: Answer, contacts: list[Answer]) -> Motion:
    if kind == "translation":
        return Translation(exact["vector"])
    if kind == "rotation":
        return Rotation(exact["pole"], {"tau": exact["tau"]})
    first, last = (Touch(c["kind"], tuple(c["robot"]), tuple(c["obstacle"])) for c in contacts)
    return Slide((first, last), exact["x"], exact["y"], exact["d"], exact["tau"])


def verdict(scene: Scene, answer: Answer) -> str:
    """ "bad file", the first check that found something, or "" if it is verified."""
    with tempfile.TemporaryDirectory() as folder:
        file = FilePath(folder, "answer.json")
        file.write_text(json.dumps(answer))
        try:
            result = second_opinion.verified(scene, file)
        except FormatError:
            return "bad file"
        if result.verified:
            assert is_true(scene, load_answer(file)), "what is not true was verified"
    return result.findings[0].kind if result.findings else ""


def is_true(scene: Scene, answer: Path | Separated) -> bool:
    """True if the core judges the answer true."""
    if isinstance(answer, Path):
        ends = scene.start in (None, answer.start) and scene.goal in (None, answer.goal)
        least = clearance(answer, scene) if answer.clearance else None
        return ends and _is_free(answer, scene) and (not least or least.found >= 0.999 * answer.clearance)
    if answer.clearance:  # apart for a robot that is larger by a little more
        scene = with_robot(scene, grown(scene, answer.clearance * Fraction("1.001")), scene.bounds)
    cells = space_of(scene).locate([answer.start, answer.goal]).tolist()
    return min(cells) != -1 and cells[0] != cells[1]


def _is_free(path: Path, scene: Scene) -> bool:
    arcs = arcs_of(scene) if scene.curved else None
    if arcs is None:
        return path.is_free(MotionChecker(scene))
    return all(arcs.is_motion_free(pose, motion) for pose, motion in zip(path.poses, path.motions, strict=False))


@cache
def space_of(scene: Scene) -> FreeSpace:
    return free_space(boundary(scene, threads=1))


def mutants(rng: random.Random, answer: Path | Separated, mutate: Mutation, count: int) -> Iterator[Answer]:
    good = json.loads(text_of(answer))
    for _ in range(count):
        changed = copy.deepcopy(good)
        if mutate(rng, changed) and changed != good:
            yield changed


def tried(mutate: Mutation, count: int) -> Counter[str]:
    """Count the checks that reject mutants; "" counts those verified, and true. Paths also without requested ends."""
    rng = random.Random(mutate.__name__)
    goods: list[tuple[Scene, Path | Separated]] = (
        [corridor(), rounded()]
        if mutate in OF_PATHS
        else [tee()]
        if mutate in OF_SLIDES
        else list(distances())
        if mutate in OF_DISTANCES
        else list(separations())
    )
    counts: Counter[str] = Counter()
    for scene, good in goods:
        for bad in mutants(rng, good, mutate, count):
            if (
                isinstance(good, Path)
                and mutate not in (*UNREPAIRED, *OF_DISTANCES)
                and verdict(scene, bad) == "bad file"
            ):
                with suppress(InvalidPoseError):  # no slide at all
                    bad = repaired(scene, bad)
            counts[verdict(scene, bad)] += 1
            if isinstance(good, Path):
                counts[verdict(replace(scene, start=None, goal=None), bad)] += 1
    return counts


def main(count: int = 20) -> None:
    print("| mutation | tried | rejected | still true | found by |", "|---|--:|--:|--:|---|", sep="\n")
    for mutate in OF_PATHS + OF_SLIDES + OF_SEPARATIONS + OF_DISTANCES:
        counts = tried(mutate, count if mutate in OF_SEPARATIONS else count * 2)
        true = counts.pop("", 0)
        checks = ", ".join(f"{check} {n}" for check, n in counts.most_common(3))
        name, rejected = mutate.__name__.replace("_", " "), counts.total()
        print(f"| {name} | {rejected + true} | {rejected} | {true} | {checks} |", flush=True)


if __name__ == "__main__":
    main()
