// SPDX-License-Identifier: MIT
/// @file
/// This file holds what drawing a scene takes besides the targets: the list of draws with the
/// buffers that shaders read of it, and a pair of pipelines for opaque and for alpha-tested
/// geometry.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "effects/engine/frame.h"
#include "effects/engine/scene_draws.h"

namespace kaamos::effects {

/// The draws of a scene on the device: a SceneDraw each, and the HitConstants of every geometry.
class SceneDrawList {
 public:
  /// Registers t of space3 that the two buffers get.
  struct Registers {
    std::uint32_t draws = 0;       ///< StructuredBuffer<SceneDraw>
    std::uint32_t geometries = 1;  ///< StructuredBuffer<HitConstants>
  };

  /// Makes the buffers, with room for the most draws that a frame of the scene has. `gpu` is
  /// `scene` on the device and must stay. `name` stands before those of the buffers.
  /// @errors those of rtapi::Device::CreateBuffer and of PassViews::set_shader_resource.
  rtapi::Status create(const rtapi::Device& device, const Scene& scene, const GpuScene& gpu,
                       PassViews& views, const Registers& registers, const std::string& name);

  /// Draws what rays of instance mask `mask` can hit, as the instances stand now. [scene_draws]
  /// What was recorded before must have finished: the device reads what is written now.
  void see_instances(std::uint32_t mask);
  /// The same with draws of one's own, at most as many as a frame of the scene has.
  void set(std::vector<SceneDraw> draws);
  /// The draws in the list.
  const std::vector<SceneDraw>& draws() const { return draws_; }
  /// The geometry of a draw.
  const GpuGeometry& geometry(std::size_t draw) const {
    return gpu_->geometries[draws_[draw].geometry];
  }
  /// Records what a draw reads: its vertices, its indices and its number, which becomes `word` of
  /// constants b0, space3.
  void bind(rtapi::CommandList& list, std::uint32_t draw, std::uint32_t word) const;
  /// The same, and the draw.
  void record(rtapi::CommandList& list, std::uint32_t draw, std::uint32_t word) const;
  /// Bytes of the buffers.
  std::uint64_t bytes() const { return draw_buffer_.size() + geometry_buffer_.size(); }

 private:
  const GpuScene* gpu_ = nullptr;
  rtapi::Buffer draw_buffer_, geometry_buffer_;
  std::vector<SceneDraw> draws_;
};

/// A pipeline that draws opaque geometry, and one that draws what has holes.
class ScenePipeline {
 public:
  /// The description of both pipelines. They draw triangles from both sides, as rays hit both, with
  /// a depth test.
  struct Desc {
    rtapi::ShaderLibrary library;             ///< where the shaders are
    std::string vertex_shader;                ///< takes POSITION and TEXCOORD
    std::string vertex_shader_of_holes;       ///< besides what `pixel_shader_of_holes` needs
    std::string pixel_shader;                 ///< of opaque geometry; empty: depth alone
    std::string pixel_shader_of_holes;        ///< discards what a texture's alpha cuts out
    rtapi::ComparisonFunc depth_func{};       ///< which depth stays
    std::vector<rtapi::Format> targets = {};  ///< of the render targets; depth is D32_FLOAT
    std::string name;                         ///< for messages
  };

  /// Makes both.
  /// @errors those of rtapi::Device::CreateGraphicsPipelineState, on Vulkan KA0965 without graphics
  /// pipelines among them.
  static rtapi::Result<ScenePipeline> create(const rtapi::Device& device, const Frame& frame,
                                             const Desc& desc);
  /// The one that draws such geometry.
  const rtapi::PipelineState& of(const GpuGeometry& geometry) const {
    return geometry.alpha_tested ? with_holes_ : opaque_;
  }
  /// Records all draws. What has holes comes last: what stands before it hides some of its pixels,
  /// whose textures need not be read then.
  void record(rtapi::CommandList& list, const SceneDrawList& draws, std::uint32_t word) const;

 private:
  rtapi::PipelineState opaque_, with_holes_;
};

/// Records that draws fill this part of their targets, pixels, at depths from 0 to 1.
void set_draw_area(rtapi::CommandList& list, std::uint32_t x, std::uint32_t y, std::uint32_t width,
                   std::uint32_t height);

/// POSITION of a scene's vertices, and TEXCOORD, for GraphicsPipelineStateDesc::InputLayout.
std::vector<rtapi::InputElementDesc> scene_input_layout();

}  // namespace kaamos::effects
