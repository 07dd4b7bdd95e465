// SPDX-License-Identifier: MIT
#include "runtime/backend/executor.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/backend/indirect.h"
#include "runtime/backend/printing.h"

namespace kaamos::runtime {
namespace {

class Executor {
 public:
  Executor(CommandTarget& target, const Context& context) : target_(target), context_(context) {}

  // With checked mode's layer around it.
  rtapi::Status run(const Command& command);
  void next() { ++index_; }

  rtapi::Status operator()(const DispatchRaysCommand& command) {
    return take(target_.dispatch_rays(command, label("DispatchRays")));
  }
  rtapi::Status operator()(const DispatchCommand& command) {
    count(command);
    return take(target_.dispatch(command, label("Dispatch")));
  }
  rtapi::Status operator()(const ExecuteIndirectCommand& command);
  rtapi::Status operator()(const BuildCommand& command) { return target_.build(command); }
  rtapi::Status operator()(const EmitPostbuildInfoCommand& command) {
    return target_.emit_postbuild_info(command);
  }
  rtapi::Status operator()(const CopyAccelerationStructureCommand& command) {
    return target_.copy_structure(command);
  }
  rtapi::Status operator()(const RtasOperationsCommand& command) {
    return target_.execute_operations(command, label("ExecuteIndirectRTASOperations"));
  }
  rtapi::Status operator()(const CopyBufferCommand& command) {
    return target_.copy_buffer(command, label("CopyBufferRegion"));
  }
  rtapi::Status operator()(const CopyTextureCommand& command) {
    return target_.copy_texture(command);
  }
  rtapi::Status operator()(const ResolveCommand& command) {
    if (command.mode != rtapi::ResolveMode::kDecompress) return target_.resolve(command);
    // Nothing is compressed: the samples go from one place to the other as they are.
    CopyTextureCommand copy;
    copy.dest = command.dest;
    copy.source = command.source;
    std::copy(command.extent, command.extent + 2, copy.extent);
    copy.extent[2] = 1;
    return target_.copy_texture(copy);
  }
  rtapi::Status operator()(const ClearUavCommand& command) { return target_.clear(command); }
  rtapi::Status operator()(const DrawCommand& command) {
    const rtapi::DrawIndexedArguments& a = command.arguments;
    by_host_.statistics.IAVertices += uint64_t{a.IndexCountPerInstance} * a.InstanceCount;
    return target_.draw(command, label(command_name(*running_)));
  }
  rtapi::Status operator()(const ClearTargetCommand& command) {
    return target_.clear_target(command);
  }
  rtapi::Status operator()(const TimestampCommand& command) {
    auto status = target_.write_timestamp(command);
    if (status) command.heap->set_written(command.index);
    return status;
  }
  rtapi::Status operator()(const BeginQueryCommand& command);
  rtapi::Status operator()(const EndQueryCommand& command);
  rtapi::Status operator()(const ResolveQueriesCommand& command);
  rtapi::Status operator()(const PredicationCommand& command);
  rtapi::Status operator()(const BarrierCommand&) { return target_.barrier(); }
  rtapi::Status operator()(const EventCommand& command) {
    if (command.begin) {
      events_.push_back(command.name);
    } else if (!events_.empty()) {
      events_.pop_back();
    }
    return {};
  }

 private:
  std::string label(const char* what) const {
    std::string text =
        std::string(indirect_ ? "ExecuteIndirect" : what) + ", command " + std::to_string(index_);
    if (!events_.empty()) text += " in \"" + events_.back() + "\"";
    return indirect_ ? indirect_label(what, *indirect_, text) : text;
  }
  rtapi::Status take(DispatchOutcome outcome);
  void count(const DispatchCommand& command);
  WorkToCount work_to_count() const;
  WorkCounts sums() const;

  CommandTarget& target_;
  const Context& context_;
  const Command* running_ = nullptr;
  size_t index_ = 0;
  std::optional<uint32_t> indirect_;  // which dispatch of an ExecuteIndirect is running
  std::vector<std::string> events_;
  // The running dispatch's. They are reported after what checked mode finds, which knows the cause.
  std::vector<DispatchOutcome::Warning> warnings_;
  std::vector<const CountingQueries*> running_queries_;  // a heap once for each of them
  WorkCounts by_host_;       // sums of all commands, of what backends do not count
  bool leaves_out_ = false;  // by predication
};

// The commands that predication concerns. [D3D12: Predication]
bool is_predicated(const Command& command) {
  if (const auto* copy = std::get_if<CopyBufferCommand>(&command)) return !copy->immediate;
  return std::holds_alternative<DrawCommand>(command) ||
         std::holds_alternative<DispatchCommand>(command) ||
         std::holds_alternative<ExecuteIndirectCommand>(command) ||
         std::holds_alternative<CopyTextureCommand>(command) ||
         std::holds_alternative<ResolveCommand>(command) ||
         std::holds_alternative<ClearUavCommand>(command) ||
         std::holds_alternative<ClearTargetCommand>(command);
}

rtapi::Status Executor::take(DispatchOutcome outcome) {
  if (auto* observer = context_.observer) {
    if (!outcome.reached.empty()) observer->reached(*running_, outcome.reached);
    observer->missed(*running_, outcome.missing);
  }
  warnings_ = std::move(outcome.warnings);
  return std::move(outcome.status);
}

rtapi::Status Executor::run(const Command& command) {
  if (leaves_out_ && is_predicated(command)) return {};
  running_ = &command;
  CommandObserver* observer = context_.observer;
  rtapi::Status status;
  if (observer != nullptr) {
    if (observer->needs_memory(command)) status = target_.finish();
    if (status) observer->before(command, label(command_name(command)));
  }
  if (status) status = std::visit(*this, command);
  if (observer != nullptr) {
    if (status && observer->needs_memory_after(command)) status = target_.finish();
    observer->after(command, status.ok());
  }
  for (const auto& warning : std::exchange(warnings_, {})) {
    context_.message(make_message(warning.id, warning.text));
  }
  if (const Printed printed = printed_by(command); printed.buffer != nullptr) {
    // Also of a shader that removed the device, which may have said why.
    if (status) status = target_.finish();
    tell_prints(printed, label(command_name(command)), context_.message);
  }
  return status;
}

rtapi::Status Executor::operator()(const ExecuteIndirectCommand& command) {
  // Earlier commands may write the arguments.
  if (auto s = target_.finish(); !s) return s;
  const auto run_one = [&](const Command& dispatch, uint32_t index) {
    indirect_ = index;
    auto status = run(dispatch);
    indirect_.reset();
    return status;
  };
  return execute_indirect(*context_.addresses, command, label("ExecuteIndirect"), run_one);
}

void Executor::count(const DispatchCommand& command) {
  if (running_queries_.empty() || command.linked == nullptr) return;
  uint64_t threads = 1;
  for (uint32_t i = 0; i < 3; ++i) {
    threads *= uint64_t{command.groups[i]} * command.linked->shader.code->compute->thread_group[i];
  }
  by_host_.statistics.CSInvocations += threads;
}

WorkToCount Executor::work_to_count() const {
  WorkToCount what;
  for (const CountingQueries* heap : running_queries_) {
    (heap->type() == rtapi::QueryHeapType::kOcclusion ? what.samples : what.statistics) = true;
  }
  return what;
}

WorkCounts Executor::sums() const {
  WorkCounts all = target_.counted();
  all.add(by_host_);
  return all;
}

rtapi::Status Executor::operator()(const BeginQueryCommand& command) {
  running_queries_.push_back(command.heap.get());
  if (auto s = target_.count_work(work_to_count()); !s) return s;
  command.heap->begin(command.index, sums());
  return {};
}

rtapi::Status Executor::operator()(const EndQueryCommand& command) {
  const auto it = std::find(running_queries_.begin(), running_queries_.end(), command.heap.get());
  if (it != running_queries_.end()) running_queries_.erase(it);
  if (auto s = target_.count_work(work_to_count()); !s) return s;
  command.heap->end(command.index, sums());
  command.heap->set_written(command.index);
  return {};
}

rtapi::Status Executor::operator()(const PredicationCommand& command) {
  leaves_out_ = false;
  if (command.buffer == nullptr) return {};
  // Earlier commands may write the value.
  if (auto s = target_.finish(); !s) return s;
  uint64_t value;
  std::memcpy(&value, command.buffer->host() + command.offset, sizeof value);
  leaves_out_ = (value == 0) == (command.op == rtapi::PredicationOp::kEqualZero);
  return {};
}

rtapi::Status Executor::operator()(const ResolveQueriesCommand& command) {
  for (uint32_t i = command.first; i < command.first + command.count; ++i) {
    if (command.heap->written(i)) continue;
    warnings_.push_back({Id::kQueryNotWritten, label("ResolveQueryData") + ": query " +
                                                   std::to_string(i) +
                                                   " was never ended, and is 0."});
    break;
  }
  if (command.type == rtapi::QueryType::kTimestamp) return target_.resolve_timestamps(command);
  const auto& queries = static_cast<const CountingQueries&>(*command.heap);
  return target_.write_buffer(command.dest, command.dest_offset,
                              queries.data(command.type, command.first, command.count));
}

}  // namespace

rtapi::Status execute(std::span<const Command> commands, CommandTarget& target,
                      const Context& context) {
  Executor executor(target, context);
  for (const Command& command : commands) {
    if (context.stopped->load(std::memory_order_relaxed)) break;
    if (auto s = executor.run(command); !s) return s;
    executor.next();
  }
  return {};
}

}  // namespace kaamos::runtime
