// SPDX-License-Identifier: MIT
// The material model of the reference, from the equations in README.md: a diffuse lobe under a GGX
// lobe, layered by albedo. Written apart from effects/shaders/brdf.hlsli, so that each can be
// checked against the other.
#ifndef KAAMOS_PATH_MATERIAL_HLSLI
#define KAAMOS_PATH_MATERIAL_HLSLI

static const float kPathPi = 3.14159265f;
// Up to this roughness a surface is a mirror.
static const float kPathMirrorRoughness = 0.03f;

// Orthonormal axes whose third is `normal`.
struct PathAxes {
  float3 x;
  float3 y;
  float3 normal;
};

PathAxes MakePathAxes(float3 normal) {
  const float3 other = abs(normal.x) > 0.7f ? float3(0, 1, 0) : float3(1, 0, 0);
  PathAxes axes;
  axes.normal = normal;
  axes.y = normalize(cross(normal, other));
  axes.x = cross(axes.y, normal);
  return axes;
}

float3 IntoAxes(PathAxes axes, float3 v) {
  return float3(dot(v, axes.x), dot(v, axes.y), dot(v, axes.normal));
}

float3 OutOfAxes(PathAxes axes, float3 v) {
  return v.x * axes.x + v.y * axes.y + v.z * axes.normal;
}

// A value for each of the two lobes.
struct Lobes {
  float3 diffuse;
  float3 specular;
};

Lobes NoLobes() {
  Lobes none;
  none.diffuse = float3(0, 0, 0);
  none.specular = float3(0, 0, 0);
  return none;
}

Lobes Scaled(Lobes lobes, float3 factor) {
  Lobes out_lobes;
  out_lobes.diffuse = lobes.diffuse * factor;
  out_lobes.specular = lobes.specular * factor;
  return out_lobes;
}

float3 SumOf(Lobes lobes) { return lobes.diffuse + lobes.specular; }

// A surface seen from `view`.
struct PathBsdf {
  PathAxes axes;           // about the shading normal
  float3 view;             // towards where the path came from, in these axes
  Lobes albedo;            // directional: what each lobe reflects of even light
  float3 f0;               // reflectance at normal incidence
  float f90;               // and at grazing incidence
  float alpha;             // GGX
  bool is_mirror;          // the specular lobe is a single direction
  float specular_chance;   // of sampling the specular lobe
};

// 1 - cosine to the fifth. [Schlick 1994]
float GrazingPart(float cosine) {
  const float m = saturate(1.0f - cosine);
  return m * m * m * m * m;
}

float3 PathFresnel(float3 f0, float f90, float cosine) {
  return f0 + (f90 - f0) * GrazingPart(cosine);
}

// Directional albedo of the specular lobe is f0 * x + y, by roughness and cosine to the view.
// Layout of the table: path_albedo.h.
static const uint kAlbedoCosines = 64;
static const uint kAlbedoRoughnesses = 32;

float2 SpecularParts(StructuredBuffer<float2> table, float roughness, float cosine) {
  if (roughness <= kPathMirrorRoughness) {
    const float grazing = GrazingPart(cosine);
    return float2(1.0f - grazing, grazing);
  }
  // Square roots are evenly spaced: grazing angles and smooth surfaces change fastest.
  const float column = sqrt(saturate(cosine)) * float(kAlbedoCosines - 1);
  const float row = sqrt(saturate((roughness - kPathMirrorRoughness) / (1.0f - kPathMirrorRoughness))) *
                    float(kAlbedoRoughnesses - 1);
  const uint x = min(uint(column), kAlbedoCosines - 2);
  const uint y = min(uint(row), kAlbedoRoughnesses - 2);
  const float2 part = float2(column - float(x), row - float(y));
  const uint at = y * kAlbedoCosines + x;
  return lerp(lerp(table[at], table[at + 1], part.x),
              lerp(table[at + kAlbedoCosines], table[at + kAlbedoCosines + 1], part.x), part.y);
}

float Brightness(float3 color) { return dot(color, float3(0.2126f, 0.7152f, 0.0722f)); }

// `view`: towards where the path came from, in world space.
PathBsdf MakePathBsdf(StructuredBuffer<float2> table, float3 base_color, float metallic,
                      float roughness, float3 dielectric_f0, float dielectric_f90,
                      float3 shading_normal, float3 view) {
  PathBsdf bsdf;
  bsdf.axes = MakePathAxes(shading_normal);
  bsdf.view = IntoAxes(bsdf.axes, view);
  bsdf.view.z = max(bsdf.view.z, 1e-6f);
  bsdf.f0 = dielectric_f0 + (base_color - dielectric_f0) * metallic;
  bsdf.f90 = dielectric_f90 + (1.0f - dielectric_f90) * metallic;
  bsdf.is_mirror = roughness <= kPathMirrorRoughness;
  bsdf.alpha = roughness * roughness;
  const float2 parts = SpecularParts(table, roughness, bsdf.view.z);
  bsdf.albedo.specular = bsdf.f0 * parts.x + bsdf.f90 * parts.y;
  bsdf.albedo.diffuse = (1.0f - metallic) * base_color * (1.0f - bsdf.albedo.specular);
  const float share = Brightness(bsdf.albedo.specular);
  const float other = Brightness(bsdf.albedo.diffuse);
  // A black diffuse lobe is never sampled; a specular one always is.
  bsdf.specular_chance = other > 0.0f ? clamp(share / (share + other), 0.1f, 0.9f) : 1.0f;
  return bsdf;
}

// Smith's Lambda of a direction. [Walter et al. 2007]
float SmithLambda(float alpha, float3 v) {
  const float tangent_squared = (v.x * v.x + v.y * v.y) / (v.z * v.z);
  return 0.5f * (sqrt(1.0f + alpha * alpha * tangent_squared) - 1.0f);
}

float FacetDensity(float alpha, float3 h) {
  const float a2 = alpha * alpha;
  const float z2 = h.z * h.z;
  const float slope = (h.x * h.x + h.y * h.y) / (a2 * z2);
  return 1.0f / (kPathPi * a2 * z2 * z2 * (1.0f + slope) * (1.0f + slope));
}

// Both lobes times the cosine, and the density with which PathSampleDirection gives that direction.
struct PathValue {
  Lobes lobes;
  float density;  // 1/sr
};

// `light`: in the axes of the surface. A mirror's specular lobe is 0 in every such direction.
PathValue PathEvaluateLocal(PathBsdf bsdf, float3 light) {
  PathValue value;
  value.lobes = NoLobes();
  value.density = 0.0f;
  if (!(light.z > 0.0f)) return value;
  value.lobes.diffuse = bsdf.albedo.diffuse * (light.z / kPathPi);
  value.density = (1.0f - bsdf.specular_chance) * light.z / kPathPi;
  if (bsdf.is_mirror) return value;
  const float3 h = normalize(bsdf.view + light);
  const float lambda_view = SmithLambda(bsdf.alpha, bsdf.view);
  const float lambda_light = SmithLambda(bsdf.alpha, light);
  const float facets = FacetDensity(bsdf.alpha, h) / (4.0f * bsdf.view.z);
  value.lobes.specular =
      PathFresnel(bsdf.f0, bsdf.f90, dot(bsdf.view, h)) * (facets / (1.0f + lambda_view + lambda_light));
  value.density += bsdf.specular_chance * facets / (1.0f + lambda_view);
  return value;
}

PathValue PathEvaluate(PathBsdf bsdf, float3 direction) {
  return PathEvaluateLocal(bsdf, IntoAxes(bsdf.axes, direction));
}

// A facet's normal with the density of those that `view` sees. [Heitz 2018, Sampling the GGX
// Distribution of Visible Normals]
float3 SampleFacet(float2 u, float3 view, float alpha) {
  const float3 stretched = normalize(float3(alpha * view.x, alpha * view.y, view.z));
  const float across = stretched.x * stretched.x + stretched.y * stretched.y;
  const float3 t1 = across > 0.0f ? float3(-stretched.y, stretched.x, 0.0f) / sqrt(across)
                                  : float3(1, 0, 0);
  const float3 t2 = cross(stretched, t1);
  const float r = sqrt(u.x);
  const float phi = 2.0f * kPathPi * u.y;
  const float p1 = r * cos(phi);
  const float s = 0.5f * (1.0f + stretched.z);
  const float p2 = (1.0f - s) * sqrt(saturate(1.0f - p1 * p1)) + s * r * sin(phi);
  const float3 n = p1 * t1 + p2 * t2 + sqrt(saturate(1.0f - p1 * p1 - p2 * p2)) * stretched;
  return normalize(float3(alpha * n.x, alpha * n.y, max(n.z, 0.0f)));
}

// A direction to go on in.
struct PathDirection {
  float3 direction;  // world space
  Lobes weight;      // both lobes times the cosine over the density
  float density;     // 1/sr; 0: a mirror's only direction
  bool is_valid;     // false: the direction points into the surface, the light is lost
};

PathDirection PathSampleDirection(PathBsdf bsdf, float2 u, float choice) {
  PathDirection sampled;
  sampled.weight = NoLobes();
  sampled.density = 0.0f;
  sampled.is_valid = false;
  float3 light;
  const bool is_specular = choice < bsdf.specular_chance;
  if (is_specular && bsdf.is_mirror) {
    light = float3(-bsdf.view.x, -bsdf.view.y, bsdf.view.z);
    sampled.weight.specular = PathFresnel(bsdf.f0, bsdf.f90, bsdf.view.z) / bsdf.specular_chance;
    sampled.is_valid = true;
  } else {
    if (is_specular) {
      const float3 h = SampleFacet(u, bsdf.view, bsdf.alpha);
      light = 2.0f * dot(bsdf.view, h) * h - bsdf.view;
    } else {
      const float r = sqrt(u.x);
      const float phi = 2.0f * kPathPi * u.y;
      light = float3(r * cos(phi), r * sin(phi), sqrt(saturate(1.0f - u.x)));
    }
    const PathValue value = PathEvaluateLocal(bsdf, light);
    sampled.density = value.density;
    sampled.is_valid = value.density > 0.0f;
    if (sampled.is_valid) sampled.weight = Scaled(value.lobes, 1.0f / value.density);
  }
  sampled.direction = OutOfAxes(bsdf.axes, light);
  return sampled;
}

#endif
