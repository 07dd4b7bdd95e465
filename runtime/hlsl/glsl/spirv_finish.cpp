// SPDX-License-Identifier: MIT
//
// A pass over a module's words. SPIR-V has a strict order (capabilities, ..., entry point,
// execution modes, debug information, decorations, types and the rest), so one walk finds every
// place where something has to be added.
#include <algorithm>
#include <set>

#include "runtime/hlsl/glsl/spirv.h"

namespace kaamos::hlsl {
namespace {

// Numbers from the SPIR-V specification.
enum : uint32_t {
  kOpSourceContinued = 2,
  kOpSource = 3,
  kOpSourceExtension = 4,
  kOpName = 5,
  kOpMemberName = 6,
  kOpString = 7,
  kOpLine = 8,
  kOpExtension = 10,
  kOpExtInstImport = 11,
  kOpMemoryModel = 14,
  kOpEntryPoint = 15,
  kOpExecutionMode = 16,
  kOpCapability = 17,
  kOpTypeFloat = 22,
  kOpDecorate = 71,
  kOpMemberDecorate = 72,
  kOpFNegate = 127,
  kOpFAdd = 129,
  kOpFSub = 131,
  kOpFMul = 133,
  kOpFDiv = 136,
  kOpFRem = 140,
  kOpFMod = 141,
  kOpVectorTimesScalar = 142,
  kOpDot = 148,
  kOpNoLine = 317,
  kOpModuleProcessed = 330,
  kOpExecutionModeId = 331,
  kOpDecorateId = 332,
};
constexpr uint32_t kDecorationSpecId = 1;
constexpr uint32_t kDecorationNoContraction = 42;
constexpr uint32_t kCapabilitySignedZeroInfNanPreserve = 4466;
constexpr uint32_t kModeSignedZeroInfNanPreserve = 4461;

bool is_debug(uint32_t op) {
  return (op >= kOpSourceContinued && op <= kOpLine) || op == kOpNoLine || op == kOpModuleProcessed;
}

bool is_arithmetic(uint32_t op) {
  switch (op) {
    case kOpFNegate:
    case kOpFAdd:
    case kOpFSub:
    case kOpFMul:
    case kOpFDiv:
    case kOpFRem:
    case kOpFMod:
      return true;
    default:
      return op >= kOpVectorTimesScalar && op <= kOpDot;
  }
}

enum class Section { kPreamble, kAnnotations, kRest };

Section section_of(uint32_t op) {
  switch (op) {
    case kOpExtension:
    case kOpExtInstImport:
    case kOpMemoryModel:
    case kOpEntryPoint:
    case kOpExecutionMode:
    case kOpCapability:
    case kOpExecutionModeId:
      return Section::kPreamble;
    case kOpDecorate:
    case kOpMemberDecorate:
    case kOpDecorateId:
      return Section::kAnnotations;
    default:
      return Section::kRest;
  }
}

struct Instruction {
  uint32_t op;
  const uint32_t* words;  // the first holds the opcode and the word count
  uint32_t count;
};

template <typename Visit>
void each_instruction(const std::vector<uint32_t>& words, const Visit& visit) {
  constexpr size_t kHeader = 5;
  for (size_t i = kHeader; i < words.size();) {
    const uint32_t count = words[i] >> 16;
    if (count == 0 || i + count > words.size()) {
      return;
    }
    visit(Instruction{words[i] & 0xFFFFu, &words[i], count});
    i += count;
  }
}

struct Facts {
  std::set<uint32_t> widths;          // of floats
  std::vector<uint32_t> arithmetic;   // results
  std::set<uint32_t> not_contracted;  // already decorated by glslang
  uint32_t entry_point = 0;
};

Facts facts_of(const std::vector<uint32_t>& words) {
  Facts facts;
  each_instruction(words, [&](const Instruction& in) {
    if (in.op == kOpTypeFloat) {
      facts.widths.insert(in.words[2]);
    } else if (in.op == kOpEntryPoint) {
      facts.entry_point = in.words[2];
    } else if (in.op == kOpDecorate && in.words[2] == kDecorationNoContraction) {
      facts.not_contracted.insert(in.words[1]);
    } else if (is_arithmetic(in.op)) {
      facts.arithmetic.push_back(in.words[2]);
    }
  });
  return facts;
}

}  // namespace

std::vector<uint32_t> finish_spirv(const std::vector<uint32_t>& words,
                                   const std::vector<uint32_t>& constants) {
  const Facts facts = facts_of(words);
  std::vector<uint32_t> out(words.begin(), words.begin() + 5);
  bool capability_added = false;
  Section section = Section::kPreamble;
  each_instruction(words, [&](const Instruction& in) {
    if (is_debug(in.op)) {
      return;
    }
    if (in.op != kOpCapability && !capability_added && !facts.widths.empty()) {
      out.insert(out.end(), {2u << 16 | kOpCapability, kCapabilitySignedZeroInfNanPreserve});
      capability_added = true;
    }
    const Section next = std::max(section, section_of(in.op));
    if (section == Section::kPreamble && next != section) {
      for (const uint32_t width : facts.widths) {
        out.insert(out.end(), {4u << 16 | kOpExecutionMode, facts.entry_point,
                               kModeSignedZeroInfNanPreserve, width});
      }
    }
    if (section != Section::kRest && next == Section::kRest) {
      for (const uint32_t id : facts.arithmetic) {
        if (facts.not_contracted.count(id) == 0) {
          out.insert(out.end(), {3u << 16 | kOpDecorate, id, kDecorationNoContraction});
        }
      }
    }
    section = next;
    const size_t at = out.size();
    out.insert(out.end(), in.words, in.words + in.count);
    if (in.op == kOpDecorate && in.words[2] == kDecorationSpecId &&
        in.words[3] < constants.size()) {
      out[at + 3] = constants[in.words[3]];
    }
  });
  return out;
}

}  // namespace kaamos::hlsl
