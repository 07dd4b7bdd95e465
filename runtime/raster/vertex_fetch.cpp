// SPDX-License-Identifier: MIT
#include "runtime/raster/vertex_fetch.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "runtime/shader/texture/format_codec.h"

namespace kaamos::raster {
namespace {

constexpr uint8_t kZeroElement[16] = {};

bool is_plain_words(rtapi::Format format) {
  const rtapi::FormatInfo info = rtapi::GetFormatInfo(format);
  return info.channel_bits == 32 && info.type != rtapi::FormatClass::kTypeless;
}

}  // namespace

void VertexFetch::bind(const Draw& draw) {
  vertex_id_column_ = draw.linked->vertex_columns.vertex_id;
  instance_id_column_ = draw.linked->vertex_columns.instance_id;
  start_vertex_column_ = draw.linked->vertex_columns.start_vertex;
  start_instance_column_ = draw.linked->vertex_columns.start_instance;
  base_vertex_ = draw.indexed ? static_cast<uint32_t>(draw.arguments.BaseVertexLocation)
                              : draw.arguments.StartIndexLocation;
  base_instance_ = draw.arguments.StartInstanceLocation;
  elements_.clear();
  for (const runtime::LinkedElement& linked : draw.linked->elements) {
    const auto& codec = shader::format_codec(static_cast<uint32_t>(linked.format));
    const std::span<const uint8_t> bytes = draw.vertex_buffers[linked.slot];
    Element element{};
    element.bytes = bytes.data();
    element.size = bytes.size();
    element.offset = linked.offset_bytes;
    element.stride = draw.state->vertex_buffers[linked.slot].StrideInBytes;
    element.element_bytes = codec.bytes;
    element.first_column = linked.first_column;
    element.components = linked.components;
    element.step_rate = linked.step_rate;
    element.words = is_plain_words(linked.format) ? codec.bytes / 4u : 0;
    element.per_instance = linked.per_instance;
    element.decode = codec.decode;
    elements_.push_back(element);
  }
}

void VertexFetch::read(uint32_t instance, const uint32_t* ids, uint32_t count,
                       shader::Column* inputs) const {
  for (const Element& element : elements_) read_element(element, instance, ids, count, inputs);
  if (vertex_id_column_ != runtime::kNoColumn) {
    for (uint32_t i = 0; i < count; ++i) inputs[vertex_id_column_][i] = ids[i];
  }
  for (const auto& [column, value] :
       {std::pair(instance_id_column_, instance), std::pair(start_vertex_column_, base_vertex_),
        std::pair(start_instance_column_, base_instance_)}) {
    if (column != runtime::kNoColumn) std::fill_n(inputs[column], count, value);
  }
}

void VertexFetch::read_element(const Element& element, uint32_t instance, const uint32_t* ids,
                               uint32_t count, shader::Column* inputs) const {
  shader::Column* columns = inputs + element.first_column;
  if (element.bytes == nullptr || element.decode == nullptr) {
    for (uint32_t c = 0; c < element.components; ++c) {
      for (uint32_t i = 0; i < count; ++i) columns[c][i] = 0;
    }
    return;
  }
  const uint32_t step = element.step_rate != 0 ? instance / element.step_rate : 0;
  for (uint32_t i = 0; i < count; ++i) {
    // Sums of locations and indices wrap.
    const uint32_t number = element.per_instance ? base_instance_ + step : base_vertex_ + ids[i];
    const uint64_t place = number * element.stride + element.offset;
    const bool inside = place <= element.size && element.size - place >= element.element_bytes;
    const uint8_t* bytes = inside ? element.bytes + place : kZeroElement;
    if (element.words >= element.components) {
      for (uint32_t c = 0; c < element.components; ++c) {
        std::memcpy(&columns[c][i], bytes + 4 * c, 4);
      }
    } else {
      const shader::Texel texel = element.decode(bytes);
      for (uint32_t c = 0; c < element.components; ++c) columns[c][i] = texel.bits[c];
    }
  }
}

}  // namespace kaamos::raster
