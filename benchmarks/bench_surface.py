"""Evaluating S(t, phi) in bulk beside a plain C loop of the same arithmetic, compiled here and now."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable

import numpy as np
from measure import Report, Times, checksum, timed

import cfree
from cfree import _core
from cfree.contact.contact import EdgeVertex
from cfree.contact.surface import contact_surface

AT_LEAST = 0.5
SOURCE = """
#include <math.h>
#include <stddef.h>
void grid(const double *s, const double *t, size_t nt, const double *phi, size_t nphi, double *out) {
    for (size_t r = 0; r < nphi; ++r) {
        double c = cos(phi[r]), n = sin(phi[r]);
        double x0 = s[0] - (c * s[4] - n * s[5]), y0 = s[1] - (n * s[4] + c * s[5]);
        double ux = s[2] - (c * s[6] - n * s[7]), uy = s[3] - (n * s[6] + c * s[7]);
        for (size_t k = 0; k < nt; ++k) {
            out[2 * (r * nt + k)] = x0 + t[k] * ux;
            out[2 * (r * nt + k) + 1] = y0 + t[k] * uy;
        }
    }
}
void points(const double *s, const double *t, const double *phi, size_t count, double *out) {
    for (size_t k = 0; k < count; ++k) {
        double c = cos(phi[k]), n = sin(phi[k]);
        double ax = s[4] + t[k] * s[6], ay = s[5] + t[k] * s[7];
        out[2 * k] = s[0] + t[k] * s[2] - (c * ax - n * ay);
        out[2 * k + 1] = s[1] + t[k] * s[3] - (n * ax + c * ay);
    }
}
"""


def run(quick: bool) -> Report:
    report = Report(
        "Evaluation of S(t, phi), one thread, beside a C loop (-O3)",
        ("what", "points", "cfree ms", "Mpoints/s", "C ms", "ratio", "C, -march=native ms", "ratio", "checksums"),
    )
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        report.notes.append("no C compiler found: nothing to compare")
        return report
    square = cfree.Polygon([(-1, -1), (2, -1), (2, 1), (-1, 1)])
    surface = contact_surface(square, cfree.Polygon([(5, 5), (8, 5), (6, 7)]), EdgeVertex(0, 0))
    s = surface._coefficients()
    nt, nphi = (1024, 512) if quick else (4096, 1024)
    t, phi = np.linspace(0, 1, nt), np.linspace(0, 2 * np.pi, nphi)
    ts, phis = np.resize(t, nt * nphi // 4), np.linspace(0, 2 * np.pi, nt * nphi // 4)
    grid, points = np.empty((nphi, nt, 2)), np.empty((len(ts), 2))
    with tempfile.TemporaryDirectory() as folder:
        plain, native = compiled(compiler, folder), compiled(compiler, folder, "-march=native")

        def row(what: str, out: np.ndarray, *calls: Callable[[], object], target: float | None = AT_LEAST) -> None:
            sums = []
            for call in calls:
                value = call()
                sums.append(checksum([value if isinstance(value, np.ndarray) else out]))
            ours, c, c_native = timed(*calls, rounds=5 if quick else 15)
            count = out.size // 2
            # with fused multiply and add, -march=native rounds differently
            same = "the same" if sums[0] == sums[1] else "DIFFERENT"
            report.rows.append((
                what, f"{count:,}", ours.text(), f"{count / ours.best / 1e6:,.0f}", c.text(), ratio(c, ours),
                c_native.text(), ratio(c_native, ours), f"{same}: {sums[0]}",
            ))  # fmt: skip
            if target:
                report.figure("evaluation, share of a C loop's speed", what, c.best / ours.best, ">=", target)

        def fresh(loop: Callable[..., None]) -> np.ndarray:
            out = np.empty_like(grid)
            loop(s, t, nt, phi, nphi, out)
            return out

        row(
            "grid, into given memory", grid,
            lambda: _core.evaluate_grid(s, t, phi, grid),
            lambda: plain.grid(s, t, nt, phi, nphi, grid),
            lambda: native.grid(s, t, nt, phi, nphi, grid),
        )  # fmt: skip
        row(
            "Surface.grid, new memory", grid,
            lambda: surface.grid(t, phi),
            lambda: fresh(plain.grid),
            lambda: fresh(native.grid),
        )  # fmt: skip
        row(
            "scattered points, a sine and cosine each", points,
            lambda: _core.evaluate_points(s, ts, phis, points),
            lambda: plain.points(s, ts, phis, len(ts), points),
            lambda: native.points(s, ts, phis, len(ts), points),
        )  # fmt: skip
    return report


def ratio(rival: Times, ours: Times) -> str:
    return f"{rival.best / ours.best:.2f}"


def compiled(compiler: str, folder: str, *options: str) -> ctypes.CDLL:
    """The loops as a library; without errno, so that sine and cosine may be taken together."""
    name = os.path.join(folder, f"loops{len(os.listdir(folder))}.so")
    command = [compiler, "-O3", "-fno-math-errno", *options, "-shared", "-fPIC", "-x", "c", "-", "-o", name, "-lm"]
    subprocess.run(command, input=SOURCE, text=True, check=True)
    library = ctypes.CDLL(name)
    array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
    library.grid.argtypes = [array, array, ctypes.c_size_t, array, ctypes.c_size_t, array]
    library.points.argtypes = [array, array, array, ctypes.c_size_t, array]
    library.grid.restype = library.points.restype = None
    return library
