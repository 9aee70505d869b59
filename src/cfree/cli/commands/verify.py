"""The command ``cfree verify``: a second opinion on boundaries and answers."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from cfree.cli import drawing, options, reading
from cfree.cli.faults import REFUTED, one_line_faults
from cfree.cli.files import bar, read_scene
from cfree.cli.options import FILE, examples
from cfree.cli.terminal import print_json
from cfree.formats.text.archive import is_archive

if TYPE_CHECKING:
    from cfree.verify.result import Verification


@click.command(
    cls=drawing.Command,
    epilog=examples(
        "cfree verify scene.json scene.npz",
        "cfree verify scene.json answer.json",
        "cfree verify scene.json scene.npz --deep",
        "cfree verify city --sample 100",
    ),
)
@options.scene
@drawing.drawing
@reading.strict
@click.argument("file", type=FILE, required=False)
@click.option(
    "--sample", type=click.IntRange(min=0), metavar="N", help="Check N random trapezoids of a boundary, no sides.",
    show_default="all",
)  # fmt: skip
@click.option(
    "--slices", type=click.IntRange(min=0), metavar="N", help="Recompute a boundary's slices at N random orientations.",
    default=12, show_default=True,
)  # fmt: skip
@click.option("--seed", type=int, metavar="N", help="Seed the random choices.", default=0, show_default=True)
@click.option(
    "--deep", is_flag=True,
    help="Count a boundary's Euler numbers by slices and by the degree of the Gauss map; for small scenes.",
)  # fmt: skip
@options.workers
@options.scheduler
@options.as_json
def verify(
    scene: Path, file: Path | None, sample: int | None, slices: int, seed: int, deep: bool, workers: int | None,
    scheduler: str | None, as_json: bool,
) -> None:  # fmt: skip
    """Check a boundary or an answer by independent exact code.

    The result distinguishes proved from sampled checks. FILE is a boundary written by cfree boundary -o, or an answer:
    a path or a proof. SCENE may be a folder written by cfree boundary --folder: then each shard and its borders are
    checked (--sample counts for each tile), or FILE, a path in it. Exit code 0: verified; 1: refuted; 2: a file that
    cannot be read.
    """
    with one_line_faults():
        if deep and (file is None or scene.is_dir() or not is_archive(file)):
            raise ValueError("--deep: is for a boundary in one file, as cfree boundary -o writes it; leave it out")
        if scene.is_dir():
            from cfree.cli import folders

            options.refuse("only for a boundary in one file", "slices")
            if file is not None:
                shard_options = "sample", "seed", "workers", "scheduler"
                options.refuse("only for shards, and an answer has none", *shard_options)
            elif sample is None:
                options.refuse("only for the random choices of --sample", "seed", remedy="give --sample as well")
            with folders.cluster(workers, scheduler) as client:
                result = folders.verified(scene, file, sample, seed, client)
            return _print_verified(result, file or scene, as_json)
        if file is None:
            raise ValueError("FILE: there is none; give a boundary or an answer")
        options.refuse("only for shards in a folder", "workers", "scheduler")
        if not is_archive(file):
            options.refuse("only for a boundary", "sample", "slices", "seed")
        elif sample is None and slices == 0:
            options.refuse("only for random choices, and there are none", "seed")
        from cfree.verify.answers import answer as verified_answer
        from cfree.verify.driver import boundary as verified_boundary

        if is_archive(file):
            from cfree.formats.boundaries.boundary_file import read_boundary

            stored = read_boundary(file)
            loaded = read_scene(scene, "rounded" if stored.scene.curved else "none")
            with bar("verify") as progress:
                result = verified_boundary(
                    stored, loaded, sample=sample, slices=slices, seed=seed, deep=deep, progress=progress
                )
        else:
            loaded = read_scene(scene)
            with bar("verify") as progress:
                result = verified_answer(loaded, file, progress=progress)
        _print_verified(result, file, as_json)


def _print_verified(result: Verification, file: Path, as_json: bool) -> None:
    if as_json:
        print_json({"file": str(file), "verified": result.verified, **asdict(result), **reading.facts(result.reading)})
    else:
        from cfree.cli.report import print_verification

        print_verification(str(file), result)
    if not result.verified:
        raise click.exceptions.Exit(REFUTED)
