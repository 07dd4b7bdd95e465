// SPDX-License-Identifier: MIT
// What every effect's shaders can reach: one global root table for all of them, and the arguments of
// hit group records. effects/frame/frame.h holds the same layout for the host.
// [Northlight deck: Root Tables]
#ifndef KAAMOS_FRAME_HLSLI
#define KAAMOS_FRAME_HLSLI

#include "encoding.hlsli"
#include "geometry.hlsli"
#include "lights.hlsli"
#include "material.hlsli"
#include "sky.hlsli"

// World space here is relative to the camera: the camera stands at the origin.
struct FrameConstants {
  float3 camera_right;    // half the picture's width at distance 1
  float near_plane;       // metres; of the reversed-Z depth
  float3 camera_up;       // half the picture's height at distance 1
  float pixel_angle;      // radians that a pixel's side covers; 0: no ray cones
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
  // The camera of the frame before, as above; the same camera in the first frame.
  float3 previous_right;
  float over_previous_right;
  float3 previous_up;
  float over_previous_up;
  float3 previous_forward;
  float padding4;
  float3 camera_motion;  // metres, from the camera before to this one
  float padding5;
  float2 jitter;           // pixels, of the primary rays
  float2 previous_jitter;  // of the frame before
};

// Root constants of a dispatch.
struct PassConstants {
  uint first_sample;  // of the samples of a pixel, this dispatch takes
  uint sample_count;  // [first_sample, first_sample + sample_count)
  float radius;       // metres; of ambient occlusion
  uint first_row;     // of the picture: a dispatch takes a band of rows
  uint sorted;        // 1: the pixels are taken in the order of ray_order
  uint pixel_step;    // 2: rays at even pixels of even rows only, and rows count those
  uint accumulate;    // 0: pictures of sums begin anew, whatever stands in them
};

// Where an instance was one frame ago. [effects/scene/gpu_scene.h]
struct PreviousInstance {
  float4 rows[3];  // object to world then, relative to the camera of then
  uint flags;      // 0: nothing moved
  uint3 padding;
};
static const uint kPreviousMoved = 1;
static const uint kPreviousDeformed = 2;  // vertices hold their previous positions
static const uint kPreviousPositionOffset = 48;  // bytes, of those vertices

ConstantBuffer<FrameConstants> frame : register(b0);
ConstantBuffer<PassConstants> pass_constants : register(b1);
RaytracingAccelerationStructure scene : register(t0);
StructuredBuffer<MaterialConstants> materials : register(t1);
StructuredBuffer<float2> blue_noise : register(t2);
StructuredBuffer<LightConstants> lights : register(t3);  // frame.light_count of them
StructuredBuffer<PreviousInstance> previous_instances : register(t4);  // by InstanceIndex()
// By place in the dispatch, rows first: its pixel, x + 65536 * y. [effects/ray_order]
StructuredBuffer<uint> ray_order : register(t5);
Texture2D<float4> textures[] : register(t0, space1);
SamplerState samplers[] : register(s0, space1);

// The G-buffer. [effects-spec B0.2]
RWTexture2D<float> g_depth : register(u0);       // reversed-Z, infinite far: near / view_z; 0 nothing
RWTexture2D<float> g_view_z : register(u1);      // metres along the camera's axis
RWTexture2D<float2> g_normal : register(u2);     // geometric, octahedral, towards the camera
RWTexture2D<float2> g_shading_normal : register(u3);
RWTexture2D<float4> g_base_color : register(u4);  // EncodeColor
RWTexture2D<float4> g_emissive : register(u5);
RWTexture2D<float4> g_material : register(u6);    // roughness, metallic, 0, 0
RWTexture2D<uint2> g_ids : register(u7);          // instance + 1, primitive; 0 nothing
// Position relative to the camera, and how far a ray must start from it along the geometric normal so
// as not to meet its own surface.
RWTexture2D<float4> g_position : register(u8);

// Effects: sums over the samples taken so far.
RWTexture2D<float> ambient_occlusion_sum : register(u9);
RWTexture2D<float> sun_visibility_sum : register(u10);
RWTexture2D<float4> radiance : register(u11);

// Where the pixel's surface was one frame ago: picture widths and heights from here, and the change
// of its view depth in metres. Without jitter.
RWTexture2D<float4> g_motion : register(u12);

// What the rays of each pixel are sorted by. [effects/ray_order]
RWStructuredBuffer<uint> ray_keys : register(u13);

// Hit group records. [Northlight deck: Root SRVs and Constants for Vertex Data]
ByteAddressBuffer vertices : register(t0, space2);
ByteAddressBuffer indices : register(t1, space2);
ConstantBuffer<HitConstants> hit_constants : register(b0, space2);

static const uint kRayTypeSurface = 0;
static const uint kRayTypeVisibility = 1;
static const uint kRayTypeCount = 2;

// Instances that block rays: all but glass (bit 1), which the transparency effect is for; these
// effects look through it. [effects/scene/scene.h: InstanceMask]
static const uint kMaskSolid = 0xFD;
// The same without the shapes of lamps (bit 4): where lamps are sampled, their light is counted, and
// a ray that met the shape by chance would count it again. [Northlight deck: Instance Inclusion Mask]
static const uint kMaskWithoutLamps = 0xED;

// As long as a ray can be without places on it that are no numbers.
static const float kLongestRay = 1e30;
// Length of a ray to the sun: nothing is too far away to cast a shadow. A number of metres would be
// one that a scene in other units outgrows.
static const float kSunDistance = kLongestRay;

// 0 for what is no number or negative, and no more than `largest`: a broken material is a black one,
// in its own pixels and wherever it is seen; a broken length is none. [effects-spec E.1]
float Contain(float x, float largest) { return x > 0.0 ? min(x, largest) : 0.0; }
float3 Contain(float3 x, float largest) {
  return float3(Contain(x.x, largest), Contain(x.y, largest), Contain(x.z, largest));
}

// Dimension pairs of a pixel's samples: two effects never share one. [effects-spec B0.3]
static const uint kAmbientOcclusionPair = 0;
static const uint kSunPair = 1;

// What a ray in that direction sees that leaves the scene.
float3 SkyTowards(float3 direction) {
  return SkyRadiance(frame.sky_zenith, frame.sky_horizon, frame.sky_ground, direction);
}

// Registers of space3 are a pass's own. [effects/frame/pass_views.h]

// The pixel of this invocation.
uint2 FramePixel() {
  const uint2 index = DispatchRaysIndex().xy;
  const uint2 place = uint2(index.x, index.y + pass_constants.first_row);
  if (pass_constants.sorted == 0) return place * pass_constants.pixel_step;
  const uint pixel = ray_order[place.y * DispatchRaysDimensions().x + place.x];
  return uint2(pixel & 0xFFFFu, pixel >> 16);
}

// What a pass adds its samples to.
float SumBefore(RWTexture2D<float> sums, uint2 pixel) {
  if (pass_constants.accumulate == 0) return 0.0;
  return sums[pixel];
}
float4 SumBefore(RWTexture2D<float4> sums, uint2 pixel) {
  if (pass_constants.accumulate == 0) return float4(0, 0, 0, 0);
  return sums[pixel];
}

#endif
