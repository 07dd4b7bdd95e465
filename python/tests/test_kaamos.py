# SPDX-License-Identifier: MIT
"""The Python package against numpy."""

import os
import signal
import threading
import unittest

import kaamos
import numpy as np

SCENE = """
RaytracingAccelerationStructure scene;
RWTexture2D<float4> image;
struct Payload { float3 color; };
[shader("raygeneration")] void Camera() {
  const uint2 pixel = DispatchRaysIndex().xy;
  const float2 at = (pixel + 0.5) / DispatchRaysDimensions().xy * 2 - 1;
  RayDesc ray = {float3(at, 0), 0, float3(0, 0, 1), 100};
  Payload payload = {float3(0, 0, 0)};
  TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, payload);
  image[pixel] = float4(payload.color, 1);
}
[shader("miss")] void Sky(inout Payload payload) { payload.color = float3(0, 0, 1); }
[shader("closesthit")] void Hit(inout Payload payload, BuiltInTriangleIntersectionAttributes a) {
  payload.color = float3(RayTCurrent() / 10, InstanceID(), 0);
}
"""


class Package(unittest.TestCase):
    def setUp(self):
        self.device = kaamos.Device(interpret=True)

    def test_compute_writes_buffers(self):
        library = self.device.compile("""
            RWStructuredBuffer<float> values; StructuredBuffer<uint> add; cbuffer C { float scale; int less; };
            [shader("compute")] [numthreads(4, 1, 1)] void Main(uint i : SV_DispatchThreadID) {
              values[i] = values[i] * scale + add[i] - less; }""")
        self.assertEqual(library.exports, ["Main"])
        self.assertEqual(sorted(library.resources), ["C", "add", "values"])
        start = np.arange(8, dtype=np.float32)
        values = self.device.buffer(start)
        self.device.dispatch(library, "Main", 2, values=values, add=self.device.buffer(np.arange(8, dtype=np.uint32)),
                             C=(2.5, -3))
        np.testing.assert_array_equal(values.numpy(), start * 2.5 + np.arange(8) + 3)
        self.assertEqual(values.numpy(np.uint8).shape, (32,))
        self.assertEqual(values.numpy(np.float32, (-1, 2)).shape, (4, 2))
        with self.assertRaisesRegex(ValueError, "64 bytes, and there are 32"):
            values.numpy(np.float32, (16,))

    def test_mapped_buffers_are_not_copied(self):
        library = self.device.compile("""
            StructuredBuffer<uint> from; RWStructuredBuffer<uint> to;
            [shader("compute")] [numthreads(4, 1, 1)] void Main(uint i : SV_DispatchThreadID) { to[i] = from[i]; }""")
        mapped = self.device.mapped_buffer(np.arange(4, dtype=np.uint32))
        array = mapped.array
        to = self.device.buffer(np.zeros(4, np.uint32))
        for value in (5, 6):
            array[1] = value
            self.device.dispatch(library, "Main", 1, **{"from": mapped, "to": to})
            np.testing.assert_array_equal(to.numpy(), [0, value, 2, 3])
        del mapped
        self.assertEqual(array[1], 6)  # it keeps the memory
        read = to.numpy()
        read[0] = 9  # its own, which the next one does not see
        self.assertEqual(to.numpy()[0], 0)
        written = self.device.mapped_buffer(np.zeros(4, np.uint32))
        seen = written.array
        self.device.dispatch(library, "Main", 1, **{"from": to, "to": written})
        np.testing.assert_array_equal(seen, [0, 6, 2, 3])
        np.testing.assert_array_equal(written.numpy(), seen)

    def test_typed_buffers_have_the_elements_of_the_array(self):
        library = self.device.compile("""
            Buffer<float4> colors; Buffer<float> grays; RWBuffer<float2> to;
            [shader("compute")] [numthreads(2, 1, 1)] void Main(uint i : SV_DispatchThreadID) {
              to[i] = float2(colors[i].w, grays[i] * 10); }""")
        to = self.device.buffer(np.zeros((2, 2), np.float32))
        self.device.dispatch(library, "Main", 1, to=to,
                             colors=self.device.buffer(np.array([[0, 0, 0, 255], [0, 0, 0, 51]], np.uint8)),
                             grays=self.device.buffer(np.array([0.5, 0.25], np.float16)))
        np.testing.assert_allclose(to.numpy(), [[1, 5], [0.2, 2.5]], rtol=1e-6)

    def test_samplers_read_as_they_say(self):
        library = self.device.compile("""
            Texture2D<float> t; SamplerState s; SamplerComparisonState c; RWStructuredBuffer<float> to;
            [shader("compute")] [numthreads(1, 1, 1)] void Main() {
              to[0] = t.SampleLevel(s, float2(0.45, 0.5), 0); to[1] = t.SampleLevel(s, float2(1.25, 0.5), 0);
              to[2] = t.SampleCmpLevelZero(c, float2(0.75, 0.5), 2); }""")
        texture = self.device.texture(np.array([[1, 3]], np.float32))

        def read(sampler, compare):
            to = self.device.buffer(np.zeros(3, np.float32))
            given = {} if sampler is None else {"s": sampler}
            self.device.dispatch(library, "Main", 1, t=texture, to=to, c=kaamos.Sampler(compare=compare), **given)
            return to.numpy().tolist()
        np.testing.assert_allclose(read(None, "less"), [1.8, 1, 1], atol=0.01)
        self.assertEqual(read(kaamos.Sampler("nearest"), "greater"), [1, 1, 0])
        self.assertEqual(read(kaamos.Sampler("nearest", "clamp"), "less"), [1, 3, 1])
        self.assertEqual(read(kaamos.Sampler("nearest", "border", border=(7, 0, 0, 0)), "less"), [1, 7, 1])
        with self.assertRaisesRegex(ValueError, "filter is 'cubic'; there are 'anisotropic', 'linear', 'nearest'"):
            kaamos.Sampler("cubic")
        with self.assertRaisesRegex(TypeError, "'c' is a SamplerComparisonState: give its Sampler a 'compare'"):
            self.device.dispatch(library, "Main", 1, t=texture, to=self.device.buffer(np.zeros(3, np.float32)),
                                 c=kaamos.Sampler())

    def test_textures_keep_their_texels(self):
        for dtype, channels in ((np.float32, 4), (np.float16, 2), (np.uint32, 1), (np.uint8, 4)):
            array = (np.arange(3 * 5 * channels) % 250).astype(dtype).reshape(3, 5, channels)
            np.testing.assert_array_equal(self.device.texture(array).numpy(), array)
        with self.assertRaisesRegex(TypeError, "no texture or typed buffer has 3 channels"):
            self.device.texture(np.zeros((2, 2, 3), np.float32))

    def test_textures_are_sampled(self):
        library = self.device.compile("""
            Texture2D<float> from; SamplerState linear_sampler; RWTexture2D<float> to;
            [shader("compute")] [numthreads(1, 1, 1)] void Main(uint2 i : SV_DispatchThreadID) {
              to[i] = from.SampleLevel(linear_sampler, (i + 1) / 4.0, 0); }""")
        image = np.array([[0, 1], [2, 3]], np.float32)
        out = self.device.texture(np.zeros((3, 3), np.float32))
        self.device.dispatch(library, "Main", (3, 3), **{"from": self.device.texture(image), "to": out})
        np.testing.assert_allclose(out.numpy(), [[0, 0.5, 1], [1, 1.5, 2], [2, 2.5, 3]], atol=1e-2)

    def picture(self, device):
        triangle = device.bottom_level(np.array([[-1, -1, 5], [1, -1, 5], [-1, 1, 5]], np.float32),
                                       np.array([[0, 1, 2]], np.uint32))
        behind = np.eye(4)
        behind[2, 3] = 3
        scene = device.top_level([kaamos.Instance(triangle, id=1),
                                  kaamos.Instance(triangle, behind * [-1, -1, 1, 1])])
        image = device.texture(np.zeros((4, 4, 4), np.float32))
        library = device.compile(SCENE)
        device.dispatch_rays(library, "Camera", (4, 4), miss=["Sky"], hit_groups=["Triangle"],
                             groups={"Triangle": ("Hit",)}, scene=scene, image=image)
        return image

    def test_rays_meet_triangles(self):
        image = self.picture(self.device)
        y, x = np.mgrid[0:4, 0:4]
        near = x + y < 3
        expected = np.where(near[:, :, None], [0.5, 1, 0, 1], [0.8, 0, 0, 1])
        edge = x + y == 3  # on both
        np.testing.assert_allclose(image.numpy()[~edge], expected[~edge], atol=1e-6)
        self.assertTrue(image._repr_png_().startswith(b"\x89PNG"))

    def test_pictures_are_arrays(self):
        import struct

        def size(picture):
            return struct.unpack(">II", picture._repr_png_()[16:24])

        self.assertEqual(size(kaamos.Picture(np.zeros((2, 3)), zoom=4)), (12, 8))
        self.assertEqual(size(kaamos.Picture(np.zeros((2, 3, 2), np.uint8))), (3, 2))
        with self.assertRaisesRegex(TypeError, "shape"):
            kaamos.Picture(np.zeros(3))

    def test_vulkan_gives_the_same(self):
        try:
            device = kaamos.Device("vulkan")
        except kaamos.Error as error:
            if os.environ.get("KAAMOS_REQUIRE_VULKAN") == "1":
                raise
            self.skipTest(str(error))
        y, x = np.mgrid[0:4, 0:4]
        off_edge = x + y != 3
        np.testing.assert_allclose(self.picture(device).numpy()[off_edge],
                                   self.picture(self.device).numpy()[off_edge], atol=1e-6)

    def test_boxes_and_records(self):
        library = self.device.compile("""
            RaytracingAccelerationStructure scene; RWStructuredBuffer<float2> out_values;
            struct Payload { float2 value; }; struct Attributes { float x; };
            cbuffer Record : register(b0, space7) { float of_record; };
            LocalRootSignature local = {"RootConstants(num32BitConstants = 1, b0, space = 7)"};
            SubobjectToExportsAssociation with_local = {"local", "Hit"};
            [shader("raygeneration")] void Start() {
              RayDesc ray = {float3(DispatchRaysIndex().x * 4.0, 0, 0), 0, float3(0, 0, 1), 100};
              Payload payload = {float2(0, 0)};
              TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, payload);
              out_values[DispatchRaysIndex().x] = payload.value; }
            [shader("miss")] void Miss(inout Payload payload) { payload.value = -1; }
            [shader("intersection")] void Box() { Attributes a = {7}; ReportHit(3 + PrimitiveIndex(), 0, a); }
            [shader("closesthit")] void Hit(inout Payload payload, Attributes a) {
              payload.value = float2(RayTCurrent(), a.x + of_record); }""")
        level = self.device.bottom_level(boxes=np.array([[-1, -1, 2, 1, 1, 9], [3, -1, 2, 5, 1, 9]], np.float32))
        scene = self.device.top_level([kaamos.Instance(level, hit_group=1)])
        out = self.device.buffer(np.zeros((3, 2), np.float32))
        self.device.dispatch_rays(library, "Start", 3, miss=["Miss"], hit_groups=[None, ("Boxes", 0.5)],
                                  groups={"Boxes": ("Hit", "", "Box")}, local=["Record"], scene=scene,
                                  out_values=out)
        np.testing.assert_array_equal(out.numpy(), [[3, 7.5], [4, 7.5], [-1, -1]])

    def test_call_broadcasts(self):
        source = "float2 f(float x, float3 v, int k) { return float2(x * v.z, k); }"
        x = np.linspace(0, 1, 5, dtype=np.float32)[:, None]
        v = np.arange(6, dtype=np.float32).reshape(2, 3)
        out = kaamos.call("f", source, x, v, 3, device=self.device)
        self.assertEqual(out.shape, (5, 2, 2))
        np.testing.assert_array_equal(out[..., 0], x * v[:, 2])
        np.testing.assert_array_equal(out[..., 1], 3)
        matrix = np.arange(12, dtype=np.float32).reshape(3, 4)
        np.testing.assert_array_equal(
            kaamos.call("g", "float3x4 g(float3x4 m) { return 2 * m; }", matrix, device=self.device), 2 * matrix)
        self.assertEqual(kaamos.call("h", "uint h(uint a) { return a; }", np.zeros(0), device=self.device).shape, (0,))
        many = np.arange(70000, dtype=np.uint32)
        np.testing.assert_array_equal(
            kaamos.call("s", "uint s(uint a) { return a * a; }", many, device=self.device), many * many)

    def test_rays_are_explained(self):
        device = self.device
        triangle = device.bottom_level(np.array([[-1, -1, 5], [1, -1, 5], [-1, 1, 5]], np.float32),
                                       np.array([[0, 1, 2]], np.uint32))
        scene = device.top_level([kaamos.Instance(triangle, mask=0xFE), kaamos.Instance(triangle, id=3)])
        image = device.texture(np.zeros((4, 4, 4), np.float32))
        library = device.compile(SCENE)
        found = device.explain_rays(library, "Camera", (4, 4), (0, 1), miss=["Sky"], hit_groups=["Triangle"],
                                    groups={"Triangle": ("Hit",)}, scene=scene, image=image)
        self.assertIn("Hit", found.text)
        self.assertEqual(str(found.tree["index"]), "[0, 1, 0]")
        ray = found.tree["ray_generation"][0]["calls"][0]
        self.assertEqual(len(ray["candidates"]), 2)
        self.assertAlmostEqual(image.numpy()[1, 0, 0], 0.5)  # it ran

    def draw(self, device, **options):
        library = device.compile("""
            StructuredBuffer<float4> corners; cbuffer C { float4 color; };
            [shader("vertex")] float4 Corner(uint i : SV_VertexID) : SV_Position { return corners[i]; }
            [shader("pixel")] float4 Color() : SV_Target { return color; }""")
        target = device.texture(np.zeros((8, 8, 4), np.float32))
        corners = np.array([[-1, 1, 0.5, 1], [1, 1, 0.5, 1], [-1, -1, 0.5, 1]], np.float32)
        for color in ((1, 0, 0, 0.5), (0, 1, 0, 0.5)):
            device.draw(library, "Corner", "Color", 3, target, corners=device.buffer(corners),
                        C=np.array(color, np.float32), **options)
        return target.numpy()

    def test_draws(self):
        y, x = np.mgrid[0:8, 0:8]
        inside = x + y < 7
        plain = self.draw(self.device)
        np.testing.assert_array_equal(plain[inside], np.tile([0, 1, 0, 0.5], (28, 1)))
        self.assertFalse(plain[~inside].any())
        # The clear of the second draw; the depth of each draw is its own.
        cleared = self.draw(self.device, clear=(0, 0, 1, 1), depth=True)
        np.testing.assert_array_equal(cleared[inside][0], [0, 1, 0, 0.5])
        np.testing.assert_array_equal(cleared[7, 7], [0, 0, 1, 1])
        blended = self.draw(self.device, blend="alpha")
        np.testing.assert_array_equal(blended[0, 0, :3], [0.25, 0.5, 0])
        self.assertFalse(self.draw(self.device, cull="front").any())
        self.assertEqual(np.count_nonzero(self.draw(self.device, wireframe=True)[1:6, 1:6, 1]), 4)  # one edge
        self.assertFalse(self.draw(self.device, topology="points")[1:, 1:7].any())
        with self.assertRaisesRegex(ValueError, "'triangles', 'triangle strip'"):
            self.draw(self.device, topology="fans")

    def test_frames_have_layers(self):
        lines = []
        frame = kaamos.FrameRenderer(kaamos.Device(), "lounge", 48, 32, effects="ao", settings={"ao-radius": 0.5})
        frame.render(lambda what, done: lines.append((what, done)))
        self.assertTrue(all(0 <= done <= 1 for _, done in lines))
        self.assertIn("ao", frame.layers)
        ao = frame.layer("ao")
        self.assertEqual((ao.dtype, ao.shape[:2]), (np.float32, (32, 48)))
        self.assertTrue(0.1 < ao.mean() < 1)
        again = kaamos.FrameRenderer(kaamos.Device(threads=1), "lounge", 48, 32, effects="ao",
                                     settings={"ao-radius": 0.5})
        np.testing.assert_array_equal(again.layer("ao"), ao)
        wider = kaamos.FrameRenderer(kaamos.Device(), "lounge", 48, 32, effects="ao", settings={"ao-radius": 5})
        self.assertLess(wider.layer("ao").mean(), ao.mean())
        self.assertTrue(frame._repr_png_().startswith(b"\x89PNG"))
        self.assertIn("lounge", kaamos.scenes())
        self.assertIn("ao-radius", [one["name"] for one in kaamos.frame_settings()])
        with self.assertRaises(kaamos.Error) as caught:
            kaamos.FrameRenderer(kaamos.Device(), effects="none such")
        self.assertEqual(caught.exception.id, "KA3046")
        with self.assertRaisesRegex(kaamos.Error, "KA3049"):
            kaamos.FrameRenderer(kaamos.Device(), settings={"ao-radios": 1})

    def test_progress_may_stop_a_frame(self):
        frame = kaamos.FrameRenderer(kaamos.Device(), "lounge", 48, 32, effects="ao")

        def stop(what, done):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            frame.render(stop)
        self.assertEqual(frame.layer("ao").shape[:2], (32, 48))  # and it goes on

    def test_ctrl_c_ends_a_dispatch(self):
        library = self.device.compile("""
            RWStructuredBuffer<uint> sums;
            [shader("compute")] [numthreads(64, 1, 1)] void Main(uint i : SV_DispatchThreadID) {
              uint sum = i;
              for (uint k = 0; k < 10000; ++k) sum = sum * 1664525 + 1013904223;
              InterlockedAdd(sums[i % 64], sum); }""")
        sums = self.device.buffer(np.zeros(64, np.uint32))
        threading.Timer(0.3, signal.raise_signal, (signal.SIGINT,)).start()
        with self.assertRaises(KeyboardInterrupt):
            self.device.dispatch(library, "Main", (65535, 100, 1), sums=sums)
        with self.assertRaises(kaamos.Error) as refused:
            self.device.dispatch(library, "Main", (1, 1, 1), sums=sums)
        self.assertEqual(refused.exception.id, "KA0917")

    def test_other_threads_dispatch(self):
        library = self.device.compile("""
            RWStructuredBuffer<uint> out_;
            [shader("compute")] [numthreads(1, 1, 1)] void Main(uint i : SV_DispatchThreadID) { out_[i] = i + 1; }""")
        made = self.device.buffer(np.zeros(4, np.uint32))
        thread = threading.Thread(target=lambda: self.device.dispatch(library, "Main", (4, 1, 1), out_=made))
        thread.start()
        thread.join()
        np.testing.assert_array_equal(made.numpy(np.uint32), [1, 2, 3, 4])

    def test_pipelines_are_made_once(self):
        library = self.device.compile("""RWStructuredBuffer<uint> a;
            [shader("compute")] [numthreads(1,1,1)] void f() { a[0] += 1; }""")
        a = self.device.buffer(np.zeros(1, np.uint32))
        for _ in range(3):
            self.device.dispatch(library, "f", 1, a=a)
        self.assertEqual(a.numpy()[0], 3)
        other = kaamos.Device(interpret=True)
        b = other.buffer(np.zeros(1, np.uint32))
        other.dispatch(library, "f", 1, a=b)  # made anew: pipelines belong to a device
        self.assertEqual(b.numpy()[0], 1)

    def test_stubs_say_what_there_is(self):
        import ast
        import inspect
        with open(os.path.join(os.path.dirname(kaamos.__file__), "__init__.pyi")) as file:
            stubs = ast.parse(file.read())
        named = {node.name: node for node in stubs.body if hasattr(node, "name")}
        for name in kaamos.__all__:
            if name == "__version__":
                continue
            self.assertIn(name, named)
            thing, stub = getattr(kaamos, name), named[name]
            if not inspect.isclass(thing):
                self.check_arguments(thing, stub)
                continue
            stubbed = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
            for member, function in vars(thing).items():
                if member.startswith("_") and member != "__init__" or name in ("Error", "CheckError", "Library"):
                    continue
                if inspect.isfunction(function) and name != "Explanation" and member in stubbed:
                    self.check_arguments(function, stubbed[member])
                elif not member.startswith("_"):
                    self.assertIn(member, stubbed, name)

    def check_arguments(self, function, stub):
        import inspect
        arguments = stub.args
        names = [one.arg for one in arguments.args] + [one.arg for one in arguments.kwonlyargs]
        names += [one.arg for one in (arguments.vararg, arguments.kwarg) if one]
        self.assertCountEqual(names, list(inspect.signature(function).parameters))

    def test_mistakes_are_explained(self):
        with self.assertRaisesRegex(kaamos.Error, "undeclared") as caught:
            self.device.compile("[shader(\"compute\")] [numthreads(1,1,1)] void f() { undeclared(); }")
        self.assertEqual(caught.exception.id, "KA2752")
        with self.assertRaises(kaamos.Error) as caught:
            kaamos.Device("none")
        self.assertEqual(caught.exception.id, "KA0901")
        library = self.device.compile("""RWStructuredBuffer<uint> a;
            [shader("compute")] [numthreads(1,1,1)] void f() { a[0] = 1; }""")
        with self.assertRaisesRegex(TypeError, "'a' is not given"):
            self.device.dispatch(library, "f", 1)
        with self.assertRaisesRegex(TypeError, "no resource 'b'"):
            self.device.dispatch(library, "f", 1, a=self.device.buffer([1]), b=1)
        with self.assertRaisesRegex(TypeError, "'a' is a Texture, and the shader has a buffer"):
            self.device.dispatch(library, "f", 1, a=self.device.texture(np.zeros((1, 1), np.float32)))
        with self.assertRaisesRegex(TypeError, "takes 1 arguments, and 2 are given"):
            kaamos.call("f", "float f(float x) { return x; }", 1, 2, device=self.device)

    def test_checked_mode_raises(self):
        device = kaamos.Device(interpret=True, checked=True)
        library = device.compile("""RWStructuredBuffer<uint> a;
            [shader("compute")] [numthreads(1,1,1)] void f() { a[1000] = 1; }""")
        with self.assertRaises(kaamos.CheckError) as caught:
            device.dispatch(library, "f", 1, a=device.buffer(np.zeros(4, np.uint32)))
        self.assertEqual(caught.exception.id, "KA0417")

    def test_printf_is_heard(self):
        lines = []
        device = kaamos.Device(interpret=True, on_print=lines.append)
        library = device.compile("""[shader("compute")] [numthreads(2,1,1)]
            void f(uint i : SV_GroupIndex) { printf("i is %u", i); }""")
        device.dispatch(library, "f", 1)
        self.assertEqual(lines, ["(0,0,0): i is 0", "(1,0,0): i is 1"])


if __name__ == "__main__":
    unittest.main()
