// SPDX-License-Identifier: MIT
//
// The input assembler's second half: reads vertices into the columns of a vertex shader.
// [D3D11.3: 8.19, 8.20]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/raster/draw.h"

namespace kaamos::raster {

class VertexFetch {
 public:
  // Before read(); `draw` need not live on.
  void bind(const Draw& draw);
  // Fills the inputs of up to kGraphicsLanes vertices. `ids` are values of SV_VertexID.
  void read(uint32_t instance, const uint32_t* ids, uint32_t count, shader::Column* inputs) const;

 private:
  struct Element {
    const uint8_t* bytes;  // null: nothing is bound
    uint64_t size;
    uint64_t offset;
    uint64_t stride;
    uint32_t element_bytes;
    uint32_t first_column;
    uint32_t components;
    uint32_t step_rate;
    uint32_t words;  // number of channels if each has 32 bits, which need no conversion; else 0
    bool per_instance;
    shader::Texel (*decode)(const uint8_t* element);
  };

  void read_element(const Element& element, uint32_t instance, const uint32_t* ids, uint32_t count,
                    shader::Column* inputs) const;

  std::vector<Element> elements_;
  uint32_t vertex_id_column_ = runtime::kNoColumn;
  uint32_t instance_id_column_ = runtime::kNoColumn;
  uint32_t start_vertex_column_ = runtime::kNoColumn;
  uint32_t start_instance_column_ = runtime::kNoColumn;
  uint32_t base_vertex_ = 0;
  uint32_t base_instance_ = 0;
};

}  // namespace kaamos::raster
