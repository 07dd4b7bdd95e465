// SPDX-License-Identifier: MIT
#include "runtime/raster/primitives.h"

#include <algorithm>

namespace kaamos::raster {
namespace {

using rtapi::PrimitiveTopology;

// 0: nothing is drawn.
uint32_t corners_of(PrimitiveTopology topology) {
  switch (topology) {
    case PrimitiveTopology::kPointList:
      return 1;
    case PrimitiveTopology::kLineList:
    case PrimitiveTopology::kLineStrip:
      return 2;
    case PrimitiveTopology::kTriangleList:
    case PrimitiveTopology::kTriangleStrip:
      return 3;
    default:
      return 0;
  }
}

}  // namespace

Indices::Indices(const Draw& draw) {
  if (!draw.indexed) return;
  data_ = draw.indices.data();
  bytes_each_ = draw.state->index_buffer.Format == rtapi::Format::kR16Uint ? 2 : 4;
  count_ = draw.indices.size() / bytes_each_;
  first_ = draw.arguments.StartIndexLocation;
}

RangeCursor::RangeCursor(const Draw& draw, uint32_t number, uint32_t limit)
    : draw_(number),
      limit_(limit),
      corners_(corners_of(draw.state->topology)),
      strip_(runtime::is_strip(draw.state->topology)),
      instances_(draw.arguments.InstanceCount) {
  const uint32_t count = draw.arguments.IndexCountPerInstance;
  if (!strip_) {
    if (corners_ != 0 && count >= corners_) segments_.push_back({0, 0, count / corners_});
  } else if (draw.indexed && draw.linked->strip_cut != rtapi::IndexBufferStripCutValue::kDisabled) {
    cut_strip(draw);
  } else {
    add_strip(0, count);
  }
}

void RangeCursor::add_strip(uint64_t first, uint64_t vertices) {
  if (vertices < corners_) return;
  const auto count = static_cast<uint32_t>(vertices - corners_ + 1);
  segments_.push_back({first, primitives_, count});
  primitives_ += count;
}

// The cut value is compared as it is, whatever the format of the indices.
void RangeCursor::cut_strip(const Draw& draw) {
  const Indices indices(draw);
  const uint32_t cut =
      draw.linked->strip_cut == rtapi::IndexBufferStripCutValue::k0xFFFF ? 0xFFFFu : 0xFFFFFFFFu;
  const uint64_t count = draw.arguments.IndexCountPerInstance;
  uint64_t first = 0;
  for (uint64_t i = 0; i < count; ++i) {
    if (indices.at(i) != cut) continue;
    add_strip(first, i - first);
    first = i + 1;
  }
  add_strip(first, count - first);
}

bool RangeCursor::next(PrimitiveRange& range) {
  if (segments_.empty() || instance_ == instances_) return false;
  const Segment& segment = segments_[segment_];
  range.draw = draw_;
  range.instance = instance_;
  range.count = std::min(limit_, segment.count - done_);
  range.primitive_id = segment.primitive_id + done_;
  range.first = segment.first + (strip_ ? uint64_t{done_} : uint64_t{done_} * corners_);
  range.corners = corners_;
  range.strip = strip_;
  range.odd = (done_ & 1) != 0;
  done_ += range.count;
  if (done_ == segment.count) {
    done_ = 0;
    if (++segment_ == segments_.size()) {
      segment_ = 0;
      ++instance_;
    }
  }
  return true;
}

}  // namespace kaamos::raster
