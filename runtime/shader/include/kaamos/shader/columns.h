// SPDX-License-Identifier: MIT
//
// Inputs and outputs of vertex and pixel shaders as scalars and vectors (graphics.h). A value has a
// column for each component.
#pragma once

#include "kaamos/shader/graphics.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

// V is a scalar or vector of float, int32_t or uint32_t.
template <class V>
KAAMOS_INLINE V column_value(const Column* columns, uint32_t lane) {
  V value{};
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
    component(value, i) = __builtin_bit_cast(scalar_of<V>, columns[i][lane]);
  });
  return value;
}

template <class V>
KAAMOS_INLINE void put_columns(Column* columns, uint32_t lane, const V& value) {
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
    columns[i][lane] = __builtin_bit_cast(uint32_t, component(value, i));
  });
}

}  // namespace kaamos::shader
