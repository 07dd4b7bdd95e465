// SPDX-License-Identifier: MIT
//
// The geometry shader: from the vertices of each primitive to lists of points, lines or triangles.
// [D3D11.3: 13]
#include <algorithm>
#include <utility>

#include "runtime/raster/front_end.h"

namespace kaamos::raster {

void FrontEnd::keep_rows(uint32_t first, uint32_t count, const shader::Column* outputs) {
  const uint32_t words = plan_->vertex_outputs;
  uint32_t* rows = rows_in_.data() + size_t{first} * words;
  for (uint32_t word = 0; word < words; ++word) {
    for (uint32_t i = 0; i < count; ++i) rows[i * words + word] = outputs[word][i];
  }
}

void FrontEnd::run_geometry(ShaderThread& thread) {
  const shader::GeometryShape& shape = plan_->linked->geometry_desc().shape;
  made_ = *range_;
  made_.count = 0;
  made_.corners = shape.output_corners;
  made_.strip = made_.odd = false;
  rows_out_.clear();
  begins_.clear();
  std::swap(corners_in_, corners_);
  corners_.clear();
  each_primitive(*range_, corners_in_.data(),
                 [&](const uint32_t vertex[3], uint32_t id) { call_geometry(thread, vertex, id); });
  range_ = &made_;
  take_emitted();
  if (counts_ == nullptr) return;
  counts_->geometry_calls = counts_->assembled * shape.instances;
  counts_->triangles = made_.count;
}

void FrontEnd::call_geometry(ShaderThread& thread, const uint32_t vertex[3], uint32_t id) {
  const runtime::LinkedGraphics& linked = *plan_->linked;
  const shader::GraphicsDesc& code = linked.geometry_desc();
  const shader::GeometryShape& shape = code.shape;
  uint32_t* rows = corner_rows_.resize(size_t{shape.corners} * code.input_columns);
  for (uint32_t corner = 0; corner < shape.corners; ++corner) {
    const uint32_t* from = rows_in_.data() + size_t{vertex[corner]} * plan_->vertex_outputs;
    uint32_t* to = rows + size_t{corner} * code.input_columns;
    for (const runtime::LinkedCorner& part : linked.corners) {
      std::copy_n(from + part.vertex_column, part.components, to + part.geometry_column);
    }
  }
  const runtime::GeometrySystemColumns& columns = linked.geometry_columns;
  if (columns.primitive_id != runtime::kNoColumn) rows[columns.primitive_id] = id;
  for (uint32_t instance = 0; instance < shape.instances; ++instance) {
    if (columns.instance != runtime::kNoColumn) rows[columns.instance] = instance;
    const auto first = static_cast<uint32_t>(begins_.size());
    shader::GeometryStream stream;
    stream.columns = code.output_columns;
    stream.most = shape.most_vertices;
    begins_.resize(first + stream.most);
    rows_out_.resize(size_t{first + stream.most} * stream.columns);
    stream.begins = begins_.data() + first;
    stream.rows = rows_out_.data() + size_t{first} * stream.columns;
    thread.primitive(range_->draw, {rows, code.input_columns}, stream);
    begins_.resize(first + stream.count);
    rows_out_.resize(size_t{first + stream.count} * stream.columns);
    assemble(stream, first);
  }
}

// Strips of too few vertices draw nothing.
void FrontEnd::assemble(const shader::GeometryStream& stream, uint32_t first) {
  uint32_t strip = 0;  // where it begins
  for (uint32_t i = 0; i < stream.count; ++i) {
    if (stream.begins[i]) strip = i;
    if (made_.corners == 1) {
      corners_.push_back(first + i);
    } else if (i - strip + 1 < made_.corners) {
      continue;
    } else if (made_.corners == 2) {
      corners_.push_back(first + i - 1);
      corners_.push_back(first + i);
    } else {
      const bool odd = (i - strip) % 2 != 0;
      corners_.push_back(first + i - 2);
      corners_.push_back(first + (odd ? i : i - 1));
      corners_.push_back(first + (odd ? i - 1 : i));
    }
    ++made_.count;
  }
}

void FrontEnd::take_emitted() {
  const auto count = static_cast<uint32_t>(begins_.size());
  const uint32_t words = plan_->linked->geometry_desc().output_columns;
  reserve_vertices(count);
  uint32_t* ids = ids_.resize(count);  // the first vertex that is wrong is known by its number
  for (uint32_t i = 0; i < count; ++i) ids[i] = i;
  auto* outputs = reinterpret_cast<shader::Column*>(columns_.resize(size_t{words} * kGroup));
  for (uint32_t first = 0; first < count; first += kGroup) {
    const uint32_t active = std::min(kGroup, count - first);
    const uint32_t* rows = rows_out_.data() + size_t{first} * words;
    for (uint32_t word = 0; word < words; ++word) {
      for (uint32_t i = 0; i < active; ++i) outputs[word][i] = rows[i * words + word];
    }
    take_outputs(first, active, outputs);
  }
}

}  // namespace kaamos::raster
