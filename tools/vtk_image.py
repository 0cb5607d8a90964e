"""Draws an exported mesh by VTK, as ParaView does: `vtk_image.py FILE.vtu -o OUT.png CX,CY WIDTH LOW,HIGH [NAME]`.

Needs pyvista and matplotlib. The colours and the place are those of `ppum render --center CX,CY --width WIDTH --range
LOW,HIGH --colormap viridis --size 600x600`.
"""

import sys

import pyvista as pv

PIXELS = 600

file, _, out, center, width, span, *name = sys.argv[1:]
x, y = map(float, center.split(","))
plotter = pv.Plotter(off_screen=True, window_size=[PIXELS, PIXELS])
plotter.add_mesh(
    pv.read(file),
    scalars=name[0] if name else "von-mises",
    clim=[float(end) for end in span.split(",")],
    cmap="viridis",
    lighting=False,
    show_scalar_bar=False,
)
plotter.view_xy()
plotter.enable_parallel_projection()
plotter.camera.focal_point, plotter.camera.position = (x, y, 0.0), (x, y, 1.0)
plotter.camera.parallel_scale = float(width) / 2
plotter.screenshot(out)
