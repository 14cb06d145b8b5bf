#!/usr/bin/env python3
"""Draws a finished run folder: the parts pulled apart, one of them opened so that its tetrahedra are seen.

A developer's tool; the picture is committed. Needs VTK for Python and, without a display, xvfb-run (Debian 12:
python3-vtk9 xvfb):

    build/kerf mesh assets/bearing_cap_14k.stl -o build/picture -n 8
    xvfb-run -a python3 assets/gallery/make_picture.py build/picture assets/gallery/bearing_cap.png
"""

import argparse
import pathlib

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

# Okabe and Ito's palette, which colour-blind people can tell apart, with grey for its black.
COLOURS = ["#56B4E9", "#E69F00", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7", "#999999"]
EDGE_SHADE = 0.42  # of the part's colour
LEVELS_APART = 8  # of a colour channel: fewer colours make a smaller file
BACKGROUND = "#FFFFFF"
SIZE = (1200, 560)
OVERSAMPLING = 3  # thin edges need more than the samples of the graphics library
SPREAD = 0.26  # of a part's way from the centre of the body
VIEW_FROM = (-0.14, 0.5, 1.0)
VIEW_UP = (0, 1, 0)


def rgb(colour):
    return [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]


def read_part(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def centre(grid):
    return vtk_to_numpy(grid.GetPoints().GetData()).mean(axis=0)


def cells_of_type(grid, cell_type):
    cells = vtk.vtkExtractCells()
    cells.SetInputData(grid)
    for cell in np.flatnonzero(vtk_to_numpy(grid.GetCellTypesArray()) == cell_type):
        cells.AddCellRange(int(cell), int(cell))
    cells.Update()
    return cells.GetOutput()


def opened(tets, direction):
    """The tetrahedra behind the plane across `direction` through the centre: whole ones, so that the mesh is seen."""
    plane = vtk.vtkPlane()
    plane.SetOrigin(*centre(tets))
    plane.SetNormal(*direction)
    half = vtk.vtkExtractGeometry()
    half.SetInputData(tets)
    half.SetImplicitFunction(plane)
    half.ExtractInsideOn()
    half.Update()
    return half.GetOutput()


def actor(grid, colour, offset):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.ScalarVisibilityOff()
    shape = vtk.vtkActor()
    shape.SetMapper(mapper)
    shape.SetPosition(*offset)
    look = shape.GetProperty()
    look.SetColor(rgb(colour))
    look.SetInterpolationToFlat()
    look.SetAmbient(0.4)
    look.SetDiffuse(0.75)
    look.EdgeVisibilityOn()
    look.SetEdgeColor([EDGE_SHADE * channel for channel in rgb(colour)])
    look.SetLineWidth(OVERSAMPLING)
    return shape


def scene(folder, opened_part):
    parts = [cells_of_type(read_part(path), vtk.VTK_TETRA) for path in sorted(folder.glob("parts/part_????.vtu"))]
    middle = np.mean([centre(part) for part in parts], axis=0)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(rgb(BACKGROUND))
    for i, part in enumerate(parts):
        offset = SPREAD * (centre(part) - middle)
        shown = opened(part, VIEW_FROM) if i == opened_part else part
        renderer.AddActor(actor(shown, COLOURS[i % len(COLOURS)], offset))
    return renderer


def aim(renderer, zoom):
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*VIEW_FROM)
    camera.SetViewUp(*VIEW_UP)
    camera.SetViewAngle(20)
    renderer.ResetCamera()
    camera.Zoom(zoom)
    renderer.ResetCameraClippingRange()


def save(renderer, path):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(OVERSAMPLING * side for side in SIZE))
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    smooth = vtk.vtkImageResize()
    smooth.SetInputConnection(grab.GetOutputPort())
    smooth.SetOutputDimensions(*SIZE, 1)
    smooth.Update()
    image = smooth.GetOutput()
    levels = vtk_to_numpy(image.GetPointData().GetScalars())
    levels[:] = np.minimum(levels.astype(int) // LEVELS_APART * LEVELS_APART + LEVELS_APART, 255)
    writer = vtk.vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.Write()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="finished run folder")
    parser.add_argument("picture", type=pathlib.Path, help="PNG file to write")
    parser.add_argument("--open", type=int, default=5, help="which part is opened, counted from 0")
    parser.add_argument("--zoom", type=float, default=2.05)
    args = parser.parse_args()
    renderer = scene(args.folder, args.open)
    aim(renderer, args.zoom)
    save(renderer, args.picture)


if __name__ == "__main__":
    main()
