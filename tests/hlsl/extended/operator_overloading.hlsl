// SPDX-License-Identifier: MIT
// FEATURE: extended operator overloading
// EXPECT f32 0 8.0
// EXPECT f32 4 12.0
// EXPECT u32 8 0
struct Complex {
  float re, im;
  Complex operator+(Complex o) {
    Complex r = {re + o.re, im + o.im};
    return r;
  }
  Complex operator*(float s) {
    Complex r = {re * s, im * s};
    return r;
  }
  bool operator==(Complex o) { return re == o.re && im == o.im; }
  float operator[](uint i) { return i == 0 ? re : im; }
};
RWByteAddressBuffer results : register(u0);

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Complex a = {1, 2 + z};
  Complex b = {3, 4};
  Complex c = (a + b) * 2;
  results.Store2(0, asuint(float2(c.re, c[1])));
  results.Store(8, a == b ? 1u : 0u);
}
