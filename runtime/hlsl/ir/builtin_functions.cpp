// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/builtin_functions.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

namespace kaamos::hlsl {
namespace {

using S = IntrinsicShape;
using I = Intrinsic;

constexpr IntrinsicRule kIntrinsics[] = {
    {"abs", I::abs, S::kNumeric, 1},
    {"acos", I::acos, S::kFloat, 1},
    {"all", I::all, S::kReduce, 1},
    {"any", I::any, S::kReduce, 1},
    {"asdouble", I::asdouble, S::kAsDouble, 2},
    {"asfloat", I::asfloat, S::kAsFloat, 1},
    {"asfloat16", I::asfloat16, S::kAsFloat16, 1},
    {"asin", I::asin, S::kFloat, 1},
    {"asint", I::asint, S::kAsInt, 1},
    {"asint16", I::asint16, S::kAsInt16, 1},
    {"asuint", I::asuint, S::kAsUint, 1},
    {"asuint16", I::asuint16, S::kAsUint16, 1},
    {"atan", I::atan, S::kFloat, 1},
    {"atan2", I::atan2, S::kFloat, 2},
    {"ceil", I::ceil, S::kFloat, 1},
    {"clamp", I::clamp, S::kNumeric, 3},
    {"cos", I::cos, S::kFloat, 1},
    {"cosh", I::cosh, S::kFloat, 1},
    {"countbits", I::countbits, S::kUint, 1},
    {"cross", I::cross, S::kCross, 2},
    {"degrees", I::degrees, S::kFloat, 1},
    {"determinant", I::determinant, S::kDeterminant, 1},
    {"distance", I::distance, S::kDistance, 2},
    {"dot", I::dot, S::kDot, 2},
    {"dst", I::dst, S::kDst, 2},
    {"exp", I::exp, S::kFloat, 1},
    {"exp2", I::exp2, S::kFloat, 1},
    {"f16tof32", I::f16tof32, S::kHalfToFloat, 1},
    {"f32tof16", I::f32tof16, S::kFloatToHalf, 1},
    {"faceforward", I::faceforward, S::kVector, 3},
    {"firstbithigh", I::firstbithigh, S::kUint, 1},
    {"firstbitlow", I::firstbitlow, S::kUint, 1},
    {"floor", I::floor, S::kFloat, 1},
    {"fma", I::fma, S::kDouble, 3},
    {"fmod", I::fmod, S::kFloat, 2},
    {"frac", I::frac, S::kFloat, 1},
    {"isfinite", I::isfinite, S::kTest, 1},
    {"isinf", I::isinf, S::kTest, 1},
    {"isnan", I::isnan, S::kTest, 1},
    {"isnormal", I::isnormal, S::kTest, 1},
    {"ldexp", I::ldexp, S::kFloat, 2},
    {"length", I::length, S::kLength, 1},
    {"lerp", I::lerp, S::kFloat, 3},
    {"lit", I::lit, S::kLit, 3},
    {"log", I::log, S::kFloat, 1},
    {"log10", I::log10, S::kFloat, 1},
    {"log2", I::log2, S::kFloat, 1},
    {"mad", I::mad, S::kNumeric, 3},
    {"max", I::max, S::kNumeric, 2},
    {"min", I::min, S::kNumeric, 2},
    {"msad4", I::msad4, S::kMsad4, 3},
    {"normalize", I::normalize, S::kVector, 1},
    {"pow", I::pow, S::kFloat, 2},
    {"radians", I::radians, S::kFloat, 1},
    {"rcp", I::rcp, S::kFloat, 1},
    {"reflect", I::reflect, S::kVector, 2},
    {"refract", I::refract, S::kRefract, 3},
    {"reversebits", I::reversebits, S::kUint, 1},
    {"round", I::round, S::kFloat, 1},
    {"rsqrt", I::rsqrt, S::kFloat, 1},
    {"saturate", I::saturate, S::kFloat, 1},
    {"sign", I::sign, S::kSign, 1},
    {"sin", I::sin, S::kFloat, 1},
    {"sinh", I::sinh, S::kFloat, 1},
    {"smoothstep", I::smoothstep, S::kFloat, 3},
    {"sqrt", I::sqrt, S::kFloat, 1},
    {"step", I::step, S::kFloat, 2},
    {"tan", I::tan, S::kFloat, 1},
    {"tanh", I::tanh, S::kFloat, 1},
    {"transpose", I::transpose, S::kTranspose, 1},
    {"trunc", I::trunc, S::kFloat, 1},
};

constexpr uint32_t kRayStages = ir::kStageRayGeneration | ir::kStageIntersection |
                                ir::kStageAnyHit | ir::kStageClosestHit | ir::kStageMiss |
                                ir::kStageCallable;
constexpr uint32_t kHitStages = ir::kStageIntersection | ir::kStageAnyHit | ir::kStageClosestHit;
constexpr uint32_t kRayDataStages = kHitStages | ir::kStageMiss;
using V = ir::SystemValue;
constexpr ir::Scalar kF = ir::Scalar::kFloat32;
constexpr ir::Scalar kU = ir::Scalar::kUint32;

// [DXR: Ray tracing system values by stage]
constexpr QueryValueRule kQueryValues[] = {
    {"CandidateType", ir::QueryValue::kType, false, ir::Scalar::kUint32, 0, 0},
    {"CommittedStatus", ir::QueryValue::kType, true, ir::Scalar::kUint32, 0, 0},
    {"CandidateTriangleRayT", ir::QueryValue::kRayT, false, ir::Scalar::kFloat32, 0, 0},
    {"CommittedRayT", ir::QueryValue::kRayT, true, ir::Scalar::kFloat32, 0, 0},
    {"CandidateInstanceIndex", ir::QueryValue::kInstanceIndex, false, ir::Scalar::kUint32, 0, 0},
    {"CommittedInstanceIndex", ir::QueryValue::kInstanceIndex, true, ir::Scalar::kUint32, 0, 0},
    {"CandidateInstanceID", ir::QueryValue::kInstanceId, false, ir::Scalar::kUint32, 0, 0},
    {"CommittedInstanceID", ir::QueryValue::kInstanceId, true, ir::Scalar::kUint32, 0, 0},
    {"CandidateInstanceContributionToHitGroupIndex", ir::QueryValue::kInstanceContribution, false,
     ir::Scalar::kUint32, 0, 0},
    {"CommittedInstanceContributionToHitGroupIndex", ir::QueryValue::kInstanceContribution, true,
     ir::Scalar::kUint32, 0, 0},
    {"CandidateGeometryIndex", ir::QueryValue::kGeometryIndex, false, ir::Scalar::kUint32, 0, 0},
    {"CommittedGeometryIndex", ir::QueryValue::kGeometryIndex, true, ir::Scalar::kUint32, 0, 0},
    {"CandidatePrimitiveIndex", ir::QueryValue::kPrimitiveIndex, false, ir::Scalar::kUint32, 0, 0},
    {"CommittedPrimitiveIndex", ir::QueryValue::kPrimitiveIndex, true, ir::Scalar::kUint32, 0, 0},
    {"CandidateObjectRayOrigin", ir::QueryValue::kObjectRayOrigin, false, ir::Scalar::kFloat32, 0,
     3},
    {"CommittedObjectRayOrigin", ir::QueryValue::kObjectRayOrigin, true, ir::Scalar::kFloat32, 0,
     3},
    {"CandidateObjectRayDirection", ir::QueryValue::kObjectRayDirection, false,
     ir::Scalar::kFloat32, 0, 3},
    {"CommittedObjectRayDirection", ir::QueryValue::kObjectRayDirection, true, ir::Scalar::kFloat32,
     0, 3},
    {"CandidateObjectToWorld3x4", ir::QueryValue::kObjectToWorld3x4, false, ir::Scalar::kFloat32, 3,
     4},
    {"CommittedObjectToWorld3x4", ir::QueryValue::kObjectToWorld3x4, true, ir::Scalar::kFloat32, 3,
     4},
    {"CandidateObjectToWorld4x3", ir::QueryValue::kObjectToWorld4x3, false, ir::Scalar::kFloat32, 4,
     3},
    {"CommittedObjectToWorld4x3", ir::QueryValue::kObjectToWorld4x3, true, ir::Scalar::kFloat32, 4,
     3},
    {"CandidateWorldToObject3x4", ir::QueryValue::kWorldToObject3x4, false, ir::Scalar::kFloat32, 3,
     4},
    {"CommittedWorldToObject3x4", ir::QueryValue::kWorldToObject3x4, true, ir::Scalar::kFloat32, 3,
     4},
    {"CandidateWorldToObject4x3", ir::QueryValue::kWorldToObject4x3, false, ir::Scalar::kFloat32, 4,
     3},
    {"CommittedWorldToObject4x3", ir::QueryValue::kWorldToObject4x3, true, ir::Scalar::kFloat32, 4,
     3},
    {"CandidateTriangleBarycentrics", ir::QueryValue::kBarycentrics, false, ir::Scalar::kFloat32, 0,
     2},
    {"CommittedTriangleBarycentrics", ir::QueryValue::kBarycentrics, true, ir::Scalar::kFloat32, 0,
     2},
    {"CandidateTriangleFrontFace", ir::QueryValue::kFrontFace, false, ir::Scalar::kBool, 0, 0},
    {"CommittedTriangleFrontFace", ir::QueryValue::kFrontFace, true, ir::Scalar::kBool, 0, 0},
    {"CandidateProceduralPrimitiveNonOpaque", ir::QueryValue::kProceduralNonOpaque, false,
     ir::Scalar::kBool, 0, 0},
    {"RayFlags", ir::QueryValue::kRayFlags, false, ir::Scalar::kUint32, 0, 0},
    {"RayTMin", ir::QueryValue::kRayTMin, false, ir::Scalar::kFloat32, 0, 0},
    {"WorldRayOrigin", ir::QueryValue::kWorldRayOrigin, false, ir::Scalar::kFloat32, 0, 3},
    {"WorldRayDirection", ir::QueryValue::kWorldRayDirection, false, ir::Scalar::kFloat32, 0, 3},
};

constexpr SystemValueRule kSystemValues[] = {
    {"DispatchRaysIndex", V::kDispatchRaysIndex, kU, 0, 3, kRayStages},
    {"DispatchRaysDimensions", V::kDispatchRaysDimensions, kU, 0, 3, kRayStages},
    {"WorldRayOrigin", V::kWorldRayOrigin, kF, 0, 3, kRayDataStages},
    {"WorldRayDirection", V::kWorldRayDirection, kF, 0, 3, kRayDataStages},
    {"RayTMin", V::kRayTMin, kF, 0, 0, kRayDataStages},
    {"RayTCurrent", V::kRayTCurrent, kF, 0, 0, kRayDataStages},
    {"RayFlags", V::kRayFlags, kU, 0, 0, kRayDataStages},
    {"InstanceIndex", V::kInstanceIndex, kU, 0, 0, kHitStages},
    {"InstanceID", V::kInstanceId, kU, 0, 0, kHitStages},
    {"GeometryIndex", V::kGeometryIndex, kU, 0, 0, kHitStages},
    {"PrimitiveIndex", V::kPrimitiveIndex, kU, 0, 0, kHitStages},
    {"ObjectRayOrigin", V::kObjectRayOrigin, kF, 0, 3, kHitStages},
    {"ObjectRayDirection", V::kObjectRayDirection, kF, 0, 3, kHitStages},
    {"ObjectToWorld3x4", V::kObjectToWorld3x4, kF, 3, 4, kHitStages},
    {"ObjectToWorld4x3", V::kObjectToWorld4x3, kF, 4, 3, kHitStages},
    {"ObjectToWorld", V::kObjectToWorld3x4, kF, 3, 4, kHitStages},
    {"WorldToObject3x4", V::kWorldToObject3x4, kF, 3, 4, kHitStages},
    {"WorldToObject4x3", V::kWorldToObject4x3, kF, 4, 3, kHitStages},
    {"WorldToObject", V::kWorldToObject3x4, kF, 3, 4, kHitStages},
    {"HitKind", V::kHitKind, kU, 0, 0, ir::kStageAnyHit | ir::kStageClosestHit},
};

using A = ir::AtomicOp;
constexpr AtomicRule kAtomics[] = {
    {"InterlockedAdd", A::kAdd, false, false, true},
    {"InterlockedAnd", A::kAnd, false, false, true},
    {"InterlockedOr", A::kOr, false, false, true},
    {"InterlockedXor", A::kXor, false, false, true},
    {"InterlockedMin", A::kMin, false, false, true},
    {"InterlockedMax", A::kMax, false, false, true},
    {"InterlockedExchange", A::kExchange, false, true, true},
    {"InterlockedCompareExchange", A::kCompareExchange, true, true, true},
    {"InterlockedCompareStore", A::kCompareStore, true, false, false},
    {"InterlockedExchangeFloat", A::kExchange, false, true, true, true},
    {"InterlockedCompareExchangeFloatBitwise", A::kCompareExchange, true, true, true, true},
    {"InterlockedCompareStoreFloatBitwise", A::kCompareStore, true, false, false, true},
};

constexpr BarrierRule kBarriers[] = {
    {"GroupMemoryBarrier", ir::kGroupMemory},
    {"GroupMemoryBarrierWithGroupSync", ir::kGroupMemory | ir::kGroupSync},
    {"DeviceMemoryBarrier", ir::kDeviceMemory},
    {"DeviceMemoryBarrierWithGroupSync", ir::kDeviceMemory | ir::kGroupSync},
    {"AllMemoryBarrier", ir::kGroupMemory | ir::kDeviceMemory},
    {"AllMemoryBarrierWithGroupSync", ir::kGroupMemory | ir::kDeviceMemory | ir::kGroupSync},
};

using W = shader::WaveOp;
using O = WaveOperand;
constexpr WaveRule kWaves[] = {
    {"WaveGetLaneCount", W::kLaneCount, O::kNone, 0},
    {"WaveGetLaneIndex", W::kLaneIndex, O::kNone, 0},
    {"GetGroupWaveIndex", W::kGroupWaveIndex, O::kNone, 10},
    {"GetGroupWaveCount", W::kGroupWaveCount, O::kNone, 10},
    {"WaveIsFirstLane", W::kIsFirstLane, O::kNone, 0},
    {"WaveActiveAnyTrue", W::kAnyTrue, O::kBool, 0},
    {"WaveActiveAllTrue", W::kAllTrue, O::kBool, 0},
    {"WaveActiveBallot", W::kBallot, O::kBool, 0},
    {"WaveActiveCountBits", W::kCountBits, O::kBool, 0},
    {"WavePrefixCountBits", W::kPrefixCountBits, O::kBool, 0},
    {"WaveActiveAllEqual", W::kAllEqual, O::kAny, 0},
    {"WaveMatch", W::kMatch, O::kNumber, 5},
    {"WaveReadLaneAt", W::kReadLaneAt, O::kAny, 0},
    {"WaveReadLaneFirst", W::kReadLaneFirst, O::kAny, 0},
    {"WaveActiveSum", W::kSum, O::kNumber, 0},
    {"WaveActiveProduct", W::kProduct, O::kNumber, 0},
    {"WaveActiveMin", W::kMin, O::kNumber, 0},
    {"WaveActiveMax", W::kMax, O::kNumber, 0},
    {"WaveActiveBitAnd", W::kBitAnd, O::kUnsigned, 0},
    {"WaveActiveBitOr", W::kBitOr, O::kUnsigned, 0},
    {"WaveActiveBitXor", W::kBitXor, O::kUnsigned, 0},
    {"WavePrefixSum", W::kPrefixSum, O::kNumber, 0},
    {"WavePrefixProduct", W::kPrefixProduct, O::kNumber, 0},
    {"WaveMultiPrefixSum", W::kMultiPrefixSum, O::kNumber, 5},
    {"WaveMultiPrefixProduct", W::kMultiPrefixProduct, O::kNumber, 5},
    {"WaveMultiPrefixCountBits", W::kMultiPrefixCountBits, O::kBool, 5},
    {"WaveMultiPrefixBitAnd", W::kMultiPrefixBitAnd, O::kInteger, 5},
    {"WaveMultiPrefixBitOr", W::kMultiPrefixBitOr, O::kInteger, 5},
    {"WaveMultiPrefixBitXor", W::kMultiPrefixBitXor, O::kInteger, 5},
    {"QuadReadLaneAt", W::kQuadReadLaneAt, O::kNumber, 0},
    {"QuadReadAcrossX", W::kQuadReadAcrossX, O::kNumber, 0},
    {"QuadReadAcrossY", W::kQuadReadAcrossY, O::kNumber, 0},
    {"QuadReadAcrossDiagonal", W::kQuadReadAcrossDiagonal, O::kNumber, 0},
    {"QuadAny", W::kQuadAny, O::kBool, 0},
    {"QuadAll", W::kQuadAll, O::kBool, 0},
};

using F = SampleForm;
constexpr SampleRule kSamples[] = {
    {"Sample", F::kSample, 0},
    {"SampleBias", F::kBias, 0},
    {"SampleLevel", F::kLevel, 0},
    {"SampleGrad", F::kGradient, 0},
    {"SampleCmp", F::kCompare, 0},
    {"SampleCmpLevelZero", F::kCompareZero, 0},
    {"SampleCmpLevel", F::kCompareLevel, 0},
    {"SampleCmpBias", F::kCompareBias, 0},
    {"SampleCmpGrad", F::kCompareGradient, 0},
    {"Gather", F::kGather, 0},
    {"GatherRed", F::kGather, 0},
    {"GatherGreen", F::kGather, 1},
    {"GatherBlue", F::kGather, 2},
    {"GatherAlpha", F::kGather, 3},
    {"GatherCmp", F::kGatherCompare, 0},
    {"GatherCmpRed", F::kGatherCompare, 0},
};

struct Family {
  std::string_view prefix;  // of a name, or the complete name if `whole`
  std::string_view what;
  bool whole;
};

constexpr Family kUnsupported[] = {
    {"MaybeReorderThread", "shader execution reordering", true},
    {"ReorderThread", "shader execution reordering", true},
    {"GetRemainingRecursionLevels", "node shaders", true},
    {"__builtin_LinAlg_", "linear algebra, Shader Model 6.10", false},
    {"__builtin_MatVecMul", "linear algebra, Shader Model 6.10", false},
    {"__builtin_OuterProductAccumulate", "linear algebra, Shader Model 6.10", true},
    {"__builtin_VectorAccumulate", "linear algebra, Shader Model 6.10", true},
    {"AllocateRayQuery", "the name of an instruction; declare a RayQuery", true},
    {"DispatchMesh", "mesh shaders", true},
    {"SetMeshOutputCounts", "mesh shaders", true},
    {"abort", "abort", true},
    {"Process2DQuadTessFactors", "tessellation", false},
    {"tex1D", "Direct3D 9 texture functions", false},
    {"tex2D", "Direct3D 9 texture functions", false},
    {"tex3D", "Direct3D 9 texture functions", false},
    {"texCUBE", "Direct3D 9 texture functions", false},
    {"noise", "noise", true},
};

constexpr std::string_view kPixelFunctions[] = {"ddx",
                                                "ddx_coarse",
                                                "ddx_fine",
                                                "ddy",
                                                "ddy_coarse",
                                                "ddy_fine",
                                                "fwidth",
                                                "clip",
                                                "EvaluateAttributeAtSample",
                                                "EvaluateAttributeCentroid",
                                                "EvaluateAttributeSnapped",
                                                "GetAttributeAtVertex",
                                                "GetRenderTargetSampleCount",
                                                "GetRenderTargetSamplePosition",
                                                "IsHelperLane"};

constexpr std::string_view kByName[] = {"mul",
                                        "Barrier",
                                        "select",
                                        "and",
                                        "or",
                                        "sincos",
                                        "modf",
                                        "frexp",
                                        "NonUniformResourceIndex",
                                        "D3DCOLORtoUBYTE4",
                                        "TraceRay",
                                        "ReportHit",
                                        "CallShader",
                                        "IgnoreHit",
                                        "AddUint64",
                                        "dot2add",
                                        "dot4add_u8packed",
                                        "dot4add_i8packed",
                                        "pack_u8",
                                        "pack_s8",
                                        "pack_clamp_u8",
                                        "pack_clamp_s8",
                                        "unpack_u8u32",
                                        "unpack_s8s32",
                                        "unpack_u8u16",
                                        "unpack_s8s16",
                                        "AcceptHitAndEndSearch",
                                        "TriangleObjectPositions",
                                        "ClusterID",
                                        "DebugBreak",
                                        "errorf",
                                        "printf"};

template <class Rule, size_t N>
const Rule* find_rule(const Rule (&rules)[N], std::string_view name) {
  static const std::unordered_map<std::string_view, const Rule*> map = [&rules] {
    std::unordered_map<std::string_view, const Rule*> result;
    for (const Rule& rule : rules) result[rule.name] = &rule;
    return result;
  }();
  const auto found = map.find(name);
  return found == map.end() ? nullptr : found->second;
}

}  // namespace

const IntrinsicRule* find_intrinsic(std::string_view name) {
  return find_rule(kIntrinsics, name);
}
const SystemValueRule* find_system_value(std::string_view name) {
  return find_rule(kSystemValues, name);
}
const QueryValueRule* find_query_value(std::string_view name) {
  return find_rule(kQueryValues, name);
}
const AtomicRule* find_atomic(std::string_view name) {
  if (name.ends_with("64")) name.remove_suffix(2);
  return find_rule(kAtomics, name);
}
const WaveRule* find_wave(std::string_view name) {
  return find_rule(kWaves, name);
}
std::string_view wave_function_name(shader::WaveOp op) {
  if (shader::is_derivative(op)) {
    constexpr std::string_view kNames[] = {"ddx_coarse", "ddy_coarse", "ddx_fine", "ddy_fine"};
    return kNames[static_cast<size_t>(op) - static_cast<size_t>(W::kDdxCoarse)];
  }
  for (const WaveRule& rule : kWaves) {
    if (rule.op == op) return rule.name;
  }
  return {};
}
const BarrierRule* find_barrier(std::string_view name) {
  return find_rule(kBarriers, name);
}
const SampleRule* find_sample(std::string_view name) {
  return find_rule(kSamples, name);
}

std::string_view unsupported_function(std::string_view name) {
  for (const Family& family : kUnsupported) {
    if (family.whole ? name == family.prefix : name.starts_with(family.prefix)) return family.what;
  }
  return {};
}

bool is_pixel_function(std::string_view name) {
  return std::find(std::begin(kPixelFunctions), std::end(kPixelFunctions), name) !=
         std::end(kPixelFunctions);
}

bool is_builtin_function(std::string_view name) {
  return find_intrinsic(name) || find_system_value(name) || find_atomic(name) ||
         find_barrier(name) || find_wave(name) || is_pixel_function(name) ||
         std::find(std::begin(kByName), std::end(kByName), name) != std::end(kByName) ||
         !unsupported_function(name).empty();
}

const std::vector<std::string_view>& builtin_function_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> result(std::begin(kByName), std::end(kByName));
    for (const auto& rule : kIntrinsics) result.push_back(rule.name);
    for (const auto& rule : kSystemValues) result.push_back(rule.name);
    for (const auto& rule : kAtomics) result.push_back(rule.name);
    for (const auto& rule : kBarriers) result.push_back(rule.name);
    for (const auto& rule : kWaves) result.push_back(rule.name);
    return result;
  }();
  return names;
}

std::string_view stage_name(uint32_t stage) {
  switch (stage) {
    case ir::kStageRayGeneration:
      return "ray generation";
    case ir::kStageIntersection:
      return "intersection";
    case ir::kStageAnyHit:
      return "any hit";
    case ir::kStageClosestHit:
      return "closest hit";
    case ir::kStageMiss:
      return "miss";
    case ir::kStageCallable:
      return "callable";
    case ir::kStageCompute:
      return "compute";
    case ir::kStageVertex:
      return "vertex";
    case ir::kStageGeometry:
      return "geometry";
    default:
      return "pixel";
  }
}

std::string stage_list(uint32_t stages) {
  std::vector<std::string_view> names;
  for (uint32_t bit = 1; bit <= ir::kStageGeometry; bit <<= 1) {
    if (stages & bit) names.push_back(stage_name(bit));
  }
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text + " shaders";
}

}  // namespace kaamos::hlsl
