// SPDX-License-Identifier: MIT
//
// The cases of wide_test.cpp: shaders whose threads diverge in every possible way. Those whose
// entry point takes nothing but SV_DispatchThreadID and SV_GroupID in groups of 64 threads also run
// as ray generation shaders.
#pragma once

namespace kaamos::test {

struct WideCase {
  const char* name;
  const char* body;
};

// Precedes each case. Word i of a buffer is i; texel (x, y) of the pictures is (x, y, 0, 0).
inline constexpr char kWideHead[] = R"(
RWByteAddressBuffer results : register(u0);
ByteAddressBuffer words : register(t0);
StructuredBuffer<uint4> records : register(t1);
cbuffer Numbers : register(b0) { uint zero; uint one; uint two; uint three; };
uint mix(uint x) { x ^= x >> 15; x *= 0x2C1B3C6D; x ^= x >> 12; return x; }
float real(uint x) { return float(mix(x) & 0xFFFF) / 4096 - 8; }
void put(uint3 id, uint word, uint value) { results.Store(4 * (id.x * 16 + word), value); }
void put(uint3 id, uint word, float value) { put(id, word, asuint(value)); }
)";

inline constexpr WideCase kWideCases[] = {
    {"ifs_inside_ifs", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  uint y = 1;
  if (x & 1) {
    y = 3;
    if (x & 2) y *= 7; else if (x & 4) y -= 20;
    if (three > two) y += 5;  // of all
  } else {
    if ((x & 24) == 24) y = 100;
    y ^= x >> 20;
  }
  put(id, 0, y);
})"},
    {"loops_left_one_by_one", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  uint sum = 0, turns = 0;
  for (uint i = 0; i < (x & 31); ++i) {
    if ((x >> i) % 3 == 0) continue;
    for (uint k = 0; k < three; ++k) {
      if (((x ^ i) >> k) % 5 == 0) break;
      sum += k * i + 1;
      if (sum % 11 == 0) continue;
      ++turns;
    }
    if (sum > 90) break;
  }
  put(id, 0, sum);
  put(id, 1, turns);
  uint y = x & 0xFFFF;
  do { y = y * 3 + 1; if (y & 4) continue; y >>= 2; } while ((y & 7) != 0 && ++turns < 40);
  put(id, 2, y);
  put(id, 3, turns);
  for (;;) { if (turns++ > (x & 63)) break; }
  put(id, 4, turns);
})"},
    {"returns_one_by_one", R"(
uint search(uint x, inout uint seen, out uint last) {
  last = 5;
  if (x % 7 == 0) return 1;
  for (uint i = 0; i < 10; ++i) {
    ++seen;
    last = i;
    if ((x >> i) % 6 == 0) return 10 + i;
    if ((x >> i) % 5 == 0) { seen += 100; if (x & 8) return 50; }
  }
  return 99;
}
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  uint seen = x & 3, last = 0;
  if (x & 16) { put(id, 0, search(x >> 3, seen, last)); }
  if (x % 9 == 0) return;
  put(id, 1, seen);
  put(id, 2, last);
  if (id.x % 2 == 0) { const uint found = search(x, seen, last); put(id, 3, found * 1000 + seen); }
  put(id, 4, search(id.x, seen, last) + seen * 256 + last);
})"},
    {"switches", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  uint x = mix(id.x), y = 0;
  for (uint i = 0; i < 6; ++i) {
    switch ((x >> i) & 7) {
      case 0: y += 1; break;
      case 1: y += 10;
      case 2: y += 100; if (y & 1) break; y += 3;
      case 5: y *= 2; continue;
      default: y += 7; if (x & 64) { y ^= 5; break; } y += 2;
      case 6: y += 1000;
    }
    y = y * 5 + i;
  }
  put(id, 0, y);
  switch (two) { case 2: if (x & 1) break; y = 1; break; case 3: y = 2; break; }
  put(id, 1, y);
  switch (three) { case 3: y += 4; break; default: y = 0; }
  put(id, 2, y);
})"},
    {"swizzles_matrices_and_structs", R"(
struct Inner { float2 a; int b[3]; };
struct Outer { Inner one; Inner two[2]; float3x2 m; bool c; };
Outer change(Outer o, uint x) {
  o.one.a.yx = o.one.a * 2 + 1;
  o.two[x & 1].b[x % 3] += 7;
  o.m[x % 3].y = 5;
  o.m._m10_m21 = float2(x & 15, 3);
  o.c = !o.c;
  return o;
}
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  Outer o = (Outer)0;
  o.one.a = float2(id.x, 2);
  o.m = float3x2(1, 2, 3, real(x), 5, 6);
  if (x & 1) o = change(o, x);
  Outer p = change(o, x + 1);
  if (x & 2) p.two[1].a.x += o.one.a.y;
  float4 v = float4(real(x), 1, 2, 3);
  v.zx = v.xw;
  if (x & 4) v.wy = v.yy + 1;
  v[x & 7] = 9;  // beyond its end: nothing
  put(id, 0, p.one.a.x + p.one.a.y * 3);
  put(id, 1, uint(p.two[0].b[0] + 2 * p.two[1].b[1] + 3 * p.two[x & 1].b[(x >> 4) % 4]));
  put(id, 2, dot(mul(p.m, float2(1, real(id.x))), float3(1, 2, 3)));
  put(id, 3, determinant(float3x3(v.xyz, v.yzw, v.zwx)));
  put(id, 4, p.c ? 1u : 0u);
  put(id, 5, dot(v, float4(1, 10, 100, 1000)));
  put(id, 6, normalize(v.xyz).y + length(v) + distance(v.xy, v.zw));
  put(id, 7, dot(reflect(v.xyz, float3(0, 1, 0)), cross(v.xyz, v.wzy)));
})"},
    {"arrays_by_varying_index", R"(
static const uint kTable[5] = {3, 1, 4, 1, 5};
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  uint own[6];
  for (uint i = 0; i < 6; ++i) own[i] = i * i + (x & 1);
  own[x % 8] = 77;  // beyond its end: nothing
  if (x & 2) own[(x >> 3) % 6] += own[(x >> 7) % 6];
  int2 pairs[2] = {int2(id.x, 1), int2(2, 3)};
  pairs[x & 1].yx = pairs[(x >> 1) & 1];
  put(id, 0, kTable[x % 6]);
  put(id, 1, own[0] + 10 * own[1] + 100 * own[2] + own[3] + own[4] + own[5]);
  put(id, 2, own[x % 9]);
  put(id, 3, uint(pairs[0].x + 100 * pairs[0].y + 10000 * pairs[1].x + 7 * pairs[1].y));
})"},
    {"integers", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  const int a = int(x), b = int(mix(x)) >> (x & 31);
  put(id, 0, x / (id.x & 7));
  put(id, 1, x % (id.x & 7));
  put(id, 2, uint(a / (b & 3)) + uint(a % (int(id.x & 3) - 1)));
  put(id, 3, uint(0x80000000 / (int(id.x & 3) - 2)));
  put(id, 4, (x << (x & 63)) ^ uint(a >> (id.x & 63)));
  put(id, 5, countbits(x) + firstbithigh(a) * 64 + firstbitlow(x) * 4096);
  put(id, 6, reversebits(x) ^ uint(min(a, b) * 3 - max(a, b)) ^ uint(abs(b)) ^ uint(sign(b)));
  put(id, 7, uint(clamp(b, -100, 100)) + (x > 0x90000000u ? 1 : 0) + uint(mad(a, b, 5)));
  put(id, 8, uint(float(x)) ^ uint(int(float(a))) ^ uint(-a) ^ ~x);
  put(id, 9, uint(real(x) * 3e9f) ^ uint(int(real(x + 1) * 3e9f)));
})"},
    {"conditions_short_of_their_operands", R"(
bool seen(uint x, inout uint count) { ++count; return (x & 4) != 0; }
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  uint count = 0;
  if ((x & 1) != 0 && words.Load(4 * (x & 63)) > 30) count += 2;
  if ((x & 2) != 0 || records[x & 15].y > 20) count += 5;
  if ((x & 8) != 0 && seen(x, count)) count += 100;
  const uint y = (x & 16) != 0 ? words.Load(4 * (x & 127)) : records[id.x & 7].z;
  const bool2 both = and(bool2(x & 1, x & 2), bool2(x & 4, x & 8));
  const uint3 picked = select(bool3(x & 1, x & 2, x & 4), uint3(1, 2, 3), uint3(x, y, 9));
  put(id, 0, count);
  put(id, 1, y);
  put(id, 2, any(both) ? 1u : all(bool3(x & 1, x & 2, x & 4)) ? 2u : 3u);
  put(id, 3, picked.x + picked.y * 3 + picked.z * 5);
  put(id, 4, three > two && (x & 1) != 0 ? 1u : 0u);
  put(id, 5, three < two || (x & 1) != 0 ? 1u : 0u);
})"},
    {"numbers_that_are_none", R"(
float odd(uint x) {
  switch (x % 9) {
    case 0: return asfloat(0x7FC00123);
    case 1: return asfloat(0xFF800000);
    case 2: return asfloat(0x7F800000);
    case 3: return -0.0f;
    case 4: return 1e-42f;
    case 5: return -2.5f;
    case 6: return 0.5f;
    case 7: return -3e9f;
    default: return real(x);
  }
}
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const float a = odd(id.x), b = odd(id.x / 9), c = odd(mix(id.x));
  put(id, 0, min(a, b));
  put(id, 1, max(a, b));
  put(id, 2, clamp(a, b, c));
  put(id, 3, saturate(a) + step(a, b));
  put(id, 4, (a < b ? 1u : 0) + (a <= b ? 2u : 0) + (a > b ? 4u : 0) + (a >= b ? 8u : 0) +
                 (a == b ? 16u : 0) + (a != b ? 32u : 0) + (isnan(a) ? 64u : 0) +
                 (isinf(a) ? 128u : 0) + (isfinite(a) ? 256u : 0) + (bool(a) ? 512u : 0) +
                 (isnormal(a) ? 1024u : 0));
  put(id, 5, uint(a) ^ uint(int(b)));
  put(id, 6, uint(sign(a) + 1));
  put(id, 7, floor(a) );
  put(id, 8, ceil(a));
  put(id, 9, trunc(b));
  put(id, 10, round(b));
  put(id, 11, frac(c));
  put(id, 12, asuint(abs(a)) ^ asuint(-b) ^ asuint(sqrt(abs(c))));
  put(id, 13, isnan(exp(a)) ? 1.0f : exp(a));
  put(id, 14, isnan(exp(c)) ? 1.0f : exp(c) + exp2(b < 5 ? b : 1));
  put(id, 15, f32tof16(a));
})"},
    {"functions_of_one_lane", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const float a = real(id.x), b = abs(real(mix(id.x))) + 0.01f;
  put(id, 0, sin(a) + cos(b) * tan(a));
  put(id, 1, pow(b, a) + log(b) + log2(b) + exp(a));
  put(id, 2, atan2(a, b) + asin(saturate(a)) + fmod(a, b));
  put(id, 3, smoothstep(0, 1, a) + lerp(a, b, 0.3f) + mad(a, b, 2) + rsqrt(b) + rcp(b));
  put(id, 4, float(dot(int3(a, b, 3), int3(id))) + degrees(a) + radians(b));
  const float2x2 m = float2x2(a, b, 1, 2);
  put(id, 5, dot(mul(m, float2(a, 1)) + mul(float2(b, 2), transpose(m)), float2(1, 3)));
  float whole;
  put(id, 6, modf(a * 3, whole) + whole * 100);
  put(id, 7, f16tof32(f32tof16(a) & 0xFFFF) + ldexp(a, 3));
  put(id, 8, uint(int64_t(a * 1e6f) * 1000003 >> 7));
  put(id, 9, float(double(a) / double(b)));
})"},
    {"sines_of_all_sizes", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  // Angles that are short of kLargestAngle (elementary.h) beside some that are not.
  const uint x = mix(id.x);
  float a = real(x) * exp2(float(x >> 8 & 31) - 12);
  if (id.x % 13 == 5) a = asfloat(0xFF800000u);
  if (id.x % 13 == 7) a = asfloat(0x7FC00000u);
  float s, c;
  sincos(a, s, c);
  put(id, 0, isnan(s) ? 2.0f : s);
  put(id, 1, isnan(c) ? 2.0f : c);
  if (x & 1) put(id, 2, isnan(sin(a)) ? 2.0f : sin(-a));
  put(id, 3, sin(real(x)));
  put(id, 4, cos(real(x) * 60));
})"},
    {"statics_of_each_thread", R"(
static uint count = 3;
static float2 last;
void visit(uint x) { if (x & 1) { count += x & 7; last.y = real(x); } else { last.x += 1; } }
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  visit(x);
  if (x & 2) visit(x >> 3);
  put(id, 0, count);
  put(id, 1, last.x + last.y);
})"},
    {"static_resources", R"(
struct Sources { ByteAddressBuffer numbers; uint from; };
static ByteAddressBuffer alias = words;
static StructuredBuffer<uint4> assigned;
static Sources sources;
static ByteAddressBuffer both[2];
uint look(uint at) { return alias.Load(4 * at) + assigned[at].y; }
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  assigned = records;
  sources.numbers = alias;
  both[0] = words;
  both[1] = alias;
  put(id, 0, look(x & 15));
  if (x & 1) put(id, 1, sources.numbers.Load(4 * (x & 7)) + both[one].Load(8 + 4 * (x & 3)));
})"},
    {"pictures_at_their_borders", R"(
RWTexture2D<float4> picture : register(u1);
RWTexture2D<uint> scratch_uint : register(u2);
Texture2D<float4> source : register(t2);
Texture2D<float4> source_array_like : register(t3);
SamplerState linear_sampler : register(s0);
[numthreads(8, 8, 1)] void main(uint3 t : SV_GroupThreadID, uint3 g : SV_GroupID) {
  const uint3 id = uint3(t.x + 8 * t.y + 64 * g.x, 0, 0);
  const int2 pixel = int2(t.xy);
  float4 sum = 0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x)
      sum += picture[pixel + int2(x, y)] * float(x + 3 * y + 20) + source[pixel + int2(y, x)];
  put(id, 0, dot(sum, float4(1, 8, 64, 512)));
  put(id, 1, picture[pixel.yx].x + picture[int2(mix(id.x) & 7, t.y)].x * 10);
  put(id, 2, source.Load(int3(pixel, t.x & 1)).z + source.Load(int3(pixel, 0), int2(1, 1)).y);
  put(id, 3, source.SampleLevel(linear_sampler, float2(t.xy) / 8, 0).x);
  if (mix(id.x) & 1) put(id, 4, picture[pixel + int2(1, 0)].x);
  put(id, 5, source_array_like[pixel & 3].y);
})"},
    {"pictures_some_way_from_the_pixel", R"(
RWTexture2D<float4> picture : register(u1);
Texture2D<float4> source : register(t2);
float4 beside(int2 pixel, int2 by) { return picture[pixel + by]; }
[numthreads(8, 8, 1)] void main(uint3 t : SV_GroupThreadID, uint3 g : SV_GroupID) {
  const uint3 id = uint3(t.x + 8 * t.y + 64 * g.x, 0, 0);
  const int2 pixel = int2(t.xy);
  const int2 right = pixel + int2(three, one);
  const int2 left = right - int2(two, zero);
  int2 moving = pixel + int2(1, 0);
  float2 sum = picture[right].xy + 2 * source[left].xy;
  for (int i = 0; i < 3; ++i) {
    const int2 other = moving + int2(i, one);
    sum += (i + 1) * picture[other].xy;
    moving.x += i;
    const int2 mirrored = int2(three, three) - pixel;  // from right to left
    sum += picture[mirrored + int2(i, 2)].yx * 5;
  }
  put(id, 0, dot(sum, float2(1, 64)));
  if (mix(id.x) & 1) moving = pixel.yx;
  put(id, 1, picture[moving + int2(1, 1)].x + 10 * picture[moving].y);
  const uint2 above = t.xy + uint2(one, 0xFFFFFFFF);  // none above the first row
  put(id, 2, picture[above].y * 100 + source[above + uint2(0, 2)].x);
  put(id, 3, beside(pixel, int2(1, two)).x + beside(right, -int2(one, one)).y * 16);
  put(id, 4, picture[pixel + int2(words.Load(4 * (id.x & 3)), 0)].x);
  if (g.x != 0) return;
  const int2 here = pixel + int2(zero, zero);
  picture[here] = float4(t.xy, 0, real(id.x));
  put(id, 5, picture[pixel].w + picture[here].x);
})"},
    {"pictures_that_are_written", R"(
RWTexture2D<float4> picture : register(u1);
RWTexture2D<float2> pairs : register(u2);
RWTexture2D<float> scalars : register(u3);
[numthreads(8, 8, 1)] void main(uint3 t : SV_GroupThreadID, uint3 g : SV_GroupID) {
  const uint3 id = uint3(t.x + 8 * t.y + 64 * g.x, 0, 0);
  if (g.x != 0) return;
  const uint x = mix(id.x);
  picture[t.xy] = float4(real(x), t.x, t.y, 4);
  scalars[t.xy] = real(x + 1);
  pairs[t.xy] = float2(real(x), 3);
  picture[t.xy + uint2((x >> 1 & 1) * 8, 0)].z = 5;  // some beyond the border: nothing
  if (x & 1) picture[t.xy].y = 7;
  put(id, 0, dot(picture[t.xy], float4(1, 10, 100, 1000)));
  put(id, 1, scalars[t.xy]);
  put(id, 2, pairs[t.xy].x + pairs[t.xy].y);
})"},
    {"groups_that_fill_no_register", R"(
[numthreads(3, 5, 2)]
void main(uint3 id : SV_DispatchThreadID, uint3 t : SV_GroupThreadID, uint i : SV_GroupIndex,
          uint3 g : SV_GroupID) {
  const uint3 at = uint3(i + 30 * g.x, 0, 0);
  put(at, 0, id.x + 100 * id.y + 10000 * id.z);
  put(at, 1, t.x + 100 * t.y + 10000 * t.z);
  put(at, 2, i + 1000 * g.x);
})"},
    {"buffers_read_alike", R"(
struct Words { float a; uint2 b; float3x2 c; int d[2]; };   // 11 words: no whole number of fours
struct Mixed { uint a; bool b; double c; uint d; };
StructuredBuffer<Words> some : register(t2);
StructuredBuffer<Mixed> mixed : register(t3);
float sum(Words w) {
  return w.a + 3 * w.b.x + 5 * w.b.y + dot(w.c[0], float2(7, 11)) + dot(w.c[2], float2(13, 17)) +
         w.c[1].y + 19 * w.d[0] + 23 * w.d[1];
}
uint sum(Mixed m) { return m.a + (m.b ? 3 : 5) + 7 * m.d + uint(asuint(float(m.c)) & 0xFF); }
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  // Eight alike, four and four, each another, any, all.
  const uint at[5] = {id.x / 8, id.x / 4, id.x ^ 5, x & 15, three};
  for (uint i = 0; i < 5; ++i) {
    put(id, i, asuint(sum(some[at[i]])) + sum(mixed[at[i]]));
    put(id, 5 + i, dot(records[at[i]], uint4(1, 3, 5, 7)) + words.Load4(4 * at[i]).w);
  }
  if ((x & 3) == 0) {  // few take part
    put(id, 10, sum(some[id.x / 8]));
    put(id, 11, sum(some[x & 31]));
    for (uint k = 0; k < (x >> 4 & 3); ++k) put(id, 12 + k, records[id.x / 16 + k].z);
  }
})"},
    {"atomics_and_buffers", R"(
RWStructuredBuffer<uint3> triples : register(u1);
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID, uint3 g : SV_GroupID) {
  const uint x = mix(id.x);
  uint before = 9;
  if (g.x != 0) return;
  if (x & 1) results.InterlockedAdd(60000, x & 15);
  if (x & 2) results.InterlockedMax(60004, x, before);
  put(id, 0, before);
  triples[id.x & 31].yx = uint2(x, id.x);
  const uint4 record = records[(x >> 5) & 63];
  put(id, 1, record.x + record.w + triples[id.x & 31].x);
  put(id, 2, words.Load3(4 * (x & 63)).z);
})"},
};

// Precedes each of the cases below.
inline constexpr char kWideRayHead[] = R"(
RaytracingAccelerationStructure scene : register(t2);
struct Payload { uint x; float4 color; uint3 index; };
[shader("miss")] void Miss(inout Payload p) { p.color.w = -p.color.w; p.index = DispatchRaysIndex(); }
[shader("closesthit")] void Hit(inout Payload p, BuiltInTriangleIntersectionAttributes a) {
  p.color = float4(RayTCurrent(), a.barycentrics, PrimitiveIndex());
  p.index = DispatchRaysIndex();
  p.x = mix(p.x);
  if (p.x % 3 != 0) return;
  RayDesc ray = {WorldRayOrigin(), 0, -WorldRayDirection(), 50};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, ray, p);
}
static uint calls;
RayDesc towards(uint x) {
  RayDesc ray = {float3(real(x), real(x + 1) + 4, -50), 0, float3(real(x + 2) / 40, 0, 1), 1000};
  return ray;
}
void shoot(uint x, uint flags, inout Payload p) {
  ++calls;
  if (x & 1) p.color += 1;
  TraceRay(scene, flags, 0xFF, 0, 1, 0, towards(x), p);
}
void put(uint3 id, uint word, Payload p) {
  put(id, word, p.x);
  for (uint i = 0; i < 4; ++i) put(id, word + 1 + i, p.color[i]);
  put(id, word + 5, p.index.x + 100 * p.index.y);
}
)";

inline constexpr WideCase kWideRayCases[] = {
    {"all", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  Payload p = {id.x, 1, 2, 3, 4, 0, 0, 0};
  TraceRay(scene, 0, 0xFF, 0, 1, 0, towards(mix(id.x)), p);
  put(id, 0, p);
})"},
    {"some", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  Payload p = {x, 1, 2, 3, 4, 0, 0, 0};
  if (x % 7 == 0) return;
  if (x & 8) {
    shoot(x, x & 16 ? RAY_FLAG_CULL_BACK_FACING_TRIANGLES : RAY_FLAG_NONE, p);
  } else {
    p.color = id.x;
  }
  put(id, 0, p);
  put(id, 6, calls);
})"},
    {"loops_left_by_rays", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  Payload kept = (Payload)0;
  for (uint i = 0; i < (x & 7); ++i) {
    Payload p = kept;
    p.x = x + i;
    if ((x >> i) % 3 == 0) continue;
    shoot(x ^ i, 0, p);
    if (p.color.w > 900) break;
    kept.color += p.color;
    kept.index += p.index;
    shoot(x + i, RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, kept);
  }
  put(id, 0, kept);
  put(id, 6, calls);
})"},
    {"an_array_of_payloads", R"(
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
  const uint x = mix(id.x);
  Payload all[2] = {(Payload)0, (Payload)0};
  shoot(x, 0, all[x & 1]);
  shoot(x + 1, 0, all[0]);
  put(id, 0, all[0]);
  put(id, 6, all[1]);
  put(id, 12, DispatchRaysDimensions().x);
})"},
};

}  // namespace kaamos::test
