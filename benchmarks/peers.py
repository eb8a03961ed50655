"""Peers that draw a morphing face, each in a process of its own: `python -m benchmarks.peers NAME DATA.npz`.

Every peer gets positions that numpy has blended (none of them blends itself), draws 1280x800 off-screen
and gives the pixels back; the last line printed is the median in milliseconds.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np

from benchmarks.harness import median_ms

SIZE = (1280, 800)


def poses(data: dict[str, np.ndarray]) -> Callable[[], np.ndarray]:
    """Positions (V, 3) of one slider position after another, all shapes active."""
    neutral, deltas = data["neutral"], data["deltas"].reshape(len(data["deltas"]), -1)
    step = iter(range(10**9))

    def blended() -> np.ndarray:
        weights = np.full(len(deltas), (next(step) % 20) / 20 / len(deltas) ** 0.5, np.float32)
        return neutral + np.einsum("k,kj->j", weights, deltas).reshape(-1, 3)

    return blended


def pyvista(data: dict[str, np.ndarray]) -> Callable[[], object]:
    """PyVista: new points, render, screenshot; flat shading, which is its cheapest."""
    import pyvista

    triangles = data["triangles"]
    faces = np.c_[np.full(len(triangles), 3), triangles].ravel()
    mesh = pyvista.PolyData(data["neutral"].copy(), faces)
    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.add_mesh(mesh, color="tan")
    plotter.show(auto_close=False)
    next_positions = poses(data)

    def frame() -> object:
        mesh.points = next_positions()
        plotter.render()
        return plotter.screenshot(None, return_img=True)

    return frame


def polyscope(data: dict[str, np.ndarray]) -> Callable[[], object]:
    """Polyscope, headless: update the vertex positions, screenshot into a buffer; flat shading."""
    import polyscope

    polyscope.set_allow_headless_backends(True)
    polyscope.set_verbosity(0)
    polyscope.set_ground_plane_mode("none")
    polyscope.init()
    polyscope.set_window_size(*SIZE)
    surface = polyscope.register_surface_mesh("face", data["neutral"], data["triangles"])
    next_positions = poses(data)

    def frame() -> object:
        surface.update_vertex_positions(next_positions())
        return polyscope.screenshot_to_buffer(transparent_bg=False)

    return frame


PEERS = {"pyvista": pyvista, "polyscope": polyscope}


def main(name: str, path: str) -> None:
    """Measure one peer."""
    with np.load(path, allow_pickle=False) as archive:
        data = {key: archive[key] for key in archive.files}
    print(median_ms(PEERS[name](data), times=11, warm=2))


if __name__ == "__main__":
    main(*sys.argv[1:])
