// SPDX-License-Identifier: MIT
//
// Opacity micromaps, which lavapipe has not: shaders decide the opacity of candidates, at the start
// of any-hit and intersection shaders and in the loops of queries and hit objects. For rays that
// use micromaps there are top levels whose instances are not opaque for the driver
// (spirv_interface.h: TopLevelEntry). The same in C++: runtime/structures/opacity_micromap.h.
// [DXR: Opacity micromaps]
#include "kaamos/shader/query_permissions.h"
#include "kaamos/shader/spirv_interface.h"
#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;

namespace {

using shader::spirv::kAllowMicromapsConstant;

static_assert(sizeof(shader::spirv::GeometryMicromaps) == 24);
static_assert(sizeof(shader::spirv::MicromapEntry) == 8);

// The micromap's state at a point of a triangle; 4: the geometry's own opacity counts.
constexpr char kState[] =
    "layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer "
    "g_GeometryMicromaps { uint64_t indices; uint64_t array; uint opaque; uint reserved; };\n"
    "uint g_spread(uint bits) {\n"
    "  bits = (bits | bits << 8) & 0x00FF00FFu;\n"
    "  bits = (bits | bits << 4) & 0x0F0F0F0Fu;\n"
    "  bits = (bits | bits << 2) & 0x33333333u;\n"
    "  return (bits | bits << 1) & 0x55555555u;\n"
    "}\n"
    "uint g_micro_triangle(vec2 at, uint level) {\n"
    "  uint n = 1u << level;\n"
    "  float fu = (at.x > 0.0 ? min(at.x, 1.0) : 0.0) * float(n);\n"
    "  float fv = (at.y > 0.0 ? min(at.y, 1.0) : 0.0) * float(n);\n"
    "  uint iu = min(uint(fu), n - 1u);\n"
    "  uint iv = min(uint(fv), n - 1u);\n"
    "  float within = (fu - float(uint(fu))) + (fv - float(uint(fv)));\n"
    "  uint sum = iu + iv;\n"
    "  if (sum >= n) iu -= sum - n + 1u;\n"
    "  uint iw = ~(iu + iv);\n"
    "  if (within >= 1.0 && sum < n - 1u) --iw;\n"
    "  uint even = ~(iu ^ iw) & (n - 1u);\n"
    "  uint both = (iu ^ iv) & even;\n"
    "  uint flips = both;\n"
    "  flips ^= flips >> 1;\n"
    "  flips ^= flips >> 2;\n"
    "  flips ^= flips >> 4;\n"
    "  flips ^= flips >> 8;\n"
    "  uint odd = (((flips ^ iu) & ~even) | both) & (n - 1u);\n"
    "  return g_spread(even) | g_spread(odd) << 1;\n"
    "}\n"
    "uint g_micromap_state(g_GeometryMicromaps of, uint primitive, vec2 at) {\n"
    "  uint index = g_Word(of.indices + uint64_t(primitive) * 4UL).v;\n"
    "  if (index >= 0x80000000u) return ~index;\n"
    "  uint64_t array = of.array;\n"
    "  if (array == 0UL || index >= g_Word(array).v) return 3u;\n"
    "  uint64_t entry = array + 8UL + uint64_t(index) * 8UL;\n"
    "  uint kind = g_Word(entry + 4UL).v;\n"
    "  uint shift = kind >> 16 == 1u ? 0u : 1u;\n"
    "  uint bit = g_micro_triangle(at, kind & 0xFFFFu) << shift;\n"
    "  uint word = g_Word(array + uint64_t(g_Word(entry).v) + uint64_t(bit >> 5) * 4UL).v;\n"
    "  return word >> (bit & 31u) & (shift == 0u ? 1u : 3u);\n"
    "}\n";

// What a ray with these flags sees of a candidate: 0 nothing, 1 an opaque one, 2 one that is not.
constexpr char kOpacity[] =
    "uint g_opacity(g_InstanceEntry entry, uint geometry, uint id, vec2 at, uint flags) {\n"
    "  if (entry.micromaps == 0UL) return 2u;\n"
    "  g_GeometryMicromaps of = g_GeometryMicromaps(entry.micromaps + uint64_t(geometry) * "
    "24UL);\n"
    "  uint instance = entry.flags;\n"
    "  uint opacity = of.opaque != 0u ? 1u : 2u;\n"
    "  if (of.indices != 0UL && (instance & 0x20u) == 0u) {\n"
    "    uint state = g_micromap_state(of, g_remapped(entry.primitive_remap, geometry, id), at);\n"
    "    if (state != 4u) {\n"
    "      if ((instance & 0x10u) != 0u || (flags & 0x400u) != 0u) state &= 1u;\n"
    "      if (state == 0u) return 0u;\n"
    "      opacity = state == 1u ? 1u : 2u;\n"
    "    }\n"
    "  }\n"
    "  if ((instance & 12u) != 0u) opacity = (instance & 4u) != 0u ? 1u : 2u;\n"
    "  if ((flags & (opacity == 1u ? 0x40u : 0x80u)) != 0u) return 0u;\n"
    "  if ((flags & 3u) != 0u) opacity = (flags & 1u) != 0u ? 1u : 2u;\n"
    "  return opacity;\n"
    "}\n";

}  // namespace

void GlslEmitter::declare_opacity() {
  declare_instance_entry();
  generated("g_opacity", std::string(kState) + kOpacity);
}

// Declares the function that tells what is seen of a query's candidate: 0 to 2, as above.
void GlslEmitter::declare_query_opacity() {
  declare_opacity();
  generated("g_query_opacity",
            "uint g_query_opacity(rayQueryEXT q, uint flags) {\n"
            "  vec2 at = vec2(0.0);\n"
            "  if (rayQueryGetIntersectionTypeEXT(q, false) == 0u) "
            "at = rayQueryGetIntersectionBarycentricsEXT(q, false);\n"
            "  g_InstanceEntry entry = g_InstanceEntry(k_dispatch.instances + "
            "uint64_t(rayQueryGetIntersectionInstanceCustomIndexEXT(q, false)) * 32UL);\n"
            "  return g_opacity(entry, uint(rayQueryGetIntersectionGeometryIndexEXT(q, false)), "
            "uint(rayQueryGetIntersectionPrimitiveIndexEXT(q, false)), at, flags);\n"
            "}\n");
}

// Declares the function that finds the top level for a ray that uses micromaps. Flags that depend
// on opacity become those that the driver may have, with the ray's own in the upper half.
void GlslEmitter::declare_micromap_top_level() {
  declare_top_level();
  generated("g_micromap_top_level",
            "uint64_t g_micromap_top_level(k_Descriptor scene, inout uint flags) {\n"
            "  uint64_t at = g_top_level_entry(scene);\n"
            "  if (at == 0UL) return k_dispatch.empty_top_level;\n"
            "  g_TopLevelEntry entry = g_TopLevelEntry(at);\n"
            "  if (entry.with_micromaps == 0UL) return entry.vulkan;\n"
            "  if ((flags & 0xC1u) == 0u) return entry.with_micromaps;\n"
            "  flags = (flags & 0x73Eu) | flags << 16;\n"
            "  return entry.all_candidates;\n"
            "}\n");
}

// A condition: whether the pipeline allows micromaps. Without them, drivers drop what depends on
// it.
std::string GlslEmitter::micromaps_allowed() {
  return constant(kAllowMicromapsConstant, "g_micromaps_allowed") + " != 0u";
}

// RayFlags() of the ray that the driver traces.
std::string GlslEmitter::ray_flags() {
  const std::string allowed = micromaps_allowed();
  return generated("g_ray_flags",
                   "uint g_ray_flags() {\n"
                   "  uint flags = gl_IncomingRayFlagsEXT;\n"
                   "  return " +
                       allowed +
                       " && flags >> 16 != 0u ? flags >> 16 : flags;\n"
                       "}\n") +
         "()";
}

// Statements at the start of an any-hit shader, or of an intersection shader, whose box the ray may
// cull by its opacity.
std::string GlslEmitter::micromap_start() {
  const bool any_hit = entry_.stage == kStageAnyHit;
  if (twin_ || (!any_hit && entry_.stage != kStageIntersection)) return "";
  declare_opacity();
  std::string at = "vec2(0.0)";
  if (any_hit) {
    declare_attributes();
    if (attributes_are_floats()) {
      at = "g_attributes";
    } else if (attribute_words() >= 2) {
      at = "vec2(uintBitsToFloat(g_attributes[0]), uintBitsToFloat(g_attributes[1]))";
    }
  }
  return "  if (" + micromaps_allowed() +
         ") {\n"
         "    uint seen = g_opacity(g_InstanceEntry(k_dispatch.instances + "
         "uint64_t(gl_InstanceCustomIndexEXT) * 32UL), uint(gl_GeometryIndexEXT), "
         "uint(gl_PrimitiveID), " +
         at + ", " + ray_flags() + ");\n" +
         (any_hit ? "    if (seen == 0u) ignoreIntersectionEXT;\n    if (seen == 1u) return;\n"
                  : "    if (seen == 0u) return;\n") +
         "  }\n";
}

}  // namespace kaamos::hlsl
