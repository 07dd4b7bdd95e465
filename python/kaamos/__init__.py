# SPDX-License-Identifier: MIT
"""DirectX Raytracing without ray tracing hardware, from Python.

    import kaamos, numpy as np
    device = kaamos.Device()
    library = device.compile('''
        RWStructuredBuffer<float> values;
        [shader("compute")] [numthreads(64, 1, 1)]
        void Double(uint i : SV_DispatchThreadID) { values[i] *= 2; }''')
    values = device.buffer(np.arange(64, dtype=np.float32))
    device.dispatch(library, "Double", 1, values=values)
    print(values.numpy())

Resources are bound by their names in HLSL. What the API refuses raises kaamos.Error, whose `id` is
the number in rtapi/ERRORS.md.
"""

import struct

import numpy as np

from . import _kaamos
from ._kaamos import Error, Library, __version__

__all__ = ["Device", "Buffer", "MappedBuffer", "Texture", "Sampler", "Instance", "AccelerationStructure", "Library", "Explanation", "Picture",
           "FrameRenderer", "scenes", "frame_settings", "Error", "CheckError", "call", "__version__"]


class CheckError(Error):
    """What checked mode reports (KA0400 to KA0499): the program does what DXR leaves undefined."""


class Buffer:
    """Memory that shaders read and write: `ByteAddressBuffer`, `StructuredBuffer<T>` and their RW, and
    `Buffer<T>` and `RWBuffer<T>`, whose elements are the array's last axis if that has up to 4 numbers:
    of the types that textures have."""

    def __init__(self, device, native):
        self._device = device
        self._native = native

    @property
    def nbytes(self):
        """Its size in bytes."""
        return self._native.nbytes

    def numpy(self, dtype=None, shape=None):
        """A numpy array of what is in it now: of the type and shape that it was made with, or of these. One
        axis of `shape` may be -1. The array's memory is what the device copied. Raises ValueError if the
        buffer is smaller."""
        return self._device._session.read_buffer(self._native, dtype, shape)


class MappedBuffer(Buffer):
    """A buffer whose memory is that of `array`: what is written there, the next dispatch reads, what shaders
    write stands there after the dispatch, and nothing is copied."""

    @property
    def array(self):
        """The memory, as an array of the type and shape that it was made with. It keeps the buffer."""
        return self._native.mapped()


class Sampler:
    """How a texture is read: `filter` "nearest", "linear" or "anisotropic"; `address` beyond the edges "wrap",
    "mirror", "mirror once", "clamp" or "border", which has the colour `border`; `lod` the least and the
    greatest level of detail, to which `bias` is added before. `compare` makes it a SamplerComparisonState:
    "less", "less equal", "greater", "greater equal", "equal", "not equal" or "always". Raises ValueError for
    words that there are not."""

    def __init__(self, filter="linear", address="wrap", compare=None, border=(0, 0, 0, 0), bias=0.0,
                 lod=(0.0, 1000.0)):
        self._native = _kaamos.Sampler(filter, address, compare or "", [float(one) for one in border],
                                       float(bias), [float(one) for one in lod])


class Texture:
    """A `Texture2D` or `RWTexture2D` of one mip. Its array has the shape (height, width) or (height,
    width, channels)."""

    def __init__(self, device, native):
        self._device = device
        self._native = native

    @property
    def shape(self):
        """The shape of its array."""
        return self._native.shape

    def numpy(self):
        """A copy as a numpy array of the type and shape that it was made with."""
        return self._device._session.read_texture(self._native)

    def _repr_png_(self):
        """The picture, for notebooks: floats from 0 to 1 as sRGB."""
        return _png(self.numpy())


class AccelerationStructure:
    """A bottom or top level. A top level can be bound as `RaytracingAccelerationStructure`."""

    def __init__(self, native):
        self._native = native


class Instance:
    """An instance of a bottom level in a top level: `transform` (3, 4) from object to world space;
    `id` InstanceID() and `hit_group` its contribution to the hit group index, 24 bits each; `mask`
    and `flags` 8 bits each."""

    def __init__(self, bottom_level, transform=None, id=0, mask=0xFF, hit_group=0, flags=0):
        self.bottom_level = bottom_level
        self.transform = transform
        self.id = id
        self.mask = mask
        self.hit_group = hit_group
        self.flags = flags


class Picture:
    """An array as notebooks show it: (height, width) or (height, width, channels), of uint8, or of floats
    from 0 to 1 that become sRGB. Two channels are red and green. `zoom`: each texel is so many pixels wide
    and high."""

    def __init__(self, array, zoom=1):
        array = np.asarray(array)
        if array.ndim not in (2, 3):
            raise TypeError(f"a picture has the shape (height, width) or (height, width, channels), not {array.shape}")
        self.array = array
        self.zoom = zoom

    def _repr_png_(self):
        return _png(self.array.repeat(self.zoom, axis=0).repeat(self.zoom, axis=1))


class Explanation:
    """What one ray of a dispatch did: `text` for people, `tree` as dicts and lists. The members of the
    tree are those of rtapi::PixelExplanation."""

    def __init__(self, text, json):
        self.text = text
        self._json = json

    @property
    def tree(self):
        """The shaders that ran, the rays that they traced, and each candidate along them."""
        import json
        return json.loads(self._json)

    def __repr__(self):
        return self.text


def _png(array):
    """The bytes of a PNG of an array of floats (0 to 1, linear) or of uint8."""
    import zlib
    if array.ndim == 2:
        array = array[:, :, None]
    array = array[:, :, :3]
    if array.shape[2] == 1:
        array = np.repeat(array, 3, axis=2)
    if array.shape[2] == 2:
        array = np.dstack([array, np.zeros_like(array[:, :, 0])])
    if array.dtype.kind == "f":
        linear = np.clip(np.nan_to_num(array.astype(np.float64)), 0, 1)
        curve = np.where(linear <= 0.0031308, 12.92 * linear,
                         1.055 * linear ** (1 / 2.4) - 0.055)
        array = (curve * 255 + 0.5).astype(np.uint8)
    array = array.astype(np.uint8)
    height, width, _ = array.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), array.reshape(height, -1)], axis=1)

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))


def _constants(value):
    """The bytes of a constant buffer or of a record's constants: bytes, an array, or numbers, of
    which int becomes a 32-bit integer and float a float."""
    if isinstance(value, (bytes, bytearray)):
        return bytes(value)
    if isinstance(value, np.ndarray):
        return np.ascontiguousarray(value).tobytes()
    if isinstance(value, (tuple, list)):
        return b"".join(_constants(one) for one in value)
    if isinstance(value, (bool, np.bool_)):
        return struct.pack("<I", value)
    if isinstance(value, (int, np.integer)):
        return struct.pack("<i" if value < 0 else "<I", value)
    if isinstance(value, (float, np.floating)):
        return struct.pack("<f", value)
    raise TypeError(f"constants are numbers, tuples of them, arrays or bytes, not {type(value).__name__}")


def _native(value):
    is_resource = isinstance(value, (Buffer, Texture, AccelerationStructure, Sampler))
    return value._native if is_resource else _constants(value)


def _three(size):
    size = (size,) if isinstance(size, (int, np.integer)) else tuple(size)
    if not 1 <= len(size) <= 3:
        raise TypeError("a size has one to three numbers")
    return size + (1,) * (3 - len(size))


def _rays(ray_generation, size, miss, hit_groups, callable, groups, local, payload_bytes, attribute_bytes,
          recursion):
    made = [(name,) + tuple(shaders) + ("",) * (3 - len(shaders))
            for name, shaders in (groups or {}).items()]
    return _kaamos.RayDispatch(ray_generation, _records(miss), _records(hit_groups), _records(callable), made,
                               list(local), payload_bytes, attribute_bytes, recursion, _three(size))


def _records(records):
    """Names, or (name, constants) for records with local root constants; None is a null record."""
    out = []
    for record in records:
        name, constants = record if isinstance(record, tuple) else (record, b"")
        out.append((name or "", _constants(constants)))
    return out


class Device:
    """A device: "embree" on the CPU, or "vulkan". With `interpret`, shaders run without a C++ compiler
    and about a hundred times slower; None takes the compiler if there is one, and `interprets` says
    which. With `checked`, what DXR leaves undefined raises CheckError. What shaders print goes to
    `on_print`, a function of one str."""

    def __init__(self, backend="embree", interpret=None, checked=False, threads=0, on_print=print):
        if interpret is None:
            import os
            import shutil
            interpret = not any(shutil.which(one) for one in
                                (os.environ.get("KAAMOS_CXX", ""), "c++", "g++", "clang++") if one)
        self._session = _kaamos.Session(backend, interpret, checked, threads)
        self.backend = backend
        self.interprets = bool(interpret)
        self.on_print = on_print

    def compile(self, source="", file="shader.hlsl", target="lib_6_6", include=(), define=None):
        """Compiles HLSL: the text `source`, or `file`. `define` maps names of macros to values. Raises
        Error (KA2752) with the compiler's messages."""
        define = {name: str(value) for name, value in (define or {}).items()}
        return self._session.compile(source, file, target, list(include), define)

    def buffer(self, array):
        """A buffer with the bytes of an array. Raises ValueError if it is empty."""
        return Buffer(self, self._session.buffer(np.asarray(array)))

    def mapped_buffer(self, array):
        """A MappedBuffer that begins with the values of an array. Raises ValueError if it is empty."""
        return MappedBuffer(self, self._session.mapped_buffer(np.asarray(array)))

    def texture(self, array):
        """A texture whose texels are the array's last axis: 1, 2 or 4 of float32, float16, uint8 (0 to
        1 in shaders), uint32 or int32."""
        return Texture(self, self._session.texture(np.asarray(array)))

    def bottom_level(self, vertices=None, indices=None, boxes=None, opaque=True):
        """A bottom level of triangles, by `vertices` (n, 3) and `indices` (m, 3), or of `boxes` (k,
        6)."""
        if (vertices is None) == (boxes is None):
            raise TypeError("a bottom level has either vertices or boxes")
        return AccelerationStructure(self._session.bottom_level(vertices, indices, boxes, opaque))

    def top_level(self, instances):
        """A top level of Instances, or of bottom levels, which then are at the origin."""
        instances = [one if isinstance(one, Instance) else Instance(one) for one in instances]
        return AccelerationStructure(self._session.top_level(
            [(one.bottom_level._native, one.transform, one.id, one.mask, one.hit_group, one.flags)
             for one in instances]))

    def dispatch(self, library, entry, groups, **resources):
        """Runs a compute shader over thread groups and waits. `resources` are Buffers, Textures,
        AccelerationStructures, Samplers (a SamplerState that is not given is linear and wraps) and, for
        constant buffers, numbers or arrays, by their names in HLSL; numbers lie as in HLSL only if no
        padding is between them. Raises Error, TypeError for names
        and kinds that do not fit."""
        self._run(self._session.dispatch, library, entry, _three(groups),
                  {name: _native(value) for name, value in resources.items()})

    def dispatch_rays(self, library, ray_generation, size, miss=(), hit_groups=(), callable=(),
                      groups=None, local=(), payload_bytes=64, attribute_bytes=8, recursion=1,
                      **resources):
        """Runs a ray generation shader over a grid of rays and waits. `miss`, `hit_groups` and
        `callable` are the shader tables: names of exports, or (name, constants) for records with
        local root constants, None for a null record. `local` are the names in HLSL of what these
        constants are for, which is in a local root signature of the HLSL. `groups` defines hit groups that the HLSL does
        not: {"Name": ("ClosestHit", "AnyHit", "Intersection")}, shorter where there are fewer."""
        self._run(self._session.dispatch_rays, library,
                  _rays(ray_generation, size, miss, hit_groups, callable, groups, local, payload_bytes,
                        attribute_bytes, recursion),
                  {name: _native(value) for name, value in resources.items()})

    def explain_rays(self, library, ray_generation, size, at, miss=(), hit_groups=(), callable=(),
                     groups=None, local=(), payload_bytes=64, attribute_bytes=8, recursion=1,
                     **resources):
        """Runs the same dispatch, and explains the ray at the index `at` (up to three numbers): which
        shaders ran, what their rays met, and why each candidate was taken or not."""
        at = tuple(at) if np.ndim(at) else (at,)
        at += (0,) * (3 - len(at))
        return Explanation(*self._run(
            self._session.explain_rays, library,
            _rays(ray_generation, size, miss, hit_groups, callable, groups, local, payload_bytes,
                  attribute_bytes, recursion),
            at, {name: _native(value) for name, value in resources.items()}))

    def draw(self, library, vertex, pixel, vertices, targets, instances=1, topology="triangles",
             clear=None, depth=False, cull="none", blend="none", wireframe=False, **resources):
        """Draws `vertices` vertices into one Texture or several of one size, and waits. The vertex
        shader reads what it needs by SV_VertexID from buffers. `topology`: "triangles", "triangle
        strip", "lines", "line strip" or "points"; `clear`: four numbers that the targets begin with,
        None keeps what is there; `depth`: the nearer wins, by a depth buffer of this draw alone;
        `cull`: "none", "back" or "front"; `blend`: "none", "alpha" or "add". Raises Error, TypeError,
        ValueError for words that there are not."""
        targets = [targets] if isinstance(targets, Texture) else list(targets)
        what = _kaamos.Draw(vertex, pixel or "", vertices, instances, topology, cull, blend, wireframe,
                            [float(one) for one in clear] if clear is not None else [], depth)
        self._run(self._session.draw, library, what, [one._native for one in targets],
                  {name: _native(value) for name, value in resources.items()})

    def _run(self, function, *arguments):
        try:
            result = function(*arguments)
        finally:
            messages = self._session.take_messages()
            for _, id, text in messages:
                if id in ("KA0845", "KA0846") and self.on_print:
                    self.on_print(text.split(": ", 1)[1])
        for severity, id, text in messages:
            if 400 <= int(id[2:]) <= 499 and severity > 0:
                error = CheckError(text)
                error.id = id
                raise error
        return result


from .call import call  # noqa: E402  (needs Device)
from .frame import FrameRenderer, frame_settings, scenes  # noqa: E402  (needs Device)
