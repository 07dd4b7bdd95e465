// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include <rtapi/pipeline_state.h>

#include "rtapi/src/device/device_impl.h"

namespace rtapi::detail {

struct PipelineStateImpl {
  std::shared_ptr<DeviceImpl> device;
  std::string name;
  RootSignature root_signature;
  std::shared_ptr<runtime::BackendPipeline> pipeline;
  // Exactly one of the two.
  std::shared_ptr<const runtime::LinkedCompute> linked;
  std::shared_ptr<const runtime::LinkedGraphics> graphics;
};

}  // namespace rtapi::detail
