// SPDX-License-Identifier: MIT
// Particles: round spots of light that turn towards the camera, drawn from back to front over the
// finished frame. Neither the G-buffer nor an acceleration structure has them, so that no ray meets
// one; only the finished picture shows them. [survey 6.2]
#include "../surfaces/gbuffer/camera_hit.hlsli"
#include "frame.hlsli"

struct Particle {
  float3 position;  // of its middle, relative to the camera
  float radius;
  float3 radiance;  // that its middle adds
  float opacity;    // part of what is behind its middle that it hides
};

struct ParticleConstants {
  float2 size;       // of the picture, pixels
  float clip_scale;  // of ToClip
};

ConstantBuffer<ParticleConstants> constants : register(b0, space3);
StructuredBuffer<Particle> particles : register(t0, space3);  // far ones first
Texture2D<float4> drawn : register(t1, space3);               // what the draws leave
// The effect's signal: the light of all particles of a pixel, and how much of the frame they hide.
RWTexture2D<float4> particle_light : register(u0, space3);

struct ParticleVertex {
  float4 clip : SV_Position;
  float2 place : PLACE;  // -1 to 1 across the spot
  nointerpolation float view_z : VIEW_Z;
  nointerpolation float4 light : LIGHT;
};

// Two triangles for each particle, parallel to the picture.
[shader("vertex")]
ParticleVertex ParticleCorner(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  const float2 corners[6] = {float2(-1, -1), float2(1, -1), float2(1, 1),
                             float2(-1, -1), float2(1, 1),  float2(-1, 1)};
  const Particle particle = particles[instance];
  const float3 right = frame.camera_right * frame.over_right, up = frame.camera_up * frame.over_up;
  ParticleVertex result;
  result.place = corners[vertex];
  const float3 corner =
      particle.position + particle.radius * (result.place.x * right + result.place.y * up);
  result.clip = ToClip(corner, constants.clip_scale, constants.size);
  result.view_z = dot(particle.position, frame.camera_forward);
  result.light = float4(particle.radiance, particle.opacity);
  return result;
}

[shader("pixel")]
float4 ParticleLight(ParticleVertex vertex) : SV_Target0 {
  const float opaque_z = g_view_z[uint2(vertex.clip.xy)];
  const bool is_hidden = opaque_z > 0.0 && vertex.view_z >= opaque_z;
  const float inside = 1.0 - dot(vertex.place, vertex.place);
  if (is_hidden || inside <= 0.0) discard;
  return vertex.light * (inside * inside);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void ParticlesResult(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  particle_light.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  particle_light[id.xy] = drawn[id.xy];
}

// Puts the particles in front of what the pixel holds.
[shader("compute")]
[numthreads(8, 8, 1)]
void ParticlesCompose(uint3 id : SV_DispatchThreadID) {
  uint width, height;
  radiance.GetDimensions(width, height);
  if (id.x >= width || id.y >= height) return;
  const float4 behind = radiance[id.xy], light = particle_light[id.xy];
  radiance[id.xy] = float4(behind.rgb * (1.0 - light.a) + light.rgb, behind.a);
}
