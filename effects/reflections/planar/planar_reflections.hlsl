// SPDX-License-Identifier: MIT
// Planar reflections: the scene mirrored at a plane, seen from the camera, once for each plane; and
// the pixels of the plane look it up: a mirror at its own place, a rough surface about where the
// directions of its lobe meet what is mirrored. [survey 6.1]
#include "../../surfaces/gbuffer/camera_hit.hlsli"
#include "../environment_map/environment_map.hlsli"
#include "../traced/reflection_shading.hlsli"

// As those of effects/reflections/traced, but no sum.
RWTexture2D<float4> reflection : register(u0, space3);
// The radiance that each plane mirrors and how far behind the plane it is, 0: the plane is not seen
// there. As many pictures side by side as there are planes.
RWTexture2D<float4> mirrored : register(u1, space3);
// Their mips from half their size on, likewise: those of a plane stand side by side.
RWTexture2D<float4> mips : register(u2, space3);
struct MirrorPlane {
  float4 plane;  // normal towards the camera, and the distance from the camera along it (negative)
  uint mask;     // of instances that it mirrors: mirrors show the shapes of lamps
  uint3 padding;
};
StructuredBuffer<MirrorPlane> planes : register(t4, space3);
// What draws need: see surfaces/gbuffer/draws.hlsli.
StructuredBuffer<SceneDraw> draws : register(t7, space3);
StructuredBuffer<HitConstants> geometries : register(t8, space3);
Texture2D<uint2> visibility : register(t9, space3);
ByteAddressBuffer geometry_buffers[] : register(t0, space4);

struct PlanarConstants {
  float longest;      // metres behind the plane that are seen
  uint sun_at_hits;   // 1: by a shadow ray
  uint by_draws;      // 1: planes' pictures are drawn, 0: traced
  uint fallback;      // of other surfaces: kFallbackNone, kFallbackEnvironment
  float roughest;     // surfaces beyond show the environment map
  uint most_planes;   // the host's
  uint taps;          // directions of a rough surface
  uint plane_count;
  uint plane;         // that is rendered
  uint width;         // of a plane's picture
  uint height;
  uint level;         // of its mips, that is made
  uint draw;          // in `draws`
  float clip_scale;   // of ToClip
};
ConstantBuffer<PlanarConstants> constants : register(b0, space3);

static const uint kFallbackEnvironment = 2;
static const uint kLevels = 6;        // mips besides the full picture
static const uint kSteps = 2;         // in which a direction finds what is behind the plane
static const float kOnPlane = 1e-3;   // of the distance from the camera
static const float kAlong = 0.999;    // cosine between a surface's normal and its plane's
// Rays start this far off the plane, in its distance from the camera: what is nearer is cut off.
static const float kClip = 1e-5;
static const float kDrawClip = 1e-4;  // likewise, for draws
static const float kTouching = 1e-30;  // metres, of what is no farther behind the plane

uint SunAtHits() { return constants.sun_at_hits; }

float2 PictureSize() {
  uint2 size;
  g_view_z.GetDimensions(size.x, size.y);
  return float2(size);
}

// A ray of the camera that the plane mirrors.
struct MirroredRay {
  bool exists;        // false: the plane is not seen there
  float3 on_plane;
  float way;          // metres from the camera to the plane
  float3 seen_along;  // unit
  float3 direction;   // from the plane on, unit
};

MirroredRay RayOfPlane(float4 plane, float2 uv) {
  const CameraRay through = RayThrough(uv * 2.0 - 1.0);
  const float facing = dot(plane.xyz, through.direction);
  const float above = plane.w - dot(plane.xyz, through.origin);
  MirroredRay ray;
  ray.exists = facing < 0.0 && above < 0.0;
  const float part = ray.exists ? above / facing : 0.0;
  ray.on_plane = through.origin + through.direction * part;
  ray.way = part * length(through.direction);
  ray.seen_along = normalize(through.direction);
  ray.direction = reflect(ray.seen_along, plane.xyz);
  return ray;
}

MirroredRay RayOfTexel(uint2 texel) {
  const float2 size = float2(constants.width, constants.height);
  const float2 uv = (float2(texel) + 0.5) / size + frame.jitter / PictureSize();
  return RayOfPlane(planes[constants.plane].plane, uv);
}

uint2 TexelOfPlane(uint plane, uint2 texel) { return texel + uint2(plane * constants.width, 0); }

// A ray of the mirrored camera starts where it passes the plane, which clips all in front of it.
[shader("raygeneration")]
void PlanarRayGen() {
  const uint2 texel = DispatchRaysIndex().xy;
  const uint2 at = TexelOfPlane(constants.plane, texel);
  const MirroredRay through = RayOfTexel(texel);
  mirrored[at] = float4(0, 0, 0, 0);
  if (!through.exists) return;
  RayDesc ray;
  ray.Origin = through.on_plane + planes[constants.plane].plane.xyz * (kClip * length(through.on_plane));
  ray.TMin = 0.0;
  ray.Direction = through.direction;
  ray.TMax = Contain(constants.longest, kLongestRay);
  ReflectionPayload payload;
  payload.radiance = float3(0, 0, 0);
  payload.distance = -1.0;
  payload.volume_jitter = kEveryCell;
  TraceRay(scene, RAY_FLAG_NONE, planes[constants.plane].mask, kRayTypeSurface, kRayTypeCount,
           kRayTypeSurface, ray, payload);
  const float distance = payload.distance >= 0.0 ? payload.distance : ray.TMax;
  mirrored[at] = float4(payload.radiance, max(distance, kTouching));
}

struct PlanarCorner {
  float3 position : POSITION;  // object space
  float2 uv : TEXCOORD;
};

struct PlanarVertex {
  float4 position : SV_Position;
  float above : SV_ClipDistance0;
  float2 uv : TEXCOORD;
};

// The mirrored camera sees the scene as the camera sees the mirrored scene.
[shader("vertex")]
PlanarVertex MirroredVertex(PlanarCorner corner) {
  const float4 plane = planes[constants.plane].plane;
  const float3 world = mul(ObjectToWorld(draws[constants.draw]), float4(corner.position, 1.0));
  const float above = dot(plane.xyz, world) - plane.w;
  PlanarVertex result;
  result.position = ToClip(world - plane.xyz * (2.0 * above), constants.clip_scale, PictureSize());
  const bool is_seen = (draws[constants.draw].mask & planes[constants.plane].mask) != 0;
  result.above = is_seen ? above - kDrawClip * length(world) : -1.0;
  result.uv = corner.uv;
  return result;
}

struct PlanarHoleVertex {
  float4 position : SV_Position;
  float above : SV_ClipDistance0;
  float2 uv : TEXCOORD;
  float alpha : ALPHA;
};

[shader("vertex")]
PlanarHoleVertex MirroredVertexWithHoles(PlanarCorner corner, uint vertex : SV_VertexID) {
  const PlanarVertex place = MirroredVertex(corner);
  const uint geometry = draws[constants.draw].geometry;
  PlanarHoleVertex result;
  result.position = place.position;
  result.above = place.above;
  result.uv = HoleUv(geometry_buffers[2 * geometry], geometries[geometry], vertex, place.uv);
  result.alpha = VertexAlpha(geometry_buffers[2 * geometry], geometries[geometry], vertex);
  return result;
}

[shader("pixel")]
uint2 MirroredTriangle(uint primitive : SV_PrimitiveID) : SV_Target0 {
  return uint2(constants.draw + 1, primitive);
}

[shader("pixel")]
uint2 MirroredTriangleWithHoles(PlanarHoleVertex vertex, uint primitive : SV_PrimitiveID)
    : SV_Target0 {
  const HitConstants layout = geometries[draws[constants.draw].geometry];
  if (IsOpenAtUv(materials[layout.material_id], vertex.uv, vertex.alpha)) discard;
  return uint2(constants.draw + 1, primitive);
}

// The light of a triangle that a draw found, as a hit of the ray. w: its distance.
float4 DrawnRadiance(ByteAddressBuffer vertices_of, ByteAddressBuffer indices_of, SceneDraw draw,
                     uint primitive, MirroredRay ray) {
  CameraRay from_plane;
  from_plane.origin = ray.on_plane;
  from_plane.direction = ray.direction;
  const TriangleHit hit = CameraHit(vertices_of, indices_of, geometries[draw.geometry], draw,
                                    primitive, from_plane);
  const float distance =
      length(LoadHitPoint(vertices_of, indices_of, hit).spawn.position - ray.on_plane);
  const Surface surface = LoadSurface(vertices_of, indices_of, hit,
                                      ConeWidthAfter(length(ray.on_plane) + distance));
  return float4(ShadeHit(surface, -ray.direction, SunAtHits()) +
                    IndirectAtHit(surface, kEveryCell, -ray.direction),
                max(distance, kTouching));
}

// The light of what the draws of a plane left.
[shader("raygeneration")]
void ShadeDrawn() {
  const uint2 texel = DispatchRaysIndex().xy;
  const uint2 at = TexelOfPlane(constants.plane, texel);
  const MirroredRay ray = RayOfTexel(texel);
  mirrored[at] = float4(0, 0, 0, 0);
  if (!ray.exists) return;
  const float longest = Contain(constants.longest, kLongestRay);
  const uint2 seen = visibility[texel];
  float4 light = float4(0, 0, 0, 2.0 * longest);
  if (seen.x != 0) {
    const SceneDraw draw = draws[seen.x - 1];
    light = DrawnRadiance(geometry_buffers[NonUniformResourceIndex(2 * draw.geometry)],
                          geometry_buffers[NonUniformResourceIndex(2 * draw.geometry + 1)], draw,
                          seen.y, ray);
  }
  if (light.w > longest) {
    light = float4(VolumeRadiance(ray.on_plane + ray.direction * longest, kEveryCell,
                                  ray.direction), longest);
  }
  mirrored[at] = light;
}

uint2 LevelSize(uint level) {
  return max((uint2(constants.width, constants.height) + (1u << level) - 1) >> level, 1u);
}

// Where a level of a plane starts in `mips`; past the last level, where the next plane's begin.
uint LevelStart(uint level) {
  uint x = 0;
  for (uint i = 1; i < level; ++i) x += LevelSize(i).x;
  return x;
}

float4 LoadMirrored(uint plane, uint level, int2 texel) {
  const uint2 inside = uint2(clamp(texel, int2(0, 0), int2(LevelSize(level)) - 1));
  if (level == 0) return mirrored[TexelOfPlane(plane, inside)];
  return mips[inside + uint2(plane * LevelStart(kLevels + 1) + LevelStart(level), 0)];
}

// A tent over 4 x 4 texels of the level above.
[shader("compute")]
[numthreads(8, 8, 1)]
void BlurMirrored(uint3 id : SV_DispatchThreadID) {
  if (any(id.xy >= LevelSize(constants.level))) return;
  float4 sum = float4(0, 0, 0, 0);
  float weights = 0.0;
  for (int i = 0; i < 16; ++i) {
    const int2 offset = int2(i % 4, i / 4) - 1;
    const float weight = (offset.x == 0 || offset.x == 1 ? 3.0 : 1.0) *
                         (offset.y == 0 || offset.y == 1 ? 3.0 : 1.0);
    const float4 texel =
        LoadMirrored(constants.plane, constants.level - 1, 2 * int2(id.xy) + offset);
    if (!(texel.w > 0.0)) continue;
    sum += weight * texel;
    weights += weight;
  }
  const uint x = constants.plane * LevelStart(kLevels + 1) + LevelStart(constants.level);
  mips[id.xy + uint2(x, 0)] = weights > 0.0 ? sum / weights : float4(0, 0, 0, 0);
}

// Between texels that see the plane. w: 0: none does.
float4 MirroredAt(uint plane, uint level, float2 uv) {
  const float2 at = uv * float2(LevelSize(level)) - 0.5;
  const float2 corner = floor(at);
  const float2 part = at - corner;
  float4 sum = float4(0, 0, 0, 0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int2 offset = int2(i & 1, i >> 1);
    const float weight = (offset.x == 1 ? part.x : 1.0 - part.x) *
                         (offset.y == 1 ? part.y : 1.0 - part.y);
    const float4 texel = LoadMirrored(plane, level, int2(corner) + offset);
    if (!(texel.w > 0.0 && weight > 0.0)) continue;
    sum += weight * texel;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : float4(0, 0, 0, 0);
}

// What a direction from the plane meets, as wide as `spread` per metre. The picture has it from the
// camera's own directions alone: the distance of what it shows is taken for that of what is met,
// which is looked up where the camera sees it then. w: 0: it is not in the picture.
float4 FollowInMirrored(uint plane, float3 from, float3 direction, float distance, float spread) {
  const float3 normal = planes[plane].plane.xyz;
  const float3 behind = reflect(direction, normal);
  const float2 size = float2(constants.width, constants.height);
  float4 seen = float4(0, 0, 0, 0);
  for (uint i = 0; i < kSteps; ++i) {
    float view_z;
    const float2 uv = PictureUv(from + behind * distance, frame.camera_right, frame.over_right,
                                frame.camera_up, frame.over_up, frame.camera_forward, view_z);
    if (!(view_z > 0.0) || any(uv < 0.0) || any(uv > 1.0)) return float4(0, 0, 0, 0);
    const float texels = spread * distance * frame.over_up * size.y / GrowthAt(view_z);
    const uint level = uint(clamp(log2(max(texels, 1.0)) + 0.5, 0.0, float(kLevels)));
    seen = MirroredAt(plane, level, uv - frame.jitter / PictureSize());
    if (!(seen.w > 0.0)) break;
    const MirroredRay through = RayOfPlane(planes[plane].plane, uv);
    distance = length(through.on_plane + through.seen_along * seen.w - from);
  }
  return seen;
}

// A rough surface's light over ReflectionScale: as many directions as the lobe needs, spread evenly,
// each as wide as the others leave it.
float4 RoughReflection(uint plane, ReflectionPoint surface, float3 position, float2 uv) {
  const float4 own = MirroredAt(plane, 0, uv);
  float3 sum = float3(0, 0, 0);
  for (uint i = 0; i < constants.taps; ++i) {
    const float2 u = float2(frac(0.61803399 * float(i)), (float(i) + 0.5) / float(constants.taps));
    const float3 half_vector = SampleGgxHalfVector(u, surface.local_view, surface.brdf.alpha);
    const float3 local_light = reflect(-surface.local_view, half_vector);
    const float3 direction = ToWorld(local_light, surface.shading_normal);
    if (!(local_light.z > 0.0) || !(dot(direction, planes[plane].plane.xyz) > 0.0)) continue;
    const float spread =
        rsqrt(float(constants.taps) * kBrdfPi * max(GgxDirectionDensity(surface, local_light), 1e-20));
    const float4 seen = FollowInMirrored(plane, position, direction, own.w, min(spread, 1.0));
    float3 light = seen.rgb;
    if (!(seen.w > 0.0)) {
      // Out of the picture.
      light = constants.fallback == kFallbackEnvironment
                  ? EnvironmentRadiance(surface.origin, direction, 0.5 * surface.roughness)
                  : own.rgb;
    }
    sum += light * GgxSampleWeight(surface.brdf, surface.cosine_view, local_light.z,
                                   dot(surface.local_view, half_vector));
  }
  return float4(sum / (float(constants.taps) * ReflectionScaleAt(surface)), own.w);
}

// The plane that a surface lies in; plane_count: none.
uint PlaneOf(float3 position, float3 normal) {
  const float tolerance = kOnPlane * length(position);
  uint i = 0;
  for (; i < constants.plane_count; ++i) {
    const float4 plane = planes[i].plane;
    if (abs(dot(position, plane.xyz) - plane.w) <= tolerance && dot(normal, plane.xyz) > kAlong) break;
  }
  return i;
}

[shader("compute")]
[numthreads(8, 8, 1)]
void PlanarReflections(uint3 id : SV_DispatchThreadID) {
  const float2 picture = PictureSize();
  if (any(float2(id.xy) >= picture)) return;
  reflection[id.xy] = float4(0, 0, 0, 0);
  if (g_ids[id.xy].x == 0) return;
  const ReflectionPoint surface = LoadReflectionPoint(id.xy);
  const float3 position = g_position[id.xy].xyz;
  const uint plane = PlaneOf(position, surface.normal);
  if (plane == constants.plane_count || surface.roughness > constants.roughest) {
    if (constants.fallback != kFallbackEnvironment) return;
    const float3 direction = reflect(SeenAlong(position), surface.shading_normal);
    reflection[id.xy] =
        float4(EnvironmentRadiance(surface.origin, direction, surface.roughness), 0.0);
    return;
  }
  const float2 uv = (float2(id.xy) + 0.5) / picture;
  if (!IsMirror(surface.roughness)) {
    reflection[id.xy] = RoughReflection(plane, surface, position, uv);
    return;
  }
  const float4 seen = MirroredAt(plane, 0, uv);
  const float3 weight = GgxSampleWeight(surface.brdf, surface.cosine_view, surface.cosine_view,
                                        surface.cosine_view);
  reflection[id.xy] = float4(seen.rgb * weight / ReflectionScaleAt(surface), seen.w);
}
