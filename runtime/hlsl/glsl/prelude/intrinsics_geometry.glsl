// SPDX-License-Identifier: MIT
// Vector geometry; the GLSL counterpart of kaamos/shader/intrinsics_geometry.h. Sums run from the
// first component to the last without fused multiply-add, so that every backend gives the same
// bits; float16 sums are kept in float and rounded once. The emitter handles matrices.

// The sum in its accumulation type: k_dot before it is rounded to float16.
//@ k_dot_sum i16 u16 i32 u32 i64 u64 f32 f64 scalar
$T k_dot_sum($T a, $T b) { return a * b; }
//@ k_dot_sum i16 u16 i32 u32 i64 u64 f32 f64 vector
$S k_dot_sum($T a, $T b) {
  precise $T products = a * b;
  precise $S sum = products.x + products.y;
  for (int i = 2; i < $N; ++i) sum += products[i];
  return sum;
}
//@ k_dot_sum f16 any
float k_dot_sum($T a, $T b) { return k_dot_sum($F(a), $F(b)); }
//@ k_dot ints floats any
$S k_dot($T a, $T b) { return $S(k_dot_sum(a, b)); }

//@ k_length floats scalar
$T k_length($T v) { return abs(v); }
//@ k_length floats vector
$S k_length($T v) { return $S(sqrt(k_dot_sum(v, v))); }
//@ k_distance floats any
$S k_distance($T a, $T b) { return k_length(b - a); }
// The zero vector gives NaN.
//@ k_normalize f32 f64 any
$T k_normalize($T v) { return v * ($S(1) / sqrt(k_dot_sum(v, v))); }
//@ k_normalize f16 any
$T k_normalize($T v) { return v * float16_t(1.0 / sqrt(k_dot_sum(v, v))); }

//@ k_cross f32 scalar
vec3 k_cross(vec3 a, vec3 b) {
  precise vec3 r = a.yzx * b.zxy - a.zxy * b.yzx;
  return r;
}
//@ k_cross f16 scalar
f16vec3 k_cross(f16vec3 a, f16vec3 b) {
  precise f16vec3 r = a.yzx * b.zxy - a.zxy * b.yzx;
  return r;
}
//@ k_cross f64 scalar
dvec3 k_cross(dvec3 a, dvec3 b) {
  precise dvec3 r = a.yzx * b.zxy - a.zxy * b.yzx;
  return r;
}

//@ k_reflect floats any
$T k_reflect($T incident, $T normal) {
  precise $T r = incident - $S(k_dot_sum(incident, normal) * $W(2)) * normal;
  return r;
}
// Zero on total internal reflection.
//@ k_refract floats any
$T k_refract($T incident, $T normal, $S eta) {
  precise $W e = $W(eta);
  precise $W cosine = k_dot_sum(incident, normal);
  precise $W k = $W(1) - e * e * ($W(1) - cosine * cosine);
  if (!(k >= $W(0))) return $0;
  precise $T r = eta * incident - $S(e * cosine + sqrt(k)) * normal;
  return r;
}
//@ k_faceforward floats any
$T k_faceforward($T normal, $T incident, $T geometric_normal) {
  return k_dot_sum(incident, geometric_normal) < $W(0) ? normal : -normal;
}

// {1, max(n.l, 0), n.l and n.h not negative: pow(n.h, m), 1}
//@ k_lit f32 scalar
vec4 k_lit(float n_dot_l, float n_dot_h, float m) {
  bool behind = n_dot_l < 0.0 || n_dot_h < 0.0;
  return vec4(1.0, n_dot_l < 0.0 ? 0.0 : n_dot_l, behind ? 0.0 : k_pow(n_dot_h, m), 1.0);
}
//@ k_lit f16 scalar
f16vec4 k_lit(float16_t n_dot_l, float16_t n_dot_h, float16_t m) {
  return f16vec4(k_lit(float(n_dot_l), float(n_dot_h), float(m)));
}
//@ k_lit f64 scalar
dvec4 k_lit(double n_dot_l, double n_dot_h, double m) {
  return dvec4(k_lit(float(n_dot_l), float(n_dot_h), float(m)));
}
// {1, a.y * b.y, a.z, b.w}
//@ k_dst f32 scalar
vec4 k_dst(vec4 a, vec4 b) { return vec4(1.0, a.y * b.y, a.z, b.w); }
//@ k_dst f16 scalar
f16vec4 k_dst(f16vec4 a, f16vec4 b) { return f16vec4(1.0, a.y * b.y, a.z, b.w); }
//@ k_dst f64 scalar
dvec4 k_dst(dvec4 a, dvec4 b) { return dvec4(1.0, a.y * b.y, a.z, b.w); }
