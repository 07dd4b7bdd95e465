// SPDX-License-Identifier: MIT
#include "d3d12/com/missing.h"

#include <mutex>
#include <set>
#include <string_view>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

void missing(const char* method) {
  // Both live on: programs release global devices after main. The names are generated literals.
  static auto* mutex = new std::mutex;
  static auto* told = new std::set<std::string_view>;
  {
    std::lock_guard lock(*mutex);
    if (!told->insert(method).second) return;
  }
  report(D3D12_MESSAGE_SEVERITY_ERROR,
         make_error(ErrorId::kMissing,
                    std::string(method) + " is not implemented; the call did nothing."));
}

HRESULT missing_result(const char* method) {
  missing(method);
  return E_NOTIMPL;
}

}  // namespace kaamos::d3d12
