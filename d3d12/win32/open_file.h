// SPDX-License-Identifier: MIT
// An open file that a handle names.
#pragma once

#include <memory>
#include <string>

#include "d3d12/win32/handles.h"

namespace kaamos::d3d12 {

class File final : public HandleObject {
 public:
  /// Takes `descriptor` over.
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() override;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Null after an error of `call`, which GetLastError tells.
std::shared_ptr<File> find_file(HANDLE handle, const char* call);

/// TRUE if `done`, else FALSE with GetLastError() of errno, and no message: programs ask for files
/// that need not be there.
BOOL succeed_or_errno(bool done, const std::string& path = {});

}  // namespace kaamos::d3d12
