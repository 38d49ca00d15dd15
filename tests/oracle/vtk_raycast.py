# SPDX-License-Identifier: BSD-3-Clause
"""An independent volume renderer makes the same picture: VTK's vtkFixedPointVolumeRayCastMapper on the CPU, unshaded,
with the same camera, transfer function and sample distance. Compared are linear RGB pictures, clipped to 0..1.

Known differences of VTK, all far below the bound: 15-bit fixed point, rays that end at 0.8 % transmittance, first
sample on the entry instead of half a step behind it, 8 bits of the picture it hands out. Voxels of 8 bits would be
rounded again after interpolation, so VTK gets them as 16-bit numbers, 128 times as large.

usage: vtk_raycast.py METAMER VOLUME.nrrd OUTPUT_FOLDER [--bound DECIBEL]; exit status 77 where VTK is missing."""
import argparse
import gzip
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import zlib

try:
    import numpy
    import vtk
    from vtk.util import numpy_support
except ImportError as reason:
    print(f"skipped: {reason}; this test needs Python with numpy and vtk")
    sys.exit(77)

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import exr_file  # noqa: E402

SIZE = 512
STEP = 0.25
AZIMUTH, ELEVATION = 35, 25
VALUE_SCALE = 128

# Fractions of the value range, opacity of one world unit, material.
POINTS = [(0.20, 0.0, "haze"), (0.40, 0.02, "haze"), (0.55, 0.05, "shell"), (0.70, 0.10, "shell"),
          (0.75, 0.50, "core"), (1.00, 0.90, "core")]
MATERIALS = {"haze": "#4080d0", "shell": "#e0a040", "core": "#f02818"}


def read_volume(path):
    with open(path, "rb") as stream:
        data = stream.read()
    header, voxels = data.split(b"\n\n", 1)
    fields = dict(re.findall(r"^([a-z ]+): (.*)$", header.decode("utf-8").replace("\r", ""), re.M))
    if fields["encoding"] in ("gzip", "gz"):
        voxels = gzip.decompress(voxels)
    if fields["type"] not in ("unsigned char", "uchar", "uint8", "uint8_t"):
        raise SystemExit(f"{path}: this test takes 8-bit volumes")
    size = [int(n) for n in fields["sizes"].split()]
    return numpy.frombuffer(voxels, numpy.uint8, count=size[0] * size[1] * size[2]).reshape(size[::-1])


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], check=True, stdout=subprocess.PIPE, text=True).stdout


class Setup:
    """What both renderers are told."""

    def __init__(self, volume):
        edges = [n - 1 for n in volume.shape[::-1]]
        self.target = [edge / 2 for edge in edges]
        self.distance = 1.9 * max(edges)
        self.low, self.high = float(volume.min()), float(volume.max())

    def points(self):
        return [(self.low + f * (self.high - self.low), opacity, name) for f, opacity, name in POINTS]

    def eye(self):
        azimuth, elevation = math.radians(AZIMUTH), math.radians(ELEVATION)
        outward = (math.cos(elevation) * math.sin(azimuth), math.sin(elevation),
                   math.cos(elevation) * math.cos(azimuth))
        return [t + self.distance * o for t, o in zip(self.target, outward)]

    def scene(self, volume_path):
        return {
            "volume": {"file": os.path.abspath(volume_path)},
            "palette": {"materials": [{"name": n, "srgb": c} for n, c in MATERIALS.items()],
                        "lights": [{"name": "day", "illuminant": "D65"}]},
            "transfer": {"opacity_length": 1,
                         "points": [{"value": v, "opacity": o, "material": m} for v, o, m in self.points()]},
            "camera": {"azimuth": AZIMUTH, "elevation": ELEVATION, "distance": self.distance,
                       "target": self.target, "fov": 30},
            "shading": {"ambient": 1, "diffuse": 0, "specular": 0},
            "render": {"size": [SIZE, SIZE], "step": STEP},
        }


def decode_srgb(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def render_metamer(metamer, setup, volume_path, folder):
    """The linear picture and the linear color of every material under the light (`metamer info`)."""
    scene, image = os.path.join(folder, "scene.json"), os.path.join(folder, "image.exr")
    with open(scene, "w", encoding="utf-8") as stream:
        json.dump(setup.scene(volume_path), stream)
    materials = json.loads(run(metamer, "info", scene, "--json"))["materials"]
    colors = {m["name"]: [decode_srgb(c) for c in m["srgb_picture"]["day"]] for m in materials}
    run(metamer, "render", scene, "-o", image)
    exr = exr_file.Image(image)
    planes = [numpy.array(exr.channels[c]).reshape(exr.height, exr.width) for c in "RGB"]
    return numpy.stack(planes, axis=-1), colors


def vtk_image(volume):
    scaled = (volume.astype(numpy.uint16) * VALUE_SCALE).ravel()
    image = vtk.vtkImageData()
    image.SetDimensions(*volume.shape[::-1])
    image.SetSpacing(1, 1, 1)
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(scaled, deep=True, array_type=vtk.VTK_UNSIGNED_SHORT))
    return image


def vtk_property(setup, colors):
    opacity, color = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
    for value, alpha, material in setup.points():
        opacity.AddPoint(value * VALUE_SCALE, alpha)
        color.AddRGBPoint(value * VALUE_SCALE, *colors[material])
    volume_property = vtk.vtkVolumeProperty()
    volume_property.SetScalarOpacity(opacity)
    volume_property.SetColor(color)
    volume_property.SetScalarOpacityUnitDistance(1)
    volume_property.SetInterpolationTypeToLinear()
    volume_property.ShadeOff()
    return volume_property


def render_vtk(volume, setup, colors):
    mapper = vtk.vtkFixedPointVolumeRayCastMapper()
    mapper.SetInputData(vtk_image(volume))
    mapper.AutoAdjustSampleDistancesOff()
    mapper.LockSampleDistanceToInputSpacingOff()
    mapper.SetSampleDistance(STEP)
    mapper.SetInteractiveSampleDistance(STEP)
    mapper.SetImageSampleDistance(1)
    mapper.IntermixIntersectingGeometryOff()
    actor = vtk.vtkVolume()
    actor.SetMapper(mapper)
    actor.SetProperty(vtk_property(setup, colors))
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*setup.eye())
    camera.SetFocalPoint(*setup.target)
    camera.SetViewUp(0, 1, 0)
    camera.SetViewAngle(30)
    renderer.ResetCameraClippingRange()
    window.Render()
    grabber = vtk.vtkWindowToImageFilter()
    grabber.SetInput(window)
    grabber.ReadFrontBufferOff()
    grabber.Update()
    pixels = numpy_support.vtk_to_numpy(grabber.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(SIZE, SIZE, -1)[::-1, :, :3] / 255.0  # VTK's first row is the lowest


def psnr(a, b):
    return -10 * math.log10(max(float(numpy.mean((a - b) ** 2)), 1e-20))


def moved(picture, x, y):
    """The picture moved by x and y pixels, linear between pixels."""
    for axis, amount in ((1, x), (0, y)):
        whole = math.floor(amount)
        part = amount - whole
        picture = (1 - part) * numpy.roll(picture, whole, axis) + part * numpy.roll(picture, whole + 1, axis)
    return picture


def best_movement(a, b):
    """The movement of b that fits a best, in half pixels from -2 to 2, and the PSNR of all. Moving by half a pixel
    blurs, which alone would bring noisy pictures closer, so both are blurred first."""
    def soften(picture):
        return (moved(moved(picture, 0.5, 0.5), -0.5, -0.5))[4:-4, 4:-4]

    reference, steps = soften(a), [i / 2 for i in range(-4, 5)]
    scores = {(x, y): psnr(reference, soften(moved(b, x, y))) for x in steps for y in steps}
    return max(scores, key=scores.get), scores


def write_png(path, linear):
    clipped = numpy.clip(linear, 0, 1)
    encoded = numpy.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    rows = numpy.rint(encoded * 255).astype(numpy.uint8)
    raw = b"".join(b"\0" + row.tobytes() for row in rows)

    def chunk(kind, body):
        return len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")

    header = rows.shape[1].to_bytes(4, "big") + rows.shape[0].to_bytes(4, "big") + b"\x08\x02\0\0\0"
    with open(path, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) +
                     chunk(b"IEND", b""))


def needs_display():
    """VTK ends the process where it finds no X display."""
    return not os.environ.get("DISPLAY")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("metamer")
    parser.add_argument("volume")
    parser.add_argument("output")
    parser.add_argument("--bound", type=float, default=40, help="smallest PSNR in dB")
    request = parser.parse_args()
    if needs_display():
        print("skipped: no display; install xvfb-run")
        return 77
    volume = read_volume(request.volume)
    setup = Setup(volume)
    with tempfile.TemporaryDirectory() as folder:
        ours, colors = render_metamer(request.metamer, setup, request.volume, folder)
    theirs = render_vtk(volume, setup, colors)
    ours, theirs = numpy.clip(ours, 0, 1), numpy.clip(theirs, 0, 1)
    os.makedirs(request.output, exist_ok=True)
    name = os.path.splitext(os.path.basename(request.volume))[0]
    picture = os.path.join(request.output, f"{name}_vtk.png")
    write_png(picture, numpy.concatenate([ours, theirs, 8 * abs(ours - theirs)], axis=1))

    quality = psnr(ours, theirs)
    movement, scores = best_movement(ours, theirs)
    print(f"{name}: PSNR {quality:.2f} dB over {SIZE}x{SIZE} linear RGB, largest difference "
          f"{abs(ours - theirs).max():.4f}, mean {ours.mean():.5f} and {theirs.mean():.5f}, best movement {movement}; "
          f"pictures and 8 x difference in {picture}")
    for x, y in ((0.5, 0), (-0.5, 0), (0, 0.5), (0, -0.5)):
        print(f"  moved by ({x:4}, {y:4}): {scores[(x, y)]:.2f} dB, in place {scores[(0, 0)]:.2f} dB")
    covered = float(numpy.mean(ours.max(axis=-1) > 0.02))
    failures = []
    if covered < 0.1:
        failures.append(f"only {covered:.1%} of the picture shows the volume")
    if quality < request.bound:
        failures.append(f"PSNR is below {request.bound} dB")
    if abs(ours.mean() / theirs.mean() - 1) > 0.02:
        failures.append("the pictures are not equally bright")
    if movement != (0, 0):
        failures.append(f"the pictures are apart by {movement} pixels")
    for failure in failures:
        print(f"FAILED: {failure}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
