// SPDX-License-Identifier: MIT
//
// CreateCommandSignature: every rule that concerns a signature alone. [D3D12: Indirect drawing]
#include <rtapi/command_signature.h>
#include <rtapi/device.h>
#include <rtapi/graphics_pipeline.h>

#include "rtapi/src/commands/command_signature_impl.h"
#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/root_signature_impl.h"

namespace rtapi {

namespace detail {

namespace {

using Type = IndirectArgumentType;

class LayoutMaker {
 public:
  LayoutMaker(const DeviceImpl& device, const CommandSignatureDesc& desc,
              const RootSignature& root_signature)
      : device_(device), desc_(desc), root_signature_(root_signature) {}

  Result<runtime::IndirectLayout> run();

 private:
  Status add(const IndirectArgumentDesc& argument, size_t index);
  Status add_root(const std::string& where, uint32_t parameter, RootParameterType type,
                  uint32_t first_value, uint32_t values);
  Status add_work(const std::string& where, runtime::IndirectWork work, uint32_t bytes,
                  size_t index);
  Status add_buffer_view(const std::string& where, bool of_indices, uint32_t slot);

  const DeviceImpl& device_;
  const CommandSignatureDesc& desc_;
  const RootSignature& root_signature_;
  runtime::IndirectLayout layout_;
  bool complete_ = false;   // the draw or dispatch was seen
  uint64_t next_root_ = 0;  // the lowest (parameter, value) that may be set next
};

Status LayoutMaker::add_work(const std::string& where, runtime::IndirectWork work, uint32_t bytes,
                             size_t index) {
  if (index + 1 != desc_.ArgumentDescs.size()) {
    return make_error(Id::kCommandSignature, where, " is a draw or dispatch, but ",
                      desc_.ArgumentDescs.size() - 1 - index,
                      " arguments follow it; it must be the last argument, and there must be only "
                      "one");
  }
  if (work == runtime::IndirectWork::kDispatchRays &&
      device_.desc.Tier < RaytracingTier::kTier1_1) {
    return make_error(Id::kCommandSignatureTier, where, ": kDispatchRays needs tier 1.1, ",
                      but_tier(device_));
  }
  const bool draws =
      work == runtime::IndirectWork::kDraw || work == runtime::IndirectWork::kDrawIndexed;
  if (!draws && !layout_.buffer_views.empty()) {
    return make_error(Id::kCommandSignature, where,
                      " is a dispatch, which does not go with vertex and index buffer views");
  }
  complete_ = true;
  layout_.work = work;
  layout_.work_offset = layout_.packed_bytes;
  layout_.packed_bytes += bytes;
  return {};
}

Status LayoutMaker::add_buffer_view(const std::string& where, bool of_indices, uint32_t slot) {
  if (slot >= kIAVertexInputResourceSlotCount) {
    return make_error(Id::kCommandSignature, where, " sets vertex buffer ", slot,
                      "; there are 0 to 31");
  }
  for (const runtime::IndirectBufferView& other : layout_.buffer_views) {
    if (other.of_indices != of_indices || other.slot != slot) continue;
    return make_error(Id::kCommandSignature, where, " sets ",
                      of_indices ? "the index buffer" : concat("vertex buffer ", slot),
                      " a second time");
  }
  layout_.buffer_views.push_back({layout_.packed_bytes, of_indices, slot});
  layout_.packed_bytes += sizeof(VertexBufferView);
  return {};
}

Status LayoutMaker::add_root(const std::string& where, uint32_t parameter, RootParameterType type,
                             uint32_t first_value, uint32_t values) {
  if (!root_signature_) {
    return make_error(Id::kCommandSignature, where,
                      " sets a root argument; pass the root signature to CreateCommandSignature");
  }
  const auto& parameters = root_signature_.GetDesc().Parameters;
  if (parameter >= parameters.size()) {
    return make_error(Id::kCommandSignature, where, ": root parameter ", parameter,
                      " does not exist; the root signature has ", parameters.size());
  }
  if (parameters[parameter].ParameterType != type) {
    return make_error(Id::kCommandSignature, where, ": root parameter ", parameter, " is of type ",
                      static_cast<uint32_t>(parameters[parameter].ParameterType),
                      ", but this argument sets one of type ", static_cast<uint32_t>(type));
  }
  const bool constants = type == RootParameterType::k32BitConstants;
  const uint64_t total = constants ? parameters[parameter].Constants.Num32BitValues : 1;
  if (values == 0) {
    return make_error(Id::kCommandSignature, where,
                      ": Num32BitValuesToSet is 0; it must be at least 1");
  }
  if (uint64_t{first_value} + values > total) {
    return make_error(Id::kCommandSignature, where, ": values ", first_value, "..",
                      uint64_t{first_value} + values, " of root parameter ", parameter,
                      ", which has only ", total);
  }
  const uint64_t key = uint64_t{parameter} << 32 | first_value;
  if (key < next_root_) {
    return make_error(
        Id::kCommandSignature, where, ": root parameter ", parameter, ", value ", first_value,
        ", is out of order; sort the arguments by parameter and value, and set each value once");
  }
  next_root_ = constants ? key + values : (uint64_t{parameter} + 1) << 32;
  runtime::IndirectArgument out;
  out.source_offset = layout_.packed_bytes;
  out.dest_offset = root_signature_.GetArgumentOffset(parameter) + first_value * 4;
  out.size_bytes = constants ? values * 4 : sizeof(GpuVirtualAddress);
  out.root_parameter = parameter;
  if (!constants) out.view_alignment = type == RootParameterType::kCbv ? 256 : 4;
  layout_.packed_bytes += out.size_bytes;
  layout_.root_arguments.push_back(out);
  return {};
}

Status LayoutMaker::add(const IndirectArgumentDesc& argument, size_t index) {
  const std::string where = concat("argument ", index);
  switch (argument.Type) {
    case Type::kDispatch:
      return add_work(where, runtime::IndirectWork::kDispatch, sizeof(DispatchArguments), index);
    case Type::kDispatchRays:
      return add_work(where, runtime::IndirectWork::kDispatchRays, sizeof(DispatchRaysDesc), index);
    case Type::kDraw:
      return add_work(where, runtime::IndirectWork::kDraw, sizeof(DrawArguments), index);
    case Type::kDrawIndexed:
      return add_work(where, runtime::IndirectWork::kDrawIndexed, sizeof(DrawIndexedArguments),
                      index);
    case Type::kVertexBufferView:
      return add_buffer_view(where, false, argument.VertexBuffer.Slot);
    case Type::kIndexBufferView:
      return add_buffer_view(where, true, 0);
    case Type::kConstant:
      return add_root(where, argument.Constant.RootParameterIndex,
                      RootParameterType::k32BitConstants, argument.Constant.DestOffsetIn32BitValues,
                      argument.Constant.Num32BitValuesToSet);
    case Type::kConstantBufferView:
      return add_root(where, argument.ConstantBufferView.RootParameterIndex,
                      RootParameterType::kCbv, 0, 1);
    case Type::kShaderResourceView:
      return add_root(where, argument.ShaderResourceView.RootParameterIndex,
                      RootParameterType::kSrv, 0, 1);
    case Type::kUnorderedAccessView:
      return add_root(where, argument.UnorderedAccessView.RootParameterIndex,
                      RootParameterType::kUav, 0, 1);
    default:
      return make_error(Id::kCommandSignature, where, " has type ",
                        static_cast<uint32_t>(argument.Type),
                        "; it must be 0 to 9: kDispatchMesh (10) is not supported");
  }
}

Result<runtime::IndirectLayout> LayoutMaker::run() {
  if (desc_.ArgumentDescs.empty()) {
    return make_error(Id::kCommandSignature,
                      "no arguments; the last one must be a draw or dispatch");
  }
  for (size_t i = 0; i < desc_.ArgumentDescs.size(); ++i) {
    if (Status s = add(desc_.ArgumentDescs[i], i); !s.ok()) return s.error();
  }
  if (!complete_) {
    return make_error(Id::kCommandSignature, "the last argument is not a draw or dispatch");
  }
  if (desc_.ByteStride % 4 != 0 || desc_.ByteStride < layout_.packed_bytes) {
    return make_error(Id::kCommandSignature, "ByteStride is ", desc_.ByteStride,
                      "; it must be a multiple of 4 and at least ", layout_.packed_bytes,
                      ", the size of the arguments");
  }
  layout_.stride_bytes = desc_.ByteStride;
  return std::move(layout_);
}

}  // namespace

}  // namespace detail

using namespace detail;

const CommandSignatureDesc& CommandSignature::GetDesc() const {
  static const CommandSignatureDesc kEmpty;
  return impl_ ? impl_->desc : kEmpty;
}

Result<CommandSignature> Device::CreateCommandSignature(const CommandSignatureDesc& desc,
                                                        const RootSignature& root_signature) const {
  if (!impl_)
    return make_error(Id::kNullHandle, "CreateCommandSignature on an empty device handle");
  if (Status s = impl_->removed(); !s.ok()) return s.error();
  if (root_signature) {
    if (Status s = CheckHandle(impl_, root_signature, "the root signature"); !s.ok()) {
      return s.error();
    }
    if (root_signature.is_local()) {
      return make_error(Id::kRootSignatureKind,
                        "CreateCommandSignature takes a global root signature, but this one is "
                        "local; local arguments belong in shader records");
    }
  }
  auto layout = LayoutMaker(*impl_, desc, root_signature).run();
  if (!layout.ok()) return layout.error();
  auto impl = std::make_shared<CommandSignatureImpl>();
  impl->device = impl_;
  impl->desc = desc;
  if (!layout->root_arguments.empty()) impl->root_signature = root_signature;
  impl->layout = std::make_shared<const runtime::IndirectLayout>(std::move(*layout));
  return CommandSignature(std::move(impl));
}

}  // namespace rtapi
