// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: partitioned top levels step by step, for the rules about them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance::ptl {

using namespace rtapi;

using WriteArgs = RtasPartitionedTlasWriteInstanceArgs;
using UpdateArgs = RtasPartitionedTlasUpdateInstanceArgs;
using TranslateArgs = RtasPartitionedTlasTranslatePartitionArgs;
using Type = RtasPartitionedTlasOperationType;
using TlasFlags = RtasPartitionedTlasFlags;
using InstanceFlags = RtasPartitionedTlasInstanceFlags;

constexpr uint32_t kGlobal = kRtasPartitionIndexGlobalPartition;

// A context with a device that has these operations, and what it said of them.
struct Partitioned {
  explicit Partitioned(Context& outer);
  ~Partitioned();
  Partitioned(const Partitioned&) = delete;
  Partitioned& operator=(const Partitioned&) = delete;

  // Expects that there was one note since the last call, with these words; "": that there was none.
  void noted(const std::string& what, const std::string& words);

  std::shared_ptr<std::vector<std::string>> notes = std::make_shared<std::vector<std::string>>();
  Context t;

 private:
  Context& outer_;
};

struct Operations {
  std::vector<WriteArgs> writes = {};
  std::vector<UpdateArgs> updates = {};
  std::vector<TranslateArgs> translations = {};
};

// The operation with arguments in a buffer of their own.
template <class Args>
RtasPartitionedTlasOperation operation(Context& t, Type type, const std::vector<Args>& args) {
  return {type,
          static_cast<uint32_t>(args.size()),
          {args.empty() ? 0 : t.upload(args).GetGPUVirtualAddress(), 0}};
}

// One operation of each type that has arguments.
std::vector<RtasPartitionedTlasOperation> in_memory(Context& t, const Operations& all);

RtasOperationPrebuildInfo sizes_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs);
Buffer memory_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs);
// Eight slots in four partitions.
RtasPartitionedTlasInputsDesc small_inputs(TlasFlags flags = TlasFlags::kNone);
// With scratch memory of its own.
RtasPartitionedTlasOperationData data_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
                                         const std::vector<RtasPartitionedTlasOperation>& all,
                                         const Buffer& dest, const Buffer& source);

void add_operation(CommandList& list, const RtasPartitionedTlasInputsDesc& inputs,
                   const RtasPartitionedTlasOperationData& data);
// The first error of recording, or else of executing.
Status run(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
           const RtasPartitionedTlasOperationData& data);
Status run(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
           const std::vector<RtasPartitionedTlasOperation>& all, const Buffer& dest,
           const Buffer& source = {});
Buffer build_new(Context& t, const RtasPartitionedTlasInputsDesc& inputs, const Operations& all,
                 const Buffer& source = {});

// An instance at x, with an InstanceID of 100 + its index.
WriteArgs write(const Buffer& bottom, uint32_t index, float x, uint32_t partition = 0);
TranslateArgs translate(uint32_t partition, float x, float y = 0, float z = 0);

// What rays along z see at each x.
std::vector<Seen> look(Context& t, const Buffer& top, const std::vector<float>& places);
// Which slot they hit; -1: a miss.
using Slots = std::vector<int>;
Slots slots_at(Context& t, const Buffer& top, const std::vector<float>& places);

// The tests of ptl_tests that are about what stands in GPU memory, and where.
std::vector<RuleTest> memory_tests();

}  // namespace kaamos::conformance::ptl
