"""Faces drawn by PyVista, off the screen: true depth order, pixel by pixel."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

FINER, LARGEST = 3, 6000  # pixels along the side of one that is shown; along the side of a picture


def image_of(faces: Floats, rgb: Floats, size: tuple[int, int]) -> NDArray[np.uint8]:
    """Picture (height, width, 4) of flat faces, transparent where there are none.

    Parameters
    ----------
    faces : (n, 4, 3) float64
        x and y in pixels from the lower left, and the depth: the camera has projected them already.
    rgb : (n, 3) float64
    size : (int, int)
        Width and height in pixels.
    """
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # it finds its way without a screen
    width, height = size
    finer = max(1, min(FINER, LARGEST // max(size)))
    points = faces.reshape(-1, 3).copy()
    near, far = points[:, 2].min(), points[:, 2].max()
    points[:, 2] = -(points[:, 2] - near) / max(far - near, 1e-300) * max(size)
    n = len(faces)
    cells = np.column_stack((np.full(n, 4), np.arange(4 * n).reshape(n, 4)))
    mesh = pyvista.PolyData(points, cells.ravel())
    mesh.cell_data["rgb"] = np.rint(255 * rgb).astype(np.uint8)
    plotter = pyvista.Plotter(off_screen=True, window_size=[width * finer, height * finer])
    plotter.disable_anti_aliasing()
    plotter.add_mesh(mesh, scalars="rgb", rgb=True, lighting=False)
    middle = (width / 2, height / 2)
    plotter.camera_position = [(*middle, 2.0 * max(size)), (*middle, 0.0), (0.0, 1.0, 0.0)]
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = height / 2
    plotter.camera.clipping_range = (0.5 * max(size), 4.0 * max(size))
    fine = np.asarray(plotter.screenshot(transparent_background=True, return_img=True)).astype(np.float64)
    plotter.close()
    # the mean of small pixels, weighed by their opacity
    blocks = fine.reshape(height, finer, width, finer, 4)
    alpha = blocks[..., 3:].mean(axis=(1, 3))
    colour = (blocks[..., :3] * blocks[..., 3:]).mean(axis=(1, 3)) / np.maximum(alpha, 1e-9)
    picture: NDArray[np.uint8] = np.rint(np.concatenate((colour, alpha), axis=-1)).astype(np.uint8)
    return picture
