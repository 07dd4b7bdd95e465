// SPDX-License-Identifier: MIT
// FEATURE: extended members defined outside of the struct
// EXPECT u32 0 9
// EXPECT u32 4 5
// EXPECT u32 8 12
// EXPECT f32 12 3.5
// EXPECT u32 16 3
// EXPECT u32 20 2
// EXPECT u32 24 20
// EXPECT u32 28 45
// EXPECT u32 32 17
// EXPECT u32 36 6
RWByteAddressBuffer results : register(u0);

struct Counter {
  static const uint kStart;
  static uint count;
  static const uint kInside = 6;
  uint step;
  uint next();
  static uint total(uint extra);
  template <typename U>
  U scaled(U factor);
};
const uint Counter::kStart = 4;
uint Counter::count = kStart + 1;
const uint Counter::kInside;

uint Counter::next() {
  count += step;
  return count;
}
uint Counter::total(uint extra) {
  return count + extra;
}
template <typename U>
U Counter::scaled(U factor) {
  return factor * (U)step;
}

template <typename T, uint N>
struct Ring {
  static const uint kSize;
  static T sum;
  T values[N];
  T at(uint index);
  void set(uint index, T value);
  static uint wrap(uint index);
  template <typename U>
  U read(uint index);
};

// An instance may come first.
uint early(Ring<uint, 2> ring) { return ring.at(3); }

template <typename Element, uint Count>
const uint Ring<Element, Count>::kSize = Count;
template <typename T, uint N>
T Ring<T, N>::sum = (T)N;
template <typename T, uint N>
T Ring<T, N>::at(uint index) {
  return values[wrap(index)];
}
template <typename Item, uint Size>
void Ring<Item, Size>::set(uint index, Item value) {
  sum += value;
  values[wrap(index)] = value;
}
template <typename T, uint N>
uint Ring<T, N>::wrap(uint index) {
  return index % kSize;
}
template <typename T, uint N>
template <typename U>
U Ring<T, N>::read(uint index) {
  return (U)at(index) + (U)N;
}

namespace tools {
template <typename T>
struct Pair {
  T a;
  T b;
  T product();
};
template <typename T>
T Pair<T>::product() {
  return a * b;
}
}  // namespace tools

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  Counter counter = {4 + z};
  results.Store(4, Counter::count);
  results.Store(0, counter.next());
  results.Store(8, Counter::total(3));
  Ring<float, 3> ring = (Ring<float, 3>)0;
  ring.set(4, 0.5 + z);
  results.Store(12, asuint(ring.at(1) + Ring<float, 3>::sum - 0.5));
  results.Store(16, ring.read<uint>(1) + z);
  Ring<uint, 2> words = {1, 2};
  results.Store(20, early(words));
  results.Store(24, counter.scaled(5u));
  tools::Pair<uint> pair = {5 + z, 9};
  results.Store(28, pair.product());
  Ring<uint, 2>::sum += 15;
  results.Store(32, Ring<uint, 2>::sum + z);
  results.Store(36, Counter::kInside + z);
}
