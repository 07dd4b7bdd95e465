// SPDX-License-Identifier: MIT
// FEATURE: extended vectors of 5 to 1,024 components
// OPTIONS: -T lib_6_9
// EXPECT f32 0 1 3 5 7 9 11 13 15
// EXPECT f32 32 0.5 1.5 2.5 3.5 4.5 7.5
// EXPECT f32 56 0.5 4.5 0.5 4.5
// EXPECT i32 72 -1 0 1 -2 3
// EXPECT f32 92 9 11 13
// EXPECT f32 104 11 -1 7
// EXPECT i32 116 2 3 5 9 17 33
// EXPECT u32 140 0 1 0 1
// EXPECT f32 156 8 7 6 5 4 3 2 1
// EXPECT f32 188 8 7 6 5 1 2 3 4
// EXPECT f32 220 11 22 31 52
// EXPECT f32 236 7 2 4 3 8 6
// EXPECT u32 260 523776 1023 1025
// EXPECT f32 272 1 3 5 7 9 11
RWByteAddressBuffer results : register(u0);

static const vector<float, 6> halves = {0.5, 1.5, 2.5, 3.5, 4.5, 5.5};
static vector<int, 6> powers = vector<int, 6>(1, 2, 4, 8, 16, 32);

struct Tagged {
  uint tag;
  vector<float, 6> values;
};

vector<float, 5> sum_of(vector<float, 5> a, in vector<float, 5> b) {
  return a + b;
}
void change(inout vector<float, 5> a, out vector<float, 5> b) {
  b = a * 2;
  a += 10;
}
Tagged tagged(vector<float, 6> values) {
  Tagged result = {7, values};
  result.values[0] = result.tag;
  return result;
}
template <typename T, int N>
T last_of(vector<T, N> v) {
  return v[N - 1];
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const float z = results.Load(65532);  // 0, known at run time only
  vector<float, 8> a = {1, 2, 3, 4, 5, 6, 7, 8};
  a += z;
  vector<float, 8> b = 2;
  b = a * b - 1;
  results.Store(0, b);

  // Made of arrays and shorter vectors; the last component is another one.
  float five[5] = {0.5, 1.5, 2.5, 3.5, 4.5 + z};
  vector<float, 6> c = {five, 7.5};
  results.Store(32, c);
  vector<float, 10> d = {five, five};
  const vector<float, 5> from_array = (vector<float, 5>)five;
  results.Store(56, float4(d[0], d[4], d[5 + (uint)z], from_array[4]));

  // Conversions of all components, to fewer, and to a short vector.
  vector<float, 7> e = {-1.75, 0.25, 1.5, -2.5, 3.75, 9, 9};
  results.Store(72, (vector<int, 5>)(e + z));
  results.Store(92, (float3)vector<float, 5>(b[4], b[5], b[6], b[0], b[0]));

  // Components by indices that are known late.
  const uint late = (uint)z;
  b[late + 3] = -1;
  results.Store(104, float3(b[5 + late], b[3], (a + late)[6 + late]));

  // A static variable; increments; operators of integers.
  powers++;
  results.Store(116, powers);

  // Comparisons, reductions and choices.
  const vector<bool, 8> above = a > 4.5;
  results.Store4(140, uint4(all(above), any(above), all(a == b), any(!above)));

  // What is assigned to reads itself, component by component.
  a = vector<float, 8>(a[7], a[6], a[5], a[4], a[3], a[2], a[1], a[0]);
  results.Store(156, a);
  a = vector<float, 8>((float4)a, a[7], a[6], a[5], a[4]);
  results.Store(188, a);

  // Parameters, by value and by reference, and elements of arrays.
  vector<float, 5> rows[2];
  rows[late] = vector<float, 5>(1, 2, 3, 4, 5);
  change(rows[0], rows[1 + late]);
  rows[1 - late] = sum_of(rows[1], rows[0] * 2);
  rows[1][4] += last_of(rows[0]) - 3;
  rows[0] = late == 0 ? rows[0] : rows[1];
  results.Store(220, float4(rows[0][0], (float)rows[1][0] - 2, rows[1][1] + 3, rows[1][4]));

  // Fields, and a vector that a condition chooses.
  const Tagged t = tagged(vector<float, 6>(1, 2, 3 + z, 4, 5, 6));
  Tagged u = t;
  u.values[4] += 3;
  const vector<float, 6> chosen = late == 1 ? t.values : u.values;
  results.Store(236, vector<float, 6>((float2)chosen, chosen[3], chosen[2], chosen[4], chosen[5]));

  // The longest.
  vector<uint, 1024> longest;
  for (uint i = 0; i < 1024; ++i) longest[i] = i;
  const vector<uint, 1024> ones = 1;
  const vector<uint, 1024> more = longest + 2;
  results.Store3(260, uint3(dot(longest, ones), longest[1023], more[1023]));
  results.Store(272, halves * 2 + z);
}
