// SPDX-License-Identifier: MIT
#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

rtapi::Error make_error(ErrorId id, const std::string& detail) {
  const rtapi::ErrorId number{static_cast<uint16_t>(id)};
  switch (id) {
#define KAAMOS_D3D12_ERROR(number_, name, code, title, rule, cure) \
  case ErrorId::name:                                              \
    return {number, rtapi::ErrorCode::code, number.text() + " " title ": " + detail};
#define KAAMOS_D3D12_WARNING(number_, name, title, rule, cure) \
  KAAMOS_D3D12_ERROR(number_, name, kFailed, title, rule, cure)
#include "d3d12/com/errors.inc"
#undef KAAMOS_D3D12_WARNING
#undef KAAMOS_D3D12_ERROR
  }
  return {number, rtapi::ErrorCode::kFailed, detail};
}

}  // namespace kaamos::d3d12
