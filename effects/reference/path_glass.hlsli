// SPDX-License-Identifier: MIT
// Glass in front of a surface: which pane, if any, a path stays at, and what it finds there.
#ifndef KAAMOS_PATH_GLASS_HLSLI
#define KAAMOS_PATH_GLASS_HLSLI

#include "path_hit.hlsli"
#include "path_sampler.hlsli"

// Panes behind one another that a path walks through.
static const uint kMaxPanes = 64;

// The first surface of a path, as the camera sees it.
static const uint kAsSolid = 0;     // what each lamp gives is a layer
static const uint kAsPane = 1;      // its mirror image is a path of its own
static const uint kAsMirrored = 2;  // seen in a pane

// The result of a path's walk through the panes in front of a surface.
struct GlassStart {
  float3 through;    // of the light behind all panes; 0 if the path stays at one
  float3 weight;     // of the light that it finds where it stays
  PathHit hit;       // the pane's surface, or what it mirrors; a miss: only `emission`
  float3 view;       // from there
  float3 emission;   // of the sky or the surface
  uint seen_as;
  uint layer;        // the pane where it stays
};

// Walks through the panes. At each the path is mirrored, stays with the pane's own colour, or goes
// on.
GlassStart WalkThroughGlass(PathSampler sampler, CameraRay ray, float solid_distance) {
  GlassStart start;
  start.through = float3(1, 1, 1);
  start.weight = start.emission = float3(0, 0, 0);
  start.hit = NoHit();
  start.view = -normalize(ray.direction);
  start.seen_as = kAsPane;
  start.layer = 0;
  float3 mirrored_origin = float3(0, 0, 0);
  float3 mirrored = float3(0, 0, 0);
  uint mirrored_mask = 0;  // 0: no pane mirrors the path
  float t_min = 0.0;
  for (uint layer = 0; layer < kMaxPanes; ++layer) {
    const PathHit pane = Follow(ray.origin, ray.direction, t_min, kGlassOnly, true);
    if (pane.distance < 0.0 || (solid_distance >= 0.0 && pane.distance >= solid_distance)) break;
    // A ray on the edge of two triangles may hit both, at the same distance but for rounding.
    t_min = pane.distance * 1.000002;
    const float3 f0 = pane.dielectric_f0 + (pane.base_color - pane.dielectric_f0) * pane.metallic;
    const float f90 = pane.dielectric_f90 + (1.0 - pane.dielectric_f90) * pane.metallic;
    const float3 fresnel = PathFresnel(f0, f90, saturate(dot(start.view, pane.shading_normal)));
    const float mirror_chance = pane.is_unlit != 0 ? 0.0 : saturate(Brightness(fresnel));
    const float2 u = PathRandom(sampler, kPairPane + layer);
    start.layer = layer;
    if (u.x < mirror_chance) {
      start.weight = start.through * fresnel / mirror_chance;
      start.through = float3(0, 0, 0);
      // A smooth pane shows the shapes of lamps; a rough one has highlights instead.
      mirrored_mask = pane.roughness <= kPathMirrorRoughness ? kMaskSolid : kMaskWithoutLamps;
      mirrored = reflect(-start.view, pane.shading_normal);
      // A normal-mapped direction can point into the pane.
      if (!(dot(mirrored, pane.normal) > 0.0)) mirrored = reflect(-start.view, pane.normal);
      mirrored_origin = pane.position + pane.normal * pane.offset;
      break;
    }
    // The pane's own light is over its coverage, whatever is mirrored: its diffuse lobe has what
    // the specular one leaves.
    if (u.y < saturate(pane.opacity)) {
      start.weight = start.through / (1.0 - mirror_chance);
      start.through = float3(0, 0, 0);
      start.hit = pane;
      start.emission = pane.emissive;
      break;
    }
    if (pane.is_unlit == 0) start.through *= (1.0 - fresnel) / (1.0 - mirror_chance);
  }
  if (mirrored_mask != 0) {
    start.hit = Follow(mirrored_origin, mirrored, 0.0, mirrored_mask, false);
    start.emission = start.hit.distance < 0.0 ? SkyTowards(mirrored) : start.hit.emissive;
    start.view = -mirrored;
    start.seen_as = kAsMirrored;
  }
  return start;
}

#endif
