// SPDX-License-Identifier: MIT
// FEATURE: extended function templates that are declared before they are defined
// EXPECT f32 0 5
// EXPECT f32 4 6
// EXPECT f32 8 13
// EXPECT u32 12 4
// EXPECT u32 16 2
RWByteAddressBuffer results : register(u0);

// The default arguments stand in the declaration.
template <bool Sum = true, typename T>
T combine(T a, T b = 2.0f);

template <typename T>
uint count(T v);
template <typename T>
uint count(vector<T, 2> v);

float early(float a) { return combine(a); }

template <bool IsSum, typename Number>
Number combine(Number a, Number b) {
  return IsSum ? a + b : a * b;
}

template <typename U>
uint count(vector<U, 2> v) {
  return 2;
}
template <typename U>
uint count(U v) {
  return 4;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  const float three = 3.0f + z;
  results.Store(0, asuint(early(three)));
  results.Store(4, asuint(combine<false>(three)));
  results.Store(8, asuint(combine(three, 10.0f)));
  results.Store(12, count(three));
  results.Store(16, count<float>(float2(three, three)));
}
