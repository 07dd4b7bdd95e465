// SPDX-License-Identifier: MIT
// The GLSL of the driver's stress test; stress_scene.h says what it computes. REST is a number of
// words that a payload carries only to be large.
#pragma once

namespace stress {

inline constexpr const char* kCommon = R"(
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_image_load_formatted : require
layout(buffer_reference, scalar) buffer Words { uint v[]; };
layout(buffer_reference, scalar) buffer Results { uvec4 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Block {
  uint64_t top_level, results, salts, counters;
  uint dimensions[3];
  uint depth, callables, seed, ray_flags, hit_groups, cells, images;
};
layout(push_constant, scalar) uniform Push { Block block; };
layout(constant_id = 0) const uint kFromRecord = 0;
layout(constant_id = 1) const uint kConstant = 0;
layout(set = 0, binding = 0) uniform texture2D textures[];
layout(set = 0, binding = 0) uniform utexture2D integer_textures[];
layout(set = 0, binding = 1) uniform image2D images[];
layout(set = 0, binding = 1) uniform uimage2D integer_images[];
layout(set = 0, binding = 2) uniform sampler samplers[];
struct Data { uint header; uint value; };
struct Payload { uint header; uint value; uint cell; float t; uint rest[REST]; };
uint mixed(uint a, uint b) {
  uint h = (a ^ (b * 0x9E3779B9u)) * 0x85EBCA6Bu;
  h ^= h >> 13;
  h *= 0xC2B2AE35u;
  return h ^ (h >> 16);
}
uint salt(uint layer) { return Words(block.salts).v[layer]; }
)";

// The record holds an address, as the backend's records do.
inline constexpr const char* kRecord = R"(
layout(shaderRecordEXT, scalar) buffer Record { uint64_t local_arguments; };
uint word() { return kFromRecord != 0 ? Words(local_arguments).v[0] : kConstant; }
)";

inline constexpr const char* kRaygenText = R"(
layout(location = 0) rayPayloadEXT Payload payload;
void main() {
  uvec3 id = gl_LaunchIDEXT, size = gl_LaunchSizeEXT;
  uint index = (id.z * size.y + id.y) * size.x + id.x;
  uint cell = index % (block.cells * block.cells);
  payload.header = 0;
  payload.cell = cell;
  payload.value = block.seed;
  for (int i = 0; i < REST; ++i) payload.rest[i] = index + i;
  vec3 origin = vec3(float(cell % block.cells) + 0.5, float(cell / block.cells) + 0.5, -1);
  traceRayEXT(accelerationStructureEXT(block.top_level), block.ray_flags, 0xFF,
              cell % block.hit_groups, 0, 0, origin, 0.0, vec3(0, 0, 1), 1000.0, 0);
  uint kept = 1;
  for (int i = 0; i < REST; ++i) kept &= uint(payload.rest[i] == index + i);
  Results(block.results).v[index] = uvec4(payload.value, mixed(index, word()), kept, index);
}
)";

inline constexpr const char* kGarbageRaygenText = R"(
layout(location = 0) rayPayloadEXT Payload payload;
float bits(uint i, uint k) {
  uint h = mixed(mixed(i, k), block.seed);
  // One in eight is infinite or not a number, one in eight zero or denormal.
  if ((h & 7) == 0) h |= 0x7F800000u;
  if ((h & 7) == 1) h &= 0x807FFFFFu;
  return uintBitsToFloat(h);
}
void main() {
  uint index = gl_LaunchIDEXT.y * gl_LaunchSizeEXT.x + gl_LaunchIDEXT.x;
  payload.header = 0;
  payload.cell = 0;
  payload.value = index;
  vec3 origin = vec3(bits(index, 0), bits(index, 1), bits(index, 2));
  if ((index & 1) != 0) origin = vec3(index % 24, index % 23, -1);
  traceRayEXT(accelerationStructureEXT(block.top_level), mixed(index, 9) & 0x3FF, mixed(index, 8),
              mixed(index, 7) % block.hit_groups, 0, 0, origin, bits(index, 3),
              vec3(bits(index, 4), bits(index, 5), bits(index, 6)), bits(index, 7), 0);
  Results(block.results).v[index] = uvec4(payload.value, 0, 1, index);
}
)";

inline constexpr const char* kMissText = R"(
layout(location = 0) rayPayloadInEXT Payload payload;
void main() { payload.value = mixed(payload.value * 17, word()); }
)";

inline constexpr const char* kClosestHitText = R"(
layout(location = 0) rayPayloadInEXT Payload payload;
layout(location = 1) rayPayloadEXT Payload deeper;
layout(location = 0) callableDataEXT Data data;
hitAttributeEXT vec2 attributes;
void main() {
  uint layer = gl_InstanceCustomIndexEXT, primitive = gl_PrimitiveID, kind = gl_HitKindEXT;
  vec3 origin = gl_WorldRayOriginEXT, direction = gl_WorldRayDirectionEXT;
  uint value = mixed(payload.value * 31 + layer * 7 + primitive, word());
  if (kind < 0x80) value += kind;
  if (block.callables > 0) {
    data.header = 1u << 16;
    data.value = value;
    executeCallableEXT(value & 1, 0);
    value = data.value;
  }
  uint depth = payload.header & 0xFFFFu;
  if (depth < block.depth) {
    deeper.header = depth + 1;
    deeper.cell = payload.cell;
    deeper.value = value;
    for (int i = 0; i < REST; ++i) deeper.rest[i] = i;
    traceRayEXT(accelerationStructureEXT(block.top_level), block.ray_flags, 0xFF,
                payload.cell % block.hit_groups, 0, 0, origin, 0.0, direction, 1000.0, 1);
    value = mixed(deeper.value, depth);
  }
  payload.value = value;
  payload.t = gl_HitTEXT;
}
)";

inline constexpr const char* kAnyHitText = R"(
layout(location = 0) rayPayloadInEXT Payload payload;
hitAttributeEXT vec2 attributes;
void main() {
  atomicAdd(Words(block.counters).v[0], 1);
  if ((mixed(gl_PrimitiveID, salt(gl_InstanceCustomIndexEXT)) & 1) != 0) ignoreIntersectionEXT;
}
)";

inline constexpr const char* kIntersectionText = R"(
hitAttributeEXT vec2 attributes;
void main() {
  uint h = mixed(gl_PrimitiveID, salt(gl_InstanceCustomIndexEXT));
  float t = (100.0 - gl_WorldRayOriginEXT.z) / gl_WorldRayDirectionEXT.z;
  attributes = vec2(1, 2);
  if ((h & 2) != 0) reportIntersectionEXT(t + 0.25, 9);
  if ((h & 2) != 0) reportIntersectionEXT(t, 5);
}
)";

inline constexpr const char* kCallableText = R"(
layout(location = 1) callableDataInEXT Data data;
layout(location = 2) callableDataEXT Data nested;
void main() {
  uint value = mixed(data.value * 5, word());
  uint depth = data.header >> 16;
  if (depth < block.callables) {
    nested.header = (depth + 1) << 16;
    nested.value = value;
    executeCallableEXT(value & 1, 2);
    value = mixed(nested.value, depth);
  }
  data.value = value;
}
)";

// Textures, storage images and samplers by index; neighbouring threads use different ones.
inline constexpr const char* kComputeText = R"(
layout(local_size_x = 32) in;
shared uint words[32];
void main() {
  uint index = gl_GlobalInvocationID.x, n = block.images;
  uint slot = mixed(index, block.seed) % n;
  ivec2 texel = ivec2(index & 3, (index >> 2) & 3);
  uint sum = uint(texelFetch(textures[nonuniformEXT(slot)], texel, 0).x * 255.0 + 0.5);
  sum += texelFetch(integer_textures[nonuniformEXT(n + slot)], texel, 0).x;
  vec2 middle = (vec2(texel) + 0.5) / 4.0;
  sum += uint(textureLod(sampler2D(textures[nonuniformEXT(slot)],
                                   samplers[nonuniformEXT(slot & 3)]), middle, 0.0).x * 255.0 + 0.5);
  sum += imageLoad(integer_images[nonuniformEXT(n + slot)], texel).x;
  words[gl_LocalInvocationID.x] = sum;
  barrier();
  uint other = words[31 - gl_LocalInvocationID.x];
  imageStore(images[nonuniformEXT(2 * n + slot)], texel, vec4(1));
  Results(block.results).v[index] = uvec4(sum, other, 1, index);
}
)";

}  // namespace stress
