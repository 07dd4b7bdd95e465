// SPDX-License-Identifier: MIT
#include <rtapi/command_list.h>

#include "rtapi/src/commands/command_list_impl.h"
#include "rtapi/src/commands/command_signature_impl.h"
#include "rtapi/src/pipelines/pipeline_state_impl.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_impl.h"
#include "rtapi/src/resources/resource_impl.h"

namespace rtapi {

using namespace detail;

namespace {

// Checks that `offset` is a multiple of 4 and that `bytes` from there lie in the buffer.
Status check_range(const std::shared_ptr<DeviceImpl>& device, const Buffer& buffer, uint64_t offset,
                   uint64_t bytes, const char* what) {
  if (Status s = CheckHandle(device, buffer, concat("ExecuteIndirect: the ", what)); !s.ok()) {
    return s;
  }
  const BufferDesc& desc = buffer.GetDesc();
  if (offset % 4 != 0) {
    return make_error(Id::kIndirectArguments, "the offset into the ", what, " is ", offset,
                      "; it must be a multiple of 4");
  }
  if (offset > desc.SizeInBytes || bytes > desc.SizeInBytes - offset) {
    return make_error(Id::kIndirectArguments, "the ", what, " needs bytes ", offset, "..",
                      offset + bytes, " of ", named("buffer", desc.Name), ", which has ",
                      desc.SizeInBytes, " bytes; check max_command_count and the offset");
  }
  return {};
}

Status check_buffers(const CommandListImpl& list, const CommandSignatureImpl& signature,
                     uint32_t max_count, const Buffer& arguments, uint64_t arguments_offset,
                     const Buffer& count, uint64_t count_offset) {
  // The buffer may end right after the last command's arguments; its stride needs no padding.
  const uint64_t bytes = max_count == 0 ? 0
                                        : uint64_t{max_count - 1} * signature.layout->stride_bytes +
                                              signature.layout->packed_bytes;
  if (Status s = check_range(list.device, arguments, arguments_offset, bytes, "argument buffer");
      !s.ok()) {
    return s;
  }
  if (!count) return {};
  return check_range(list.device, count, count_offset, sizeof(uint32_t), "count buffer");
}

// Sets what the list has for this kind of work. Returns whether that is enough; if not, an error is
// kept.
bool take_pipeline(CommandListImpl& list, runtime::IndirectWork work,
                   runtime::ExecuteIndirectCommand& command) {
  constexpr const char* kCall = "ExecuteIndirect";
  if (work == runtime::IndirectWork::kDispatchRays) {
    const StateObjectImpl* pipeline = list.rays_pipeline(kCall);
    if (!pipeline) return false;
    command.pipeline = pipeline->pipeline;
    command.linked = pipeline->linked;
    command.pipeline_stack_bytes = pipeline->stack_bytes.load();
    return true;
  }
  if (work == runtime::IndirectWork::kDispatch) {
    const PipelineStateImpl* pipeline = list.compute_pipeline(kCall);
    if (!pipeline) return false;
    command.pipeline = pipeline->pipeline;
    command.linked_compute = pipeline->linked;
    return true;
  }
  const PipelineStateImpl* pipeline =
      list.draw_pipeline(kCall, work == runtime::IndirectWork::kDrawIndexed);
  if (!pipeline) return false;
  command.pipeline = pipeline->pipeline;
  command.linked_graphics = pipeline->graphics;
  command.draw_state = list.draw_state;
  return true;
}

}  // namespace

void CommandList::ExecuteIndirect(const CommandSignature& signature, uint32_t max_count,
                                  const Buffer& arguments, uint64_t arguments_offset,
                                  const Buffer& count, uint64_t count_offset) {
  if (!impl_ || !impl_->check_open("ExecuteIndirect")) return;
  if (Status s = CheckHandle(impl_->device, signature, "ExecuteIndirect: the command signature");
      !s.ok()) {
    return impl_->fail(s.error());
  }
  const CommandSignatureImpl& given = *signature.impl();
  const runtime::IndirectWork work = given.layout->work;
  const bool draws =
      work == runtime::IndirectWork::kDraw || work == runtime::IndirectWork::kDrawIndexed;
  RootState& root = draws ? impl_->graphics : impl_->compute;
  if (given.root_signature && !same_definition(given.root_signature, root.signature)) {
    return impl_->fail(
        make_error(Id::kIndirectArguments, named("command signature", given.desc.Name),
                   " was made for another root signature than the one that is set on the list"));
  }
  // The commands bring these buffers along.
  for (const runtime::IndirectBufferView& view : given.layout->buffer_views) {
    impl_->input_uses.erase(view.of_indices ? kIndexBufferSlot : view.slot);
  }
  runtime::ExecuteIndirectCommand command;
  if (!take_pipeline(*impl_, work, command)) return;
  if (Status s =
          check_buffers(*impl_, given, max_count, arguments, arguments_offset, count, count_offset);
      !s.ok()) {
    return impl_->fail(s.error());
  }
  command.layout = given.layout;
  command.max_count = max_count;
  command.arguments = arguments.impl()->memory;
  command.arguments_offset = arguments_offset;
  if (count) command.count = count.impl()->memory;
  command.count_offset = count_offset;
  // The commands bring these arguments along, so they are looked at when they are read.
  for (const runtime::IndirectArgument& argument : given.layout->root_arguments) {
    root.views.erase(argument.root_parameter);
  }
  command.state = impl_->snapshot("ExecuteIndirect", root);
  impl_->record(std::move(command));
  // After ExecuteIndirect, everything that the signature sets is zero or null. [D3D12: Indirect
  // drawing]
  for (const runtime::IndirectArgument& argument : given.layout->root_arguments) {
    root.clear(argument.dest_offset, argument.size_bytes);
  }
  for (const runtime::IndirectBufferView& view : given.layout->buffer_views) {
    runtime::DrawState& state = impl_->writable_draw_state();
    if (view.of_indices) {
      state.index_buffer = {};
    } else {
      state.vertex_buffers[view.slot] = {};
    }
  }
}

}  // namespace rtapi
