// SPDX-License-Identifier: MIT
#include "runtime/checks/hazards.h"

#include <utility>

#include "runtime/backend/backend.h"
#include "runtime/checks/names.h"

namespace kaamos::checks {
namespace {

using rtapi::HasAny;
using rtapi::ResourceStates;

constexpr ResourceStates kWritable = ResourceStates::kUnorderedAccess | ResourceStates::kCopyDest |
                                     ResourceStates::kRenderTarget | ResourceStates::kDepthWrite |
                                     ResourceStates::kResolveDest;

}  // namespace

std::string state_name(ResourceStates state) {
  static constexpr std::pair<ResourceStates, const char*> kNames[] = {
      {ResourceStates::kVertexAndConstantBuffer, "kVertexAndConstantBuffer"},
      {ResourceStates::kIndexBuffer, "kIndexBuffer"},
      {ResourceStates::kRenderTarget, "kRenderTarget"},
      {ResourceStates::kUnorderedAccess, "kUnorderedAccess"},
      {ResourceStates::kDepthWrite, "kDepthWrite"},
      {ResourceStates::kDepthRead, "kDepthRead"},
      {ResourceStates::kNonPixelShaderResource, "kNonPixelShaderResource"},
      {ResourceStates::kPixelShaderResource, "kPixelShaderResource"},
      {ResourceStates::kIndirectArgument, "kIndirectArgument"},
      {ResourceStates::kCopyDest, "kCopyDest"},
      {ResourceStates::kCopySource, "kCopySource"},
      {ResourceStates::kResolveDest, "kResolveDest"},
      {ResourceStates::kResolveSource, "kResolveSource"},
  };
  if (state == ResourceStates::kCommon) return "kCommon";
  if (state == ResourceStates::kGenericRead) return "kGenericRead";
  std::string text;
  for (const auto& [bit, name] : kNames) {
    if (HasAny(state, bit)) text += (text.empty() ? "" : " | ") + std::string(name);
  }
  return text.empty() ? hex(static_cast<uint32_t>(state)) : text;
}

void Hazards::begin_list() {
  written_.clear();
  read_.clear();
  scratch_.clear();
  states_.clear();
}

void Hazards::add(Ranges& ranges, uint64_t begin, uint64_t end, std::string what) {
  Range& range = ranges[begin];
  if (range.end < end) range.end = end;
  range.what = std::move(what);
}

void Hazards::drop(Ranges& ranges, uint64_t begin, uint64_t end) {
  for (auto it = ranges.begin(); it != ranges.end();) {
    it = it->first < end && begin < it->second.end ? ranges.erase(it) : std::next(it);
  }
}

void Hazards::hold_against(Ranges& ranges, uint64_t begin, uint64_t end, const std::string& what) {
  for (auto it = ranges.begin(); it != ranges.end();) {
    if (it->first >= end || begin >= it->second.end) {
      ++it;
      continue;
    }
    const auto allocation = addresses_.find(it->first);
    reporter_.report(
        Id::kUavBarrierMissing,
        what + " at " + address_name(addresses_, begin) + " is " + it->second.what +
            ", but there is no UAV barrier between the two. Record ResourceBarrier::Uav for " +
            (allocation && !allocation->name.empty() ? in_quotes(allocation->name)
                                                     : std::string("the buffer")) +
            ", or without a resource for all, after the first.");
    it = ranges.erase(it);
  }
}

// An enhanced barrier orders everything before it, whatever its scopes are: lists run in order. A
// global one makes no memory unusable, so that the next use promotes it.
void Hazards::access_barrier(const runtime::BarrierCommand& command) {
  if (command.buffer == nullptr) {
    for (Ranges* ranges : {&written_, &read_, &scratch_}) ranges->clear();
    states_.clear();
    return;
  }
  const uint64_t begin = command.buffer->address();
  const uint64_t end = begin + command.buffer->size_bytes();
  for (Ranges* ranges : {&written_, &read_, &scratch_}) drop(*ranges, begin, end);
  if (command.after == ResourceStates::kCommon) {
    states_.erase(begin);
  } else {
    states_[begin] = {command.after, false, label_, true};
  }
}

void Hazards::barrier(const runtime::BarrierCommand& command) {
  if (command.texture != nullptr) return;
  if (command.kind == runtime::BarrierCommand::Kind::kAccess) return access_barrier(command);
  if (command.buffer == nullptr) {
    if (command.kind != runtime::BarrierCommand::Kind::kUav) return;
    written_.clear();
    read_.clear();
    scratch_.clear();
    return;
  }
  const uint64_t begin = command.buffer->address();
  const uint64_t end = begin + command.buffer->size_bytes();
  for (Ranges* ranges : {&written_, &read_, &scratch_}) drop(*ranges, begin, end);
  if (command.kind != runtime::BarrierCommand::Kind::kTransition) return;
  const auto it = states_.find(begin);
  if (it != states_.end() && !it->second.promoted && it->second.state != command.before) {
    const auto allocation = addresses_.find(begin);
    reporter_.report(Id::kTransitionBefore,
                     "StateBefore of " +
                         (allocation ? buffer_name(*allocation) : std::string("a buffer")) +
                         " is " + state_name(command.before) + ", but it is in state " +
                         state_name(it->second.state) + " since " + it->second.by +
                         ". Pass the state that it is in.");
  }
  if (command.after == ResourceStates::kCommon) {
    states_.erase(begin);
  } else {
    states_[begin] = {command.after, false, label_};
  }
}

void Hazards::read_structure(uint64_t address, uint64_t size_bytes, const std::string& what) {
  hold_against(written_, address, address + size_bytes, what);
  add(read_, address, address + size_bytes, "read by " + label_);
}

void Hazards::write_structure(uint64_t address, uint64_t size_bytes, const std::string& what) {
  hold_against(written_, address, address + size_bytes, what);
  hold_against(read_, address, address + size_bytes, what);
  add(written_, address, address + size_bytes, "written by " + label_);
}

void Hazards::use_scratch(uint64_t address, uint64_t size_bytes) {
  if (size_bytes == 0) return;
  hold_against(scratch_, address, address + size_bytes, "the scratch memory");
  add(scratch_, address, address + size_bytes, "scratch memory of " + label_);
}

void Hazards::use(uint64_t address, ResourceStates wanted, const std::string& what) {
  const auto allocation = addresses_.find(address);
  if (!allocation || !runtime::has_free_state(allocation->heap)) return;
  if (allocation->acceleration_structure) return;
  const auto [it, first] = states_.try_emplace(allocation->address, State{wanted, true, label_});
  if (first) return;
  State& state = it->second;
  if ((state.state & wanted) == wanted) return;
  if (state.promoted && !HasAny(state.state | wanted, kWritable)) {
    state.state = state.state | wanted;
    return;
  }
  const std::string has = state_name(state.state) + " since " + state.by;
  const std::string needs = state_name(wanted);
  reporter_.report(
      Id::kResourceState,
      what + " is in " + buffer_name(*allocation) +
          (state.enhanced ? ", which is visible to " + has + "; it must be to " + needs +
                                ". Record a BufferBarrier whose AccessAfter allows that first."
                          : ", which is in state " + has + "; it must be in state " + needs +
                                ". Record ResourceBarrier::Transition from " +
                                state_name(state.state) + " to " + needs + " first."));
  state = {wanted, true, label_};
}

}  // namespace kaamos::checks
