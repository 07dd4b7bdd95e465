// SPDX-License-Identifier: MIT
// Reflection's interfaces as base classes. Microsoft's header does not declare them in MIDL's
// style, so that no entries are generated for them.
#pragma once

#include <directx/d3d12.h>
#include <directx/d3d12shader.h>

namespace kaamos::d3d12 {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"

/// Gives an interface the destructor that it has none of.
template <class Interface>
class ReflectionBase : public Interface {
 public:
  virtual ~ReflectionBase() = default;
};

#pragma GCC diagnostic pop

}  // namespace kaamos::d3d12
