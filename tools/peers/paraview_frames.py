"""The Lagrange cells of vtk_frames.py in ParaView, drawn off screen.

    xvfb-run -a pvpython paraview_frames.py FOLDER FRAMES       reads FOLDER/cells.npy, writes FOLDER/paraview-VIEW.png
"""

import numpy as np
from paraview import servermanager, simple

from common import PIXELS, VIEWS, folder, milliseconds, moved, report, viridis
from sampled import CELLS, ORDER, cell_values, lagrange_grid

# Divisions of a cell for drawing: ParaView's own, and VTK's of vtk_frames.py.
LEVELS = 1, 3


def transfer(most):
    """The colour map from 0 to a largest value."""
    table = simple.GetColorTransferFunction("von-mises")
    places, colours = np.linspace(0, most, 256), viridis() / 255
    table.RGBPoints = np.c_[places, colours].ravel().tolist()
    table.ColorSpace = "RGB"


def look(window, view, k=0):
    _, height, most = VIEWS[view]
    x, y = moved(view, k) if k else VIEWS[view][0]
    window.CameraFocalPoint, window.CameraPosition = [x, y, 0], [x, y, 1]
    window.CameraParallelScale = height / 2
    if k == 0:
        transfer(most)


def main():
    at, frames = folder()
    grid = lagrange_grid(cell_values(at))
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(grid)
    window = simple.CreateRenderView()
    window.ViewSize, window.Background, window.UseColorPaletteForBackground = list(PIXELS), [1, 1, 1], 0
    window.CameraParallelProjection, window.OrientationAxesVisibility = 1, 0
    shown = simple.Show(source, window)
    shown.SetRepresentationType("Surface")
    shown.Ambient, shown.Diffuse = 1.0, 0.0
    simple.ColorBy(shown, ("POINTS", "von-mises"))
    shown.SetScalarBarVisibility(window, False)
    for level in LEVELS:
        shown.NonlinearSubdivisionLevel = level
        measured(at, frames, level, (source, grid, window))


def measured(at, frames, level, shown):
    source, grid, window = shown
    pictures = {view: f"paraview-{level}-{view}.png" for view in VIEWS}
    for view, picture in pictures.items():
        look(window, view)
        simple.SaveScreenshot(str(at / picture), window, ImageResolution=list(PIXELS))

    def panned(k):
        look(window, "whole", k or 1)
        simple.Render(window)

    def changed(k):
        grid.GetPointData().GetScalars().Modified()
        grid.Modified()
        source.MarkModified(source)
        panned(k)

    look(window, "whole")
    words = f"ParaView, {CELLS}² Lagrange cells of order {ORDER}, divided {level} times"
    # dividing takes seconds
    data, view = milliseconds(changed, 3), milliseconds(panned, frames)
    report(words, {"paraview": version()}, pictures, data, view)


def version():
    proxies = servermanager.vtkSMProxyManager
    return f"{proxies.GetVersionMajor()}.{proxies.GetVersionMinor()}.{proxies.GetVersionPatch()}"


main()
