// SPDX-License-Identifier: MIT
/// @file
/// A ray tracing pipeline over a frame: state object, shader tables, dispatch. Each dispatch has a
/// state object of its own. [Northlight deck: One state object per dispatch]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <string>

#include "effects/engine/frame.h"
#include "effects/engine/gpu_scene.h"

namespace kaamos::effects {

/// Hit shaders of one ray type. The any-hit shader is for alpha-tested geometry only. Both empty: a
/// hit runs nothing, which is all that a visibility ray needs.
struct HitShaders {
  std::string any_hit;      ///< an export; empty: none
  std::string closest_hit;  ///< an export; empty: none
};

/// The shaders of a pass, and what they ask for.
struct RayPassDesc {
  std::string name;              ///< for messages
  rtapi::ShaderLibrary library;  ///< where the shaders are
  std::string ray_generation;    ///< an export
  /// A ray generation shader that traces nothing and writes what each pixel's first ray is sorted
  /// by (WriteRayKey of ray_key.hlsli). Empty: the pass's rays cannot be sorted.
  std::string key_generation;
  /// By ray type; an empty name makes a record that runs nothing.
  std::array<std::string, kRayTypeCount> miss;
  std::array<HitShaders, kRayTypeCount> hit;  ///< by ray type
  std::uint32_t payload_bytes = 4;            ///< of the largest payload
  std::uint32_t max_recursion_depth = 1;      ///< 0 to 31
};

/// The pass that writes the keys of another's rays; it takes the same arguments.
RayPassDesc key_pass(const RayPassDesc& desc);

/// The pipeline of a pass and its shader tables, which have records for every geometry of the
/// scene.
class RayPass {
 public:
  /// Makes the pipeline and the tables.
  /// @errors those of rtapi::Device::CreateStateObject, rtapi::ShaderTable::AddRecord and
  /// rtapi::Device::CreateBuffer.
  static rtapi::Result<RayPass> create(const rtapi::Device& device, const Frame& frame,
                                       const GpuScene& scene, const RayPassDesc& desc);
  /// Records a dispatch over `row_count` rows of the picture from constants.first_row on, and the
  /// barrier behind it. Rows are those that get rays [traced_rows].
  void dispatch(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
                std::uint32_t row_count, const PassArguments& arguments = {}) const;
  /// The same over another grid than the frame's: half resolution, texels of an atlas, cells.
  void dispatch_grid(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
                     std::uint32_t width, std::uint32_t height,
                     const PassArguments& arguments) const;

  /// The state object.
  const rtapi::StateObject& pipeline() const { return pipeline_; }
  /// The tables of every dispatch; no size.
  const rtapi::DispatchRaysDesc& tables() const { return dispatch_; }

 private:
  rtapi::StateObject pipeline_;
  rtapi::Buffer tables_[3];  // keeps them alive
  rtapi::DispatchRaysDesc dispatch_;
};

}  // namespace kaamos::effects
