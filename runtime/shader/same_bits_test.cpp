// SPDX-License-Identifier: MIT
//
// Results have the same bits on every processor and with every compiler, NaNs aside: a hash of the
// results of each function for many operands is compared with the one that all of them had when it
// was written down. What the C library computes is not among the functions.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>

#include "kaamos/shader/prelude.h"
#include "kaamos/shader/wide_operators.h"
#include "runtime/shader/float_mode.h"
#include "runtime/shader/test_values.h"

namespace kaamos::shader {
namespace {

class Hash {
 public:
  void add(float x) { add_word(x == x ? std::bit_cast<uint32_t>(x) : 0x7FC00000u); }
  void add(double x) { add_word(x == x ? std::bit_cast<uint64_t>(x) : 0x7FF8000000000000u); }
  void add(int32_t x) { add_word(static_cast<uint32_t>(x)); }
  void add(uint32_t x) { add_word(x); }
  void add(half x) { add(to_float(x)); }
  void add(bool x) { add_word(x ? 1 : 0); }
  uint64_t value() const { return value_; }

 private:
  void add_word(uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3u; }

  uint64_t value_ = 0xCBF29CE484222325ull;
};

// Any bits, numbers near 1, and the values of test_values.h.
float next_operand(std::mt19937& random) {
  const uint32_t bits = random();
  switch (random() % 4) {
    case 0:
      return std::bit_cast<float>(bits);
    case 1:
      return kFloats[bits % std::size(kFloats)];
    default:
      return std::bit_cast<float>((bits & 0x83FFFFFFu) | 0x3C000000u);  // 2^-7 to 2
  }
}

struct Case {
  const char* name;
  void (*run)(Hash& hash, float x, float y, float z);
  uint64_t expected;
};

const Case kCases[] = {
    {"sum", [](Hash& h, float x, float y, float) { h.add(map<op::Add>(x, y)); },
     0xd677649e77e73ad6u},
    {"difference", [](Hash& h, float x, float y, float) { h.add(map<op::Subtract>(x, y)); },
     0x1a2e8ef7bf19e85u},
    {"product", [](Hash& h, float x, float y, float) { h.add(map<op::Multiply>(x, y)); },
     0x9a40fb01ebddeb03u},
    {"quotient", [](Hash& h, float x, float y, float) { h.add(map<op::Divide>(x, y)); },
     0x3d5acf0b48740a26u},
    {"comparisons",
     [](Hash& h, float x, float y, float) {
       h.add(map<op::Less>(x, y));
       h.add(map<op::GreaterEqual>(x, y));
       h.add(map<op::Equal>(x, y));
     },
     0x5508fd5169336789u},
    {"min, max, clamp",
     [](Hash& h, float x, float y, float z) {
       h.add(min(x, y));
       h.add(max(x, y));
       h.add(clamp(x, y, z));
     },
     0xd8702ee521b3e7aeu},
    {"mad", [](Hash& h, float x, float y, float z) { h.add(mad(x, y, z)); }, 0x2ea0024111103046u},
    {"lerp", [](Hash& h, float x, float y, float z) { h.add(lerp(x, y, z)); }, 0xf057d37107fd3ae8u},
    {"smoothstep", [](Hash& h, float x, float y, float z) { h.add(smoothstep(x, y, z)); },
     0x257eacd5a3cf803cu},
    {"dot, cross, normalize",
     [](Hash& h, float x, float y, float z) {
       const vec<float, 3> a = {{x, y, z}}, b = {{z, x, y}};
       h.add(dot(a, b));
       for (const float v : cross(a, b).e) h.add(v);
       for (const float v : normalize(a).e) h.add(v);
     },
     0x671bf2056321ddabu},
    {"sqrt, rsqrt, rcp",
     [](Hash& h, float x, float, float) {
       h.add(sqrt(x));
       h.add(rsqrt(x));
       h.add(rcp(x));
     },
     0xc197a05a067825b5u},
    {"exp", [](Hash& h, float x, float, float) { h.add(exp(x)); }, 0x5c3c449414ce51eu},
    {"sin, cos",
     [](Hash& h, float x, float, float) {
       if (!(abs(x) <= op::kLargestAngle)) return;  // the C library's
       h.add(sin(x));
       h.add(cos(x));
     },
     0x198385e9fcb13776u},
    {"floor, ceil, round, trunc, frac",
     [](Hash& h, float x, float, float) {
       h.add(floor(x));
       h.add(ceil(x));
       h.add(round(x));
       h.add(trunc(x));
       h.add(frac(x));
     },
     0xa56d6f3c3d6c0b17u},
    {"fmod", [](Hash& h, float x, float y, float) { h.add(fmod(x, y)); }, 0x6e81924731a7646bu},
    {"saturate, sign, abs",
     [](Hash& h, float x, float, float) {
       h.add(saturate(x));
       h.add(sign(x));
       h.add(abs(x));
     },
     0xad3ee91e9220cf33u},
    {"conversions",
     [](Hash& h, float x, float, float) {
       h.add(convert<int32_t>(x));
       h.add(convert<uint32_t>(x));
       h.add(convert<half>(x));
       h.add(convert<double>(x));
       h.add(convert<float>(std::bit_cast<int32_t>(x)));
       h.add(convert<float>(std::bit_cast<uint32_t>(x)));
     },
     0xa27199500862a8a3u},
    {"float16",
     [](Hash& h, float x, float y, float z) {
       const half a = convert<half>(x), b = convert<half>(y), c = convert<half>(z);
       h.add(map<op::Add>(a, b));
       h.add(map<op::Divide>(a, b));
       h.add(mad(a, b, c));
       h.add(rsqrt(a));
     },
     0x5c102f58b2697525u},
    {"double",
     [](Hash& h, float x, float y, float z) {
       const double a = x, b = y, c = z;
       h.add(map<op::Multiply>(a * 1.1, b * 1.3));
       h.add(mad(a * 1.1, b * 1.3, c));
       h.add(map<op::Divide>(a, b));
       h.add(sqrt(a));
     },
     0xdc8f9950a626b60u},
};

// The same for the threads that run side by side, in registers.
const Case kWideCases[] = {
    {"mad, lerp",
     [](Hash& h, float x, float y, float z) {
       const auto a = spread<wide<float>>(x), b = spread<wide<float>>(y),
                  c = spread<wide<float>>(z);
       h.add(get(map<op::Mad>(a, b, c), 3));
       h.add(get(map<op::Lerp>(a, b, c), 4));
     },
     0xc5e07bf521b1ade9u},
    {"min, max",
     [](Hash& h, float x, float y, float) {
       h.add(get(map<op::Min>(spread<wide<float>>(x), spread<wide<float>>(y)), 0));
       h.add(get(map<op::Max>(spread<wide<float>>(x), spread<wide<float>>(y)), 7));
     },
     0x8d009cd98ca6df1cu},
    {"rsqrt, exp, floor, round",
     [](Hash& h, float x, float, float) {
       const auto a = spread<wide<float>>(x);
       h.add(get(map<op::rsqrt_function>(a), 1));
       h.add(get(map<op::exp_function>(a), 2));
       h.add(get(map<op::floor_function>(a), 5));
       h.add(get(map<op::round_function>(a), 6));
     },
     0x651ea4de866bdcbdu},
    {"conversions",
     [](Hash& h, float x, float, float) {
       const auto a = spread<wide<float>>(x);
       h.add(get(map<op::Convert<int32_t>>(a), 1));
       h.add(get(map<op::Convert<uint32_t>>(a), 6));
       h.add(get(map<op::Convert<float>>(spread<wide<uint32_t>>(std::bit_cast<uint32_t>(x))), 2));
     },
     0x5ba4ef5714ac6389u},
};

void expect_bits(std::span<const Case> cases) {
  for (const Case& c : cases) {
    Hash hash;
    std::mt19937 random(1);
    {
      const FloatMode mode;
      for (int i = 0; i < 100000; ++i) {
        const float x = next_operand(random), y = next_operand(random), z = next_operand(random);
        c.run(hash, x, y, z);
      }
    }
    EXPECT_EQ(hash.value(), c.expected) << c.name << ": 0x" << std::hex << hash.value() << "ull";
  }
}

TEST(ShaderBits, AreTheSameOnEveryProcessor) {
  expect_bits(kCases);
}

TEST(ShaderBits, AreTheSameOnEveryProcessorForThreadsSideBySide) {
  expect_bits(kWideCases);
}

}  // namespace
}  // namespace kaamos::shader
