// SPDX-License-Identifier: MIT
//
// Inputs and outputs of geometry shaders as scalars and vectors (graphics.h).
#pragma once

#include "kaamos/shader/graphics.h"
#include "kaamos/shader/vector.h"

namespace kaamos::shader {

// V is a scalar or vector of float, int32_t or uint32_t.
template <class V>
KAAMOS_INLINE V corner_value(const GeometryInputs& inputs, uint32_t corner, uint32_t column) {
  const uint32_t* words = inputs.rows + corner * inputs.columns + column;
  V value{};
  unroll<shape<V>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
    component(value, i) = __builtin_bit_cast(scalar_of<V>, words[i]);
  });
  return value;
}

template <class V, uint32_t N>
KAAMOS_INLINE array<V, N> corner_values(const GeometryInputs& inputs, uint32_t column) {
  array<V, N> values{};
  for (uint32_t i = 0; i < N; ++i) values[i] = corner_value<V>(inputs, i, column);
  return values;
}

// Writes the values side by side.
template <class... V>
KAAMOS_INLINE void emit_vertex(GeometryStream& stream, const V&... values) {
  if (stream.count >= stream.most) return;
  uint32_t* words = stream.rows + size_t{stream.count} * stream.columns;
  const auto put = [&](const auto& value) KAAMOS_INLINE_LAMBDA {
    using T = std::remove_cv_t<std::remove_reference_t<decltype(value)>>;
    unroll<shape<T>::count>([&](int i) KAAMOS_INLINE_LAMBDA {
      *words++ = __builtin_bit_cast(uint32_t, component(value, i));
    });
  };
  (put(values), ...);
  stream.begins[stream.count++] = stream.cut;
  stream.cut = false;
}

}  // namespace kaamos::shader
