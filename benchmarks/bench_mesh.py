"""Meshes within a stated error: triangles beside the best known density and beside grids, and seconds."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from measure import REAL, SCENES, Report, Times, checksum, timed

import cfree
from cfree.forbidden.mesh import Mesh, robot_radius

SHARES = (1e-2, 1e-3, 1e-4)
"""Errors, in the robot's radius."""
LARGE = 50
"""Grids are made for e-v trapezoids of more triangles than this, at most so many of them:"""
SAMPLE = 40


def run(quick: bool) -> Report:
    report = Report(
        "Meshes; errors in robot's radii",
        ("scene", "trapezoids", "error", "triangles", "ratio", "large parts", "uniform", "own grids", "best grids",
         "ms", "ms/1000 triangles", "checksum"),
        notes=[
            "ratio: triangles on e-v patches to the best known density",
            f"large parts: e-v trapezoids of more than {LARGE} triangles, and their ratio",
            "uniform: triangles of grids with one step of t and one of phi for all large parts, the best two, to ours;",
            "own grids: the best two for each part; diagonals alternate; best grids: each diagonal is the better one",
        ],
    )  # fmt: skip
    for name in ("paper_fig9",) if quick else ("paper_fig9", "five_convex", "flat", *REAL):
        boundary = cfree.boundary(cfree.load_scene(SCENES / f"{name}.json"))
        for share in SHARES[: 1 if quick else 3]:
            error = share * robot_radius(boundary.scene)
            try:
                mesh = boundary.mesh(error)
            except cfree.UnsupportedError as refused:
                report.notes.append(f"{name}: {refused}")
                continue
            rounds = 1 if share == SHARES[2] else 3
            (times,) = timed(lambda error=error, boundary=boundary: boundary.mesh(error), rounds=rounds, warm_up=False)
            add(report, name, share, boundary, mesh, times)
    return report


def add(report: Report, name: str, share: float, boundary: cfree.Boundary, mesh: Mesh, times: Times) -> None:
    count = np.bincount(mesh.trapezoid, minlength=len(boundary.trapezoids))
    kind = boundary.patch_kind[boundary.trapezoids.patch]
    (large,) = np.nonzero((kind == 2) & (count > LARGE))
    columns = ["", "", "", ""]
    if len(large):
        chosen = np.random.default_rng(0).permutation(large)[:SAMPLE]
        parts = [SaddlePart(boundary, k, mesh.angle_scale) for k in chosen.tolist()]
        least = np.array([part.least(mesh.error) for part in parts])
        ours = count[chosen].sum()
        grids = [uniform(parts, mesh.error) / ours]
        grids += [sum(part.grid(mesh.error, best) for part in parts) / ours for best in (False, True)]
        columns = [f"{len(large):,}: {ours / least.sum():.2f}", *(f"{grid:.2f}" for grid in grids)]
        if name == "paper_fig9" and share == SHARES[-1]:
            report.figure("mesh, triangles of large patches to the best known", name, ours / least.sum(), "<=", 1.15)
        if share == SHARES[2]:
            report.figure("mesh, triangles of a uniform grid of large patches to ours", name, grids[0], ">=", 2)
            report.figure("mesh, triangles of the patches' own best grids to ours", name, grids[1], ">=", 1)
    report.rows.append((
        name, f"{len(boundary.trapezoids):,}", f"{share:g}", f"{len(mesh.triangles):,}", f"{mesh.ratio:.2f}", *columns,
        times.text(), f"{1e6 * times.best / len(mesh.triangles):.3g}", checksum([mesh.vertices, mesh.triangles]),
    ))  # fmt: skip


def uniform(parts: list[SaddlePart], error: float) -> int:
    """Fewest triangles of grids with the same steps of s and theta on all parts, with this error to first order."""
    fewest = math.inf
    for step in np.geomspace(1e-4, 1, 400):
        room = [part.widest(step, error) for part in parts]
        if min(room) > 0:
            rows = (math.ceil(part.high / step) for part in parts)
            columns = (math.ceil(float((part.up - part.low).max()) / min(room)) for part in parts)
            fewest = min(fewest, sum(2 * r * c for r, c in zip(rows, columns, strict=True)))
    return int(fewest)


class SaddlePart:
    """An e-v trapezoid: s from its lower to its upper curve, at 65 angles."""

    def __init__(self, boundary: cfree.Boundary, trapezoid: int, scale: float) -> None:
        table = boundary.trapezoids
        a, edge = np.split(boundary.ruled[table.patch[trapezoid], 4:], 2)
        length = math.hypot(*edge)
        self.w, self.h = scale, abs(edge[1] * a[0] - edge[0] * a[1]) / length
        self.radius = max(math.hypot(*a), math.hypot(*(a + edge)))
        self.high = float((table.theta_to - table.theta_from)[trapezoid])
        theta = np.linspace(table.theta_from[trapezoid], table.theta_to[trapezoid], 65)
        limits = boundary.limits(np.full(65, trapezoid), theta)
        self.low, self.up = (a @ edge / length + t * length for t in limits)

    def least(self, error: float) -> float:
        """Triangles of the best known density."""
        wide = np.arcsinh(self.up / self.w) - np.arcsinh(self.low / self.w)
        return math.sqrt(3) / 8 * self.w * self.high * float((wide[:-1] + wide[1:]).mean() / 2) / error

    def grid(self, error: float, best: bool) -> int:
        """Fewest triangles of a grid with this error to first order; its outer curves may be off by as much."""
        return min(2 * rows * columns for rows, columns in self._grids(error, best))

    def widest(self, step: float, error: float) -> float:
        """How wide cells of a height may be."""
        nearest = max(0.0, float(np.minimum(self.up, self.low).min()), float(-np.maximum(self.up, self.low).max()))
        lean = 0.5 * self.h * step
        allowed = error * math.hypot(self.w, nearest) / self.w
        return 4 * allowed / step - lean if step * lean / 4 <= allowed and self.radius * step**2 <= 8 * error else 0.0

    def _grids(self, error: float, best: bool) -> Iterator[tuple[int, int]]:
        rows = math.ceil(self.high / math.sqrt(8 * error / self.radius))
        fewest = math.inf
        while 2 * rows < fewest:
            columns = self._columns(self.high / rows, error, best)
            if columns:
                fewest = min(fewest, 2 * rows * columns)
                yield rows, columns
            rows += max(1, rows // 30)

    def _columns(self, step: float, error: float, best: bool) -> int:
        """Fewest columns for rows so high, 0 if there are none."""
        few, many = 0, 1
        while not self._is_close(step, many, error, best):
            few, many = many, 2 * many
            if many > 1e4:
                return 0
        while many - few > 1:
            middle = (few + many) // 2
            few, many = (few, middle) if self._is_close(step, middle, error, best) else (middle, many)
        return many

    def _is_close(self, step: float, columns: int, error: float, best: bool) -> bool:
        share = np.arange(columns + 1) / columns
        s = np.abs(self.low[:, None] + (self.up - self.low)[:, None] * share)
        nearest, wide = np.minimum(s[:, 1:], s[:, :-1]), ((self.up - self.low) / columns)[:, None]
        lean = 0.5 * self.h * step
        diagonal = step * np.abs(wide - lean if best else wide + lean) / 4
        off = np.maximum(diagonal, step * lean / 4) * self.w / np.hypot(self.w, nearest)
        return bool(off.max() <= error)
