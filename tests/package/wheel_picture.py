# SPDX-License-Identifier: MIT
"""wheel_picture.py FOLDER OUT: renders a sphere with the package that is installed in FOLDER, compares each pixel with
the sphere's closed form, and writes the picture to OUT."""

import sys

import kaamos
import numpy as np

SIZE = 64
SCENE = """
RaytracingAccelerationStructure scene;
RWTexture2D<float4> image;
struct Payload { float4 seen; };
struct Attributes { float3 normal; };
[shader("raygeneration")] void Camera() {
  const uint2 pixel = DispatchRaysIndex().xy;
  RayDesc ray = {float3((pixel + 0.5) / 32.0 - 1, -3), 0, float3(0, 0, 1), 100};
  Payload payload = {float4(0, 0, 0, 0)};
  TraceRay(scene, RAY_FLAG_NONE, 0xFF, 0, 0, 0, ray, payload);
  image[pixel] = payload.seen;
}
[shader("miss")] void Sky(inout Payload payload) { payload.seen = float4(0.5, 0.5, 1, 0); }
[shader("intersection")] void Sphere() {
  const float2 at = ObjectRayOrigin().xy;
  const float inside = 0.64 - dot(at, at);
  if (inside < 0) return;
  Attributes attributes = {float3(at, -sqrt(inside)) / 0.8};
  ReportHit(3 - sqrt(inside), 0, attributes);
}
[shader("closesthit")] void Shade(inout Payload payload, Attributes attributes) {
  payload.seen = float4(attributes.normal * 0.5 + 0.5, RayTCurrent());
}
"""


def main():
    folder, out = sys.argv[1:]
    assert kaamos.__file__.startswith(folder), kaamos.__file__
    device = kaamos.Device(interpret=True)
    scene = device.top_level([kaamos.Instance(device.bottom_level(boxes=np.array([[-0.8] * 3 + [0.8] * 3], np.float32)))])
    image = device.texture(np.zeros((SIZE, SIZE, 4), np.float32))
    device.dispatch_rays(device.compile(SCENE), "Camera", (SIZE, SIZE), miss=["Sky"], hit_groups=["Ball"],
                         groups={"Ball": ("Shade", "", "Sphere")}, attribute_bytes=12, scene=scene, image=image)
    found = image.numpy()

    x, y = np.meshgrid(*[(np.arange(SIZE) + 0.5) / 32 - 1] * 2)
    inside = 0.64 - x * x - y * y
    depth = np.sqrt(np.maximum(inside, 0))
    ball = np.stack([x / 1.6 + 0.5, y / 1.6 + 0.5, 0.5 - depth / 1.6, 3 - depth], axis=-1)
    expected = np.where((inside > 0)[..., None], ball, [0.5, 0.5, 1, 0])
    sure = np.abs(inside) > 1e-4  # rounding decides at the outline
    assert sure.mean() > 0.99
    np.testing.assert_allclose(found[sure], expected[sure], atol=1e-4)

    with open("/proc/self/maps") as maps:
        loaded = {line.split()[-1] for line in maps if "libembree" in line or "libtbb" in line}
    assert loaded and all(path.startswith(folder) for path in loaded), loaded
    with open(out, "wb") as file:
        file.write(b"P6 %d %d 255\n" % (SIZE, SIZE) + (found[..., :3] * 255).astype(np.uint8).tobytes())


main()
