"""The field in VTK's own terms, drawn off screen: values on a regular grid as a texture, or Lagrange cells of order 4.

    vtk_frames.py FOLDER FRAMES         reads FOLDER/grid.npy and FOLDER/cells.npy, writes FOLDER/vtk-WHAT-VIEW.png
"""

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from common import PIXELS, VIEWS, folder, milliseconds, moved, report, viridis
from sampled import CELLS, ORDER, cell_values, grid_values, lagrange_grid


def lookup(most):
    """The colour map from 0 to a largest value."""
    table = vtk.vtkLookupTable()
    table.SetTable(numpy_to_vtk(np.c_[viridis(), np.full(256, 255, np.uint8)], deep=True))
    table.SetRange(0, most)
    return table


class Window:
    """A window that is not shown, looking at one thing."""

    def __init__(self, prop, colour):
        self.colour, self.renderer, self.window = colour, vtk.vtkRenderer(), vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*PIXELS)
        self.window.AddRenderer(self.renderer)
        self.renderer.SetBackground(1, 1, 1)
        self.renderer.AddViewProp(prop)
        self.renderer.GetActiveCamera().ParallelProjectionOn()

    def look(self, view, k=0):
        _, height, most = VIEWS[view]
        x, y = moved(view, k) if k else VIEWS[view][0]
        camera = self.renderer.GetActiveCamera()
        camera.SetFocalPoint(x, y, 0)
        camera.SetPosition(x, y, 1)
        camera.SetParallelScale(height / 2)
        camera.SetClippingRange(0.1, 10)
        self.colour(most)

    def draw(self):
        self.window.Render()
        # drawn when this returns, as pictures on the CPU are
        self.window.WaitForCompletion()

    def save(self, path):
        self.draw()
        shot, writer = vtk.vtkWindowToImageFilter(), vtk.vtkPNGWriter()
        shot.SetInput(self.window)
        shot.ReadFrontBufferOff()
        writer.SetInputConnection(shot.GetOutputPort())
        writer.SetFileName(str(path))
        writer.Write()


def texture(values):
    """An image of values; its window, and what says that the values are new."""
    rows, columns = values.shape
    image = vtk.vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetOrigin(-1, -1, 0)
    image.SetSpacing(2 / (columns - 1), 2 / (rows - 1), 1)
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel().astype(np.float32), deep=True))
    slice, mapper = vtk.vtkImageSlice(), vtk.vtkImageSliceMapper()
    mapper.SetInputData(image)
    slice.SetMapper(mapper)
    slice.GetProperty().SetInterpolationTypeToLinear()

    def colour(most):
        slice.GetProperty().SetLookupTable(lookup(most))
        slice.GetProperty().UseLookupTableScalarRangeOn()

    def new():
        image.GetPointData().GetScalars().Modified()
        image.Modified()

    return Window(slice, colour), new


def cells(values, level):
    """Lagrange cells, divided for drawing; its window, and what says that the values are new."""
    grid = lagrange_grid(values)
    surface, mapper, actor = vtk.vtkDataSetSurfaceFilter(), vtk.vtkPolyDataMapper(), vtk.vtkActor()
    surface.SetInputData(grid)
    surface.SetNonlinearSubdivisionLevel(level)
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.UseLookupTableScalarRangeOn()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()

    def new():
        grid.GetPointData().GetScalars().Modified()
        grid.Modified()

    return Window(actor, lambda most: mapper.SetLookupTable(lookup(most))), new


def measured(at, frames, name, words, made):
    window, new = made
    pictures = {view: f"vtk-{name}-{view}.png" for view in VIEWS}
    for view, picture in pictures.items():
        window.look(view)
        window.save(at / picture)

    def panned(k):
        window.look("whole", k)
        window.draw()

    def changed(k):
        new()
        panned(k)

    window.look("whole")
    data, view = milliseconds(changed, frames), milliseconds(panned, frames)
    gl = window.window.ReportCapabilities().split("OpenGL renderer string:")[-1].split("\n")[0].strip()
    report(words, {"vtk": vtk.VTK_VERSION, "opengl": gl}, pictures, data, view)


def main():
    at, frames = folder()
    grid = grid_values(at)
    measured(at, frames, "texture", f"VTK, values on {grid.shape[1]}² points as a texture", texture(grid))
    values = cell_values(at)
    for level in (1, 3):
        words = f"VTK, {CELLS}² Lagrange cells of order {ORDER}, divided {level} times"
        measured(at, frames, f"cells-{level}", words, cells(values, level))


main()
