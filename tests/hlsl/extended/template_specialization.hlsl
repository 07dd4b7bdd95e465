// SPDX-License-Identifier: MIT
// FEATURE: extended template specialization
// EXPECT u32 0 120
// EXPECT u32 4 7
// EXPECT u32 8 2
// EXPECT u32 12 3
// EXPECT u32 16 30
// EXPECT u32 20 12
// EXPECT u32 24 203
// EXPECT f32 28 2.5
// EXPECT u32 32 41
// EXPECT u32 36 5
// EXPECT u32 40 99
// EXPECT u32 44 8
// EXPECT u32 48 1
// EXPECT u32 52 10
RWByteAddressBuffer results : register(u0);

template <uint N>
struct Factorial {
  enum { kValue = N * Factorial<N - 1>::kValue };
};
template <>
struct Factorial<0> {
  enum { kValue = 1 };
};

// Ackermann's function.
template <uint M, uint N>
struct Ack {
  enum { kValue = Ack<M - 1, Ack<M, N - 1>::kValue>::kValue };
};
template <uint M>
struct Ack<M, 0> {
  enum { kValue = Ack<M - 1, 1>::kValue };
};
template <uint N>
struct Ack<0, N> {
  enum { kValue = N + 1 };
};
template <>
struct Ack<0, 0> {
  enum { kValue = 1 };
};

// Partial ones by the shape of a type; the one that says more is taken.
template <typename T>
struct Shape {
  static uint rank() { return 1; }
};
template <typename T, int N>
struct Shape<vector<T, N> > {
  static uint rank() { return 10 * N; }
};
template <int N>
struct Shape<vector<uint, N> > {
  static uint rank() { return 6 * N; }
};
template <typename T, int N>
struct Shape<T[N]> {
  static uint rank() { return 200 + N; }
};
template <>
struct Shape<half>;
template <>
struct Shape<half> {
  static uint rank() { return 41; }
};

template <typename A, typename B>
struct Same {
  static const uint value = 0;
};
template <typename A>
struct Same<A, A> {
  static const uint value = 1;
};

template <typename T>
T twice(T value) {
  return value + value;
}
template <>
float twice<float>(float value) {
  return value + 0.5;
}
template <>
bool twice(bool value) {
  return !value;
}
template <typename To, typename From>
To cast(From value);
template <>
uint cast<uint, int>(int value) {
  return value + 100;
}
template <typename T>
void change(in T by, inout T what, out T before) {
  before = what;
  what += by;
}
template <>
void change<uint>(in uint by, inout uint what, out uint before) {
  before = what + 1;
  what += 2 * by;
}

template <typename T>
struct Box {
  T value;
  T get() { return value; }
  template <typename U>
  U as() { return (U)value; }
};
template <>
uint Box<uint>::get() {
  return value + 1;
}

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  results.Store(0, Factorial<5>::kValue + z);
  results.Store(4, Ack<2, 2>::kValue + z);
  results.Store(8, Ack<0, 1>::kValue + z);
  results.Store(12, Ack<1, 1>::kValue + z);
  results.Store(16, Shape<float3>::rank() + z);
  results.Store(20, Shape<uint2>::rank() + z);
  results.Store(24, Shape<float[3]>::rank() + z);
  results.Store(28, asuint(twice(2.0f + z)));
  results.Store(32, Shape<half>::rank() + z);
  uint number = 3;
  uint before;
  change(1 + z, number, before);
  results.Store(36, number);
  results.Store(40, cast<uint, int>((int)z - 1));
  Box<uint> box = {7 + z};
  results.Store(44, box.get());
  results.Store(48, Same<float, float>::value + Same<float, int>::value + (twice(z == 0) ? 1 : 0));
  Box<int> other = {4 + z};
  results.Store(52, other.get() + twice((uint)other.as<float>() - 1));
}
