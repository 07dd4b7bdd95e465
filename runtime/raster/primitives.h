// SPDX-License-Identifier: MIT
//
// The input assembler's first half: which vertices of a draw form its points, lines or triangles.
// [D3D11.3: 8]
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/raster/draw.h"

namespace kaamos::raster {

// The indices of a draw; of a draw without an index buffer 0, 1, 2, ...
class Indices {
 public:
  explicit Indices(const Draw& draw);
  // Number `position` of an instance; 0 beyond the buffer. [D3D11.3: 8.6]
  uint32_t at(uint64_t position) const {
    if (bytes_each_ == 0) return static_cast<uint32_t>(position);
    const uint64_t place = first_ + position;
    if (place >= count_) return 0;
    if (bytes_each_ == 2) {
      uint16_t index;
      std::memcpy(&index, data_ + place * 2, 2);
      return index;
    }
    uint32_t index;
    std::memcpy(&index, data_ + place * 4, 4);
    return index;
  }

 private:
  const uint8_t* data_ = nullptr;
  uint64_t count_ = 0;  // whole indices in the buffer
  uint64_t first_ = 0;
  uint32_t bytes_each_ = 0;  // 0: no index buffer
};

// Primitives of one instance that follow each other: triangle i has the vertices at positions
// first + 3 i, + 1, + 2 of a list, and first + i, + 1, + 2 of a strip, the last two swapped where
// i + odd is odd. Lines and points have as many as they have corners.
struct PrimitiveRange {
  uint32_t draw = 0;
  uint32_t instance = 0;
  uint64_t first = 0;
  uint32_t primitive_id = 0;  // of the first
  uint32_t count = 0;
  uint32_t corners = 3;  // of a primitive: 1 to 3
  bool strip = false;
  bool odd = false;
};

// Cuts a draw into ranges of at most `limit` primitives, in the order of drawing.
class RangeCursor {
 public:
  RangeCursor(const Draw& draw, uint32_t number, uint32_t limit);
  // False at the end.
  bool next(PrimitiveRange& range);

 private:
  // A list, or a strip between cuts.
  struct Segment {
    uint64_t first;
    uint32_t primitive_id;
    uint32_t count;
  };

  void cut_strip(const Draw& draw);
  void add_strip(uint64_t first, uint64_t vertices);

  uint32_t draw_;
  uint32_t limit_;
  uint32_t corners_;
  bool strip_;
  uint32_t instances_;
  std::vector<Segment> segments_;
  uint32_t primitives_ = 0;
  uint32_t instance_ = 0;
  size_t segment_ = 0;
  uint32_t done_ = 0;  // primitives of the segment
};

}  // namespace kaamos::raster
