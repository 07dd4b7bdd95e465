// SPDX-License-Identifier: MIT
// ID3DBlob: bytes that a call hands out.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "d3d12/com/object.h"

namespace kaamos::d3d12 {

class Blob final : public ComObject<ID3D10BlobEntries> {
 public:
  explicit Blob(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}
  /// A text with its terminating zero, as error blobs hold it.
  explicit Blob(std::string_view text);

  LPVOID STDMETHODCALLTYPE GetBufferPointer() override { return bytes_.data(); }
  SIZE_T STDMETHODCALLTYPE GetBufferSize() override { return bytes_.size(); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace kaamos::d3d12
