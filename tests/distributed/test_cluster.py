"""Workers of Dask on this machine: the same bytes whoever dies."""

from __future__ import annotations

import importlib
import os
import signal
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cfree
from cfree.cli.folders import cluster
from cfree.distributed import TaskError, boundary
from cfree.distributed.running import run
from stones import SCENE

pytest.importorskip("distributed", reason="distributed is not installed: no cluster was tried")
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    with cluster(2, None) as found:
        yield found


def test_functions_are_mapped_over_scenes(client: Any) -> None:
    scenes = [cfree.Scene([(0, 0), (1, 0), (0, 1)], [[(k, 3), (k + 1, 3), (k, 4)]]) for k in range(2, 6)]
    found = [made.stats.trapezoids for made in cfree.distributed.map(cfree.boundary, scenes, client=client)]
    assert found == [made.stats.trapezoids for made in cfree.distributed.map(cfree.boundary, scenes)]


def test_a_function_that_workers_cannot_import_is_said_so(client: Any, tmp_path: Path, monkeypatch: Any) -> None:
    (tmp_path / "only_here.py").write_text("def twice(x): return 2 * x")
    monkeypatch.syspath_prepend(tmp_path)
    only_here = importlib.import_module("only_here")
    with pytest.raises(ImportError, match="only_here"):
        cfree.distributed.map(only_here.twice, [1, 2], client=client)
    assert cfree.distributed.map(only_here.twice, [1, 2]) == [2, 4]


def test_a_cluster_gives_the_same_bytes_when_workers_are_killed(client: Any, tmp_path: Path) -> None:
    here = boundary(SCENE, folder=tmp_path / "here", tiles=12)
    killed = []

    def kill(stage: str, done: int, of: int) -> None:
        if (stage, done) in (("trim", 3), ("glue", 4)):
            pid = next(iter(client.run(os.getpid).values()))
            killed.append(pid)
            os.kill(pid, signal.SIGKILL)

    there = boundary(SCENE, folder=tmp_path / "there", tiles=12, client=client, progress=kill)
    assert len(killed) == 2 and there == here
    for stage in ("trim", "glue"):
        for path in sorted((here.folder / stage).iterdir()):
            assert path.read_bytes() == (there.folder / stage / path.name).read_bytes()
    assert there.verify(sample=5, client=client).verified
    poses = cfree.Poses([(x, y) for x in range(-9, 49, 7) for y in range(-9, 49, 7)], [0.7] * 81)
    cells = here.locate(poses)
    assert set(cells.tolist()) == {-1, 0} and there.locate(poses, client=client).tolist() == cells.tolist()


def test_nobody_else_can_reach_the_cluster(client: Any) -> None:
    """Scheduler and dashboard listen on this machine alone."""
    address = client.scheduler.address
    assert "127.0.0.1" in address
    ports = [int(address.rpartition(":")[2])] + [int(p) for p in client.scheduler_info()["services"].values()]
    outside = socket.gethostbyname(socket.gethostname())
    for port in ports if not outside.startswith("127.") else []:
        with pytest.raises(OSError), socket.create_connection((outside, port), timeout=2):
            pass


def test_a_tile_that_ends_its_workers_is_named(client: Any) -> None:
    with pytest.raises(TaskError, match="tile 7") as caught:
        list(run(os._exit, [(7, (1,))], client))
    assert caught.value.tile == 7
