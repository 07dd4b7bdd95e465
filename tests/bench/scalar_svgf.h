// SPDX-License-Identifier: MIT
//
// The baseline of frame/svgf: the filter of effects/denoise written by hand in plain C++, one pixel
// at a time, on tiles over the same threads. Same equations, same order of sums. [Schied et al.
// 2017]
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <vector>

#include "effects/denoise/denoise.h"

namespace kaamos::bench {

struct Float4 {
  float x = 0, y = 0, z = 0, w = 0;
};

// Pictures that the filter reads, row by row.
struct SvgfInput {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<Float4> signal;
  std::vector<float> view_z;          // 0: no surface
  std::vector<float> shading_normal;  // two values a pixel, octahedral
  std::vector<uint32_t> instance;
  std::vector<Float4> motion;
};

// Takes it from a frame's G-buffer and a picture with one or four floats per pixel.
SvgfInput svgf_input(const rtapi::Device& device, rtapi::CommandQueue& queue,
                     const effects::Frame& frame, const rtapi::Texture& signal);

class ScalarSvgf {
 public:
  ScalarSvgf(uint32_t width, uint32_t height, const effects::DenoiseDesc& desc);

  // Filters one frame, which follows the frame of the previous call.
  void run(tbb::task_arena& arena, const SvgfInput& input);
  void reset() { frames_ = 0; }
  const std::vector<Float4>& result() const { return result_; }

 private:
  struct Reprojected {
    Float4 color;
    Float4 moments;
    float weight = 0;
  };
  struct Center;

  void prepare_guides(const SvgfInput& input, int x, int y);
  Reprojected reproject(const SvgfInput& input, int x, int y) const;
  Float4 clip_to_neighbours(const SvgfInput& input, const Reprojected& before, int x, int y) const;
  void accumulate(const SvgfInput& input, int x, int y);
  void estimate_variance(int x, int y);
  void filter(const std::vector<Float4>& from, std::vector<Float4>& to, int step, int x, int y);
  Center center(int x, int y) const;
  float smooth_variance(const std::vector<Float4>& picture, int x, int y) const;
  size_t at(int x, int y) const { return static_cast<size_t>(y) * width_ + x; }
  bool is_inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  int width_;
  int height_;
  effects::DenoiseConstants constants_;
  uint32_t iterations_;
  uint32_t iterations_with_history_;
  uint32_t frames_ = 0;
  // [parity of the frame]
  std::vector<Float4> guides_[2], moments_[2];
  std::vector<Float4> history_, accumulated_, scratch_, result_;
};

}  // namespace kaamos::bench
