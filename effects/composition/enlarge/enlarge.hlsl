// SPDX-License-Identifier: MIT
// Enlarges the finished picture along its edges: twelve pixels are weighed by a kernel that is
// turned and stretched as the edge runs, sharp across it, wide along it. An upscaler of EASU's kind,
// by structure tensors. [AMD 2021: FidelityFX Super Resolution 1.0; Bigun & Granlund 1987; Duchon
// 1979]
#include "frame.hlsli"

// Mirrors EnlargeConstants in effects/composition/enlarge/enlarge.h.
struct EnlargeConstants {
  float edges;  // how far kernels follow edges, 0 to 1
  uint method;  // kBilinear, kAlongEdges
};
ConstantBuffer<EnlargeConstants> constants : register(b0, space3);

RWTexture2D<float4> source : register(u0, space3);
RWTexture2D<float4> result : register(u1, space3);

static const uint kBilinear = 0;
static const uint kAlongEdges = 1;

static const int kSide = 4;  // of the window, pixels; its corners have no weight
static const float kBrightest = 1e30;
static const float kPi = 3.14159265;

// Light as a tone curve shows it, below 1: what is very bright outweighs nothing, and edges are
// where they are seen. Negative and infinite values are contained.
float3 Shown(float3 light) {
  const float3 contained = Contain(light, kBrightest);
  const float largest = max(contained.x, max(contained.y, contained.z));
  return contained / (frame.white + largest);
}

float3 Light(float3 shown) {
  const float largest = max(shown.x, max(shown.y, shown.z));
  return shown * (frame.white / max(1.0 - largest, 1e-30));
}

// A window of pixels around a point between its middle four.
struct Window {
  float3 shown[16];  // by rows
  float luma[16];
  float2 part;       // the point, pixels from the upper left of the middle four
};

Window LoadWindow(float2 at, int2 size) {
  Window window;
  const float2 corner = floor(at);
  window.part = at - corner;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int2 pixel = int2(corner) + int2(i % kSide - 1, i / kSide - 1);
    const float3 shown = Shown(source[clamp(pixel, int2(0, 0), size - 1)].rgb);
    window.shown[i] = shown;
    window.luma[i] = dot(shown, float3(0.25, 0.5, 0.25));
  }
  return window;
}

// The place of one of the middle four in the window.
int Middle(int i) { return kSide * (1 + i / 2) + 1 + i % 2; }

float MiddleWeight(float2 part, int i) {
  return (i % 2 == 1 ? part.x : 1.0 - part.x) * (i / 2 == 1 ? part.y : 1.0 - part.y);
}

float3 Bilinear(Window window) {
  float3 sum = float3(0, 0, 0);
  for (int i = 0; i < 4; ++i) sum += MiddleWeight(window.part, i) * window.shown[Middle(i)];
  return sum;
}

// The direction across the edge, and how much of an edge it is: 0 where all directions are alike.
float3 FindEdge(Window window) {
  float xx = 0.0, xy = 0.0, yy = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int at = Middle(i);
    const float2 slope = 0.5 * float2(window.luma[at + 1] - window.luma[at - 1],
                                      window.luma[at + kSide] - window.luma[at - kSide]);
    const float weight = MiddleWeight(window.part, i);
    xx += weight * slope.x * slope.x;
    xy += weight * slope.x * slope.y;
    yy += weight * slope.y * slope.y;
  }
  const float mean = 0.5 * (xx + yy);
  if (!(mean > 1e-12)) return float3(1, 0, 0);
  const float2 doubled = float2(0.5 * (xx - yy), xy);  // at twice the angle
  const float apart = length(doubled);
  const float angle = apart > 0.0 ? 0.5 * atan2(doubled.y, doubled.x) : 0.0;
  return float3(cos(angle), sin(angle), saturate(apart / mean));
}

float Sinc(float x) { return x > 1e-4 ? sin(kPi * x) / (kPi * x) : 1.0; }

// Lanczos' kernel with two lobes.
float Lanczos(float x) { return x < 2.0 ? Sinc(x) * Sinc(0.5 * x) : 0.0; }

// Positive, as wide as the window.
float Bump(float x) {
  const float inside = saturate(1.0 - 0.25 * x * x);
  return inside * inside;
}

float3 AlongEdges(Window window) {
  const float3 edge = FindEdge(window);
  const float strength = constants.edges * edge.z;
  float3 sum = float3(0, 0, 0);
  float weights = 0.0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int x = i % kSide, y = i / kSide;
    if ((x == 0 || x == kSide - 1) && (y == 0 || y == kSide - 1)) continue;
    const float2 away = float2(x - 1, y - 1) - window.part;
    const float across = abs(dot(away, edge.xy));
    const float along = abs(dot(away, float2(-edge.y, edge.x)));
    const float weight =
        lerp(Lanczos(length(away)), Lanczos(across) * Bump(along), strength);
    sum += weight * window.shown[i];
    weights += weight;
  }
  // Negative lobes must not show what none of the nearest pixels shows.
  float3 least = float3(1, 1, 1), most = float3(0, 0, 0);
  for (int k = 0; k < 4; ++k) {
    least = min(least, window.shown[Middle(k)]);
    most = max(most, window.shown[Middle(k)]);
  }
  return clamp(sum / max(weights, 1e-3), least, most);
}

[shader("compute")]
[numthreads(8, 8, 1)]
void Enlarge(uint3 id : SV_DispatchThreadID) {
  uint2 size, from;
  result.GetDimensions(size.x, size.y);
  source.GetDimensions(from.x, from.y);
  if (any(id.xy >= size)) return;
  const float2 at = (float2(id.xy) + 0.5) * float2(from) / float2(size) - 0.5;
  const Window window = LoadWindow(at, int2(from));
  const float3 shown =
      constants.method == kBilinear ? Bilinear(window) : AlongEdges(window);
  result[id.xy] = float4(Light(shown), 1);
}
