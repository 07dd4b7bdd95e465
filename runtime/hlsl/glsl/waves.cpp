// SPDX-License-Identifier: MIT
//
// Wave operations in compute and pixel shaders as subgroup operations. What those lack is made of
// shuffles, over the lanes in ascending order.
#include <cctype>

#include "runtime/hlsl/glsl/emitter.h"

namespace kaamos::hlsl {

using namespace ir;
using shader::WaveOp;

namespace {

// GLSL's function, or null if the operation is made otherwise.
const char* subgroup_function(WaveOp op) {
  switch (op) {
    case WaveOp::kAnyTrue:
      return "subgroupAny";
    case WaveOp::kAllTrue:
      return "subgroupAll";
    case WaveOp::kBallot:
      return "subgroupBallot";
    case WaveOp::kReadLaneFirst:
      return "subgroupBroadcastFirst";
    case WaveOp::kReadLaneAt:
      return "subgroupShuffle";
    case WaveOp::kSum:
      return "subgroupAdd";
    case WaveOp::kProduct:
      return "subgroupMul";
    case WaveOp::kMin:
      return "subgroupMin";
    case WaveOp::kMax:
      return "subgroupMax";
    case WaveOp::kBitAnd:
      return "subgroupAnd";
    case WaveOp::kBitOr:
      return "subgroupOr";
    case WaveOp::kBitXor:
      return "subgroupXor";
    case WaveOp::kPrefixSum:
      return "subgroupExclusiveAdd";
    case WaveOp::kPrefixProduct:
      return "subgroupExclusiveMul";
    default:
      return nullptr;
  }
}

struct MultiPrefix {
  const char* name;
  const char* op;
  const char* start;  // as the argument of the type's constructor
};

MultiPrefix multi_prefix_of(WaveOp op) {
  switch (op) {
    case WaveOp::kMultiPrefixSum:
      return {"sum", "+", "0"};
    case WaveOp::kMultiPrefixProduct:
      return {"product", "*", "1"};
    case WaveOp::kMultiPrefixBitAnd:
      return {"and", "&", "-1"};
    case WaveOp::kMultiPrefixBitOr:
      return {"or", "|", "0"};
    default:
      return {"xor", "^", "0"};
  }
}

constexpr char kLoopOverLanes[] =
    "  for (uint i = 0u; i < gl_SubgroupSize; ++i) {\n"
    "    const T other = subgroupShuffle(v, i);\n";

// Replaces each T that is a word of its own.
std::string with_type(const std::string& text, const std::string& type) {
  std::string out;
  const auto part_of_word = [&](size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_');
  };
  for (size_t i = 0; i < text.size(); ++i) {
    const bool word = text[i] == 'T' && (i == 0 || !part_of_word(i - 1)) && !part_of_word(i + 1);
    word ? out += type : out += text[i];
  }
  return out;
}

}  // namespace

std::string GlslEmitter::multi_prefix_function(WaveOp op, const Type* t) {
  const MultiPrefix parts = multi_prefix_of(op);
  const std::string name = std::string("g_multi_prefix_") + parts.name + "_" + type(t);
  return generated(
      name,
      with_type("T " + name + "(T v, uvec4 lanes) {\n  T result = T(" + parts.start + ");\n" +
                    "  const uvec4 before = lanes & subgroupBallot(true) & gl_SubgroupLtMask;\n" +
                    kLoopOverLanes +
                    "    if (subgroupBallotBitExtract(before, i)) result = result " + parts.op +
                    " other;\n  }\n  return result;\n}\n",
                type(t)));
}

std::string GlslEmitter::match_function(const Type* t) {
  const std::string name = "g_match_" + type(t);
  return generated(
      name, with_type("uvec4 " + name +
                          "(T v) {\n  uvec4 same = uvec4(0u);\n"
                          "  const uvec4 taking_part = subgroupBallot(true);\n" +
                          std::string(kLoopOverLanes) +
                          "    if ((other == v || i == gl_SubgroupInvocationID) && "
                          "subgroupBallotBitExtract(taking_part, i)) {\n"
                          "      same[i >> 5] |= 1u << (i & 31u);\n    }\n  }\n  return same;\n}\n",
                      type(t)));
}

// A derivative in a compute shader, of the GLSL type `real`; 0 where one of the two lanes takes no
// part.
std::string GlslEmitter::difference_function(WaveOp op, const std::string& real) {
  const bool across = op == WaveOp::kDdxCoarse || op == WaveOp::kDdxFine;
  const bool fine = op == WaveOp::kDdxFine || op == WaveOp::kDdyFine;
  const std::string step = across ? "1u" : "2u";
  const std::string name =
      std::string("g_difference_") + (across ? "x_" : "y_") + (fine ? "fine_" : "coarse_") + real;
  return generated(
      name, real + " " + name + "(" + real + " v) {\n" +
                "  const uint first = gl_SubgroupInvocationID & ~" + (fine ? step : "3u") + ";\n" +
                "  const uint second = first + " + step + ";\n" +
                "  const uvec4 lanes = subgroupBallot(true);\n" + "  const " + real +
                " difference = subgroupShuffle(v, second) - " + "subgroupShuffle(v, first);\n" +
                "  return subgroupBallotBitExtract(lanes, first) && " +
                "subgroupBallotBitExtract(lanes, second) ? difference : " + real + "(0);\n}\n");
}

std::string GlslEmitter::quad_votes_function() {
  const std::string name = "g_quad_votes";
  std::string others;
  for (const char* lane : {"1u", "2u", "3u"}) {
    others += std::string(" | subgroupShuffle(v, gl_SubgroupInvocationID ^ ") + lane + ")";
  }
  return generated(name, "uint " + name + "(bool vote) {\n  const uint v = uint(vote);\n" +
                             "  return v" + others + ";\n}\n");
}

std::string GlslEmitter::all_equal(const Expr* operand) {
  const std::string v = repeatable(operand);
  const uint32_t count = operand->type->kind == TypeKind::kVector ? operand->type->columns : 1;
  if (count == 1) return "subgroupAll(" + v + " == subgroupBroadcastFirst(" + v + "))";
  std::string out = glsl::vector_name(Scalar::kBool, static_cast<int>(count)) + "(";
  for (uint32_t i = 0; i < count; ++i) {
    const std::string part = v + "." + glsl::component(static_cast<int>(i));
    out += (i == 0 ? "" : ", ") +
           ("subgroupAll(" + part + " == subgroupBroadcastFirst(" + part + "))");
  }
  return out + ")";
}

// Returns what a wave of one lane gives, in a ray shader.
std::string GlslEmitter::lone_wave(const Stmt& stmt) {
  const Type* t = stmt.result->type;
  const std::string v = stmt.operands.empty() ? "" : value(stmt.operands[0]);
  switch (stmt.wave) {
    case WaveOp::kLaneCount:
      return "1u";
    case WaveOp::kIsFirstLane:
      return "true";
    case WaveOp::kAllEqual:
      return type(t) + "(true)";
    case WaveOp::kCountBits:
      return "uint(" + v + ")";
    case WaveOp::kBallot:
      return "uvec4(uint(" + v + "), 0u, 0u, 0u)";
    case WaveOp::kMatch:
      return "uvec4(1u, 0u, 0u, 0u)";
    case WaveOp::kPrefixProduct:
    case WaveOp::kMultiPrefixProduct:
      return type(t) + "(1)";
    case WaveOp::kMultiPrefixBitAnd:
      return type(t) + "(-1)";
    case WaveOp::kLaneIndex:
    case WaveOp::kPrefixCountBits:
    case WaveOp::kPrefixSum:
    case WaveOp::kMultiPrefixSum:
    case WaveOp::kMultiPrefixCountBits:
    case WaveOp::kMultiPrefixBitOr:
    case WaveOp::kMultiPrefixBitXor:
      return zero(t);
    default:
      return v;
  }
}

std::string GlslEmitter::wave_text(const Stmt& stmt) {
  const auto operand = [&](size_t i) { return value(stmt.operands[i]); };
  const auto from_lane = [&](const std::string& lane) {
    return "subgroupShuffle(" + operand(0) + ", " + lane + ")";
  };
  // The votes of this lane's quad. Ballots of pixel shaders may lack helpers, which vote here.
  const auto quad = [&](const std::string& vote) {
    if (entry_.stage == kStagePixel) return quad_votes_function() + "(" + vote + ")";
    return "(subgroupBallot(" + vote +
           ")[gl_SubgroupInvocationID >> 5] >> (gl_SubgroupInvocationID & 28u) & 15u)";
  };
  switch (stmt.wave) {
    case WaveOp::kLaneCount:
      return "gl_SubgroupSize";
    case WaveOp::kLaneIndex:
      return "gl_SubgroupInvocationID";
    case WaveOp::kGroupWaveIndex:
      return "gl_SubgroupID";
    case WaveOp::kGroupWaveCount:
      return "gl_NumSubgroups";
    case WaveOp::kIsFirstLane:
      return "subgroupElect()";
    case WaveOp::kCountBits:
      return "subgroupBallotBitCount(subgroupBallot(" + operand(0) + "))";
    case WaveOp::kPrefixCountBits:
      return "subgroupBallotExclusiveBitCount(subgroupBallot(" + operand(0) + "))";
    case WaveOp::kMultiPrefixCountBits:
      return "subgroupBallotExclusiveBitCount(subgroupBallot(" + operand(0) + ") & " + operand(1) +
             ")";
    case WaveOp::kAllEqual:
      return all_equal(stmt.operands[0]);
    case WaveOp::kMatch:
      return match_function(stmt.operands[0]->type) + "(" + operand(0) + ")";
    case WaveOp::kMultiPrefixSum:
    case WaveOp::kMultiPrefixProduct:
    case WaveOp::kMultiPrefixBitAnd:
    case WaveOp::kMultiPrefixBitOr:
    case WaveOp::kMultiPrefixBitXor:
      return multi_prefix_function(stmt.wave, stmt.operands[0]->type) + "(" + operand(0) + ", " +
             operand(1) + ")";
    case WaveOp::kQuadReadLaneAt:
      return from_lane("(gl_SubgroupInvocationID & ~3u) | (" + operand(1) + " & 3u)");
    case WaveOp::kQuadReadAcrossX:
      return from_lane("gl_SubgroupInvocationID ^ 1u");
    case WaveOp::kQuadReadAcrossY:
      return from_lane("gl_SubgroupInvocationID ^ 2u");
    case WaveOp::kQuadReadAcrossDiagonal:
      return from_lane("gl_SubgroupInvocationID ^ 3u");
    case WaveOp::kQuadAny:
      return "(" + quad(operand(0)) + " != 0u)";
    case WaveOp::kQuadAll:
      return "(" + quad("!(" + operand(0) + ")") + " == 0u)";
    default:
      break;
  }
  std::string out = std::string(subgroup_function(stmt.wave)) + "(";
  for (size_t i = 0; i < stmt.operands.size(); ++i) out += (i == 0 ? "" : ", ") + operand(i);
  return out + ")";
}

void GlslEmitter::wave(const Stmt& stmt) {
  const bool waves = entry_.stage == kStageCompute || entry_.stage == kStagePixel;
  const std::string text = shader::is_derivative(stmt.wave) ? derivative(stmt)
                           : waves                          ? wave_text(stmt)
                                                            : lone_wave(stmt);
  line(variable(stmt.result) + " = " + text + ";");
}

std::string GlslEmitter::wave_extensions() const {
  const bool waves = entry_.stage == kStageCompute || entry_.stage == kStagePixel;
  if (!waves || !entry_.function->has_waves) return "";
  std::string out;
  for (const char* extension :
       {"GL_KHR_shader_subgroup_basic", "GL_KHR_shader_subgroup_vote",
        "GL_KHR_shader_subgroup_ballot", "GL_KHR_shader_subgroup_shuffle",
        "GL_KHR_shader_subgroup_arithmetic", "GL_EXT_shader_subgroup_extended_types_int16",
        "GL_EXT_shader_subgroup_extended_types_int64",
        "GL_EXT_shader_subgroup_extended_types_float16"}) {
    out += std::string("#extension ") + extension + " : require\n";
  }
  return out;
}

}  // namespace kaamos::hlsl
