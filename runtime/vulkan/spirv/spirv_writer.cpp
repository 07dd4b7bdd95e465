// SPDX-License-Identifier: MIT
#include "runtime/vulkan/spirv/spirv_writer.h"

namespace kaamos::vulkan {
namespace {

constexpr uint32_t kMain = 1;
constexpr uint32_t kMagic = 0x07230203;
constexpr uint32_t kVersion = 0x00010300;
constexpr uint32_t kLogical = 0, kGlsl450 = 1;
constexpr uint32_t kMainName[] = {0x6E69616D, 0};  // "main"

}  // namespace

void SpirvWriter::put(std::vector<uint32_t>& words, Op op, std::span<const uint32_t> operands) {
  words.push_back(static_cast<uint32_t>(operands.size() + 1) << 16 | op);
  words.insert(words.end(), operands.begin(), operands.end());
}

uint32_t SpirvWriter::global(Op op, std::initializer_list<uint32_t> operands) {
  uint32_t& id = known_[{op, std::vector<uint32_t>(operands)}];
  if (id != 0) return id;
  id = new_id();
  std::vector<uint32_t> all = {id};
  all.insert(all.end(), operands.begin(), operands.end());
  put(globals_, op, all);
  return id;
}

uint32_t SpirvWriter::typed_global(Op op, uint32_t type, std::initializer_list<uint32_t> operands) {
  std::vector<uint32_t> key = {type};
  key.insert(key.end(), operands.begin(), operands.end());
  uint32_t& id = known_[{op, key}];
  if (id != 0) return id;
  id = new_id();
  std::vector<uint32_t> all = {type, id};
  all.insert(all.end(), operands.begin(), operands.end());
  put(globals_, op, all);
  return id;
}

uint32_t SpirvWriter::spec_constant(uint32_t type, uint32_t number, uint32_t value) {
  const uint32_t id = new_id();
  put(globals_, kSpecConstant, {type, id, value});
  decorate(id, kSpecId, number);
  return id;
}

uint32_t SpirvWriter::variable(StorageClass storage, uint32_t type) {
  const uint32_t pointer = global(kTypePointer, {storage, type});
  const uint32_t id = new_id();
  put(globals_, kVariable, {pointer, id, storage});
  interface_.push_back(id);
  return id;
}

void SpirvWriter::decorate(uint32_t id, Decoration decoration, uint32_t value) {
  put(decorations_, kDecorate, {id, decoration, value});
}

void SpirvWriter::mode(uint32_t number, std::initializer_list<uint32_t> operands) {
  std::vector<uint32_t> all = {kMain, number};
  all.insert(all.end(), operands.begin(), operands.end());
  put(modes_, kExecutionMode, all);
}

uint32_t SpirvWriter::compute(Op op, uint32_t type, std::initializer_list<uint32_t> operands) {
  const uint32_t id = new_id();
  std::vector<uint32_t> all = {type, id};
  all.insert(all.end(), operands.begin(), operands.end());
  put(code_, op, all);
  return id;
}

std::vector<uint32_t> SpirvWriter::module(uint32_t model) {
  const uint32_t nothing = global(kTypeVoid, {});
  const uint32_t function = global(kTypeFunction, {nothing});
  const uint32_t label = new_id();
  std::vector<uint32_t> words = {kMagic, kVersion, 0, next_id_, 0};
  const auto append = [&](const std::vector<uint32_t>& part) {
    words.insert(words.end(), part.begin(), part.end());
  };
  append(head_);
  put(words, kMemoryModel, {kLogical, kGlsl450});
  std::vector<uint32_t> entry = {model, kMain, kMainName[0], kMainName[1]};
  entry.insert(entry.end(), interface_.begin(), interface_.end());
  put(words, kEntryPoint, entry);
  append(modes_);
  append(decorations_);
  append(globals_);
  put(words, kFunction, {nothing, kMain, 0, function});
  put(words, kLabel, {label});
  append(code_);
  put(words, kReturn, {});
  put(words, kFunctionEnd, {});
  return words;
}

}  // namespace kaamos::vulkan
