# SPDX-License-Identifier: MIT
"""Calls of a single HLSL function over arrays."""

import re

import numpy as np

_SCALARS = {"float": np.float32, "int": np.int32, "uint": np.uint32, "double": np.float64}
_TYPE = re.compile(r"^(float|int|uint|double)([1-4])?(?:x([1-4]))?$")


def _parse(type_name):
    """The numpy type and the shape of one value of an HLSL type."""
    match = _TYPE.match(type_name)
    if not match:
        raise TypeError(f"'{type_name}' is no float, int, uint, double, vector or matrix of them")
    scalar, first, second = match.groups()
    return _SCALARS[scalar], tuple(int(one) for one in (first, second) if one)


def _signature(function, source):
    """The types of the result and of the parameters of the function in the source."""
    plain = re.sub(r"//[^\n]*|/\*.*?\*/", " ", source, flags=re.S)
    match = re.search(r"\b(\w+)\s+" + re.escape(function) + r"\s*\(([^)]*)\)\s*\{", plain)
    if not match:
        raise TypeError(f"the source has no function '{function}'")
    parameters = [one.split() for one in match.group(2).split(",") if one.strip()]
    for words in parameters:
        if words[0] in ("out", "inout"):
            raise TypeError(f"'{function}' has the {words[0]} parameter '{words[-1]}'; call takes inputs only")
    return match.group(1), [[word for word in words if word not in ("in", "const")][0] for words in parameters]


def call(function, source, *arguments, device=None, target="lib_6_6", include=()):
    """The values of an HLSL function for each element of arrays, which are broadcast as numpy does;
    a vector's or matrix' components are the last axes. `device`: a kaamos.Device, or one is made.

        kaamos.call("f", "float f(float x, float3 n) { return x * n.z; }", x, normals)
    """
    from . import Device
    device = device or Device()
    result, parameters = _signature(function, source)
    if len(parameters) != len(arguments):
        raise TypeError(f"'{function}' takes {len(parameters)} arguments, and {len(arguments)} are given")
    arrays, outer = [], []
    for name, value in zip(parameters, arguments):
        dtype, inner = _parse(name)
        array = np.asarray(value, dtype)
        if inner and array.shape[array.ndim - len(inner):] != inner:
            raise TypeError(f"an argument of type {name} has the last axes {inner}, and the array has the "
                            f"shape {array.shape}")
        arrays.append((array, inner))
        outer.append(array.shape[:array.ndim - len(inner)])
    shape = np.broadcast_shapes(*outer) if outer else ()
    count = int(np.prod(shape, dtype=np.int64))
    dtype, inner = _parse(result)
    if count == 0:
        return np.empty(shape + inner, dtype)
    names = [f"kaamos_argument_{i}" for i in range(len(arrays))]
    text = source + "\n"
    for name, type_name in zip(names, parameters):
        text += f"StructuredBuffer<row_major {type_name}> {name};\n" if "x" in type_name else \
            f"StructuredBuffer<{type_name}> {name};\n"
    matrix = "row_major " if "x" in result else ""
    text += f"RWStructuredBuffer<{matrix}{result}> kaamos_result;\n"
    values = ", ".join(f"{name}[kaamos_index]" for name in names)
    text += ("[shader(\"compute\")] [numthreads(64, 1, 1)] void kaamos_call(uint3 kaamos_group : SV_GroupID, "
             "uint kaamos_thread : SV_GroupIndex) {\n"
             "  const uint kaamos_index = (kaamos_group.y * 65535 + kaamos_group.x) * 64 + kaamos_thread;\n"
             f"  if (kaamos_index < {count}u) kaamos_result[kaamos_index] = {function}({values});\n}}\n")
    library = device.compile(text, file=function + ".hlsl", target=target, include=include)
    resources = {name: device.buffer(np.ascontiguousarray(np.broadcast_to(array, shape + inner_shape)))
                 for name, (array, inner_shape) in zip(names, arrays)}
    out = device.buffer(np.zeros((count,) + inner, dtype))
    groups = (count + 63) // 64
    device.dispatch(library, "kaamos_call", (min(groups, 65535), (groups + 65534) // 65535),
                    kaamos_result=out, **resources)
    return out.numpy().reshape(shape + inner)
