# SPDX-License-Identifier: MIT
"""blender -b --factory-startup --python-exit-code 1 --python cycles_check.py

Cycles as cycles_scene.py sets it up against closed forms, on a plane: a lamp, a sun, a sky, a
polished surface and rough white metal. Exits with 1 where one is off by more than 0.1 % and its
noise.
"""

import math
import os
import sys
import tempfile

sys.dont_write_bytecode = True  # no folder beside the sources
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy  # noqa: E402
import cycles_scene  # noqa: E402
import numpy  # noqa: E402
from mathutils import Matrix, Vector  # noqa: E402

SIZE = (32, 18)
SAMPLES = 512
SPAN = 4.0  # metres that the picture shows from left to right
WHITE = {"name": "white", "pbrMetallicRoughness": {
    "baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0}}
SKY = 0.5


def metal(roughness):
    return {"name": "metal", "pbrMetallicRoughness": {"roughnessFactor": roughness}}


def grazing(cosine):
    return 0.04 + 0.96 * (1.0 - cosine) ** 5


def begin(material, cosine, sky=((0, 0, 0), (0, 0, 0), (0, 0, 0))):
    """A plane z = 0 under a camera that all rays leave in one direction."""
    cycles_scene.clear()
    bpy.ops.mesh.primitive_plane_add(size=200.0)
    made = bpy.data.materials.new("plane")
    cycles_scene.match_material(made, material)
    bpy.context.object.data.materials.append(made)
    sine = math.sqrt(1.0 - cosine * cosine)
    back = Vector((0.0, -sine, cosine))
    up = Vector((0.0, cosine, sine))
    axes = Matrix(((1, up[0], back[0]), (0, up[1], back[1]), (0, up[2], back[2]))).to_4x4()
    cycles_scene.add_camera(Matrix.Translation(back * 50.0) @ axes, 1.0)
    bpy.context.scene.camera.data.type = "ORTHO"
    bpy.context.scene.camera.data.sensor_fit = "HORIZONTAL"
    bpy.context.scene.camera.data.ortho_scale = SPAN
    cycles_scene.add_sky(*sky)


def pictures():
    """Two, of different seeds; row 0 is the lowest, as Blender has it."""
    cycles_scene.set_up_cycles(SIZE, SAMPLES, 0)
    found = []
    for seed in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "check.exr")
            cycles_scene.render(path, seed, 0)
            image = bpy.data.images.load(path)
            values = numpy.array(image.pixels[:], dtype=numpy.float64)
            found.append(values.reshape(SIZE[1], SIZE[0], -1)[:, :, 0])
            bpy.data.images.remove(image)
    return found


def places():
    """x and y of each pixel's centre on the plane, seen from straight above."""
    step = SPAN / SIZE[0]
    x = (numpy.arange(SIZE[0]) + 0.5 - SIZE[0] / 2) * step
    y = (numpy.arange(SIZE[1]) + 0.5 - SIZE[1] / 2) * step
    return numpy.meshgrid(x, y)


def check(name, expected):
    first, second = pictures()
    ratio = 0.5 * (first + second) / expected
    noise = numpy.sqrt(numpy.mean((0.5 * (first - second) / expected) ** 2) / ratio.size)
    off = ratio.mean() - 1.0
    good = abs(off) < 1e-3 + 4.0 * noise
    print(f"{'ok  ' if good else 'OFF '} {name}: {100 * off:+.4f} % +- {100 * noise:.4f} %",
          flush=True)
    return good


def diffuse(irradiance, cosine=1.0):
    return 0.8 / math.pi * (1.0 - grazing(cosine)) * irradiance


def check_lamp(height, radius):
    begin(WHITE, 1.0)
    cycles_scene.add_lamp((0.3, 0.1, height), (4.0, 4.0, 4.0), radius)
    x, y = places()
    distance = numpy.sqrt((x - 0.3) ** 2 + (y - 0.1) ** 2 + height ** 2)
    return check(f"lamp of radius {radius} m at {height} m", diffuse(4.0 * height / distance ** 3))


def check_sun(angle, radius):
    begin(WHITE, 1.0)
    cycles_scene.add_sun(Matrix.Rotation(angle, 4, "X"), (3.0, 3.0, 3.0), radius)
    return check(f"sun of radius {radius} at {angle} from the zenith",
                 diffuse(3.0 * math.cos(angle)))


def check_sky():
    zenith, horizon = 0.3, 0.9
    begin(WHITE, 0.7, ((zenith,) * 3, (horizon,) * 3, (5.0,) * 3))
    # Integral of mix(horizon, zenith, sqrt(y)) y over the hemisphere; and what the polish mirrors.
    irradiance = math.pi * (0.2 * horizon + 0.8 * zenith)
    mirrored = horizon + (zenith - horizon) * math.sqrt(0.7)
    return check("sky", diffuse(irradiance, 0.7) + grazing(0.7) * mirrored)


def check_metal(roughness, cosine):
    begin(metal(roughness), cosine, ((SKY,) * 3,) * 3)
    ours, cycles = cycles_scene.ggx_albedo(roughness, cosine)
    name = f"white metal of roughness {roughness} at cosine {cosine} (untinted {cycles / ours:.4f})"
    return check(name, SKY * ours)


def main():
    results = [check_lamp(1.0, 0.1), check_lamp(0.5, 0.2), check_sun(0.0, 0.0349),
               check_sun(0.8, 0.0349), check_sun(0.8, 0.00463), check_sky()]
    results += [check_metal(roughness, cosine)
                for roughness in (0.3, 0.6) for cosine in (0.95, 0.6, 0.3)]
    if not all(results):
        sys.exit("cycles_check.py: some are off")


main()
