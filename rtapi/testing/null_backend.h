// SPDX-License-Identifier: MIT
//
// A backend for unit tests: memory is real and buffers are really copied; everything else is only
// recorded.
#pragma once

#include <memory>
#include <vector>

#include <rtapi/rtapi.h>

#include "runtime/backend/backend.h"

namespace rtapi::testing {

struct NullPipeline : kaamos::runtime::BackendPipeline {
  std::shared_ptr<const kaamos::runtime::LinkedPipeline> raytracing;
  std::shared_ptr<const kaamos::runtime::LinkedCompute> compute;
  std::shared_ptr<const kaamos::runtime::LinkedGraphics> graphics;
};

// A record of what the backend of one device saw.
struct NullLog {
  std::vector<kaamos::runtime::Command> executed;
  std::vector<kaamos::runtime::TextureViewDesc> texture_views;
  std::vector<SamplerDesc> samplers;
  std::shared_ptr<const kaamos::runtime::LinkedPipeline> last_raytracing;
  std::shared_ptr<const kaamos::runtime::LinkedCompute> last_compute;
  std::shared_ptr<const kaamos::runtime::LinkedGraphics> last_graphics;
  Status fail_next_execute;  // returned once
};

// Makes a device "null". null_log() returns the log of the device made last.
Device CreateNullDevice(DeviceDesc desc = {});
NullLog& null_log();

}  // namespace rtapi::testing
