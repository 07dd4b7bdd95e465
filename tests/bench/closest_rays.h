// SPDX-License-Identifier: MIT
//
// Rays that a pipeline traces through any top level, and what they hit.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>

#include <vector>

#include "fixtures.h"

namespace kaamos::bench {

// One for each pixel of the options, from random points of a box in random directions.
std::vector<Ray> random_rays(const Options& options, const float (&lower)[3],
                             const float (&upper)[3]);

class ClosestRays {
 public:
  ClosestRays(const rtapi::Device& device, const rtapi::CommandQueue& queue, const Options& options,
              const std::vector<Ray>& rays);

  rtapi::CommandList list_for(rtapi::GpuVirtualAddress top_level) const;
  // The hits of the list that ran last.
  std::vector<ClosestResult> results() const;

 private:
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::Buffer rays_, results_;
  rtapi::RootSignature signature_;
  rtapi::StateObject pipeline_;
  std::vector<rtapi::ShaderTable> tables_;
  rtapi::DispatchRaysDesc dispatch_;
};

}  // namespace kaamos::bench
