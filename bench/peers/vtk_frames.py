# SPDX-License-Identifier: BSD-3-Clause
"""Renders the frames of `metamer bench` with VTK's software raycaster, vtkFixedPointVolumeRayCastMapper, which does the
same work: trilinear samples, shading from gradients, empty-space skipping, early ray termination; in 15-bit fixed point.

usage: vtk_frames.py VOLUME.raw X Y Z smoke|solid, or vtk_frames.py marschner-lobb EDGE smoke|solid
Each line of standard input is a JSON object: threads, views (8), step (1). For each a line is written: {"ms": [the
mapper's own time of every view], "fill": share of pixels that are not black}. With "reference": STEP the answer is
instead how far the first view at the step is from that at STEP: {"snr_db": signal to noise}."""
import json
import math
import sys

import numpy
import vtk
from vtk.util import numpy_support

EDGE = 512  # pixels
VIEWS = 8
OPACITY = {"smoke": ((0, 0), (80, 0), (110, 0.02), (180, 0.05), (200, 0.6), (255, 0.9)),
           "solid": ((0, 0), (80, 0), (110, 0.6), (255, 0.95))}  # of one voxel's length
COLOR = ((0, 0.2, 0.2, 0.3), (110, 0.55, 0.6, 0.75), (180, 0.7, 0.75, 0.9), (200, 0.95, 0.6, 0.2), (255, 1, 0.9, 0.5))


def marschner_lobb(edge):
    """S. R. Marschner, R. J. Lobb (IEEE Visualization 1994), eq. 5, in bytes; [z, y, x]."""
    place = numpy.linspace(-1, 1, edge)
    z, y, x = numpy.meshgrid(place, place, place, indexing="ij", sparse=True)
    ripple = numpy.cos(12 * math.pi * numpy.cos(0.5 * math.pi * numpy.sqrt(x * x + y * y)))
    signal = (1 - numpy.sin(0.5 * math.pi * z) + 0.25 * (1 + ripple)) / 2.5
    return numpy.floor(255 * signal + 0.5).astype(numpy.uint8)


def read_volume(words):
    if words[0] == "marschner-lobb":
        return marschner_lobb(int(words[1]))
    x, y, z = map(int, words[1:4])
    return numpy.fromfile(words[0], numpy.uint8).reshape(z, y, x)


def make_property(transfer):
    opacity = vtk.vtkPiecewiseFunction()
    for value, alpha in OPACITY[transfer]:
        opacity.AddPoint(value, alpha)
    color = vtk.vtkColorTransferFunction()
    for value, red, green, blue in COLOR:
        color.AddRGBPoint(value, red, green, blue)
    look = vtk.vtkVolumeProperty()
    look.SetScalarOpacity(opacity)
    look.SetColor(color)
    look.SetScalarOpacityUnitDistance(1)
    look.SetInterpolationTypeToLinear()
    look.ShadeOn()
    look.SetAmbient(0.3)
    look.SetDiffuse(0.6)
    look.SetSpecular(0.3)
    look.SetSpecularPower(20)
    return look


class Frames:
    def __init__(self, voxels, transfer):
        self.size = voxels.shape[::-1]
        data = vtk.vtkImageData()
        data.SetDimensions(*self.size)
        data.GetPointData().SetScalars(numpy_support.numpy_to_vtk(voxels.ravel(), deep=True))
        self.mapper = vtk.vtkFixedPointVolumeRayCastMapper()
        self.mapper.SetInputData(data)
        self.mapper.SetBlendModeToComposite()
        self.mapper.AutoAdjustSampleDistancesOff()
        self.mapper.SetImageSampleDistance(1)
        volume = vtk.vtkVolume()
        volume.SetMapper(self.mapper)
        volume.SetProperty(make_property(transfer))
        self.renderer = vtk.vtkRenderer()
        self.renderer.AddVolume(volume)
        self.renderer.SetBackground(0, 0, 0)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(EDGE, EDGE)
        self.window.SetDesiredUpdateRate(1e-5)  # as long as it takes
        self.window.AddRenderer(self.renderer)

    def turn(self, view):
        azimuth = math.radians(15 + 360 * view / VIEWS)
        elevation = math.radians(20)
        outward = (math.cos(elevation) * math.sin(azimuth), math.sin(elevation), math.cos(elevation) * math.cos(azimuth))
        target = [(n - 1) / 2 for n in self.size]
        distance = 1.75 * max(self.size)
        camera = self.renderer.GetActiveCamera()
        camera.SetViewAngle(30)
        camera.SetFocalPoint(*target)
        camera.SetPosition(*(t + distance * o for t, o in zip(target, outward)))
        camera.SetViewUp(0, 1, 0)
        self.renderer.ResetCameraClippingRange()

    def render(self, view):
        """Milliseconds of the mapper, without showing the picture, and the pixels: 8 bits of linear red, green, blue."""
        self.turn(view)
        self.window.Render()
        self.window.WaitForCompletion()
        pixels = vtk.vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, EDGE - 1, EDGE - 1, 1, pixels, 0)
        return 1e3 * self.mapper.GetTimeToDraw(), numpy_support.vtk_to_numpy(pixels).reshape(-1, 3).copy()

    def set_step(self, step):
        self.mapper.SetSampleDistance(step)
        self.mapper.SetInteractiveSampleDistance(step)

    def compare_steps(self, step, reference):
        self.set_step(step)
        found = self.render(0)[1].astype(float)
        self.set_step(reference)
        expected = self.render(0)[1].astype(float)
        return 10 * math.log10((expected**2).sum() / ((found - expected) ** 2).sum())

    def answer(self, request):
        self.mapper.SetNumberOfThreads(request["threads"])
        if "reference" in request:
            return {"snr_db": self.compare_steps(request["step"], request["reference"])}
        self.set_step(request.get("step", 1))
        seen = [self.render(view) for view in range(request.get("views", VIEWS))]
        fills = [float((rgb.max(axis=1) > 0).mean()) for _, rgb in seen]
        return {"ms": [ms for ms, _ in seen], "fill": sum(fills) / len(fills)}


def main(words):
    frames = Frames(read_volume(words[:-1]), words[-1])
    for line in sys.stdin:
        print(json.dumps(frames.answer(json.loads(line))), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
