// SPDX-License-Identifier: MIT
// The reference: paths from the camera, next-event estimation of every light, multiple importance
// sampling, Russian roulette. README.md has the equations; every light and lobe that the frame
// treats on its own is a layer here.
#include "path_glass.hlsli"
#include "path_hit.hlsli"
#include "path_lights.hlsli"
#include "path_sampler.hlsli"

// Sums over samples.
RWTexture2D<float4> path_radiance : register(u0, space3);    // all of it, glass included
RWTexture2D<float4> path_emission : register(u1, space3);    // of what the camera sees, or the sky
RWTexture2D<float4> path_sun : register(u2, space3);         // both lobes
RWTexture2D<float4> path_lamps : register(u3, space3);       // both lobes
RWTexture2D<float4> path_indirect : register(u4, space3);    // diffuse lobe, all other light
RWTexture2D<float4> path_first : register(u5, space3);       // the part of it with one bounce
RWTexture2D<float4> path_reflection : register(u6, space3);  // specular lobe, all other light
RWTexture2D<float4> path_glass : register(u7, space3);       // of glass in front; a: transmittance
RWTexture2D<float4> path_visibility : register(u8, space3);  // ambient, sun
// The part of even light that each lobe of the surface in view reflects; black where the sky is
// seen.
RWTexture2D<float4> path_diffuse_albedo : register(u9, space3);
RWTexture2D<float4> path_specular_albedo : register(u10, space3);
// What glass lets through of the sun, by colour.
RWTexture2D<float4> path_sun_tint : register(u11, space3);
// Radiance of each lamp and its visibility, picture by picture. Empty with more than
// constants.lamps_apart lamps.
RWStructuredBuffer<float4> path_each_lamp : register(u12, space3);

struct PathConstants {
  uint seed;
  uint bounces;       // after the surface that the camera sees; 0xFFFFFFFF: no limit
  uint emitters;      // emissive triangles
  uint has_sun;
  uint has_sky;
  uint has_glass;
  uint lamps_apart;   // up to so many lamps are all sampled where the camera looks
  float occlusion_radius;  // of ambient visibility, metres
  uint ways;          // PathWays in path_tracer.h
  float glass_tint;   // of light that passes panes; negative: glass casts no shadows
};
ConstantBuffer<PathConstants> constants : register(b0, space3);

// Bounces before Russian roulette may end a path.
static const uint kSafeBounces = 3;
static const float kSurest = 0.95;

static const uint kLightsOnly = 1;
static const uint kDirectionsOnly = 2;

// Weight of a sampled light whose direction the surface would sample with density `other`.
float LightShare(float density, float other) {
  if (density == 0.0) return 1.0;
  if (constants.ways == kLightsOnly) return 1.0;
  return constants.ways == kDirectionsOnly ? 0.0 : ShareOf(density, other);
}

// Weight of light met in a sampled direction that sampling lights would find with density `other`.
float DirectionShare(float density, float other) {
  if (constants.ways == kDirectionsOnly) return 1.0;
  if (constants.ways == kLightsOnly) return other > 0.0 ? 0.0 : 1.0;
  return ShareOf(density, other);
}

// The light that a path brings to the camera.
struct PathLight {
  float3 all;
  float3 sun;
  float3 lamps;
  float3 indirect;
  float3 first;
  float3 reflection;
};

PathLight NoLight() {
  PathLight light;
  light.all = light.sun = light.lamps = light.indirect = light.first = light.reflection =
      float3(0, 0, 0);
  return light;
}

// A surface of the path.
struct Vertex {
  PathBsdf bsdf;
  float3 position;
  float3 normal;  // of the triangle, towards where the path came from
  float offset;
};

Vertex MakeVertex(PathHit hit, float3 view) {
  Vertex vertex;
  vertex.bsdf = MakePathBsdf(specular_albedo, hit.base_color, hit.metallic, hit.roughness,
                             hit.dielectric_f0, hit.dielectric_f90, hit.shading_normal, view);
  vertex.position = hit.position;
  vertex.normal = hit.normal;
  vertex.offset = hit.offset;
  return vertex;
}

float3 OriginAbove(Vertex vertex) { return vertex.position + vertex.normal * vertex.offset; }

// What panes let through of light on its way to a surface.
float3 LightThrough(float3 origin, float3 direction, float reach) {
  if (constants.has_glass == 0 || !(constants.glass_tint >= 0.0)) return float3(1, 1, 1);
  return ThroughPanes(origin, direction, reach, constants.glass_tint);
}

// Light of one sampled direction, reflected by both lobes. `is_free`: whether the light is visible.
Lobes Reflected(Vertex vertex, LightRay light, out bool is_free) {
  is_free = false;
  if (!(dot(light.direction, vertex.normal) > 0.0)) return NoLobes();
  const PathValue value = PathEvaluate(vertex.bsdf, light.direction);
  if (!any(SumOf(value.lobes) * light.value > 0.0)) return NoLobes();
  is_free = !(light.reach > 0.0) || IsFree(OriginAbove(vertex), light.direction, light.reach);
  if (!is_free) return NoLobes();
  const float3 through = light.reach > 0.0
                             ? LightThrough(OriginAbove(vertex), light.direction, light.reach)
                             : float3(1, 1, 1);
  return Scaled(value.lobes, light.value * through * LightShare(light.density, value.density));
}

// Sum of LampWeight over all lamps.
float LampWeights(Vertex vertex) {
  float sum = 0.0;
  for (uint i = 0; i < frame.light_count; ++i) {
    sum += LampWeight(SeeLamp(lights[i], vertex.position), vertex.normal);
  }
  return sum;
}

// One lamp, chosen by its weight. `total`: LampWeights.
LightRay SampleOneLamp(Vertex vertex, float total, float choice, float2 u) {
  float before = 0.0;
  uint chosen = frame.light_count;
  float weight = 0.0;
  for (uint i = 0; i < frame.light_count && chosen == frame.light_count; ++i) {
    weight = LampWeight(SeeLamp(lights[i], vertex.position), vertex.normal);
    before += weight;
    if (weight > 0.0 && choice * total < before) chosen = i;
  }
  if (chosen == frame.light_count) return NoLightRay();
  LightRay light = SampleLamp(u, lights[chosen], SeeLamp(lights[chosen], vertex.position));
  const float chance = weight / total;
  light.density *= chance;
  light.value /= chance;
  return light;
}

bool HasEachLamp() { return frame.light_count <= constants.lamps_apart; }

// The next segment of a path, and what it needs to know about the vertex that it left.
struct Segment {
  float3 direction;
  float density;      // of the direction; 0: a mirror's
  uint vertex_number;
  float lamp_weights;  // LampWeights of that vertex
  float3 position;
  float3 normal;
};

// Light of the lamps that a segment meets before it ends.
float3 LampsAlong(Segment segment, float length) {
  float3 sum = float3(0, 0, 0);
  const bool is_each = segment.vertex_number == 0 && HasEachLamp();
  for (uint i = 0; i < frame.light_count; ++i) {
    float density;
    const float3 radiance =
        LampTowards(lights[i], segment.position, segment.direction, length, density);
    if (!(density > 0.0)) continue;
    float chance = 1.0;
    if (!is_each) {
      const SeenLamp seen = SeeLamp(lights[i], segment.position);
      const float weight = LampWeight(seen, segment.normal);
      chance = weight > 0.0 ? weight / segment.lamp_weights : 0.0;
    }
    sum += radiance * DirectionShare(segment.density, density * chance);
  }
  return sum;
}

// The light that a segment finds at its end, weighted against what sampling lights finds there.
// Lights that are no surfaces, the sun and lamps, are apart: no mirror and no camera sees them.
struct Found {
  float3 sky_or_emission;
  float3 sun;
  float3 lamps;
};

Found FindLight(Segment segment, PathHit hit) {
  Found found;
  found.sun = found.lamps = float3(0, 0, 0);
  const bool is_mirrored = segment.density == 0.0;
  const bool is_miss = hit.distance < 0.0;
  float other = 0.0;
  if (is_miss) {
    found.sky_or_emission = SkyTowards(segment.direction);
    if (constants.has_sky != 0) other = SkyDensity(segment.direction);
  } else {
    found.sky_or_emission = hit.emissive;
    const float cosine = abs(dot(hit.normal, segment.direction));
    if (hit.emitter_density > 0.0 && cosine > 1e-6) {
      other = hit.emitter_density * hit.distance * hit.distance / cosine;
    }
  }
  if (is_mirrored) return found;
  found.sky_or_emission *= DirectionShare(segment.density, other);
  if (is_miss && constants.has_sun != 0) {
    float density;
    const float3 radiance = SunTowards(segment.direction, density);
    if (density > 0.0) found.sun = radiance * DirectionShare(segment.density, density);
  }
  if (frame.light_count > 0) {
    found.lamps = LampsAlong(segment, is_miss ? kLongestRay : hit.distance);
  }
  return found;
}

// Kinds of light that a vertex samples one after the other.
static const uint kSunSample = 0;
static const uint kEmitterSample = 1;
static const uint kSkySample = 2;
static const uint kLampSample = 3;  // and on: each lamp, or a chosen one

uint CountLightSamples(uint vertex_number) {
  if (frame.light_count == 0) return kLampSample;
  return kLampSample + (vertex_number == 0 && HasEachLamp() ? frame.light_count : 1);
}

// `lamp_weights`: LampWeights of the vertex.
LightRay SampleLight(PathSampler sampler, Vertex vertex, uint number, float lamp_weights,
                     uint kind) {
  if (kind == kSunSample) {
    if (constants.has_sun == 0) return NoLightRay();
    return SampleSunDisk(PathRandom(sampler, number, kPairSun));
  }
  if (kind == kEmitterSample) {
    if (constants.emitters == 0) return NoLightRay();
    return SampleEmitter(PathRandom(sampler, number, kPairEmitter),
                         PathRandom(sampler, number, kPairChoice).y, constants.emitters,
                         vertex.position);
  }
  if (kind == kSkySample) {
    if (constants.has_sky == 0) return NoLightRay();
    return SampleSky(PathRandom(sampler, number, kPairSky));
  }
  if (number == 0 && HasEachLamp()) {
    const uint lamp = kind - kLampSample;
    return SampleLamp(PathRandom(sampler, kPairEachLamp + lamp), lights[lamp],
                      SeeLamp(lights[lamp], vertex.position));
  }
  if (!(lamp_weights > 0.0)) return NoLightRay();
  return SampleOneLamp(vertex, lamp_weights, PathRandom(sampler, number, kPairChoice).x,
                       PathRandom(sampler, number, kPairLamp));
}

// Adds what the camera sees of a sampled light on the first surface to its layer.
void AddInView(inout PathLight light, uint kind, Lobes lobes, bool is_free, uint seen_as,
               uint2 pixel) {
  if (kind == kSunSample) {
    light.sun += SumOf(lobes);
  } else if (kind == kEmitterSample || kind == kSkySample) {
    light.indirect += lobes.diffuse;
    if (seen_as != kAsPane) light.reflection += lobes.specular;
  } else {
    light.lamps += SumOf(lobes);
    if (seen_as != kAsSolid || !HasEachLamp()) return;
    uint width, height;
    path_radiance.GetDimensions(width, height);
    path_each_lamp[((kind - kLampSample) * height + pixel.y) * width + pixel.x] +=
        float4(SumOf(lobes), is_free ? 1.0 : 0.0);
  }
}

// Light that reaches the camera from a surface that it sees.
PathLight LightFrom(PathSampler sampler, PathHit first, float3 view, uint seen_as, uint2 pixel) {
  PathLight light = NoLight();
  if (first.is_unlit != 0) return light;
  Vertex vertex = MakeVertex(first, view);
  const bool is_pane = seen_as == kAsPane;
  if (is_pane) vertex.bsdf.specular_chance = 0.0;
  Segment segment;
  segment.vertex_number = 0;
  Lobes lobes = NoLobes();              // of the first surface
  float3 throughput = float3(1, 1, 1);  // of the bounces behind it
  bool goes_on = true;
  while (goes_on) {
    const uint number = segment.vertex_number;
    segment.lamp_weights = LampWeights(vertex);
    const uint samples = CountLightSamples(number);
    float3 reflected = float3(0, 0, 0);
    for (uint kind = 0; kind < samples; ++kind) {
      const LightRay ray = SampleLight(sampler, vertex, number, segment.lamp_weights, kind);
      bool is_free;
      const Lobes found = Reflected(vertex, ray, is_free);
      if (number == 0) {
        AddInView(light, kind, found, is_free, seen_as, pixel);
      } else {
        reflected += SumOf(found);
      }
    }
    reflected *= throughput;
    light.indirect += lobes.diffuse * reflected;
    light.reflection += lobes.specular * reflected;
    if (number == 1) light.first += lobes.diffuse * reflected;
    if (is_pane && number == 0 && !any(vertex.bsdf.albedo.diffuse > 0.0)) break;

    const float2 choice = PathRandom(sampler, number, kPairLobe);
    const PathDirection next =
        PathSampleDirection(vertex.bsdf, PathRandom(sampler, number, kPairDirection), choice.x);
    if (!next.is_valid || !(dot(next.direction, vertex.normal) > 0.0)) break;
    if (number == 0) {
      lobes = next.weight;
      if (is_pane) lobes.specular = float3(0, 0, 0);
    } else {
      throughput *= SumOf(next.weight);
    }
    const float3 carried = throughput * SumOf(lobes);
    const float strongest = max(carried.x, max(carried.y, carried.z));
    if (!(strongest > 0.0)) break;
    if (number >= kSafeBounces) {
      const float chance = min(strongest, kSurest);
      if (choice.y >= chance) break;
      throughput /= chance;
    }
    segment.direction = next.direction;
    segment.density = next.density;
    segment.position = vertex.position;
    segment.normal = vertex.normal;
    // A mirror shows the shapes of lamps, as the camera does; all else meets their light.
    const uint mask = next.density == 0.0 ? kMaskSolid : kMaskWithoutLamps;
    const PathHit hit = Follow(OriginAbove(vertex), segment.direction, 0.0, mask, false);
    const float3 through = LightThrough(OriginAbove(vertex), segment.direction,
                                        hit.distance < 0.0 ? kLongestRay : hit.distance);
    Found found = FindLight(segment, hit);
    found.sky_or_emission *= through;
    found.sun *= through;
    found.lamps *= through;
    float3 gathered = throughput * found.sky_or_emission;
    if (number == 0) {
      light.sun += SumOf(lobes) * found.sun;
      light.lamps += SumOf(lobes) * found.lamps;
    } else {
      gathered += throughput * (found.sun + found.lamps);
    }
    light.indirect += lobes.diffuse * gathered;
    light.reflection += lobes.specular * gathered;
    if (number == 1) light.first += lobes.diffuse * gathered;
    throughput *= through;
    goes_on = hit.distance >= 0.0 && hit.is_unlit == 0 && number < constants.bounces;
    if (goes_on) vertex = MakeVertex(hit, -segment.direction);
    segment.vertex_number = number + 1;
  }
  light.all = light.sun + light.lamps + light.indirect + light.reflection;
  return light;
}

// Tells whether a direction about the shading normal is free up to the radius of ambient occlusion.
float AmbientVisibility(PathSampler sampler, PathHit hit) {
  if (!(constants.occlusion_radius > 0.0)) return 1.0;
  const float2 u = PathRandom(sampler, kPairOcclusion);
  const float r = sqrt(u.x);
  const float phi = 2.0 * kPathPi * u.y;
  const float3 direction = OutOfAxes(MakePathAxes(hit.shading_normal),
                                     float3(r * cos(phi), r * sin(phi), sqrt(saturate(1.0 - u.x))));
  if (!(dot(direction, hit.normal) > 0.0)) return 0.0;
  return IsFree(hit.position + hit.normal * hit.offset, direction, constants.occlusion_radius)
             ? 1.0 : 0.0;
}

// Tells whether a point of the sun's disk is visible from the triangle, whatever its material and
// shading normal make of the light. It is the point that the path's light sample has.
float SunVisibility(PathSampler sampler, PathHit hit) {
  if (constants.has_sun == 0) return 0.0;
  const LightRay ray = SampleSunDisk(PathRandom(sampler, 0, kPairSun));
  if (!(dot(ray.direction, hit.normal) > 0.0)) return 0.0;
  return IsFree(hit.position + hit.normal * hit.offset, ray.direction, ray.reach) ? 1.0 : 0.0;
}

// What glass lets through of the same point of the sun; all of it where the triangle faces away.
float3 SunTint(PathSampler sampler, PathHit hit) {
  if (constants.has_sun == 0) return float3(1, 1, 1);
  const LightRay ray = SampleSunDisk(PathRandom(sampler, 0, kPairSun));
  if (!(dot(ray.direction, hit.normal) > 0.0)) return float3(1, 1, 1);
  return LightThrough(hit.position + hit.normal * hit.offset, ray.direction, ray.reach);
}

void ClearEachLamp(uint2 pixel) {
  if (!HasEachLamp()) return;
  uint width, height;
  path_radiance.GetDimensions(width, height);
  for (uint i = 0; i < frame.light_count; ++i) {
    path_each_lamp[(i * height + pixel.y) * width + pixel.x] = float4(0, 0, 0, 0);
  }
}

[shader("raygeneration")]
void PathTracerRayGen() {
  const uint2 pixel = FramePixel();
  uint width, height;
  path_radiance.GetDimensions(width, height);
  // Through the pixel's centre, as the frame's G-buffer.
  const float2 ndc = (float2(pixel) + 0.5 + frame.jitter) / float2(width, height) * 2.0 - 1.0;
  const CameraRay ray = RayThrough(ndc);
  const float3 direction = ray.direction;
  const float3 view = -normalize(direction);
  const PathHit first = Follow(ray.origin, direction, 0.0, kMaskSolid, true);
  const float3 emission = first.distance < 0.0 ? SkyTowards(-view) : first.emissive;
  ClearEachLamp(pixel);

  PathLight sum = NoLight();
  float3 whole = float3(0, 0, 0);
  float2 visible = float2(0, 0);
  float3 sun_tint = float3(0, 0, 0);
  float4 glass = float4(0, 0, 0, 0);
  PathSampler sampler;
  sampler.seed = HashCombine(HashCombine(constants.seed, pixel.x), pixel.y);
  for (uint i = 0; i < pass_constants.sample_count; ++i) {
    sampler.index = pass_constants.first_sample + i;
    float3 through = float3(1, 1, 1);
    float3 of_glass = float3(0, 0, 0);
    PathLight light = NoLight();
    // First the solid surface, whatever glass is in front of it, then the glass.
    const uint parts = constants.has_glass != 0 ? 2 : 1;
    for (uint part = 0; part < parts; ++part) {
      GlassStart start;
      PathSampler part_sampler = sampler;
      start.hit = first;
      start.view = view;
      start.seen_as = kAsSolid;
      if (part == 1) {
        start = WalkThroughGlass(sampler, ray, first.distance);
        through = start.through;
        part_sampler.seed = HashCombine(sampler.seed, kPairPane + kMaxPanes + start.layer);
      }
      PathLight found = NoLight();
      if (start.hit.distance >= 0.0) {
        found = LightFrom(part_sampler, start.hit, start.view, start.seen_as, pixel);
      }
      if (part == 0) {
        light = found;
      } else {
        of_glass = start.weight * (start.emission + found.all);
      }
    }
    float2 visibility = float2(1, 1);
    float3 tint = float3(1, 1, 1);
    if (first.distance >= 0.0) {
      tint = SunTint(sampler, first);
      visibility = float2(AmbientVisibility(sampler, first), SunVisibility(sampler, first));
    }
    sum.sun += light.sun;
    sum.lamps += light.lamps;
    sum.indirect += light.indirect;
    sum.first += light.first;
    sum.reflection += light.reflection;
    visible += visibility;
    sun_tint += tint;
    glass += float4(of_glass, Brightness(through));
    whole += (emission + light.all) * through + of_glass;
  }
  const float count = float(pass_constants.sample_count);
  path_radiance[pixel] = float4(whole, count);
  path_emission[pixel] = float4(emission * count, count);
  path_sun[pixel] = float4(sum.sun, count);
  path_lamps[pixel] = float4(sum.lamps, count);
  path_indirect[pixel] = float4(sum.indirect, count);
  path_first[pixel] = float4(sum.first, count);
  path_reflection[pixel] = float4(sum.reflection, count);
  path_glass[pixel] = glass;
  path_visibility[pixel] = float4(visible, 0, 0);
  path_sun_tint[pixel] = float4(sun_tint, count);
  Lobes albedo = NoLobes();
  if (first.distance >= 0.0) albedo = MakeVertex(first, view).bsdf.albedo;
  path_diffuse_albedo[pixel] = float4(albedo.diffuse * count, count);
  path_specular_albedo[pixel] = float4(albedo.specular * count, count);
}
