# SPDX-License-Identifier: MIT
"""Makes a .glb of write_glb a scene of Blender's Cycles that shows the same, lamp by lamp.

Runs inside of Blender 3.4. What Cycles cannot show exactly is an error: dielectrics and coloured
metals that are rough, because Cycles' nodes know the angle of the view and not that of the facet,
which Schlick's term needs. README.md of this folder says how each thing is matched.
"""

import json
import math
import struct

import bmesh
import bpy
import numpy
from mathutils import Matrix

# The importer of Blender 3.4 needs names that numpy 1.24 has no more.
for old, new in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if old not in numpy.__dict__:
        setattr(numpy, old, new)

# glTF has +y up, Blender +z.
UPRIGHT = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
MIRROR_ROUGHNESS = 0.03  # up to here a specular lobe is one direction
DIELECTRIC_F0 = 0.04
EMISSIVE_PROXY = 0x10


class NotMatched(Exception):
    """The scene has something that Cycles cannot show exactly."""


def read_glb(path):
    """The JSON of a .glb."""
    with open(path, "rb") as file:
        magic, _, _, length, kind = struct.unpack("<5I", file.read(20))
        if magic != 0x46546C67 or kind != 0x4E4F534A:
            raise NotMatched(f"{path} is no .glb file")
        return json.loads(file.read(length))


def extras(thing, *keys):
    """A value below extras.kaamos, or None."""
    value = thing.get("extras", {}).get("kaamos", {})
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def node_matrix(node):
    """The transform of a light's or camera's node in Blender's world; write_glb has no parents."""
    m = node.get("matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    return UPRIGHT @ Matrix([[m[4 * c + r] for c in range(4)] for r in range(4)])


class Nodes:
    """A node tree in the making: each method adds a node and returns its output."""

    def __init__(self, owner):
        owner.use_nodes = True
        self.tree = owner.node_tree
        self.tree.nodes.clear()

    def add(self, kind, output=0, inputs=(), **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for at, value in enumerate(inputs):
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[at])
            elif value is not None:
                node.inputs[at].default_value = value
        return node.outputs[output]

    def math(self, operation, *inputs):
        return self.add("ShaderNodeMath", inputs=inputs, operation=operation)

    def mix(self, factor, a, b):
        """Of colours; `factor` is not clamped to 0..1 by rounding."""
        return self.add("ShaderNodeMixRGB", inputs=(factor, a, b), blend_type="MIX")

    def scale(self, color, factor):
        grey = self.add("ShaderNodeCombineXYZ", inputs=(factor, factor, factor))
        return self.add("ShaderNodeMixRGB", inputs=(1.0, color, grey), blend_type="MULTIPLY")

    def sum(self, shaders):
        total = shaders[0]
        for shader in shaders[1:]:
            total = self.add("ShaderNodeAddShader", inputs=(total, shader))
        return total

    def polynomial(self, x, coefficients):
        """Highest power first."""
        value = float(coefficients[0])
        for coefficient in coefficients[1:]:
            value = self.math("MULTIPLY_ADD", value, x, float(coefficient))
        return value

    def view_cosine(self):
        geometry = self.tree.nodes.new("ShaderNodeNewGeometry")
        dot = self.tree.nodes.new("ShaderNodeVectorMath")
        dot.operation = "DOT_PRODUCT"
        self.tree.links.new(geometry.outputs["Normal"], dot.inputs[0])
        self.tree.links.new(geometry.outputs["Incoming"], dot.inputs[1])
        return self.math("ABSOLUTE", dot.outputs["Value"])

    def is_no_mirror(self):
        """0 for rays of mirrors, which show no lamp; else 1."""
        path = self.tree.nodes.new("ShaderNodeLightPath")
        return self.math("SUBTRACT", 1.0, path.outputs["Is Singular Ray"])

    def output(self, kind, shader):
        node = self.tree.nodes.new(kind)
        self.tree.links.new(shader, node.inputs[0])


def rgba(color):
    return (color[0], color[1], color[2], 1.0)


def smith_lambda(alpha, cosine):
    tangent_squared = 1.0 / numpy.square(cosine) - 1.0
    return 0.5 * (numpy.sqrt(1.0 + alpha * alpha * tangent_squared) - 1.0)


def ggx_albedo(roughness, cosine, side=400):
    """Directional albedo of GGX with F = 1, by a regular grid over its facets: with height-correlated
    masking, which the scenes have, and with independent masking of view and light, which Cycles 3.4
    has."""
    alpha = roughness * roughness
    view = (math.sqrt(1.0 - cosine * cosine), cosine)
    # Facets by the distribution's own density. [Walter et al. 2007]
    u = (numpy.arange(side) + 0.5) / side
    u, phi = numpy.meshgrid(u, 2.0 * math.pi * u)
    z = 1.0 / numpy.sqrt(1.0 + alpha * alpha * u / (1.0 - u))
    facing = view[0] * numpy.sqrt(1.0 - z * z) * numpy.cos(phi) + view[1] * z
    light_z = 2.0 * facing * z - cosine
    valid = (facing > 0.0) & (light_z > 0.0)
    weight = numpy.where(valid, facing / (cosine * z), 0.0)
    of_view = smith_lambda(alpha, cosine)
    of_light = smith_lambda(alpha, numpy.where(valid, light_z, 1.0))
    correlated = (weight / (1.0 + of_view + of_light)).mean()
    independent = (weight / ((1.0 + of_view) * (1.0 + of_light))).mean()
    return correlated, independent


def metal_tint(nodes, roughness):
    """What white metal's colour must be in Cycles by the view's cosine, so that it reflects as much
    as ours."""
    cosines = numpy.linspace(0.15, 1.0, 40)
    albedos = [ggx_albedo(roughness, c) for c in cosines]
    fit = numpy.polyfit(cosines, [ours / cycles for ours, cycles in albedos], 8)
    cosine = nodes.math("MAXIMUM", nodes.view_cosine(), 0.15)
    value = nodes.polynomial(cosine, fit)
    return nodes.add("ShaderNodeCombineXYZ", inputs=(value, value, value))


def is_rough_metal(source):
    pbr = source.get("pbrMetallicRoughness", {})
    return pbr.get("metallicFactor", 1) == 1 and pbr.get("roughnessFactor", 1) > MIRROR_ROUGHNESS


def match_material(material, source):
    """Replaces the importer's nodes by those that show `source`, a material of the file, exactly."""
    pbr = source.get("pbrMetallicRoughness", {})
    base = pbr.get("baseColorFactor", [1, 1, 1, 1])
    metallic, roughness = pbr.get("metallicFactor", 1), pbr.get("roughnessFactor", 1)
    name = source.get("name", "")
    textures = [key for part in (source, pbr) for key in part if key.endswith("Texture")]
    if textures or source.get("alphaMode", "OPAQUE") != "OPAQUE":
        raise NotMatched(f'material "{name}" has textures or alpha')
    nodes = Nodes(material)
    shaders = []
    if is_rough_metal(source):
        if min(base[:3]) < 1:
            raise NotMatched(f'material "{name}" is a rough metal with a colour: white is allowed')
        shaders.append(nodes.add("ShaderNodeBsdfGlossy", distribution="GGX",
                                 inputs=(metal_tint(nodes, roughness), roughness)))
    elif metallic in (0, 1) and roughness <= MIRROR_ROUGHNESS:
        grazing = nodes.math("POWER", nodes.math("SUBTRACT", 1.0, nodes.view_cosine()), 5.0)
        f0 = rgba(base) if metallic == 1 else rgba([DIELECTRIC_F0] * 3)
        shaders.append(nodes.add("ShaderNodeBsdfGlossy", distribution="SHARP",
                                 inputs=(nodes.mix(grazing, f0, (1, 1, 1, 1)), 0.0)))
        if metallic == 0:
            # The specular lobe takes DIELECTRIC_F0 + (1 - DIELECTRIC_F0) * grazing.
            rest = nodes.math("MULTIPLY_ADD", grazing, DIELECTRIC_F0 - 1.0, 1.0 - DIELECTRIC_F0)
            shaders.append(nodes.add("ShaderNodeBsdfDiffuse",
                                     inputs=(nodes.scale(rgba(base), rest), 0.0)))
    else:
        raise NotMatched(f'material "{name}" is metallic {metallic}, roughness {roughness}: white '
                         f"metal and surfaces of roughness <= {MIRROR_ROUGHNESS} are allowed")
    strength = source.get("extensions", {}).get("KHR_materials_emissive_strength", {})
    emission = [part * strength.get("emissiveStrength", 1)
                for part in source.get("emissiveFactor", [0, 0, 0])]
    if max(emission) > 0:
        shaders.append(nodes.add("ShaderNodeEmission", inputs=(rgba(emission), 1.0)))
    nodes.output("ShaderNodeOutputMaterial", nodes.sum(shaders))


def add_lamp(position, intensity, radius):
    """A sphere of radiance intensity / (pi radius^2) that rays go through and mirrors do not show.

    A mesh: the point light of Cycles 3.4 is a disk that turns to the point, which gives less than
    intensity / d^2 near it."""
    mesh = bpy.data.meshes.new("lamp")
    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=5, radius=1.0)
    # What a convex body shows of itself is a quarter of its surface, averaged over directions.
    scale = math.sqrt(4.0 * math.pi / sum(face.calc_area() for face in shape.faces))
    bmesh.ops.scale(shape, vec=(scale * radius,) * 3, verts=shape.verts)
    shape.to_mesh(mesh)
    shape.free()
    material = bpy.data.materials.new("lamp")
    nodes = Nodes(material)
    geometry = nodes.tree.nodes.new("ShaderNodeNewGeometry")
    is_front = nodes.math("SUBTRACT", 1.0, geometry.outputs["Backfacing"])
    shines = nodes.math("MULTIPLY", is_front, nodes.is_no_mirror())
    radiance = [part / (math.pi * radius * radius) for part in intensity]
    emission = nodes.add("ShaderNodeEmission", inputs=(rgba(radiance), shines))
    clear = nodes.add("ShaderNodeBsdfTransparent")
    nodes.output("ShaderNodeOutputMaterial", nodes.sum([emission, clear]))
    mesh.materials.append(material)
    lamp = bpy.data.objects.new("lamp", mesh)
    lamp.location = position
    lamp.visible_camera = False
    bpy.context.scene.collection.objects.link(lamp)


def add_sun(matrix, irradiance, angular_radius):
    """Constant radiance over the disk, `irradiance` on a surface that faces it."""
    light = bpy.data.lights.new("sun", "SUN")
    # Cycles spreads its strength evenly over the disk in the plane that touches the unit sphere in
    # the middle: a surface that faces the sun gets the mean cosine of that.
    tangent_squared = math.tan(angular_radius) ** 2
    if tangent_squared > 0.0:
        light.energy = 0.5 * tangent_squared / (math.sqrt(1.0 + tangent_squared) - 1.0)
    else:
        light.energy = 1.0
    light.angle = 2.0 * angular_radius
    nodes = Nodes(light)
    shader = nodes.add("ShaderNodeEmission", inputs=(rgba(irradiance), 1.0))
    nodes.output("ShaderNodeOutputLight", shader)
    sun = bpy.data.objects.new("sun", light)
    sun.matrix_world = matrix
    # For distant lights, Light Path does not know mirrors.
    sun.visible_camera = sun.visible_glossy = False
    bpy.context.scene.collection.objects.link(sun)


def add_sky(zenith, horizon, ground):
    """mix(horizon, zenith, sqrt(y)) above, mix(horizon, ground, min(1, -8 y)) below.
    [effects/shaders/sky.hlsli]"""
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    nodes = Nodes(world)
    place = nodes.tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
    y = nodes.add("ShaderNodeSeparateXYZ", output=2, inputs=(place,))
    up = nodes.math("SQRT", nodes.math("MINIMUM", nodes.math("MAXIMUM", y, 0.0), 1.0))
    down = nodes.math("MINIMUM", nodes.math("MULTIPLY", nodes.math("MINIMUM", y, 0.0), -8.0), 1.0)
    above = nodes.mix(up, rgba(horizon), rgba(zenith))
    shader = nodes.add("ShaderNodeBackground", inputs=(nodes.mix(down, above, rgba(ground)), 1.0))
    nodes.output("ShaderNodeOutputWorld", shader)
    world.cycles.sampling_method = "MANUAL"
    world.cycles.sample_map_resolution = 512


def add_camera(matrix, vertical_fov):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = vertical_fov
    data.clip_start, data.clip_end = 1e-4, 1e5
    camera = bpy.data.objects.new("camera", data)
    camera.matrix_world = matrix
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def load(path):
    """The scene of a .glb, in place of what is open."""
    clear()
    source = read_glb(path)
    if extras(source["scenes"][0], "sky") is None:
        raise NotMatched(f"{path} has no sky in its extras: write it with northlight --write-glb")
    bpy.ops.import_scene.gltf(filepath=path)
    for item in list(bpy.context.scene.objects):
        if item.type != "MESH":
            bpy.data.objects.remove(item)
    for material in source["materials"]:
        if material["name"] in bpy.data.materials:
            match_material(bpy.data.materials[material["name"]], material)
    for node in source["nodes"]:
        if "mesh" in node and (extras(node, "mask") or 0) & EMISSIVE_PROXY:
            raise NotMatched(f'node "{node["name"]}" shows a lamp')
    add_lights(source)
    sky = extras(source["scenes"][0], "sky")
    add_sky(sky["zenith"], sky["horizon"], sky["ground"])
    camera = next(node for node in source["nodes"] if "camera" in node)
    add_camera(node_matrix(camera), source["cameras"][camera["camera"]]["perspective"]["yfov"])


def add_lights(source):
    lights = source.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for node in source["nodes"]:
        use = node.get("extensions", {}).get("KHR_lights_punctual")
        if use is None:
            continue
        light = lights[use["light"]]
        if sun := extras(node, "sun"):
            if any(is_rough_metal(material) for material in source["materials"]):
                raise NotMatched("a sun and rough metal: Cycles hides the sun from mirrors only "
                                 "together with rough metal")
            add_sun(node_matrix(node), sun["irradiance"], sun["angularRadius"])
        elif light["type"] == "point" and extras(node, "lamp", "radius"):
            color = light.get("color", [1, 1, 1])
            add_lamp(node_matrix(node).to_translation(),
                     [part * light["intensity"] for part in color], extras(node, "lamp", "radius"))
        else:
            raise NotMatched(f'light "{light.get("name")}" is none of a sun and sphere lamps')


def set_up_cycles(size, samples, threads):
    """Nothing that biases: no clamps, no filter, no light left out, every path as long as it lasts."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.threads_mode, scene.render.threads = ("FIXED", threads) if threads else ("AUTO", 1)
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_mode = "RGB"
    scene.render.image_settings.color_depth = "32"
    scene.render.use_compositing = scene.render.use_sequencer = False
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0
    cycles.transparent_max_bounces = 64
    # Rays through the centres of pixels, as near as Cycles goes: +-0.005 of a pixel. A box is always
    # a pixel wide.
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 0.01


def render(path, seed, bounces):
    """Writes an EXR of linear radiance."""
    scene = bpy.context.scene
    cycles = scene.cycles
    cycles.seed = seed
    cycles.max_bounces = bounces
    cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces = bounces
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
