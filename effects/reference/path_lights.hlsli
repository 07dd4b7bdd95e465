// SPDX-License-Identifier: MIT
// Every light of the scene as something to sample and as something that a ray meets, with the same
// density for both: the sun's disk, spheres of lamps, emissive triangles, the sky. The equations
// are in README.md. Written apart from effects/shaders/lights.hlsli.
#ifndef KAAMOS_PATH_LIGHTS_HLSLI
#define KAAMOS_PATH_LIGHTS_HLSLI

#include "path_material.hlsli"
#include "surface.hlsli"

// An emissive triangle. path_emitters.h has the same layout.
struct PathEmitter {
  float3 corner;  // relative to the camera
  uint material;
  float3 edge1;
  float keep;     // alias method: chance to keep this triangle
  float3 edge2;
  uint other;     // else this one
  float2 uv0;
  float2 uv1;
  float2 uv2;
  uint2 alphas;  // opacity of the corners, 16 bits each; all ones where vertices have no colours
};

StructuredBuffer<float2> specular_albedo : register(t0, space3);
StructuredBuffer<PathEmitter> emitters : register(t1, space3);
// Chance of a point on an emitter of a material, per square metre.
StructuredBuffer<float> emitter_densities : register(t2, space3);
// 1: the instance's emissive triangles are among `emitters`.
StructuredBuffer<uint> emitting_instances : register(t3, space3);
// Chance that a sampled direction to the sky has a y of at most -1 + 2 i / kSkyBands.
StructuredBuffer<float> sky_bands : register(t4, space3);

static const uint kSkyBands = 128;

// A direction in which a light shines on a point.
struct LightRay {
  float3 direction;
  float reach;      // metres that must be free
  float3 value;     // radiance over density; of a light without an extent, irradiance facing it
  float density;    // 1/sr; 0: the light has no extent, and no ray meets it
};

LightRay NoLightRay() {
  LightRay none;
  none.direction = float3(0, 1, 0);
  none.reach = 0.0f;
  none.value = float3(0, 0, 0);
  none.density = 0.0f;
  return none;
}

// 1 - cosine of the half angle with that sine squared, without cancellation.
float CapHeight(float sine_squared) {
  return sine_squared / (1.0f + sqrt(saturate(1.0f - sine_squared)));
}

// A direction in the cone about `axis` whose cap has that height, uniformly over its solid angle.
float3 SampleCone(float2 u, float3 axis, float height) {
  const float down = u.x * height;
  const float r = sqrt(saturate(down * (2.0f - down)));
  const float phi = 2.0f * kPathPi * u.y;
  return OutOfAxes(MakePathAxes(axis), float3(r * cos(phi), r * sin(phi), 1.0f - down));
}

float ConeDensity(float height) { return 1.0f / (2.0f * kPathPi * height); }

// The sun: a disk of even radiance, irradiance / (pi sin^2 r).
float SunSineSquared() {
  const float t = frame.tan_sun_radius * frame.tan_sun_radius;
  return t / (1.0f + t);
}

LightRay SampleSunDisk(float2 u) {
  LightRay ray = NoLightRay();
  const float sine_squared = SunSineSquared();
  ray.direction = frame.direction_to_sun;
  ray.reach = kLongestRay;
  ray.value = frame.sun_irradiance;
  if (sine_squared > 0.0f) {
    const float height = CapHeight(sine_squared);
    ray.direction = SampleCone(u, frame.direction_to_sun, height);
    ray.density = ConeDensity(height);
    ray.value = frame.sun_irradiance / (kPathPi * sine_squared * ray.density);
  }
  return ray;
}

// Returns the radiance of each colour that a sampled ray that leaves the scene sees of the sun.
// `density`: of SampleSunDisk.
float3 SunTowards(float3 direction, out float density) {
  const float sine_squared = SunSineSquared();
  density = 0.0f;
  if (!(sine_squared > 0.0f)) return float3(0, 0, 0);
  const float3 beside = cross(direction, frame.direction_to_sun);
  if (dot(direction, frame.direction_to_sun) <= 0.0f || dot(beside, beside) > sine_squared) {
    return float3(0, 0, 0);
  }
  density = ConeDensity(CapHeight(sine_squared));
  return frame.sun_irradiance / (kPathPi * sine_squared);
}

// A lamp as a point sees it.
struct SeenLamp {
  float3 axis;         // to its centre, unit
  float distance;      // to its centre
  float3 irradiance;   // on a surface that faces its centre
  float sine_squared;  // of its half angle; 0: it has no extent from here
};

SeenLamp SeeLamp(LightConstants lamp, float3 position) {
  SeenLamp seen;
  const float3 to_centre = lamp.position - position;
  seen.distance = length(to_centre);
  seen.axis = seen.distance > 0.0f ? to_centre / seen.distance : -lamp.direction;
  const float part = seen.distance / lamp.range;
  const float window = saturate(1.0f - part * part * part * part);
  float cone = 1.0f;
  if (lamp.is_spot != 0) {
    cone = saturate(-dot(seen.axis, lamp.direction) * lamp.spot_scale + lamp.spot_offset);
  }
  float3 slide = float3(1, 1, 1);
  if (lamp.projection >= 0) {
    // The slide at distance 1 along the spot's axis.
    const float depth = max(-dot(seen.axis, lamp.direction), 1e-6f);
    const float2 place = float2(-dot(seen.axis, lamp.map_right), dot(seen.axis, lamp.map_up));
    slide = textures[NonUniformResourceIndex(lamp.projection)].SampleLevel(
        samplers[NonUniformResourceIndex(lamp.projection_sampler)],
        (place / depth + 1.0f) * 0.5f, 0.0f).rgb;
  }
  const float nearest = max(seen.distance, max(lamp.radius, 1.0f / lamp.over_least_distance));
  seen.irradiance = slide * lamp.intensity * ((window * window) * (cone * cone) / (nearest * nearest));
  const float sine = seen.distance > lamp.radius ? lamp.radius / seen.distance : 0.0f;
  seen.sine_squared = sine * sine;
  return seen;
}

LightRay SampleLamp(float2 u, LightConstants lamp, SeenLamp seen) {
  LightRay ray = NoLightRay();
  ray.direction = seen.axis;
  ray.reach = seen.distance - lamp.radius;
  ray.value = seen.irradiance;
  if (seen.sine_squared > 0.0f) {
    const float height = CapHeight(seen.sine_squared);
    ray.direction = SampleCone(u, seen.axis, height);
    ray.density = ConeDensity(height);
    ray.value = seen.irradiance / (kPathPi * seen.sine_squared * ray.density);
    // To the near side of the sphere.
    const float along = dot(ray.direction, seen.axis) * seen.distance;
    const float3 beside = cross(ray.direction, seen.axis) * seen.distance;
    ray.reach = along - sqrt(max(lamp.radius * lamp.radius - dot(beside, beside), 0.0f));
  }
  return ray;
}

// Radiance of a lamp that a ray of that length meets; its density in SampleLamp.
float3 LampTowards(LightConstants lamp, float3 position, float3 direction, float length,
                   out float density) {
  density = 0.0f;
  const SeenLamp seen = SeeLamp(lamp, position);
  if (!(seen.sine_squared > 0.0f)) return float3(0, 0, 0);
  const float3 beside = cross(direction, seen.axis);
  const float along = dot(direction, seen.axis);
  if (along <= 0.0f || dot(beside, beside) > seen.sine_squared) return float3(0, 0, 0);
  const float inside = max(seen.sine_squared - dot(beside, beside), 0.0f);
  if ((along - sqrt(inside)) * seen.distance > length) return float3(0, 0, 0);
  density = ConeDensity(CapHeight(seen.sine_squared));
  return seen.irradiance / (kPathPi * seen.sine_squared);
}

// Returns how likely a lamp is chosen at a point, relative to the others: its irradiance there,
// with the largest cosine that a point of its sphere can have.
float LampWeight(SeenLamp seen, float3 normal) {
  return Brightness(seen.irradiance) * max(dot(normal, seen.axis) + sqrt(seen.sine_squared), 0.0f);
}

// Emission of a material at a point; 0 in its holes. `vertex_alpha`: opacity of the vertices there.
float3 EmissionAt(MaterialConstants material, float2 uv, float vertex_alpha) {
  const float alpha = vertex_alpha * SampleMaterial(material, kBaseColorTexture, uv, kFinestLevel).a;
  if (IsOpen(material, alpha)) return float3(0, 0, 0);
  return Contain(material.emissive * SampleMaterial(material, kEmissiveTexture, uv, kFinestLevel).rgb,
                 kLargestRadiance);
}

// The part of a ray to an emitter that must be free: the rest is for rounding at its end.
static const float kEmitterReach = 0.9998f;

LightRay SampleEmitter(float2 u, float choice, uint emitter_count, float3 position) {
  LightRay ray = NoLightRay();
  const float scaled = choice * float(emitter_count);
  uint chosen = min(uint(scaled), emitter_count - 1);
  if (scaled - float(chosen) >= emitters[chosen].keep) chosen = emitters[chosen].other;
  const PathEmitter emitter = emitters[chosen];
  const float root = sqrt(u.x);
  const float2 place = float2(root * (1.0f - u.y), root * u.y);  // weights of corners 1 and 2
  const float3 to_point = emitter.corner + emitter.edge1 * place.x + emitter.edge2 * place.y - position;
  const float distance_squared = dot(to_point, to_point);
  if (!(distance_squared > 0.0f)) return ray;
  const float distance = sqrt(distance_squared);
  ray.direction = to_point / distance;
  ray.reach = distance * kEmitterReach;
  const float cosine = abs(dot(normalize(cross(emitter.edge1, emitter.edge2)), ray.direction));
  if (!(cosine > 1e-6f)) return ray;
  ray.density = emitter_densities[emitter.material] * distance_squared / cosine;
  const float2 uv = emitter.uv0 * (1.0f - place.x - place.y) + emitter.uv1 * place.x +
                    emitter.uv2 * place.y;
  float alpha = 1.0f;
  if (any(emitter.alphas != uint2(0xFFFFFFFFu, 0xFFFFFFFFu))) {
    const float3 alphas = float3(float(emitter.alphas.x & 0xFFFFu), float(emitter.alphas.x >> 16u),
                                 float(emitter.alphas.y & 0xFFFFu)) / 65535.0f;
    alpha = alphas.x * (1.0f - place.x - place.y) + alphas.y * place.x + alphas.z * place.y;
  }
  ray.value = EmissionAt(materials[emitter.material], uv, alpha) / ray.density;
  return ray;
}

// The sky: y in a band, uniform within it.
LightRay SampleSky(float2 u) {
  uint low = 0;
  uint high = kSkyBands;
  while (high - low > 1) {
    const uint middle = (low + high) / 2;
    if (sky_bands[middle] <= u.x) {
      low = middle;
    } else {
      high = middle;
    }
  }
  const float chance = sky_bands[low + 1] - sky_bands[low];
  const float y = -1.0f + (float(low) + (u.x - sky_bands[low]) / chance) * (2.0f / float(kSkyBands));
  const float r = sqrt(saturate(1.0f - y * y));
  const float phi = 2.0f * kPathPi * u.y;
  LightRay ray = NoLightRay();
  ray.direction = float3(r * cos(phi), y, r * sin(phi));
  ray.reach = kLongestRay;
  ray.density = chance * float(kSkyBands) / (4.0f * kPathPi);
  ray.value = SkyTowards(ray.direction) / ray.density;
  return ray;
}

float SkyDensity(float3 direction) {
  const uint band = min(uint(max((direction.y + 1.0f) * (0.5f * float(kSkyBands)), 0.0f)), kSkyBands - 1);
  return (sky_bands[band + 1] - sky_bands[band]) * float(kSkyBands) / (4.0f * kPathPi);
}

// Share of an estimate by one of two ways to sample the same direction. [Veach 1997: balance
// heuristic]
float ShareOf(float density, float other) { return density / (density + other); }

#endif
