// SPDX-License-Identifier: MIT
// This file holds what the shaders of every effect can reach: one global root table for all of
// them, plus the arguments of hit group records. effects/engine/frame.h has the same layout for the
// host. [Northlight deck: Root Tables]
#ifndef KAAMOS_FRAME_HLSLI
#define KAAMOS_FRAME_HLSLI

#include "encoding.hlsli"
#include "geometry.hlsli"
#include "material.hlsli"
#include "sky.hlsli"

// World space is relative to the camera here: the camera is at the origin.
struct FrameConstants {
  // Half the picture's width at distance 1, or anywhere where rays are parallel; and its height.
  float3 camera_right;
  float near_plane;       // metres, for the reversed-Z depth
  float3 camera_up;
  float pixel_angle;      // that a pixel's side covers, or metres; 0: no ray cones
  float3 camera_forward;  // unit
  uint seed;
  float3 direction_to_sun;  // unit
  float tan_sun_radius;
  float3 sun_irradiance;
  uint light_count;
  float3 sky_zenith;
  uint frame_index;
  float3 sky_horizon;
  float over_right;  // 1 / length(camera_right), and so on
  float3 sky_ground;
  float over_up;
  // The previous frame's camera, as above; in the first frame, the current one.
  float3 previous_right;
  float over_previous_right;
  float3 previous_up;
  float over_previous_up;
  float3 previous_forward;
  float white;  // radiance that the exposure takes to 1
  float3 camera_motion;  // metres, from the previous camera to this one
  uint is_orthographic;  // 1: the camera's rays are parallel; what is at distance 1 is everywhere
  float2 jitter;           // pixels, added to the primary rays
  float2 previous_jitter;  // the previous frame's
  // The sun's map in the atlas. A point p stands at dot(p - sun_map_centre, axis), from -1 to 1.
  float3 sun_map_centre;
  float sun_map_reach;  // metres from the centre to where its rays begin, and to their end
  float3 sun_map_right;
  float sun_map_texel;  // metres
  float3 sun_map_up;
  uint sun_map_size;    // texels along its side; 0: there is no map
};

// Root constants of a dispatch.
struct PassConstants {
  uint first_sample;  // the dispatch takes samples
  uint sample_count;  // [first_sample, first_sample + sample_count) of each pixel
  float radius;       // metres; reach of ambient occlusion
  uint first_row;     // first row of the band of the picture that is dispatched
  uint sorted;        // 1: pixels are taken in the order of ray_order
  uint pixel_step;    // 2: only one pixel of each 2 x 2 gets rays, and rows count those
  uint accumulate;    // 0: sums begin anew, whatever the pictures hold
  uint pixel_offset;  // which pixel of the 2 x 2: bit 0 to the right, bit 1 below
  uint sharpness;     // 0: nobody reads how sharp shadows are
  uint again;         // 1: samples of the previous frame are taken again
};

// The place of an instance in the previous frame. [effects/engine/gpu_scene.h]
struct PreviousInstance {
  float4 rows[3];  // object to world, relative to the camera, both of the previous frame
  uint flags;      // 0: nothing moved
  uint3 padding;
};
static const uint kPreviousMoved = 1;
static const uint kPreviousDeformed = 2;  // its vertices hold their previous positions
static const uint kPreviousPositionOffset = 48;  // bytes into such a vertex

ConstantBuffer<FrameConstants> frame : register(b0);
ConstantBuffer<PassConstants> pass_constants : register(b1);
RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<MaterialConstants> materials : register(t1);
StructuredBuffer<float2> blue_noise : register(t2);
StructuredBuffer<PreviousInstance> previous_instances : register(t4);  // by InstanceIndex()
// The pixel of each place in the dispatch, row by row: x + 65536 * y. [effects/surfaces/ray_order]
StructuredBuffer<uint> ray_order : register(t5);
// Specular albedo: x * F0 + y, by sqrt(cosine of the view) and roughness, both 0 to 1, cosines
// running fastest. [effects/assets/common/specular_albedo.h]
StructuredBuffer<float2> specular_albedo_table : register(t6);
static const uint kSpecularAlbedoCosines = 32;
static const uint kSpecularAlbedoRoughnesses = 32;
Texture2D<float4> textures[] : register(t0, space1);
SamplerState samplers[] : register(s0, space1);

#include "lights.hlsli"
StructuredBuffer<LightConstants> lights : register(t3);  // frame.light_count of them

// The G-buffer.
RWTexture2D<float> g_depth : register(u0);       // reversed-Z, infinite far: near / view_z; 0: a miss
RWTexture2D<float> g_view_z : register(u1);      // metres along the camera's axis
RWTexture2D<float2> g_normal : register(u2);     // geometric normal, octahedral, towards the camera
RWTexture2D<float2> g_shading_normal : register(u3);
RWTexture2D<float4> g_base_color : register(u4);  // EncodeColor
RWTexture2D<float4> g_emissive : register(u5);    // w: tint of EncodeDielectric
RWTexture2D<float4> g_material : register(u6);    // roughness, metallic, EncodeDielectric; z is 1: unlit
RWTexture2D<uint2> g_ids : register(u7);          // instance + 1, primitive; 0: a miss
// Position relative to the camera, and how far along the geometric normal a ray must start so that
// it does not hit its own surface.
RWTexture2D<float4> g_position : register(u8);

// The radiance that the camera sees of the surfaces, the sky and glass.
RWTexture2D<float4> radiance : register(u9);

// The place of the pixel's surface in the previous frame: xy is the offset from here in picture
// widths and heights, z the change of its view depth in metres. Without jitter.
RWTexture2D<float4> g_motion : register(u10);

// The key that each pixel's ray is sorted by. [effects/surfaces/ray_order]
RWStructuredBuffer<uint> ray_keys : register(u11);

// Arguments of hit group records. [Northlight deck: Root SRVs and Constants for Vertex Data]
ByteAddressBuffer vertices : register(t0, space2);
ByteAddressBuffer indices : register(t1, space2);
ConstantBuffer<HitConstants> hit_constants : register(b0, space2);

static const uint kRayTypeSurface = 0;
static const uint kRayTypeVisibility = 1;
static const uint kRayTypeCount = 2;

// The camera and mirrors see everything but glass (bit 1). The transparency effect handles glass;
// all others look through it. [effects/assets/scene/scene.h: InstanceMask]
static const uint kMaskSolid = 0xFD;
// The same without the shapes of lamps (bit 4), for all other rays. A lamp is met as a light or by
// its shape: a ray that hit the shape as well would count its light twice, or shadow it by itself.
// [Northlight deck: Instance Inclusion Mask]
static const uint kMaskWithoutLamps = 0xED;

// The longest ray whose points are all finite numbers.
static const float kLongestRay = 1e30;
// Length of a ray to the sun: nothing is too far away to cast a shadow. A limit in metres would
// fail for a scene in other units.
static const float kSunDistance = kLongestRay;

// Replaces NaN and negative values by 0 and limits x to `largest`. A broken material turns black,
// in its own pixels and wherever it is seen; a broken length becomes 0.
float Contain(float x, float largest) { return x > 0.0 ? min(x, largest) : 0.0; }
float3 Contain(float3 x, float largest) {
  return float3(Contain(x.x, largest), Contain(x.y, largest), Contain(x.z, largest));
}

// Dimension pairs of a pixel's sample sequence. No two effects share a pair.
static const uint kAmbientOcclusionPair = 0;
static const uint kSunPair = 1;

// Returns what a ray in that direction sees if it leaves the scene.
float3 SkyTowards(float3 direction) {
  return SkyRadiance(frame.sky_zenith, frame.sky_horizon, frame.sky_ground, direction);
}

// A ray of the camera. Its direction has the component 1 along the camera's axis, so that the t of a
// hit is the view depth.
struct CameraRay {
  float3 origin;
  float3 direction;
};

// The ray through a place of the picture, -1..1 to the right and down. `right`, `up` and `forward`
// are those of a camera.
CameraRay RayOfCamera(float2 ndc, float3 right, float3 up, float3 forward) {
  CameraRay ray;
  ray.origin = float3(0, 0, 0);
  ray.direction = forward;
  if (frame.is_orthographic != 0) {
    ray.origin = ndc.x * right - ndc.y * up;
  } else {
    ray.direction = forward + ndc.x * right - ndc.y * up;
  }
  return ray;
}

CameraRay RayThrough(float2 ndc) {
  return RayOfCamera(ndc, frame.camera_right, frame.camera_up, frame.camera_forward);
}

// The unit vector along which the camera sees a point, which is given relative to it.
float3 SeenAlong(float3 position) {
  return frame.is_orthographic != 0 ? frame.camera_forward : normalize(position);
}

// Returns by how much what is at distance 1 grows up to a view depth.
float GrowthAt(float view_z) { return frame.is_orthographic != 0 ? 1.0 : view_z; }

// Width of a pixel's cone after `way` metres.
float ConeWidthAfter(float way) { return GrowthAt(way) * frame.pixel_angle; }

// Projects a point relative to a camera to picture coordinates from the upper left corner, 0..1.
// `view_z` is its distance along the camera's axis; `over_right` and `over_up` are 1 / length.
float2 PictureUv(float3 position, float3 right, float over_right, float3 up, float over_up,
                 float3 forward, out float view_z) {
  view_z = dot(position, forward);
  // The lengths of right and up are half the picture's size at distance 1.
  const float2 ndc = float2(dot(position, right) * (over_right * over_right),
                            dot(position, up) * (over_up * over_up)) * (1.0 / GrowthAt(view_z));
  return float2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y);
}

// Returns where the previous camera saw a point, given relative to that camera.
float2 PreviousPictureUv(float3 position, out float view_z) {
  return PictureUv(position, frame.previous_right, frame.over_previous_right, frame.previous_up,
                   frame.over_previous_up, frame.previous_forward, view_z);
}

// The registers of space3 belong to each pass. [effects/engine/pass_views.h]

// The pixel that gets rays at a place of the dispatch.
uint2 TracedPixel(uint2 place) {
  const uint2 offset = uint2(pass_constants.pixel_offset & 1u, pass_constants.pixel_offset >> 1);
  return place * pass_constants.pixel_step + offset;
}

uint2 FramePixel() {
  const uint2 index = DispatchRaysIndex().xy;
  const uint2 place = uint2(index.x, index.y + pass_constants.first_row);
  if (pass_constants.sorted == 0) return TracedPixel(place);
  const uint pixel = ray_order[place.y * DispatchRaysDimensions().x + place.x];
  return uint2(pixel & 0xFFFFu, pixel >> 16);
}

// The sum that a pass adds its samples to.
float SumBefore(RWTexture2D<float> sums, uint2 pixel) {
  if (pass_constants.accumulate == 0) return 0.0;
  return sums[pixel];
}
float4 SumBefore(RWTexture2D<float4> sums, uint2 pixel) {
  if (pass_constants.accumulate == 0) return float4(0, 0, 0, 0);
  return sums[pixel];
}

#endif
