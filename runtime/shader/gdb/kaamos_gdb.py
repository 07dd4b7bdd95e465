# SPDX-License-Identifier: MIT
"""Pretty-printers that let gdb show HLSL values, and what goes with them, in HLSL terms.

In gdb: source .../share/kaamos/gdb/kaamos_gdb.py
Covered: vectors, matrices, arrays, payloads and other structs of shaders, RayDesc, descriptors,
RayQuery, shader records (of a running dispatch and of a state object) and shader identifiers.
"""
import re

import gdb
import gdb.printing

HLSL_SCALARS = {
    "float": "float", "double": "double", "bool": "bool", "int": "int", "int32_t": "int",
    "unsigned int": "uint", "uint32_t": "uint", "short": "int16_t", "int16_t": "int16_t",
    "unsigned short": "uint16_t", "uint16_t": "uint16_t", "long": "int64_t", "int64_t": "int64_t",
    "unsigned long": "uint64_t", "uint64_t": "uint64_t", "kaamos::shader::half": "half",
}

KINDS = ["null", "constant buffer", "raw buffer", "structured buffer", "typed buffer", "texture",
         "sampler", "acceleration structure"]
ACCESS = ["SRV", "UAV", ""]
RECORD_KINDS = ["none", "ray generation", "miss", "hit group", "callable"]
LINKED_KINDS = ["ray generation", "miss", "callable", "hit group"]


def scalar_text(value):
    value_type = value.type.strip_typedefs()
    if value_type.code == gdb.TYPE_CODE_STRUCT:  # half: 16 stored bits
        bits = int(value[value_type.fields()[0]])
        exponent, fraction = (bits >> 10) & 31, bits & 1023
        if exponent == 31:
            number = float("nan") if fraction else float("inf")
        else:
            number = (fraction / 1024.0 + (1 if exponent else 0)) * 2.0 ** (max(exponent, 1) - 15)
        return "%g" % (-number if bits & 0x8000 else number)
    if value_type.code == gdb.TYPE_CODE_FLT:
        return "%.9g" % float(value) if value_type.sizeof == 4 else "%.17g" % float(value)
    if value_type.code == gdb.TYPE_CODE_BOOL:
        return "true" if value else "false"
    return str(int(value))


def scalar_name(value_type):
    return HLSL_SCALARS.get(str(value_type.strip_typedefs()), str(value_type))


def elements(array):
    first, last = array.type.strip_typedefs().range()
    return [array[i] for i in range(first, last + 1)]


def vector_text(value):
    return "(" + ", ".join(scalar_text(e) for e in elements(value["e"])) + ")"


def float_list(array, count=3):
    return "(" + ", ".join("%.9g" % float(array[i]) for i in range(count)) + ")"


def text_of(pointer, otherwise):
    return pointer.string() if int(pointer) != 0 else otherwise


class Vector:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        scalar = self.value.type.strip_typedefs().template_argument(0)
        return "%s%d%s" % (scalar_name(scalar), len(elements(self.value["e"])),
                           vector_text(self.value))


class Matrix:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        matrix = self.value.type.strip_typedefs()
        rows = [vector_text(row) for row in elements(self.value["e"])]
        columns = int(matrix.template_argument(2))
        return "%s%dx%d(%s)" % (scalar_name(matrix.template_argument(0)), len(rows), columns,
                                ", ".join(rows))


class Array:
    def __init__(self, value):
        self.value = value

    def children(self):
        for i, element in enumerate(elements(self.value["e"])):
            yield "[%d]" % i, element

    def display_hint(self):
        return "array"


class ShaderStruct:
    """A shader struct, such as a payload: its HLSL name and its fields."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        return str(self.value.type.strip_typedefs()).split("::u::")[-1]

    def children(self):
        for field in self.value.type.strip_typedefs().fields():
            yield field.name, self.value[field]


class AbiRayDesc:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        ray = self.value
        return "RayDesc origin %s, direction %s, t %.9g to %.9g" % (
            float_list(ray["origin"]), float_list(ray["direction"]), float(ray["t_min"]),
            float(ray["t_max"]))


class HlslRayDesc:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        ray = self.value
        return "RayDesc origin %s, direction %s, t %.9g to %.9g" % (
            vector_text(ray["Origin"]), vector_text(ray["Direction"]), float(ray["TMin"]),
            float(ray["TMax"]))


class Descriptor:
    def __init__(self, value):
        self.value = value

    def to_string(self):
        d = self.value
        kind = int(d["kind"])
        if kind == 0:
            return "null descriptor"
        text = KINDS[kind] if kind < len(KINDS) else "descriptor of kind %d" % kind
        if kind not in (1, 6) and int(d["access"]) < 2:
            text = ACCESS[int(d["access"])] + " " + text
        if int(d["stride_bytes"]) and kind == 3:
            text += ", stride %d" % int(d["stride_bytes"])
        text += ", at 0x%x" % int(d["address"])
        if int(d["size_bytes"]):
            text += ", %d bytes" % int(d["size_bytes"])
        return text


class RayQuery:
    COMMITTED = ["nothing", "a triangle", "a procedural hit"]

    def __init__(self, value):
        self.value = value

    def to_string(self):
        q = self.value
        status = int(q["committed"]["type"])
        committed = self.COMMITTED[status] if status < 3 else "type %d" % status
        text = "RayQuery %s, committed %s at t %.9g" % (
            AbiRayDesc(q["ray"]).to_string()[8:], committed, float(q["committed"]["t"]))
        if q["has_candidate"]:
            text += ", candidate at t %.9g" % float(q["candidate"]["t"])
        return text + (", ended" if q["ended"] else "")


def shaders_text(target, name_of):
    """`name_of` gives the name of a member, or None if there is no shader."""
    parts = []
    for what in ("shader", "intersection", "any_hit", "closest_hit"):
        name = name_of(target[what])
        if name is not None:
            label = "" if what == "shader" else what.replace("_", "-") + " "
            parts.append('%s"%s"' % (label, name))
    return ", ".join(parts) if parts else "nothing runs"


class ShaderRecord:
    """What a dispatch on the CPU found at an index of a shader table."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        record = self.value
        target = record["target"].dereference()
        kind = int(target["kind"])
        return "%s record at 0x%x: %s" % (
            RECORD_KINDS[kind] if kind < len(RECORD_KINDS) else "unknown", int(record["address"]),
            shaders_text(target, lambda s: text_of(s["name"], "") if int(s["entry"]) else None))


def linked_name(shader):
    if int(shader) == 0:
        return None
    return shader.dereference()["name"].format_string().strip('"')


class LinkedRecord:
    """What an identifier of a state object stands for."""

    def __init__(self, value):
        self.value = value

    def to_string(self):
        record = self.value
        kind = int(record["kind"])
        return "%s %s: %s, %d bytes of local arguments" % (
            LINKED_KINDS[kind] if kind < len(LINKED_KINDS) else "unknown",
            record["name"].format_string(),
            shaders_text(record, linked_name),
            int(record["local_argument_bytes"]))


PRINTERS = [
    (re.compile(r"^kaamos::shader::vec<.*>$"), Vector),
    (re.compile(r"^kaamos::shader::mat<.*>$"), Matrix),
    (re.compile(r"^kaamos::shader::array<.*>$"), Array),
    (re.compile(r"^kaamos::shader::RayDesc$"), AbiRayDesc),
    (re.compile(r"^kaamos::shader::Descriptor$"), Descriptor),
    (re.compile(r"^kaamos::shader::RayQuery$"), RayQuery),
    (re.compile(r"^kaamos::embree::ShaderRecord$"), ShaderRecord),
    (re.compile(r"^kaamos::runtime::LinkedRecord$"), LinkedRecord),
    (re.compile(r"(^|::)unit_[^:]*::u::RayDesc[_0-9]*$"), HlslRayDesc),
    (re.compile(r"(^|::)unit_[^:]*::u::(?!Context$)[^:<]+$"), ShaderStruct),
]


class Kaamos(gdb.printing.PrettyPrinter):
    def __init__(self):
        super().__init__("kaamos")

    def __call__(self, value):
        value_type = value.type
        if value_type.code in (gdb.TYPE_CODE_REF, gdb.TYPE_CODE_RVALUE_REF):
            value = value.referenced_value()
            value_type = value.type
        value_type = value_type.unqualified().strip_typedefs()
        if value_type.code != gdb.TYPE_CODE_STRUCT:
            return None
        name = value_type.tag or str(value_type)
        for pattern, printer in PRINTERS:
            if pattern.search(name):
                return printer(value)
        return None


class RecordCommand(gdb.Command):
    """kaamos-record ADDRESS: the identifier and the first arguments of the shader record there."""

    def __init__(self):
        super().__init__("kaamos-record", gdb.COMMAND_DATA)

    def invoke(self, argument, _from_tty):
        value = gdb.parse_and_eval(argument)
        address = int(value.address if value.type.code == gdb.TYPE_CODE_ARRAY else value)
        memory = gdb.selected_inferior().read_memory(address, 64).tobytes()
        words = [memory[i:i + 4][::-1].hex() for i in range(0, 64, 4)]
        null = "" if any(memory[:32]) else " (NULL: nothing runs)"
        gdb.write("identifier %s%s\n" % (" ".join(words[:8]), null))
        gdb.write("arguments  %s\n" % " ".join(words[8:]))


gdb.printing.register_pretty_printer(None, Kaamos(), replace=True)
RecordCommand()
