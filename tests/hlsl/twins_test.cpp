// SPDX-License-Identifier: MIT
//
// Arithmetic on Vulkan against arithmetic on the CPU: the same operators, conversions and
// intrinsics of every scalar type on the same values, which are edge cases and random bits. The
// interpreter gives the expected results with the C++ prelude's arithmetic; the GLSL prelude must
// give the same bits, or be within a few units in the last place where D3D allows it. [D3D11.3 3.1]
#include <gtest/gtest.h>
#include <rtapi/rtapi.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/vulkan/support.h"
#include "twin_device.h"

namespace kaamos::test {
namespace {

using namespace rtapi;

constexpr uint32_t kThreads = 64;
constexpr uint32_t kTuples = 4096;

// An expression in a, b, c of one type. result: 'T' that type, 'f' float, 'h' float16, 'd' double,
// 'u' anything else, compared bit by bit.
struct Operation {
  const char* text;
  char result = 'T';
  int ulps = 0;
  bool squares = false;  // skips operands whose square is denormal
};

const std::vector<Operation> kFloatOperations = {{"a + b"},
                                                 {"a - b"},
                                                 {"a * b"},
                                                 {"a / b"},
                                                 {"a % b"},
                                                 {"-a"},
                                                 {"a < b", 'u'},
                                                 {"a <= b", 'u'},
                                                 {"a > b", 'u'},
                                                 {"a >= b", 'u'},
                                                 {"a == b", 'u'},
                                                 {"a != b", 'u'},
                                                 {"!a", 'u'},
                                                 {"!(a < b)", 'u'},
                                                 {"!(a >= b)", 'u'},
                                                 {"(bool)a", 'u'},
                                                 {"(int)a", 'u'},
                                                 {"(uint)a", 'u'},
                                                 {"(int64_t)a", 'u'},
                                                 {"(uint64_t)a", 'u'},
                                                 {"(int16_t)a", 'u'},
                                                 {"(uint16_t)a", 'u'},
                                                 {"(float)a", 'f'},
                                                 {"(double)a", 'd'},
                                                 {"(float16_t)a", 'h'},
                                                 {"abs(a)"},
                                                 {"sign(a)", 'u'},
                                                 {"min(a, b)"},
                                                 {"max(a, b)"},
                                                 {"clamp(a, b, c)"},
                                                 {"saturate(a)"},
                                                 {"ceil(a)"},
                                                 {"floor(a)"},
                                                 {"round(a)"},
                                                 {"trunc(a)"},
                                                 {"frac(a)"},
                                                 {"sqrt(a)"},
                                                 {"rsqrt(a)", 'T', 1},
                                                 {"rcp(a)"},
                                                 {"fmod(a, b)"},
                                                 {"lerp(a, b, c)"},
                                                 {"mad(a, b, c)"},
                                                 {"step(a, b)"},
                                                 {"smoothstep(a, b, c)", 'T', 0, true},
                                                 {"isnan(a)", 'u'},
                                                 {"isinf(a)", 'u'},
                                                 {"isfinite(a)", 'u'},
                                                 {"isnormal(a)", 'u'},
                                                 {"any(a)", 'u'},
                                                 {"select(a < b, a, b)"},
                                                 {"a < b ? a : b"},
                                                 {"frexp_mantissa(a)"},
                                                 {"frexp_exponent(a)"},
                                                 {"modf_integer(a)"},
                                                 {"modf_fraction(a)"},
                                                 {"degrees(a)"},
                                                 {"radians(a)"},
                                                 {"dot(T3(a, b, c), T3(c, a, b))"},
                                                 {"cross(T3(a, b, c), T3(b, c, a)).x"},
                                                 {"reflect(T2(a, b), T2(b, c)).x"}};
// Not for double.
const std::vector<Operation> kElementary = {{"sin(a)", 'T', 4},
                                            {"cos(a)", 'T', 4},
                                            {"tan(a)", 'T', 8},
                                            {"asin(a)", 'T', 4},
                                            {"acos(a)", 'T', 4},
                                            {"atan(a)", 'T', 4},
                                            {"atan2(a, b)", 'T', 4},
                                            {"sinh(a)", 'T', 4},
                                            {"cosh(a)", 'T', 4},
                                            {"tanh(a)", 'T', 4},
                                            {"exp(a)", 'T', 4},
                                            {"exp2(a)", 'T', 4},
                                            {"log(a)", 'T', 4},
                                            {"log2(a)", 'T', 4},
                                            {"log10(a)", 'T', 4},
                                            {"pow(a, b)", 'T', 4},
                                            {"ldexp(a, clamp(b, T(-12), T(12)))", 'T', 4},
                                            {"length(T2(a, b))", 'T', 2, true},
                                            {"normalize(T3(a, b, c)).x", 'T', 3, true},
                                            {"lit(a, b, c).z", 'T', 4}};
const std::vector<Operation> kFloat32Operations = {
    {"asuint(a)", 'u'}, {"asint(a)", 'u'}, {"f32tof16(a)", 'u'}};
const std::vector<Operation> kDoubleOperations = {
    {"fma(a, b, c)"}, {"low_bits(a)", 'u'}, {"high_bits(a)", 'u'}};
const std::vector<Operation> kIntegerOperations = {{"a + b"},
                                                   {"a - b"},
                                                   {"a * b"},
                                                   {"a / b"},
                                                   {"a % b"},
                                                   {"-a"},
                                                   {"~a"},
                                                   {"a & b"},
                                                   {"a | b"},
                                                   {"a ^ b"},
                                                   {"a << b"},
                                                   {"a >> b"},
                                                   {"a < b", 'u'},
                                                   {"a <= b", 'u'},
                                                   {"a > b", 'u'},
                                                   {"a >= b", 'u'},
                                                   {"a == b", 'u'},
                                                   {"a != b", 'u'},
                                                   {"!a", 'u'},
                                                   {"(bool)a", 'u'},
                                                   {"(int)a", 'u'},
                                                   {"(uint)a", 'u'},
                                                   {"(int64_t)a", 'u'},
                                                   {"(uint64_t)a", 'u'},
                                                   {"(int16_t)a", 'u'},
                                                   {"(uint16_t)a", 'u'},
                                                   {"(float)a", 'f'},
                                                   {"(double)a", 'd'},
                                                   {"(float16_t)a", 'h'},
                                                   {"abs(a)"},
                                                   {"sign(a)", 'u'},
                                                   {"min(a, b)"},
                                                   {"max(a, b)"},
                                                   {"clamp(a, b, c)"},
                                                   {"mad(a, b, c)"},
                                                   {"any(a)", 'u'},
                                                   {"all(a)", 'u'},
                                                   {"countbits(a)", 'u'},
                                                   {"firstbitlow(a)", 'u'},
                                                   {"firstbithigh(a)", 'u'},
                                                   {"reversebits(a)"},
                                                   {"dot(T2(a, b), T2(b, c))"},
                                                   {"select(a < b, a, b)"}};
const std::vector<Operation> kWordOperations = {{"asfloat(a)", 'u'},
                                                {"f16tof32(a)", 'f'},
                                                {"asdouble(a, b)", 'u'},
                                                {"msad4(a, T2(b, c), T4(a, b, c, a)).y", 'u'}};

struct ScalarType {
  const char* name;  // in HLSL
  char kind;         // f, h, d; i, u
  uint32_t bytes;
};
constexpr ScalarType kTypes[] = {{"float", 'f', 4},    {"float16_t", 'h', 2}, {"double", 'd', 8},
                                 {"int", 'i', 4},      {"uint", 'u', 4},      {"int16_t", 'i', 2},
                                 {"uint16_t", 'u', 2}, {"int64_t", 'i', 8},   {"uint64_t", 'u', 8}};

std::vector<Operation> operations_of(const ScalarType& type) {
  std::vector<Operation> out;
  const auto add = [&out](const std::vector<Operation>& more) {
    out.insert(out.end(), more.begin(), more.end());
  };
  const bool integer = type.kind == 'i' || type.kind == 'u';
  add(integer ? kIntegerOperations : kFloatOperations);
  if (type.kind == 'f' || type.kind == 'h') add(kElementary);
  if (type.kind == 'f') add(kFloat32Operations);
  if (type.kind == 'd') add(kDoubleOperations);
  if (std::string(type.name) == "uint") add(kWordOperations);
  return out;
}

std::string source_of(const ScalarType& type, const std::vector<Operation>& operations) {
  std::string text = R"(
typedef TYPE T;
typedef vector<TYPE, 2> T2;
typedef vector<TYPE, 3> T3;
typedef vector<TYPE, 4> T4;
ByteAddressBuffer values : register(t0);
RWByteAddressBuffer results : register(u0);
void put(uint at, uint v) { results.Store2(at, uint2(v, 0)); }
void put(uint at, int v) { results.Store2(at, uint2(asuint(v), 0)); }
void put(uint at, bool v) { results.Store2(at, uint2(v ? 1 : 0, 0)); }
void put(uint at, uint16_t v) { results.Store2(at, uint2(v, 0)); }
void put(uint at, int16_t v) { results.Store2(at, uint2(asuint16(v), 0)); }
void put(uint at, uint64_t v) { results.Store<uint64_t>(at, v); }
void put(uint at, int64_t v) { results.Store<int64_t>(at, v); }
void put(uint at, float v) { results.Store2(at, uint2(asuint(v), 0)); }
void put(uint at, float16_t v) { results.Store2(at, uint2(asuint16(v), 0)); }
void put(uint at, double v) { results.Store<double>(at, v); }
#if FLOATING
T frexp_mantissa(T x) { T e; return frexp(x, e); }
T frexp_exponent(T x) { T e; frexp(x, e); return e; }
T modf_integer(T x) { T i; modf(x, i); return i; }
T modf_fraction(T x) { T i; return modf(x, i); }
#endif
uint low_bits(double x) { uint low, high; asuint(x, low, high); return low; }
uint high_bits(double x) { uint low, high; asuint(x, low, high); return high; }
[shader("compute")]
[numthreads(THREADS, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
  const uint at = id.x * 24;
  const T a = values.Load<T>(at), b = values.Load<T>(at + 8), c = values.Load<T>(at + 16);
)";
  for (size_t i = 0; i < operations.size(); ++i) {
    text +=
        "  put((" + std::to_string(i * kTuples) + " + id.x) * 8, " + operations[i].text + ");\n";
  }
  const bool floating = type.kind != 'i' && type.kind != 'u';
  return "#define TYPE " + std::string(type.name) + "\n#define FLOATING " + (floating ? "1" : "0") +
         "\n#define THREADS " + std::to_string(kThreads) + text + "}\n";
}

// ---------------------------------------------------------------------------------------------
// Values

// Sign, exponent and fraction bits of the floating-point types.
struct FloatLayout {
  int exponent_bits, fraction_bits;
};
FloatLayout layout_of(char kind) {
  return kind == 'f' ? FloatLayout{8, 23} : kind == 'h' ? FloatLayout{5, 10} : FloatLayout{11, 52};
}
uint64_t infinity_of(char kind) {
  const FloatLayout l = layout_of(kind);
  return ((uint64_t{1} << l.exponent_bits) - 1) << l.fraction_bits;
}
uint64_t sign_of(char kind) {
  const FloatLayout l = layout_of(kind);
  return uint64_t{1} << (l.exponent_bits + l.fraction_bits);
}
bool is_nan(char kind, uint64_t bits) {
  return (bits & ~sign_of(kind)) > infinity_of(kind);
}
bool is_denormal(char kind, uint64_t bits) {
  const uint64_t magnitude = bits & ~sign_of(kind);
  return magnitude != 0 && magnitude >> layout_of(kind).fraction_bits == 0;
}

uint64_t random_value(const ScalarType& type, std::mt19937_64& random) {
  const uint64_t mask = type.bytes == 8 ? ~uint64_t{0} : (uint64_t{1} << type.bytes * 8) - 1;
  if (type.kind == 'i' || type.kind == 'u') {
    constexpr uint64_t kEdges[] = {0, 1, 2, 3, 31, 32, 33, 63, 64};
    const uint64_t pick = random() % 32;
    if (pick < 9) return kEdges[pick];
    if (pick < 14) return (uint64_t{0} - kEdges[pick - 9]) & mask;
    if (pick < 16) return (mask >> 1) + pick - 14;  // the ends of the signed range
    return (pick < 24 ? random() >> random() % 64 : random()) & mask;
  }
  const FloatLayout l = layout_of(type.kind);
  const uint64_t one = ((uint64_t{1} << (l.exponent_bits - 1)) - 1) << l.fraction_bits;
  const uint64_t sign = (random() & 1) != 0 ? sign_of(type.kind) : 0;
  const uint64_t pick = random() % 32;
  if (pick == 0) return sign;
  if (pick == 1) return infinity_of(type.kind) | sign;
  if (pick == 2) return infinity_of(type.kind) | uint64_t{1} << (l.fraction_bits - 1) | sign;
  if (pick == 3) return one | sign;
  if (pick == 4) return (one - (uint64_t{1} << l.fraction_bits)) | sign;
  if (pick == 5) return (infinity_of(type.kind) - 1) | sign;
  // Usually between 1/8 and 32, and rarely any bits at all.
  const uint64_t exponent = (one >> l.fraction_bits) - 3 + random() % 8;
  uint64_t bits =
      exponent << l.fraction_bits | (random() & ((uint64_t{1} << l.fraction_bits) - 1)) | sign;
  if (pick < 10) bits &= ~uint64_t{0} << (l.fraction_bits - 2);  // few digits: ties
  if (pick > 26) bits = random() & mask;
  // Vulkan lets the driver decide whether denormal numbers are flushed to zero. So does D3D.
  return is_denormal(type.kind, bits) ? one : bits;
}

double number(char kind, uint64_t bits) {
  if (kind == 'd') return std::bit_cast<double>(bits);
  if (kind == 'f') return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits)));
  const int exponent = static_cast<int>(bits >> 10 & 31);
  const double fraction = static_cast<double>(bits & 1023);
  const double magnitude =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(fraction + 1024, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

// Tells whether the square of a value is a normal number or zero.
bool has_square(const ScalarType& type, uint64_t bits) {
  const uint64_t magnitude = bits & ~sign_of(type.kind);
  const FloatLayout l = layout_of(type.kind);
  return magnitude == 0 || magnitude >> l.fraction_bits >= uint64_t{1} << (l.exponent_bits - 2);
}

// Maps values to integers so that neighbouring values differ by 1.
int64_t place(char kind, uint64_t bits) {
  const auto magnitude = static_cast<int64_t>(bits & ~sign_of(kind));
  return (bits & sign_of(kind)) != 0 ? -magnitude : magnitude;
}

bool agree(const Operation& operation, char kind, uint64_t expected, uint64_t actual) {
  if (expected == actual) return true;
  if (kind == 'u' || kind == 'i') return false;
  if (is_nan(kind, expected) || is_nan(kind, actual)) {
    return is_nan(kind, expected) && is_nan(kind, actual);
  }
  if (is_denormal(kind, expected)) expected &= sign_of(kind);
  if (is_denormal(kind, actual)) actual &= sign_of(kind);
  const int64_t distance = place(kind, expected) - place(kind, actual);
  // The largest denormal number and the smallest normal one may be one rounding apart.
  const int64_t smallest = int64_t{1} << layout_of(kind).fraction_bits;
  const auto vanishes = [&](uint64_t bits) {
    return std::abs(place(kind, bits)) <= (operation.squares ? 3 * smallest : smallest);
  };
  return std::abs(distance) <= operation.ulps || (vanishes(expected) && vanishes(actual));
}

// ---------------------------------------------------------------------------------------------

std::vector<uint64_t> run(const char* backend, const std::string& source,
                          const std::vector<uint64_t>& values, size_t result_count) {
  TwinDevice twin(backend);
  Compiled code;
  const ShaderLibrary library = twin.compile(source, code);
  if (!library) return {};
  const Buffer input = CreateUploadBuffer(twin.device, values).value();
  const Buffer output = twin.output(result_count * 8);
  RootSignatureDesc desc;
  desc.Parameters = {RootParameter::Srv(0, 0), RootParameter::Uav(0, 0)};
  const RootSignature root = twin.device.CreateRootSignature(desc).value();
  CommandList list = twin.device.CreateCommandList().value();
  list.SetComputeRootSignature(root);
  list.SetPipelineState(twin.device.CreateComputePipelineState({root, library, "", ""}).value());
  list.SetComputeRootShaderResourceView(0, input.GetGPUVirtualAddress());
  list.SetComputeRootUnorderedAccessView(1, output.GetGPUVirtualAddress());
  list.Dispatch(kTuples / kThreads, 1, 1);
  twin.queue.ExecuteAndWait(list).value();
  const std::vector<std::byte> bytes = ReadbackBuffer(twin.device, twin.queue, output).value();
  std::vector<uint64_t> results(result_count);
  std::memcpy(results.data(), bytes.data(), result_count * 8);
  return results;
}

void compare_type(const ScalarType& type) {
  const std::vector<Operation> operations = operations_of(type);
  const std::string source = source_of(type, operations);
  std::mt19937_64 random(1);
  std::vector<uint64_t> values(kTuples * 3);
  for (uint64_t& value : values) value = random_value(type, random);
  const size_t count = operations.size() * kTuples;
  const auto expected = run("embree", source, values, count);
  const auto actual = run("vulkan", source, values, count);
  ASSERT_EQ(expected.size(), count);
  ASSERT_EQ(actual.size(), count);
  for (size_t op = 0; op < operations.size(); ++op) {
    const char kind = operations[op].result == 'T' ? type.kind : operations[op].result;
    size_t wrong = 0;
    std::string first;
    for (size_t i = 0; i < kTuples; ++i) {
      const uint64_t e = expected[op * kTuples + i], a = actual[op * kTuples + i];
      const bool counts = !operations[op].squares ||
                          (has_square(type, values[i * 3]) && has_square(type, values[i * 3 + 1]) &&
                           has_square(type, values[i * 3 + 2]));
      if (!counts || agree(operations[op], kind, e, a)) continue;
      if (++wrong > 3) continue;
      char line[256];
      const auto show = [](char k, uint64_t bits) {
        return k == 'u' || k == 'i' ? static_cast<double>(static_cast<int64_t>(bits))
                                    : number(k, bits);
      };
      std::snprintf(line, sizeof(line),
                    "  (%.9g %.9g %.9g; a = 0x%llx): expected %.9g 0x%llx, is %.9g 0x%llx\n",
                    show(type.kind, values[i * 3]), show(type.kind, values[i * 3 + 1]),
                    show(type.kind, values[i * 3 + 2]),
                    static_cast<unsigned long long>(values[i * 3]), show(kind, e),
                    static_cast<unsigned long long>(e), show(kind, a),
                    static_cast<unsigned long long>(a));
      first += line;
    }
    EXPECT_EQ(wrong, 0u) << type.name << ": " << operations[op].text << "\n" << first;
  }
}

class VulkanTwins : public testing::TestWithParam<ScalarType> {};

TEST_P(VulkanTwins, GiveWhatTheCpuGives) {
  KAAMOS_NEED_VULKAN();
  compare_type(GetParam());
}
INSTANTIATE_TEST_SUITE_P(Scalars, VulkanTwins, testing::ValuesIn(kTypes),
                         [](const auto& scalar) { return std::string(scalar.param.name); });

}  // namespace
}  // namespace kaamos::test
