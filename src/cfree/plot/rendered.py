"""Render faces by PyVista, off the screen: true depth order, pixel by pixel."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from cfree.errors import UnsupportedError

Renderer = Literal["matplotlib", "pyvista"]
Floats = NDArray[np.float64]

FINER = 3  # rendered pixels along the side of a shown one
LARGEST = 6000  # pixels along the side of a picture at most
PEELS = 12  # transparent faces behind each other
MISSING = "surfaces in true depth order need PyVista: pip install 'cfree[render]'"


def best_renderer() -> Renderer:
    """Return "pyvista" if it is installed with the libraries it needs, else "matplotlib"."""
    if not find_spec("pyvista"):
        return "matplotlib"
    try:
        import pyvista  # noqa: F401
    except ImportError:
        return "matplotlib"
    return "pyvista"


def require(renderer: Renderer) -> None:
    """Raise UnsupportedError, with the install command, if a renderer is missing."""
    if renderer == "pyvista" and not find_spec("pyvista"):
        raise UnsupportedError(MISSING)


def image_of(faces: Floats, rgba: Floats, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Return a picture (height, width, 4) of flat faces, transparent elsewhere.

    Parameters
    ----------
    faces : (n, 4, 3) float64
        Projected corners: x and y in pixels from the lower left, and the depth.
    rgba : (n, 4) float64
    size : (int, int)
        Width and height in pixels.
    """
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it warns without a screen, and works
    width, height = size
    finer = max(1, min(FINER, LARGEST // max(size)))
    points = faces.reshape(-1, 3).copy()
    near, far = points[:, 2].min(), points[:, 2].max()
    points[:, 2] = -(points[:, 2] - near) / max(far - near, 1e-300) * max(size)
    n = len(faces)
    cells = np.column_stack((np.full(n, 4), np.arange(4 * n).reshape(n, 4)))
    mesh = pyvista.PolyData(points, cells.ravel())
    mesh.cell_data["rgba"] = np.rint(255 * rgba).astype(np.uint8)
    plotter: Any = pyvista.Plotter(off_screen=True, window_size=[width * finer, height * finer])
    plotter.disable_anti_aliasing()  # else peeling makes faces vanish
    if (rgba[:, 3] < 1).any():
        plotter.enable_depth_peeling(number_of_peels=PEELS)
    plotter.set_background("black")
    plotter.add_mesh(mesh, scalars="rgba", rgba=True, lighting=False)
    middle = (width / 2, height / 2)
    plotter.camera_position = [(*middle, 2.0 * max(size)), (*middle, 0.0), (0.0, 1.0, 0.0)]
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = height / 2
    plotter.camera.clipping_range = (0.5 * max(size), 4.0 * max(size))
    fine = np.asarray(plotter.screenshot(transparent_background=True, return_img=True)).astype(np.float64)
    plotter.close()
    # the mean of small pixels: transparency mixes their colours with the black behind
    blocks = fine.reshape(height, finer, width, finer, 4)
    alpha = blocks[..., 3:].mean(axis=(1, 3))
    colour = (255 * blocks[..., :3].mean(axis=(1, 3)) / np.maximum(alpha, 1e-9)).clip(0, 255)
    picture: NDArray[np.uint8] = np.rint(np.concatenate((colour, alpha), axis=-1)).astype(np.uint8)
    return picture
