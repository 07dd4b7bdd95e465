// SPDX-License-Identifier: MIT
// Event, FileHandle, and RoInitializeWrapper, which has nothing to do here.
#pragma once

#include <combaseapi.h>
#include <wrl/event.h>

enum RO_INIT_TYPE { RO_INIT_SINGLETHREADED = 0, RO_INIT_MULTITHREADED = 1 };

namespace Microsoft::WRL::Wrappers {

class RoInitializeWrapper {
 public:
  explicit RoInitializeWrapper(RO_INIT_TYPE) {}
  operator HRESULT() const { return S_OK; }
};

}  // namespace Microsoft::WRL::Wrappers
