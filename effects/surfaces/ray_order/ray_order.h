// SPDX-License-Identifier: MIT
/// @file
/// The order in which a dispatch takes the pixels of a frame: by the direction, origin or end of
/// their rays. It is a permutation, so the picture stays the same, bit for bit. [survey 3.5;
/// Meister et al. 2020]
#pragma once

#include <rtapi/rtapi.h>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// The key by which rays are sorted.
enum class RayOrder : std::uint8_t {
  kPixels,       ///< as they lie in the picture
  kDirection,    ///< 256 octahedral cells of direction
  kOrigin,       ///< cells of half a metre, then direction
  kTermination,  ///< cells of half a metre, then cells of where the ray is thought to end
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> ray_order_library();

/// Sorts the rays of one frame.
class RaySorter {
 public:
  /// Makes the pass and its buffers, and binds them to registers t5 and u11 of the frame, which
  /// must outlive it. A picture may have at most 65,535 pixels on a side.
  /// @errors KA3044 a larger picture; KA0537 a library without the pass; those of the device.
  static rtapi::Result<RaySorter> create(const rtapi::Device& device, const Frame& frame,
                                         const rtapi::ShaderLibrary& library);
  /// Records the sorting of keys that a pass of key_pass wrote, in tiles of 64 x 128 pixels.
  /// `order` is not kPixels. Dispatches with PassConstants::sorted = 1 take it.
  void sort(rtapi::CommandList& list, const Frame& frame, RayOrder order) const;
  /// A word for each pixel: its key, row by row; and for each place in the dispatch the pixel that
  /// it takes, x + 65536 * y.
  ///@{
  const rtapi::Buffer& keys() const { return keys_; }
  const rtapi::Buffer& order() const { return order_; }
  ///@}

 private:
  rtapi::Buffer keys_;
  rtapi::Buffer order_;
  rtapi::Buffer between_;  // after the first of two passes
  ComputePass pass_;
  PassViews once_;    // writes to order_
  PassViews first_;   // writes to between_
  PassViews second_;  // reads between_, writes to order_
};

}  // namespace kaamos::effects
