// SPDX-License-Identifier: MIT
// Tests what the checker refuses or warns about in uses of resources, with line and column: `@`
// marks the place.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/hlsl/check/check_test_support.h"

namespace kaamos::hlsl {
namespace {

using Id = DiagnosticId;

struct Mistake {
  const char* name;
  Id id;
  std::string text;
  FrontendOptions options = {};
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.text;
}

const char kMultisampled[] =
    "Texture2DMS<float4, 8> t;\nTexture2DMSArray<uint> a;\nRWTexture2DMS<float> w;\n"
    "static float4 x;\nstatic uint n;\n";

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all = {
      // Multisampled textures
      {"MultisampledElement", Id::kMissingElement, kernel("", "@Texture2DMS t;")},
      {"MultisampledOfStruct", Id::kElementType,
       kernel("", "struct S { int a; };\nTexture2DMSArray<@S> t;")},
      {"MultisampledArguments", Id::kTemplateCount, kernel("", "@Texture2DMS<float, 2, 3> t;")},
      {"MultisampledCount", Id::kNotConstant,
       kernel("int k = 2;\nRWTexture2DMS<float, @k> t = ResourceDescriptorHeap[0];")},
      {"MultisampledScalarIndex", Id::kTexelIndex, kernel("x = t[@0];", kMultisampled)},
      {"MultisampledShortIndex", Id::kTexelIndex, kernel("n = a[@uint2(1, 2)];", kMultisampled)},
      {"MultisampledLongIndex", Id::kTexelIndex,
       kernel("x = t.sample[1][@uint3(1, 2, 3)];", kMultisampled)},
      {"MultisampledSampleAlone", Id::kConversion, kernel("x @= t.sample[1];", kMultisampled)},
      {"MultisampledMips", Id::kNoMembers, kernel("x = t.@mips[0][uint2(0, 0)];", kMultisampled)},
      {"MultisampledLoad", Id::kArgumentCount, kernel("x = t.@Load(int2(0, 0));", kMultisampled)},
      {"MultisampledLoadOffset", Id::kConversion,
       kernel("x = t.Load(int2(0, 0), 1, @a);", kMultisampled)},
      {"MultisampledSampled", Id::kNoSuchMethod,
       kernel("x = t.@SampleLevel(s, float2(0, 0), 0);",
              std::string(kMultisampled) + "SamplerState s;")},
      {"MultisampledWrite", Id::kConstPlace, kernel("t[uint2(0, 0)] @= 1;", kMultisampled)},
      {"MultisampledDimensions", Id::kArgumentCount,
       kernel("a.@GetDimensions(n, n, n);", kMultisampled)},
      {"MultisampledStatus", Id::kArgumentCount,
       kernel("x.x = w.@Load(int2(0, 0), 1, n, n);", kMultisampled)},
      // Counters
      {"AppendIndexed", Id::kNotIndexable,
       kernel("uint x = a[@0];", "AppendStructuredBuffer<uint> a;")},
      {"AppendConsumed", Id::kNoSuchMethod,
       kernel("uint x = a.@Consume();", "AppendStructuredBuffer<uint> a;")},
      {"ConsumeAppended", Id::kNoSuchMethod,
       kernel("a.@Append(1);", "ConsumeStructuredBuffer<uint> a;")},
      {"ConsumeCount", Id::kArgumentCount,
       kernel("uint x = a.@Consume(1);", "ConsumeStructuredBuffer<uint> a;")},
      {"AppendElement", Id::kConversion,
       kernel("a.Append(@1.5);", "struct S { float2 v; };\nAppendStructuredBuffer<S> a;")},
      {"AppendWithoutElement", Id::kMissingElement, kernel("", "@AppendStructuredBuffer a;")},
      {"CounterOfReadOnly", Id::kNoSuchMethod,
       kernel("uint x = a.@IncrementCounter();", "StructuredBuffer<uint> a;")},
      {"CounterBothWays", Id::kCounterBothWays,
       kernel("a.IncrementCounter();\na.@DecrementCounter();", "RWStructuredBuffer<uint> a;")},
      // Texels of 64 bits
      {"SampledPairs", Id::kSampledPairs,
       kernel("uint64_t x = t.@SampleLevel(s, float2(0, 0), 0);",
              "Texture2D<uint64_t> t;\nSamplerState s;")},
      {"GatheredPairs", Id::kSampledPairs,
       kernel("double4 x = t.@Gather(s, float2(0, 0));", "Texture2D<double> t;\nSamplerState s;")},
      {"ThreePairs", Id::kElementType, kernel("", "RWBuffer<@int64_t3> t;")},
      {"FourDoubles", Id::kElementType, kernel("", "Texture2D<@double4> t;")},
      {"AtomicOnPartOfTexel", Id::kAtomicTarget,
       kernel("InterlockedAdd(t[0].@x, 1ull);", "RWBuffer<uint64_t2> t;")},
      // Packed numbers
      {"Dot2AddWithoutHalf", Id::kNeeds16Bit,
       kernel("half2 h = 1;\nfloat x = @dot2add(h, h, 1.0);")},
      {"Dot4AddCount", Id::kArgumentCount, kernel("uint x = @dot4add_u8packed(1, 2);")},
      {"AddUint64OfThree", Id::kIntrinsicArgument,
       kernel("uint3 v = 1;\nuint3 x = AddUint64(@v, v);")},
      {"AddUint64Shapes", Id::kConversion,
       kernel("uint4 v = 1;\nuint4 x = AddUint64(v, @uint2(1, 2));")},
      {"AsDoubleOfMatrix", Id::kIntrinsicArgument,
       kernel("uint2x2 m = 1;\ndouble2x2 x = asdouble(@m, m);")},
      // Root signatures
      {"RootSignatureNumber", Id::kRootSignatureAttribute,
       "[shader(\"compute\")][numthreads(1, 1, 1)]\n[@RootSignature(3)] void main() {}"},
      {"RootSignatureEmpty", Id::kRootSignatureAttribute,
       "[shader(\"compute\")][numthreads(1, 1, 1)]\n[@RootSignature] void main() {}"},
      // The namespace vk
      {"VkFunction", Id::kVkIgnored, kernel("uint64_t t = vk::@ReadClock(vk::DeviceScope);")},
      {"VkLoad", Id::kVkIgnored, kernel("float4 v = vk::@RawBufferLoad<float4>(1, 16);")},
      {"VkStore", Id::kVkIgnored, kernel("vk::@RawBufferStore<float>(1, 2.0);")},
      {"VkExecutionMode", Id::kVkIgnored, kernel("vk::@ext_execution_mode(38, 8, 8, 1);")},
      {"VkLoadCount", Id::kArgumentCount, kernel("uint v = vk::@RawBufferLoad(1, 2, 3);")},
      {"VkLoadOfResource", Id::kElementType, kernel("vk::@RawBufferLoad<ByteAddressBuffer>(1);")},
      {"VkClockOfType", Id::kNotATemplate, kernel("vk::@ReadClock<uint>(1);")},
      {"VkUnknown", Id::kUndeclared, kernel("uint x = @vk::nothing(1);")},
      {"VkUnknownConstant", Id::kUndeclared, kernel("uint x = @vk::NoScope;")},
  };
  return all;
}

class ObjectErrors : public testing::TestWithParam<Mistake> {};

TEST_P(ObjectErrors, IsReportedAtItsPlace) {
  const Mistake& mistake = GetParam();
  std::string text = mistake.text;
  const size_t mark = text.find('@');
  ASSERT_NE(mark, std::string::npos);
  text.erase(mark, 1);
  const auto begin = text.begin();
  const auto line = 1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(mark), '\n');
  const size_t previous = mark == 0 ? std::string::npos : text.rfind('\n', mark - 1);
  const size_t column = mark - (previous == std::string::npos ? 0 : previous + 1) + 1;
  const Compilation compilation(text, mistake.options);
  bool found = false;
  for (const Diagnostic& diagnostic : compilation.diagnostics()) {
    if (diagnostic.id != mistake.id) continue;
    const ResolvedLocation location = compilation.resolve(diagnostic.location);
    found = found || (location.line == static_cast<uint32_t>(line) && location.column == column);
  }
  EXPECT_TRUE(found) << "expected " << line << ":" << column << "\n" << compilation.messages();
}

INSTANTIATE_TEST_SUITE_P(All, ObjectErrors, testing::ValuesIn(mistakes()),
                         [](const testing::TestParamInfo<Mistake>& one) { return one.param.name; });

}  // namespace
}  // namespace kaamos::hlsl
