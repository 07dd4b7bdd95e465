// SPDX-License-Identifier: MIT
//
// Writes small SPIR-V modules of one function without branches.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace kaamos::vulkan {

class SpirvWriter {
 public:
  // Numbers of SPIR-V's enumerations that the modules use.
  enum Op : uint16_t {
    kMemoryModel = 14,
    kEntryPoint = 15,
    kExecutionMode = 16,
    kCapability = 17,
    kTypeVoid = 19,
    kTypeBool = 20,
    kTypeInt = 21,
    kTypeFloat = 22,
    kTypeVector = 23,
    kTypeArray = 28,
    kTypePointer = 32,
    kTypeFunction = 33,
    kConstant = 43,
    kConstantComposite = 44,
    kSpecConstant = 50,
    kFunction = 54,
    kFunctionEnd = 56,
    kVariable = 59,
    kLoad = 61,
    kStore = 62,
    kAccessChain = 65,
    kDecorate = 71,
    kBitcast = 124,
    kSelect = 169,
    kULessThan = 176,
    kEmitVertex = 218,
    kEndPrimitive = 219,
    kLabel = 248,
    kReturn = 253,
  };
  enum Decoration : uint32_t { kSpecId = 1, kBuiltIn = 11, kLocation = 30 };
  enum StorageClass : uint32_t { kInput = 1, kOutput = 3 };

  uint32_t new_id() { return next_id_++; }
  // Types and constants, each once. Returns the id.
  uint32_t global(Op op, std::initializer_list<uint32_t> operands);
  // The same with a type before the id.
  uint32_t typed_global(Op op, uint32_t type, std::initializer_list<uint32_t> operands);
  // A constant of its own, whatever its value.
  uint32_t spec_constant(uint32_t type, uint32_t number, uint32_t value);
  uint32_t variable(StorageClass storage, uint32_t type);
  void decorate(uint32_t id, Decoration decoration, uint32_t value);
  void capability(uint32_t number) { put(head_, kCapability, {number}); }
  void mode(uint32_t number, std::initializer_list<uint32_t> operands);
  // Instructions of main().
  void run(Op op, std::initializer_list<uint32_t> operands) { put(code_, op, operands); }
  uint32_t compute(Op op, uint32_t type, std::initializer_list<uint32_t> operands);

  // The module. `model`: SPIR-V's execution model of the stage.
  std::vector<uint32_t> module(uint32_t model);

 private:
  static void put(std::vector<uint32_t>& words, Op op, std::span<const uint32_t> operands);
  static void put(std::vector<uint32_t>& words, Op op, std::initializer_list<uint32_t> operands) {
    put(words, op, std::span(operands.begin(), operands.size()));
  }

  uint32_t next_id_ = 2;  // 1: main
  std::vector<uint32_t> head_, modes_, decorations_, globals_, code_;
  std::vector<uint32_t> interface_;
  std::map<std::pair<uint32_t, std::vector<uint32_t>>, uint32_t> known_;
};

}  // namespace kaamos::vulkan
