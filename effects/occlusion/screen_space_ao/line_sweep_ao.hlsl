// SPDX-License-Identifier: MIT
// Line-sweep ambient occlusion: one thread walks along a whole line of the picture and keeps the
// points that later ones can see as their horizon on a stack, so that each pixel gets its exact
// horizon after a few steps, however far away it is. [Timonen 2013, Line-Sweep Ambient Obscurance]
#include "horizons.hlsli"
#include "occlusion.hlsli"

struct LineSweepConstants {
  uint column_wise;  // 1: a line takes a pixel of every row, 0: of every column
  float slope;       // pixels across for each pixel along, -1 to 1
  int first_line;    // may be negative
  uint backwards;    // 0: stores the horizons, 1: integrates between them and these
  uint first;        // 1: of all directions
};
ConstantBuffer<LineSweepConstants> sweep : register(b0, space3);

RWTexture2D<float2> stacks : register(u3, space3);   // of each line, at the line's own pixels
RWTexture2D<float> horizons : register(u4, space3);  // cosine of the horizon behind
RWTexture2D<float2> sums : register(u5, space3);     // of visibility and of weights

int2 Turned(int2 v) { return sweep.column_wise != 0 ? v.yx : v; }
float2 Turned(float2 v) { return sweep.column_wise != 0 ? v.yx : v; }

// The line's place across, in pixels, where it is `along` pixels far.
float Across(int number, int along) { return float(number) + 0.5 + sweep.slope * float(along); }

int2 LinePixel(int number, int along) { return Turned(int2(along, int(floor(Across(number, along))))); }

// The depth on the line, between the two pixels beside it: straight on a plane. At an edge, that of
// the nearer pixel.
float DepthOnLine(int number, int along, int2 size) {
  const float across = Across(number, along);
  const int2 nearest = LinePixel(number, along);
  const float z = g_view_z[nearest];
  const float offset = across - floor(across) - 0.5;
  const int2 other = nearest + Turned(int2(0, offset > 0.0 ? 1 : -1));
  if (offset == 0.0 || !IsInside(other, size)) return z;
  const float other_z = g_view_z[other];
  if (!IsSurface(other_z) || abs(other_z - z) > 0.05 * min(z, other_z)) return z;
  return 1.0 / lerp(1.0 / z, 1.0 / other_z, abs(offset));
}

// A line of the picture shows a plane through the camera. In it, x goes along the line and y into
// the picture.
struct LinePlane {
  float3 x;      // view space, unit
  float3 y;      // view space, unit
  float height;  // y of the points with a depth of 1
};

LinePlane MakeLinePlane(int number, int2 size) {
  const float2 start = SlopeAt(Turned(float2(0.5, Across(number, 0))), size);
  const float2 end = SlopeAt(Turned(float2(1.5, Across(number, 1))), size);
  const float2 way = normalize(end - start);
  const float2 off = start - dot(start, way) * way;
  LinePlane plane;
  plane.x = float3(way, 0.0);
  plane.height = sqrt(1.0 + dot(off, off));
  plane.y = float3(off, 1.0) / plane.height;
  return plane;
}

// Cosine of the angle at `from` between the camera and `to`.
float HorizonCosine(float2 from, float2 to) {
  const float2 delta = to - from;
  return -dot(delta, from) * rsqrt(max(dot(delta, delta) * dot(from, from), 1e-30));
}

// A stack for each line. It is never higher than the number of pixels that the line has passed, so
// it has room at these pixels.
struct Stack {
  int number;  // of the line
  int bottom;  // the first of the line's pixels inside of the picture, along the line
  int count;
};

int2 StackPixel(Stack stack, int slot) { return LinePixel(stack.number, stack.bottom + slot); }

// The cosine of the highest horizon that the points of the stack make for `at`, -1 for none; drops
// the points that no later pixel can see behind a higher one that is still within the radius.
float FindHorizon(inout Stack stack, float2 at) {
  const float radius = Radius();
  while (stack.count >= 2) {
    const float2 top = stacks[StackPixel(stack, stack.count - 1)];
    const float2 below = stacks[StackPixel(stack, stack.count - 2)];
    if (length(below - at) > radius || HorizonCosine(at, below) < HorizonCosine(at, top)) break;
    --stack.count;
  }
  float cosine = -1.0;
  for (int slot = stack.count - 1; slot >= 0; --slot) {
    const float2 other = stacks[StackPixel(stack, slot)];
    // The whole ray through this point passes too far away, and so do those of the points below.
    if (abs(at.x * other.y - at.y * other.x) > 1.001 * radius * length(other)) break;
    if (length(other - at) > radius) continue;
    const float raised = HorizonCosine(at, other);
    if (raised < cosine) break;
    cosine = raised;
  }
  return cosine;
}

// Visibility in the plane of the line, from -1 (no horizon) to 1, and what it counts.
float2 LineVisibility(LinePlane plane, float2 at, float2 encoded_normal, float behind, float before) {
  const float over_length = rsqrt(dot(at, at));
  const float3 to_camera = -over_length * (at.x * plane.x + at.y * plane.y);
  const float3 direction = over_length * (at.y * plane.x - at.x * plane.y);
  const float3 normal = ViewNormal(encoded_normal, to_camera);
  const SliceNormal projected = ProjectNormal(normal, direction, to_camera);
  const float visibility =
      projected.length * SliceVisibility(-SafeAcos(behind), SafeAcos(before), projected.gamma);
  // The lines are spread evenly over the picture, not about the view ray.
  const float sine = dot(plane.x, to_camera);
  const float weight = abs(to_camera.z) / max(1.0 - sine * sine, 1e-6);
  return weight * float2(visibility, 1.0);
}

[shader("compute")]
[numthreads(64, 1, 1)]
void SweepLine(uint3 id : SV_DispatchThreadID) {
  const int2 size = PictureSize();
  const int length_pixels = Turned(size).x;
  const int number = sweep.first_line + int(id.x);
  const LinePlane plane = MakeLinePlane(number, size);
  Stack stack;
  stack.number = number;
  stack.bottom = 0;
  stack.count = 0;
  while (stack.bottom < length_pixels && !IsInside(StackPixel(stack, 0), size)) ++stack.bottom;
  for (int i = 0; i < length_pixels; ++i) {
    const int along = sweep.backwards != 0 ? length_pixels - 1 - i : i;
    const int2 pixel = LinePixel(number, along);
    if (!IsInside(pixel, size)) continue;
    if (!IsSurface(g_view_z[pixel]) || !(Radius() > 0.0)) {
      result[pixel] = float4(1, 1, 1, 1);
      continue;
    }
    const float2 slope = SlopeAt(Turned(float2(float(along) + 0.5, Across(number, along))), size);
    const float2 at =
        DepthOnLine(number, along, size) * float2(dot(slope, plane.x.xy), plane.height);
    const float cosine = FindHorizon(stack, at);
    stacks[StackPixel(stack, stack.count)] = at;
    ++stack.count;
    if (sweep.backwards == 0) {
      horizons[pixel] = cosine;
      continue;
    }
    float2 sum = LineVisibility(plane, at, g_shading_normal[pixel], horizons[pixel], cosine);
    if (sweep.first == 0) sum += sums[pixel];
    sums[pixel] = sum;
    const float mean = saturate(sum.x / sum.y);
    result[pixel] = float4(mean, mean, mean, 1.0);
  }
}
