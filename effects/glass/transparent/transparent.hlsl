// SPDX-License-Identifier: MIT
// Glass in front of the G-buffer's surfaces. The first layers are traced one by one, some with a
// mirror ray each; all layers behind them take one ray, whose any-hit shader blends them without an
// order. [Control; Northlight deck: Transparent objects]
#include "glass_layer.hlsli"

// Radiance of the glass, and the view depth of its first layer, metres (0: no glass).
RWTexture2D<float4> glass_radiance : register(u0, space3);
// Transmittance per colour, and the number of layers that were traced one by one.
RWTexture2D<float4> glass_transmittance : register(u1, space3);

// For glass that is drawn: radiance that the nearest layer mirrors and its view depth (0: no glass).
// [effects/glass/drawn_glass]
RWTexture2D<float4> first_mirrored : register(u2, space3);

struct TransparentConstants {
  uint reflecting_layers;   // first layers with a mirror ray
  uint sorted_layers;       // layers traced one by one, mirrored or not; at most kMaxSortedLayers
  uint weight_kind;         // weight function of the blend without order
  uint sun;                 // 1: a shadow ray per layer and per reflection
  float reflection_length;  // metres
  float fade;               // fraction of that length, at its end, over which the volume takes over
  uint full_reflection;     // 1: reflections keep their strength where coverage is thin
  float depth_scale;        // factor on view depths before they are weighted
};
ConstantBuffer<TransparentConstants> constants : register(b0, space3);

static const uint kMaskGlass = 0x02;  // [effects/assets/scene/scene.h: InstanceMask]
static const uint kMaxSortedLayers = 8;

// Closer to an edge than this, in barycentrics, a ray may hit the neighbour as well, at the same
// distance but for rounding.
static const float kEdge = 1e-5;
static const float kSameDistance = 1e-6;
static const uint kNoInstance = 0xFFFFFFFF;

// Kinds of rays.
static const uint kLayerRay = 0;
static const uint kReflectingLayerRay = 1;
static const uint kMirrorRay = 2;
static const uint kBlendRay = 3;
static const uint kMirrorOfLayerRay = 4;  // finds what a layer mirrors, and no more of it

struct GlassPayload {
  float3 radiance;       // of a layer, or of a mirror ray's hit; in a blend the weighted sum
  float distance;        // along the ray; negative: a miss
  float3 transmittance;  // of a layer; in a blend the product, in x
  float weight;          // sum of weights in a blend
  uint kind;
  uint instance;         // of the previous layer, which the ray must not hit again
  uint primitive;
  float met;             // distance at which that layer was hit
  float sun_visibility;  // of the last layer that faced the sun; kUnknown: none did
  // In a blend with unknown visibility, because any-hit shaders cannot trace rays:
  float3 sunlight;       // the weighted sum of what the sun adds where nothing is in its way
  float3 sun_origin;     // where a ray to the sun starts, on the nearest layer that faces it
  float sunlit;          // distance of that layer; negative: none faces it
};

static const float kUnknown = -1.0;  // visibility

GlassPayload NewPayload(uint kind, float sun_visibility) {
  GlassPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.transmittance = float3(1, 1, 1);
  payload.weight = 0.0;
  payload.kind = kind;
  payload.instance = kNoInstance;
  payload.primitive = 0;
  payload.met = -1.0;
  payload.sun_visibility = sun_visibility;
  payload.sunlight = float3(0, 0, 0);
  payload.sun_origin = float3(0, 0, 0);
  payload.sunlit = -1.0;
  return payload;
}

bool SunShines() { return constants.sun != 0 && any(frame.sun_irradiance > 0.0); }

// Coverage of the glass at a hit; 0 where the ray passes: in holes and at the back of single-sided
// glass.
float GlassCoverage(float2 barycentrics) {
  const MaterialConstants material = materials[hit_constants.material_id];
  const uint3 corners = LoadTriangle(indices, hit_constants.index_size_bytes, PrimitiveIndex());
  if ((material.flags & kMaterialDoubleSided) == 0) {
    const float3 p0 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.x);
    const float3 p1 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.y);
    const float3 p2 = LoadVertexFloat3(vertices, hit_constants.vertex_stride, 0, corners.z);
    if (dot(ObjectRayDirection(), cross(p1 - p0, p2 - p0)) > 0.0) return 0.0;
  }
  float alpha = material.base_color.a;
  if (HasTexture(material, kBaseColorTexture)) {
    const float2 uv = LoadUvOf(vertices, hit_constants, corners, barycentrics,
                             UsesSecondUv(material, kBaseColorTexture));
    alpha *= SampleMaterial(material, kBaseColorTexture, uv, kFinestLevel).a;
  }
  if (hit_constants.color_offset != 0) {
    alpha *= LoadColor(vertices, hit_constants, corners, barycentrics).w;
  }
  return Coverage(alpha);
}

// A ray on the edge of two triangles can hit both; that is still one layer.
bool IsMetAgain(GlassPayload payload, bool on_edge) {
  if (InstanceIndex() != payload.instance) return false;
  return PrimitiveIndex() == payload.primitive ||
         (on_edge && abs(RayTCurrent() - payload.met) <= kSameDistance * RayTCurrent());
}

bool IsOnEdge(float2 barycentrics) {
  return min(min(barycentrics.x, barycentrics.y), 1.0 - barycentrics.x - barycentrics.y) < kEdge;
}

void Remember(inout GlassPayload payload) {
  payload.instance = InstanceIndex();
  payload.primitive = PrimitiveIndex();
  payload.met = RayTCurrent();
}

// The weights of weighted blended order-independent transparency. [McGuire and Bavoil 2013,
// equations 7 to 10]
float BlendWeight(float alpha, float view_z) {
  const float z = view_z * constants.depth_scale;
  const float far = z / 200.0;
  const float far_squared = far * far;
  if (constants.weight_kind == 1) {
    const float near = z / 5.0;
    return alpha * clamp(10.0 / (1e-5 + near * near + far_squared * far_squared * far_squared), 1e-2, 3e3);
  }
  if (constants.weight_kind == 2) {
    const float near = z / 10.0;
    return alpha * clamp(10.0 / (1e-5 + near * near * near + far_squared * far_squared * far_squared),
                         1e-2, 3e3);
  }
  if (constants.weight_kind == 3) return alpha * clamp(0.03 / (1e-5 + far_squared * far_squared), 1e-2, 3e3);
  if (constants.weight_kind == 4) {
    // 1 - d for a depth buffer that is 1 at infinity: near / z.
    const float nearness = saturate(frame.near_plane / max(view_z, frame.near_plane));
    return alpha * max(3e3 * nearness * nearness * nearness, 1e-2);
  }
  return 1.0;
}

[shader("anyhit")]
void TransparentAnyHit(inout GlassPayload payload, in BuiltInTriangleIntersectionAttributes hit) {
  if (payload.kind == kMirrorRay) {
    if (IsOpenAt(hit.barycentrics)) {
      IgnoreHit();
    }
    return;
  }
  const float coverage = GlassCoverage(hit.barycentrics);
  if (!(coverage > 0.0)) {
    IgnoreHit();
  }
  const bool on_edge = IsOnEdge(hit.barycentrics);
  if (IsMetAgain(payload, on_edge)) {
    IgnoreHit();
  }
  if (payload.kind != kBlendRay) return;
  if (on_edge) Remember(payload);
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  const Brdf brdf = SurfaceBrdf(surface);
  const float3 view = -normalize(WorldRayDirection());
  const float weight = coverage * BlendWeight(coverage, RayTCurrent());
  float3 light = LayerLight(surface, brdf, view);
  if (payload.sun_visibility != 0.0) {
    const float3 sunlight = LayerSunlight(surface, brdf, view);
    if (payload.sun_visibility > 0.0) {
      light += sunlight * payload.sun_visibility;
    } else if (any(sunlight > 0.0)) {
      payload.sunlight += Contain(sunlight) * weight;
      if (payload.sunlit < 0.0 || RayTCurrent() < payload.sunlit) {
        payload.sunlit = RayTCurrent();
        payload.sun_origin = SurfaceOrigin(surface, frame.direction_to_sun);
      }
    }
  }
  payload.radiance += Contain(light) * weight;
  payload.weight += weight;
  payload.transmittance.x *= 1.0 - coverage;
  if (payload.distance < 0.0 || RayTCurrent() < payload.distance) payload.distance = RayTCurrent();
  IgnoreHit();
}

[shader("miss")]
void TransparentMiss(inout GlassPayload payload) {
  if (payload.kind == kMirrorRay) {
    const float3 end = WorldRayOrigin() + WorldRayDirection() * RayTCurrent();
    payload.radiance = VolumeRadiance(end, kEveryCell, WorldRayDirection());
  }
}

// Returns what the glass mirrors, as a flat pane would: roughness is ignored.
float3 MirrorImage(Surface surface, float3 direction) {
  float3 mirrored = reflect(direction, surface.shading_normal);
  // A normal-mapped direction can point into the pane.
  if (!(dot(mirrored, surface.normal) > 0.0)) mirrored = reflect(direction, surface.normal);
  RayDesc ray;
  ray.Origin = SurfaceOrigin(surface, mirrored);
  ray.TMin = 0.0;
  ray.Direction = mirrored;
  const float longest = Contain(constants.reflection_length, kLongestRay);
  ray.TMax = longest;
  GlassPayload payload = NewPayload(kMirrorRay, 0.0);
  TraceRay(scene, RAY_FLAG_NONE, ReflectionMask(surface.roughness), kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  if (payload.distance < 0.0) return payload.radiance;
  // Fade to what a miss answers, so that no seam shows where the rays end.
  const float start = longest * (1.0 - Contain(constants.fade, 1.0));
  const float far = saturate((payload.distance - start) / max(longest - start, 1e-6 * longest));
  if (far == 0.0) return payload.radiance;
  return lerp(payload.radiance,
              VolumeRadiance(ray.Origin + mirrored * longest, kEveryCell, mirrored), far);
}

void ShadeMirrored(inout GlassPayload payload, Surface surface) {
  payload.radiance = ShadeHit(surface, -WorldRayDirection(), constants.sun) +
                     IndirectAtHit(surface, kEveryCell, -WorldRayDirection());
  payload.distance = RayTCurrent();
}

[shader("closesthit")]
void TransparentClosestHit(inout GlassPayload payload,
                           in BuiltInTriangleIntersectionAttributes hit) {
  const Surface surface = LoadSurface(hit.barycentrics, ConeWidth());
  if (payload.kind == kMirrorRay) {
    ShadeMirrored(payload, surface);
    return;
  }
  const float3 direction = normalize(WorldRayDirection());
  if (payload.kind == kMirrorOfLayerRay) {
    payload.radiance = Contain(MirrorImage(surface, direction));
    payload.distance = RayTCurrent();
    return;
  }
  if (SunShines() && dot(surface.normal, frame.direction_to_sun) > 0.0) {
    payload.sun_visibility = TraceVisibility(SurfaceOrigin(surface, frame.direction_to_sun),
                                             frame.direction_to_sun, kSunDistance);
  }
  const float coverage = Coverage(surface.opacity);
  GlassLayer layer = LitLayer(surface, coverage, direction, payload.sun_visibility);
  if (payload.kind == kReflectingLayerRay) {
    AddMirrored(layer, surface, coverage, direction, Contain(MirrorImage(surface, direction)),
                constants.full_reflection != 0);
  }
  payload.radiance = layer.radiance;
  payload.transmittance = layer.transmittance;
  payload.distance = RayTCurrent();
  Remember(payload);
}

// Through a pixel, up to what is opaque there.
RayDesc GlassRay(uint2 pixel) {
  uint width, height;
  g_view_z.GetDimensions(width, height);
  const float2 ndc = (float2(pixel) + 0.5 + frame.jitter) / float2(width, height) * 2.0 - 1.0;
  const float opaque_z = g_view_z[pixel];
  // The same unnormalised direction as in the G-buffer: t is the view depth.
  const CameraRay through = RayThrough(ndc);
  RayDesc ray;
  ray.Origin = through.origin;
  ray.TMin = 0.0;
  ray.Direction = through.direction;
  ray.TMax = opaque_z > 0.0 ? opaque_z : 1e30;
  return ray;
}

[shader("raygeneration")]
void TransparentRayGen() {
  const uint2 pixel = FramePixel();
  RayDesc ray = GlassRay(pixel);
  GlassPayload payload = NewPayload(kLayerRay, SunShines() ? kUnknown : 0.0);
  float3 sum = float3(0, 0, 0);
  float3 through = float3(1, 1, 1);
  float first = 0.0;
  uint layers = 0;
  bool more = true;
  const uint sorted_layers = min(constants.sorted_layers, kMaxSortedLayers);
  for (uint i = 0; i < sorted_layers && more; ++i) {
    payload.kind = i < constants.reflecting_layers ? kReflectingLayerRay : kLayerRay;
    payload.radiance = float3(0, 0, 0);
    payload.transmittance = float3(1, 1, 1);
    payload.distance = -1.0;
    payload.weight = 0.0;
    TraceRay(scene, RAY_FLAG_NONE, kMaskGlass, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
             payload);
    if (payload.distance < 0.0) {
      more = false;
    } else {
      sum += through * payload.radiance;
      through *= payload.transmittance;
      if (layers == 0) first = payload.distance;
      ++layers;
      // Continue strictly behind this layer. A second pane at the same distance counts as the same
      // layer.
      ray.TMin = payload.distance;
      more = max(through.x, max(through.y, through.z)) > 0.0;
    }
  }
  if (more) {
    payload.kind = kBlendRay;
    payload.radiance = float3(0, 0, 0);
    payload.transmittance = float3(1, 1, 1);
    payload.distance = -1.0;
    payload.weight = 0.0;
    TraceRay(scene, RAY_FLAG_NONE, kMaskGlass, kRayTypeSurface, kRayTypeCount, kRayTypeSurface, ray,
             payload);
    if (payload.weight > 0.0) {
      if (payload.sunlit >= 0.0) {
        payload.radiance += payload.sunlight * TraceVisibility(payload.sun_origin,
                                                               frame.direction_to_sun, kSunDistance);
      }
      const float open = payload.transmittance.x;
      sum += through * (payload.radiance / payload.weight) * (1.0 - open);
      through *= open;
    }
    if (layers == 0 && payload.distance >= 0.0) first = payload.distance;
  }
  glass_radiance[pixel] = float4(Contain(sum), first);
  glass_transmittance[pixel] = float4(through, float(layers));
}

// The nearest layer alone, for glass that is drawn.
[shader("raygeneration")]
void GlassReflectionRayGen() {
  const uint2 pixel = FramePixel();
  GlassPayload payload = NewPayload(kMirrorOfLayerRay, 0.0);
  TraceRay(scene, RAY_FLAG_NONE, kMaskGlass, kRayTypeSurface, kRayTypeCount, kRayTypeSurface,
           GlassRay(pixel), payload);
  first_mirrored[pixel] = float4(payload.radiance, max(payload.distance, 0.0));
}

// Puts the glass in front of what the pixel holds.
[shader("compute")]
[numthreads(8, 8, 1)]
void TransparentCompose(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  const float4 behind = radiance[id.xy];
  radiance[id.xy] = float4(behind.rgb * glass_transmittance[id.xy].rgb + glass_radiance[id.xy].rgb,
                           behind.a);
}
