#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws surfaces side by side with the camera and the scale of the first.

    render.py --output picture.png before.ply after.ply [--labels before after]

Reads PLY, OBJ, STL and OFF. Needs Debian's python3-vtk9 and xvfb. VTK needs an X display, so the script
restarts itself on a virtual one.
"""

import argparse
import os
import shutil
import sys

ON_VIRTUAL_DISPLAY = "TRACKED_MCF_ON_VIRTUAL_DISPLAY"

MATERIAL = (0.93, 0.89, 0.83)  # plaster, slightly warm
INK = (0.2, 0.2, 0.2)
EDGES = (0.1, 0.3, 0.65)  # blue
SMALLEST_TEXT = 12  # pixels
OVERSAMPLING = 2  # drawn larger and averaged, for smooth outlines


def parse_arguments():
    parser = argparse.ArgumentParser(
        description="Draws surfaces side by side, with the camera and the scale of the first.")
    parser.add_argument("meshes", nargs="+", metavar="MESH", help=".ply, .obj, .stl or .off")
    parser.add_argument("--output", required=True, metavar="PICTURE.png")
    parser.add_argument("--labels", nargs="+", default=[], metavar="TEXT",
                        help="text below each surface")
    parser.add_argument("--view", nargs=3, type=float, default=(0, 0, -1), metavar=("X", "Y", "Z"),
                        help="direction of the camera (default: 0 0 -1)")
    parser.add_argument("--up", nargs=3, type=float, default=(0, 1, 0), metavar=("X", "Y", "Z"),
                        help="upward direction of the picture (default: 0 1 0)")
    parser.add_argument("--zoom", type=float, default=1, help="above 1: enlarge the middle")
    parser.add_argument("--center", nargs=2, type=float, default=(0, 0), metavar=("RIGHT", "UP"),
                        help="middle of the picture, in half widths and heights of the mesh")
    parser.add_argument("--edges", nargs="+", default=[], metavar="MESH",
                        help="for each surface, a mesh of which to draw the edges over it")
    parser.add_argument("--flat", action="store_true", help="flat shading")
    parser.add_argument("--colours", action="store_true", help="show the colours of PLY vertices")
    parser.add_argument("--height", type=int, default=900, help="height of the picture in pixels")
    arguments = parser.parse_args()
    if arguments.labels and len(arguments.labels) != len(arguments.meshes):
        parser.error("give one label for each mesh")
    if arguments.edges and len(arguments.edges) != len(arguments.meshes):
        parser.error("give one mesh of edges for each mesh")
    if not os.path.isdir(os.path.dirname(os.path.abspath(arguments.output))):
        parser.error(f"the folder of {arguments.output} does not exist")
    return arguments


def restart_on_virtual_display():
    """Restarts the script. An existing display may be unreachable or lack OpenGL."""
    if os.environ.get(ON_VIRTUAL_DISPLAY):
        return
    if not shutil.which("xvfb-run"):
        sys.exit("render.py: xvfb-run is missing. On Debian: apt-get install xvfb xauth")
    os.environ[ON_VIRTUAL_DISPLAY] = "1"
    screen = ["xvfb-run", "--auto-servernum", "--server-args=-screen 0 1280x1024x24"]
    os.execvp(screen[0], screen + [sys.executable, os.path.abspath(__file__)] + sys.argv[1:])


def read_off(path):
    """Reads an OFF file, the only format that VTK does not read."""
    with open(path, encoding="ascii", errors="replace") as file:
        words = [word for line in file for word in line.split("#")[0].split()]
    if not words or words[0] != "OFF":
        sys.exit(f"render.py: {path} does not begin with OFF")
    vertex_count, face_count = int(words[1]), int(words[2])
    points, faces = vtkPoints(), vtkCellArray()
    for i in range(4, 4 + 3 * vertex_count, 3):
        points.InsertNextPoint([float(word) for word in words[i:i + 3]])
    at = 4 + 3 * vertex_count
    for _ in range(face_count):
        corners = int(words[at])
        faces.InsertNextCell(corners, [int(word) for word in words[at + 1:at + 1 + corners]])
        at += 1 + corners
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(faces)
    return surface


def read_surface(path):
    if not os.path.isfile(path):
        sys.exit(f"render.py: there is no file {path}")
    extension = os.path.splitext(path)[1].lower()
    if extension == ".off":
        return read_off(path)
    readers = {".ply": vtkPLYReader, ".obj": vtkOBJReader, ".stl": vtkSTLReader}
    if extension not in readers:
        sys.exit(f"render.py: {path} is not .ply, .obj, .stl or .off")
    reader = readers[extension]()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def add_normals(surface):
    """Keeps the orientation of faces and does not detect creases, because noise has many."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def make_actor(surface, flat, colours):
    surface = add_normals(surface)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarVisibility(colours)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.ForceOpaqueOn()  # whatever the colours' alpha: VTK would not sort translucent faces
    material = actor.GetProperty()
    material.SetColor(MATERIAL)
    material.SetAmbient(0.12)
    material.SetDiffuse(0.88)
    material.SetSpecular(0.12)
    material.SetSpecularPower(25)
    if flat:
        material.SetInterpolationToFlat()
    else:
        material.SetInterpolationToPhong()
    return actor


def make_edges(surface):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    actor = vtkActor()
    actor.SetMapper(mapper)
    lines = actor.GetProperty()
    lines.SetRepresentationToWireframe()
    lines.LightingOff()
    lines.SetColor(EDGES)
    lines.SetLineWidth(OVERSAMPLING)
    return actor


def add_lights(renderer):
    """Adds a grazing key light from the upper left and two weak lights."""
    for position, intensity, color in [((-1.5, 1.5, 1.0), 0.88, (1.0, 0.98, 0.95)),
                                       ((1.8, 0.2, 1.0), 0.34, (0.9, 0.95, 1.0)),
                                       ((0.0, 0.3, 2.0), 0.22, (1.0, 1.0, 1.0))]:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(position)
        light.SetIntensity(intensity)
        light.SetColor(color)
        renderer.AddLight(light)


class View:
    """Returns a parallel camera that shows a whole surface."""

    def __init__(self, surface, arguments):
        self.forward = numpy.array(arguments.view, float) / numpy.linalg.norm(arguments.view)
        right = numpy.cross(self.forward, arguments.up)
        self.right = right / numpy.linalg.norm(right)
        self.up = numpy.cross(self.right, self.forward)
        points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
        axes = numpy.stack([self.right, self.up, self.forward])
        in_view = points[numpy.isfinite(points).all(axis=1)] @ axes.T
        low, high = in_view.min(axis=0), in_view.max(axis=0)
        self.size = high - low
        shift = numpy.array([*arguments.center, 0]) * self.size / 2
        self.center = ((low + high) / 2 + shift) @ axes
        self.half_height = self.size[1] / 2 * 1.06 / arguments.zoom

    def aspect(self):
        return self.size[0] * 1.1 / (self.size[1] * 1.06)

    def apply(self, camera):
        camera.ParallelProjectionOn()
        camera.SetParallelScale(self.half_height)
        camera.SetFocalPoint(self.center)
        camera.SetPosition(self.center - self.forward * numpy.linalg.norm(self.size) * 2)
        camera.SetViewUp(self.up)


def make_label(text, pixels):
    label = vtkTextActor()
    label.SetInput(text)
    label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    label.SetPosition(0.5, 0.012)
    style = label.GetTextProperty()
    style.SetFontSize(pixels)
    style.SetFontFamilyToArial()
    style.SetColor(INK)
    style.SetBackgroundColor(1, 1, 1)  # a zoomed surface may reach it
    style.SetBackgroundOpacity(1)
    style.SetJustificationToCentered()
    style.SetVerticalJustificationToBottom()
    return label


def make_renderer(surface, view, index, arguments):
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    count = len(arguments.meshes)
    renderer.SetViewport(index / count, 0, (index + 1) / count, 1)
    renderer.AddActor(make_actor(surface, arguments.flat, arguments.colours))
    if arguments.edges:
        renderer.AddActor(make_edges(read_surface(arguments.edges[index])))
    renderer.AutomaticLightCreationOff()
    add_lights(renderer)
    view.apply(renderer.GetActiveCamera())
    if arguments.labels:
        # A strip below the surface is the label's.
        camera = renderer.GetActiveCamera()
        camera.SetParallelScale(view.half_height * 1.08)
        camera.SetWindowCenter(0, -0.07)
        renderer.AddViewProp(make_label(arguments.labels[index],
                                        max(arguments.height // 30, SMALLEST_TEXT) * OVERSAMPLING))
    renderer.ResetCameraClippingRange()
    return renderer


def write_picture(window, arguments):
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    width, height, _ = picture.GetOutput().GetDimensions()
    resize = vtkImageResize()
    resize.SetInputConnection(picture.GetOutputPort())
    resize.SetOutputDimensions(width // OVERSAMPLING, height // OVERSAMPLING, 1)
    writer = vtkPNGWriter()
    writer.SetInputConnection(resize.GetOutputPort())
    writer.SetFileName(arguments.output)
    writer.Write()


def main():
    arguments = parse_arguments()
    surfaces = [read_surface(path) for path in arguments.meshes]
    for path, surface in zip(arguments.meshes, surfaces):
        if surface.GetNumberOfPolys() == 0:
            sys.exit(f"render.py: {path} has no faces that could be read")
    view = View(surfaces[0], arguments)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    width = int(arguments.height * view.aspect()) * len(surfaces)
    window.SetSize(width * OVERSAMPLING, arguments.height * OVERSAMPLING)
    for index, surface in enumerate(surfaces):
        window.AddRenderer(make_renderer(surface, view, index, arguments))
    window.Render()
    write_picture(window, arguments)


if __name__ == "__main__":
    if "-h" not in sys.argv and "--help" not in sys.argv:
        restart_on_virtual_display()
    try:
        import numpy
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.all import (
            vtkActor, vtkCellArray, vtkImageResize, vtkLight, vtkOBJReader, vtkPLYReader,
            vtkPNGWriter, vtkPoints, vtkPolyData, vtkPolyDataMapper, vtkPolyDataNormals,
            vtkRenderer, vtkRenderWindow, vtkSTLReader, vtkTextActor, vtkWindowToImageFilter)
    except ImportError as error:
        sys.exit(f"render.py: {error}; on Debian: apt-get install python3-vtk9 python3-numpy, and "
                 "run it with /usr/bin/python3, which knows them")
    main()
