// SPDX-License-Identifier: MIT
// Textures of the bindless set of kaamos/shader/spirv_interface.h. The driver handles what a
// descriptor refers to. The code here handles what D3D defines and Vulkan does not: null
// descriptors and those of another kind, dimension, number class or access read 0 and write
// nothing, and so do texels outside the texture or its mips [D3D11.3 7.18]; coordinates may be NaN
// or infinite.
//
// Blocks with $D and $C are expanded for each dimension and number class: $V is a texel, $L the
// location of a sample, $X that of a texel (array element last), $G a gradient, $O an offset
// without the array element.

//@ k_textures_$D_$C
layout(set = 0, binding = 0) uniform $Ptexture$DIM k_textures_$D_$C[];
//@ k_images_$D_$C 1d 1d_array 2d 2d_array 3d
layout(set = 0, binding = 1) uniform $Pimage$DIM k_images_$D_$C[];
//@ k_samplers
layout(set = 0, binding = 2) uniform sampler k_samplers[];
//@ k_comparison_samplers
layout(set = 0, binding = 2) uniform samplerShadow k_comparison_samplers[];

// Number classes of texture_shape() in kaamos/shader/abi.h.
//@ k_class_f
const uint k_class_f = 0u;
//@ k_class_i
const uint k_class_i = 1u;
//@ k_class_u
const uint k_class_u = 2u;
// An array fits the declaration of a single one, and the other way round. Each has a view of its
// own in the set, the one of the other form right after that of the descriptor. `dimension` is a
// literal, so this is one comparison.
//@ k_other_form
uint k_other_form(uint dimension) {
  return dimension < 8u ? dimension ^ 1u : dimension == 8u ? 8u : 19u - dimension;
}
//@ k_fits
bool k_fits(k_Descriptor t, uint dimension, uint number) {
  uint form = t.stride ^ number << 8;
  return t.address != 0UL && (form == dimension || form == k_other_form(dimension));
}
//@ k_view
uint k_view(k_Descriptor t, uint dimension) {
  return uint(t.address) + ((t.stride & 0xFFu) == dimension ? 0u : 1u);
}
//@ k_can_read
bool k_can_read(k_Descriptor t, uint dimension, uint number) {
  return t.kind_access == 5u && k_fits(t, dimension, number);
}
//@ k_can_write
bool k_can_write(k_Descriptor t, uint dimension, uint number) {
  return t.kind_access == (5u | 1u << 16) && k_fits(t, dimension, number);
}
//@ k_can_sample
bool k_can_sample(k_Descriptor t, k_Descriptor s, uint dimension, uint number) {
  return k_can_read(t, dimension, number) && (s.kind_access & 0xFFFFu) == 6u && s.address != 0UL;
}

// NaN becomes 0. Beyond 2^30 every float is an even integer, so the clamp loses nothing.
//@ k_coordinate f32 each
float k_coordinate(float u) { return isnan(u) ? 0.0 : clamp(u, -1073741824.0, 1073741824.0); }
// A cube direction keeps its proportions.
//@ k_direction
vec3 k_direction(vec3 d) {
  d = mix(d, vec3(0.0), isnan(d));
  if (any(isinf(d))) d = sign(d) * vec3(isinf(d));
  return d == vec3(0.0) ? vec3(1.0, 0.0, 0.0) : d;
}
//@ k_location_$D 1d 1d_array 2d 2d_array 3d
$L k_location_$D($L at) { return k_coordinate(at); }
//@ k_location_cube
vec3 k_location_cube(vec3 at) { return k_direction(at); }
//@ k_location_cube_array
vec4 k_location_cube_array(vec4 at) { return vec4(k_direction(at.xyz), k_coordinate(at.w)); }
//@ k_lod
float k_lod(float lod) { return isnan(lod) ? -1000.0 : clamp(lod, -1000.0, 1000.0); }

//@ k_inside
bool k_inside(int at, int size) { return uint(at) < uint(size); }
bool k_inside(ivec2 at, ivec2 size) { return all(lessThan(uvec2(at), uvec2(size))); }
bool k_inside(ivec3 at, ivec3 size) { return all(lessThan(uvec3(at), uvec3(size))); }
// The size of a mip is computed from that of mip 0, because lavapipe answers a size query with the
// mip of the first of the invocations that run side by side.
//@ k_size_$D_$C 1d 2d 3d
$X k_size_$D_$C(k_Descriptor t, int mip) {
  return max(textureSize(k_texture_$D_$C(t), 0) >> mip, $X(1));
}
//@ k_size_$D_$C 1d_array
ivec2 k_size_$D_$C(k_Descriptor t, int mip) {
  ivec2 size = textureSize(k_texture_$D_$C(t), 0);
  return ivec2(max(size.x >> mip, 1), size.y);
}
//@ k_size_$D_$C 2d_array cube_array
ivec3 k_size_$D_$C(k_Descriptor t, int mip) {
  ivec3 size = textureSize(k_texture_$D_$C(t), 0);
  return ivec3(max(size.xy >> mip, ivec2(1)), size.z);
}
//@ k_size_$D_$C cube
ivec2 k_size_$D_$C(k_Descriptor t, int mip) {
  return max(textureSize(k_texture_$D_$C(t), 0) >> mip, ivec2(1));
}
// A location, or a texel, moved by an offset in texels that leaves the array element unchanged.
//@ k_moved
float k_moved(float at, int offset, int size) { return at + float(offset) / float(size); }
vec2 k_moved(vec2 at, int offset, ivec2 size) {
  return vec2(at.x + float(offset) / float(size.x), at.y);
}
vec2 k_moved(vec2 at, ivec2 offset, ivec2 size) { return at + vec2(offset) / vec2(size); }
vec3 k_moved(vec3 at, ivec2 offset, ivec3 size) {
  return vec3(at.xy + vec2(offset) / vec2(size.xy), at.z);
}
vec3 k_moved(vec3 at, ivec3 offset, ivec3 size) { return at + vec3(offset) / vec3(size); }
int k_moved(int at, int offset) { return at + offset; }
ivec2 k_moved(ivec2 at, int offset) { return ivec2(at.x + offset, at.y); }
ivec2 k_moved(ivec2 at, ivec2 offset) { return at + offset; }
ivec3 k_moved(ivec3 at, ivec2 offset) { return ivec3(at.xy + offset, at.z); }
ivec3 k_moved(ivec3 at, ivec3 offset) { return at + offset; }

// ---------------------------------------------------------------------------------------------
// Samples

//@ k_texture_$D_$C
#define k_texture_$D_$C(t) k_textures_$D_$C[nonuniformEXT(k_view(t, $Ru))]
//@ k_image_$D_$C 1d 1d_array 2d 2d_array 3d
#define k_image_$D_$C(t) k_images_$D_$C[nonuniformEXT(k_view(t, $Ru))]
//@ k_sampled_$D_$C 1d 1d_array 2d 2d_array 3d cube cube_array
#define k_sampled_$D_$C(t, s) \
  $Psampler$DIM(k_texture_$D_$C(t), k_samplers[nonuniformEXT(uint(s.address))])
//@ k_compared_$D 1d 1d_array 2d 2d_array cube cube_array
#define k_compared_$D(t, s)     \
  sampler$DIMShadow(k_texture_$D_f(t), k_comparison_samplers[nonuniformEXT(uint(s.address))])

//@ k_sample_level_$D_$C 1d 1d_array 2d 2d_array 3d cube cube_array
$V k_sample_level_$D_$C(k_Descriptor t, k_Descriptor s, $L at, float lod) {
  if (!k_can_sample(t, s, $Ru, k_class_$C)) return $V(0);
  return textureLod(k_sampled_$D_$C(t, s), k_location_$D(at), k_lod(lod));
}
//@ k_sample_gradient_$D_$C 1d 1d_array 2d 2d_array 3d cube cube_array
$V k_sample_gradient_$D_$C(k_Descriptor t, k_Descriptor s, $L at, $G ddx, $G ddy) {
  if (!k_can_sample(t, s, $Ru, k_class_$C)) return $V(0);
  return textureGrad(k_sampled_$D_$C(t, s), k_location_$D(at), k_coordinate(ddx),
                     k_coordinate(ddy));
}

// The level that sample_gradient takes, before the sampler's bias and clamps.
//@ k_level_of_detail_$D_f 1d 1d_array 2d 2d_array 3d
float k_level_of_detail_$D_f(k_Descriptor t, k_Descriptor s, $L at, $G ddx, $G ddy) {
  if (!k_can_sample(t, s, $Ru, k_class_f)) return 0.0;
  $G size = $G(k_spatial_$D(k_size_$D_f(t, 0)));
  return 0.5 * log2(max(dot(ddx * size, ddx * size), dot(ddy * size, ddy * size)));
}
//@ k_face_change
vec2 k_face_change(vec3 at, vec3 change) {
  vec3 a = abs(at);
  int major = a.z >= a.x && a.z >= a.y ? 2 : a.y >= a.x ? 1 : 0;
  int u = major == 0 ? 2 : 0;
  int v = major == 1 ? 2 : 1;
  float grows = sign(at[major]) * change[major];
  return vec2(change[u] - at[u] / a[major] * grows, change[v] - at[v] / a[major] * grows) /
         (2.0 * a[major]);
}
//@ k_level_of_detail_$D_f cube cube_array
float k_level_of_detail_$D_f(k_Descriptor t, k_Descriptor s, $L at, $G ddx, $G ddy) {
  if (!k_can_sample(t, s, $Ru, k_class_f)) return 0.0;
  vec2 size = vec2(k_size_$D_f(t, 0).xy);
  vec2 x = k_face_change(at.xyz, ddx) * size;
  vec2 y = k_face_change(at.xyz, ddy) * size;
  return 0.5 * log2(max(dot(x, x), dot(y, y)));
}

// With a constant offset from -8 to 7 texels; t and s are names.
//@ k_sample_level_offset_$D_$C 1d 1d_array 2d 2d_array 3d
#define k_sample_level_offset_$D_$C(t, s, at, lod, offset)                                      \
  (k_can_sample(t, s, $Ru, k_class_$C)                                                          \
       ? textureLodOffset(k_sampled_$D_$C(t, s), k_location_$D(at), k_lod(lod), offset)         \
       : $V(0))
//@ k_sample_gradient_offset_$D_$C 1d 1d_array 2d 2d_array 3d
#define k_sample_gradient_offset_$D_$C(t, s, at, ddx, ddy, offset)                              \
  (k_can_sample(t, s, $Ru, k_class_$C)                                                          \
       ? textureGradOffset(k_sampled_$D_$C(t, s), k_location_$D(at), k_coordinate(ddx),         \
                           k_coordinate(ddy), offset)                                           \
       : $V(0))

// With any offset. Vulkan requires a constant one, so the location is moved instead, by texels of
// the nearest mip; between two mips of different size the other one's share is off by part of a
// texel.
//@ k_mip_size_$D 1d 1d_array 2d 2d_array 3d
$X k_mip_size_$D(k_Descriptor t, float lod) {
  int levels = textureQueryLevels(k_texture_$D_f(t));
  return k_size_$D_f(t, clamp(int(floor(k_lod(lod) + 0.5)), 0, levels - 1));
}
//@ k_sample_level_$D_$C 1d 1d_array 2d 2d_array 3d
$V k_sample_level_$D_$C(k_Descriptor t, k_Descriptor s, $L at, float lod, $O offset) {
  if (offset == $O(0) || !k_can_sample(t, s, $Ru, k_class_$C)) {
    return k_sample_level_$D_$C(t, s, at, lod);
  }
  return k_sample_level_$D_$C(t, s, k_moved(k_coordinate(at), offset, k_mip_size_$D(t, lod)), lod);
}
//@ k_sample_gradient_$D_$C 1d 1d_array 2d 2d_array 3d
$V k_sample_gradient_$D_$C(k_Descriptor t, k_Descriptor s, $L at, $G ddx, $G ddy, $O offset) {
  if (offset == $O(0) || !k_can_sample(t, s, $Ru, k_class_$C)) {
    return k_sample_gradient_$D_$C(t, s, at, ddx, ddy);
  }
  $G size = $G(k_spatial_$D(k_mip_size_$D(t, 0.0)));
  float longest = max(dot(ddx * size, ddx * size), dot(ddy * size, ddy * size));
  $X mip_size = k_mip_size_$D(t, 0.5 * log2(longest));
  return k_sample_gradient_$D_$C(t, s, k_moved(k_coordinate(at), offset, mip_size), ddx, ddy);
}
// Cubes have no offsets.
//@ k_sample_level_$D_$C cube cube_array
$V k_sample_level_$D_$C(k_Descriptor t, k_Descriptor s, $L at, float lod, ivec3 zero) {
  return k_sample_level_$D_$C(t, s, at, lod);
}
//@ k_sample_gradient_$D_$C cube cube_array
$V k_sample_gradient_$D_$C(k_Descriptor t, k_Descriptor s, $L at, $G ddx, $G ddy, ivec3 zero) {
  return k_sample_gradient_$D_$C(t, s, at, ddx, ddy);
}
//@ k_spatial_$D 1d 2d 3d
$X k_spatial_$D($X size) { return size; }
//@ k_spatial_1d_array
int k_spatial_1d_array(ivec2 size) { return size.x; }
//@ k_spatial_2d_array
ivec2 k_spatial_2d_array(ivec3 size) { return size.xy; }

// ---------------------------------------------------------------------------------------------
// Comparisons. The reference value is clamped to the range that a depth buffer of a normalized
// format can hold.

//@ k_reference
float k_reference(k_Descriptor t, float reference) {
  uint l = k_typed_layout(t.format);
  bool normalized = l != 0u && (l >> 8 & 0xFu) < 2u;
  return normalized ? k_saturate(reference) : reference;
}
// OpImageSampleDrefExplicitLod with image operand Lod (2): GLSL lacks it for some dimensions.
//@ k_dref_lod_$D 1d 1d_array 2d 2d_array cube cube_array
spirv_instruction(id = 90) float k_dref_lod_$D(sampler$DIMShadow s, $L at, float reference,
                                               spirv_literal int operands, float lod);
//@ k_sample_compare_level_$D 1d 1d_array 2d 2d_array cube cube_array
float k_sample_compare_level_$D(k_Descriptor t, k_Descriptor s, $L at, float reference,
                                float lod) {
  if (!k_can_sample(t, s, $Ru, k_class_f)) return 0.0;
  return k_dref_lod_$D(k_compared_$D(t, s), k_location_$D(at), k_reference(t, reference), 2,
                       k_lod(lod));
}
// With the operands Lod and ConstOffset (2 + 8).
//@ k_dref_lod_offset_$D 1d 1d_array 2d 2d_array
spirv_instruction(id = 90) float k_dref_lod_offset_$D(sampler$DIMShadow s, $L at, float reference,
                                                      spirv_literal int operands, float lod,
                                                      $O offset);
//@ k_sample_compare_level_offset_$D 1d 1d_array 2d 2d_array
#define k_sample_compare_level_offset_$D(t, s, at, reference, lod, offset)                      \
  (k_can_sample(t, s, $Ru, k_class_f)                                                           \
       ? k_dref_lod_offset_$D(k_compared_$D(t, s), k_location_$D(at), k_reference(t, reference), \
                              10, k_lod(lod), offset)                                           \
       : 0.0)
//@ k_sample_compare_level_$D 1d 1d_array 2d 2d_array
float k_sample_compare_level_$D(k_Descriptor t, k_Descriptor s, $L at, float reference, float lod,
                                $O offset) {
  if (offset == $O(0) || !k_can_sample(t, s, $Ru, k_class_f)) {
    return k_sample_compare_level_$D(t, s, at, reference, lod);
  }
  return k_sample_compare_level_$D(t, s, k_moved(k_coordinate(at), offset, k_mip_size_$D(t, lod)),
                                   reference, lod);
}
//@ k_sample_compare_level_$D cube cube_array
float k_sample_compare_level_$D(k_Descriptor t, k_Descriptor s, $L at, float reference, float lod,
                                ivec3 zero) {
  return k_sample_compare_level_$D(t, s, at, reference, lod);
}

// ---------------------------------------------------------------------------------------------
// Gathers: component 0 red .. 3 alpha.

//@ k_gather_$D_$C 2d 2d_array cube cube_array
$V k_gather_$D_$C(k_Descriptor t, k_Descriptor s, $L at, uint component) {
  if (!k_can_sample(t, s, $Ru, k_class_$C)) return $V(0);
  $L p = k_location_$D(at);
  if (component == 0u) return textureGather(k_sampled_$D_$C(t, s), p, 0);
  if (component == 1u) return textureGather(k_sampled_$D_$C(t, s), p, 1);
  if (component == 2u) return textureGather(k_sampled_$D_$C(t, s), p, 2);
  return textureGather(k_sampled_$D_$C(t, s), p, 3);
}
//@ k_gather_$D_$C 2d 2d_array
$V k_gather_$D_$C(k_Descriptor t, k_Descriptor s, $L at, uint component, ivec2 offset) {
  if (!k_can_sample(t, s, $Ru, k_class_$C)) return $V(0);
  $L p = k_location_$D(at);
  if (component == 0u) return textureGatherOffset(k_sampled_$D_$C(t, s), p, offset, 0);
  if (component == 1u) return textureGatherOffset(k_sampled_$D_$C(t, s), p, offset, 1);
  if (component == 2u) return textureGatherOffset(k_sampled_$D_$C(t, s), p, offset, 2);
  return textureGatherOffset(k_sampled_$D_$C(t, s), p, offset, 3);
}
//@ k_gather_compare_$D 2d 2d_array cube cube_array
vec4 k_gather_compare_$D(k_Descriptor t, k_Descriptor s, $L at, float reference) {
  if (!k_can_sample(t, s, $Ru, k_class_f)) return vec4(0.0);
  return textureGather(k_compared_$D(t, s), k_location_$D(at), k_reference(t, reference));
}
//@ k_gather_compare_$D 2d 2d_array
vec4 k_gather_compare_$D(k_Descriptor t, k_Descriptor s, $L at, float reference, ivec2 offset) {
  if (!k_can_sample(t, s, $Ru, k_class_f)) return vec4(0.0);
  return textureGatherOffset(k_compared_$D(t, s), k_location_$D(at), k_reference(t, reference),
                             offset);
}
//@ k_gather_$D_$C cube cube_array
$V k_gather_$D_$C(k_Descriptor t, k_Descriptor s, $L at, uint component, ivec3 zero) {
  return k_gather_$D_$C(t, s, at, component);
}
//@ k_gather_compare_$D cube cube_array
vec4 k_gather_compare_$D(k_Descriptor t, k_Descriptor s, $L at, float reference, ivec3 zero) {
  return k_gather_compare_$D(t, s, at, reference);
}

// ---------------------------------------------------------------------------------------------
// Texels: k_load_texel_ of textures, k_load_image_ and k_store_texel_ of RW textures.

//@ k_load_texel_$D_$C 1d 1d_array 2d 2d_array 3d
$V k_load_texel_$D_$C(k_Descriptor t, $X at, int mip) {
  if (!k_can_read(t, $Ru, k_class_$C)) return $V(0);
  if (uint(mip) >= uint(textureQueryLevels(k_texture_$D_$C(t)))) return $V(0);
  if (!k_inside(at, k_size_$D_$C(t, mip))) return $V(0);
  return texelFetch(k_texture_$D_$C(t), at, mip);
}
//@ k_load_texel_$D_$C 1d 1d_array 2d 2d_array 3d
$V k_load_texel_$D_$C(k_Descriptor t, $X at, int mip, $O offset) {
  return k_load_texel_$D_$C(t, k_moved(at, offset), mip);
}
// Multisampled textures have samples where others have mips.
//@ k_load_texel_$D_$C 2d_ms 2d_ms_array
$V k_load_texel_$D_$C(k_Descriptor t, $X from, int index, $O offset) {
  if (!k_can_read(t, $Ru, k_class_$C)) return $V(0);
  $X at = k_moved(from, offset);
  if (uint(index) >= uint(textureSamples(k_texture_$D_$C(t)))) return $V(0);
  if (!k_inside(at, textureSize(k_texture_$D_$C(t)))) return $V(0);
  return texelFetch(k_texture_$D_$C(t), at, index);
}
//@ k_load_image_$D_$C 1d 1d_array 2d 2d_array 3d
$V k_load_image_$D_$C(k_Descriptor t, $X at) {
  if (!k_can_write(t, $Ru, k_class_$C)) return $V(0);
  if (!k_inside(at, imageSize(k_image_$D_$C(t)))) return $V(0);
  return imageLoad(k_image_$D_$C(t), at);
}
//@ k_store_texel_$D_$C 1d 1d_array 2d 2d_array 3d
void k_store_texel_$D_$C(k_Descriptor t, $X at, $V value) {
  if (!k_can_write(t, $Ru, k_class_$C)) return;
  if (k_inside(at, imageSize(k_image_$D_$C(t)))) imageStore(k_image_$D_$C(t), at, value);
}

// {width, height, depth or elements, mips} of a mip; for a mip that does not exist, only the last.
//@ k_extent
uvec3 k_extent(int size) { return uvec3(size, 1, 1); }
uvec3 k_extent(ivec2 size) { return uvec3(size, 1); }
uvec3 k_extent(ivec3 size) { return uvec3(size); }
//@ k_texture_dimensions_$D 1d 2d 2d_array 3d cube cube_array
uvec4 k_texture_dimensions_$D(k_Descriptor t, uint number, uint mip) {
  if (!k_can_read(t, $Ru, number)) return uvec4(0u);
  uint levels = uint(textureQueryLevels(k_texture_$D_f(t)));
  if (mip >= levels) return uvec4(0u, 0u, 0u, levels);
  return uvec4(k_extent(k_size_$D_f(t, int(mip))), levels);
}
//@ k_texture_dimensions_$D 2d_ms 2d_ms_array
uvec4 k_texture_dimensions_$D(k_Descriptor t, uint number, uint mip) {
  if (!k_can_read(t, $Ru, number)) return uvec4(0u);
  return uvec4(k_extent(textureSize(k_texture_$D_f(t))), uint(textureSamples(k_texture_$D_f(t))));
}
//@ k_texture_dimensions_1d_array
uvec4 k_texture_dimensions_1d_array(k_Descriptor t, uint number, uint mip) {
  if (!k_can_read(t, 3u, number)) return uvec4(0u);
  uint levels = uint(textureQueryLevels(k_texture_1d_array_f(t)));
  if (mip >= levels) return uvec4(0u, 0u, 0u, levels);
  uvec2 size = uvec2(k_size_1d_array_f(t, int(mip)));
  return uvec4(size.x, 1u, size.y, levels);
}
//@ k_image_dimensions_$D 1d 2d 2d_array 3d
uvec4 k_image_dimensions_$D(k_Descriptor t, uint number) {
  if (!k_can_write(t, $Ru, number)) return uvec4(0u);
  return uvec4(k_extent(imageSize(k_image_$D_f(t))), 1u);
}
//@ k_image_dimensions_1d_array
uvec4 k_image_dimensions_1d_array(k_Descriptor t, uint number) {
  if (!k_can_write(t, 3u, number)) return uvec4(0u);
  uvec2 size = uvec2(imageSize(k_image_1d_array_f(t)));
  return uvec4(size.x, 1u, size.y, 1u);
}

// ---------------------------------------------------------------------------------------------
// Interlocked operations on texels of the formats R32_UINT, R32_SINT and (exchange) R32_FLOAT. Each
// returns the previous value; if there is no such texel, it does nothing and returns 0.

//@ k_atomic_images_$D_i 1d 1d_array 2d 2d_array 3d
layout(set = 0, binding = 1, r32i) uniform iimage$DIM k_atomic_images_$D_i[];
//@ k_atomic_images_$D_u 1d 1d_array 2d 2d_array 3d
layout(set = 0, binding = 1, r32ui) uniform uimage$DIM k_atomic_images_$D_u[];
//@ k_atomic_image_$D_$C 1d 1d_array 2d 2d_array 3d
#define k_atomic_image_$D_$C(t) k_atomic_images_$D_$C[nonuniformEXT(k_view(t, $Ru))]
//@ k_atomic_images_$D_f 1d 1d_array 2d 2d_array 3d
layout(set = 0, binding = 1, r32f) uniform image$DIM k_atomic_images_$D_f[];
//@ k_r32_f
const uint k_r32_f = 41u;
//@ k_r32_i
const uint k_r32_i = 43u;
//@ k_r32_u
const uint k_r32_u = 42u;
//@ k_has_atomic_texel_$D_$C 1d 1d_array 2d 2d_array 3d
bool k_has_atomic_texel_$D_$C(k_Descriptor t, $X at) {
  return k_can_write(t, $Ru, k_class_$C) && t.format == k_r32_$C &&
         k_inside(at, imageSize(k_atomic_image_$D_$C(t)));
}
//@ k_image_atomic_add_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_add_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicAdd(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_add_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_add_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicAdd(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_and_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_and_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicAnd(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_and_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_and_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicAnd(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_or_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_or_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicOr(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_or_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_or_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicOr(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_xor_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_xor_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicXor(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_xor_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_xor_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicXor(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_min_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_min_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicMin(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_min_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_min_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicMin(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_max_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_max_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicMax(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_max_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_max_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicMax(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_exchange_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_exchange_$D_i(k_Descriptor t, $X at, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicExchange(k_atomic_image_$D_i(t), at, value);
}
//@ k_image_atomic_exchange_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_exchange_$D_u(k_Descriptor t, $X at, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicExchange(k_atomic_image_$D_u(t), at, value);
}
//@ k_image_atomic_compare_exchange_$D_i 1d 1d_array 2d 2d_array 3d
int k_image_atomic_compare_exchange_$D_i(k_Descriptor t, $X at, int compare, int value) {
  if (!k_has_atomic_texel_$D_i(t, at)) return int(0);
  return imageAtomicCompSwap(k_atomic_image_$D_i(t), at, compare, value);
}
//@ k_image_atomic_compare_exchange_$D_u 1d 1d_array 2d 2d_array 3d
uint k_image_atomic_compare_exchange_$D_u(k_Descriptor t, $X at, uint compare, uint value) {
  if (!k_has_atomic_texel_$D_u(t, at)) return uint(0);
  return imageAtomicCompSwap(k_atomic_image_$D_u(t), at, compare, value);
}
//@ k_image_atomic_exchange_$D_f 1d 1d_array 2d 2d_array 3d
float k_image_atomic_exchange_$D_f(k_Descriptor t, $X at, float value) {
  if (!k_has_atomic_texel_$D_f(t, at)) return 0.0;
  return imageAtomicExchange(k_atomic_image_$D_f(t), at, value);
}
