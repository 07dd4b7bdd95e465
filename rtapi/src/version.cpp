// SPDX-License-Identifier: MIT
#include <rtapi/version.h>

namespace rtapi {

const char* GetVersion() {
  return KAAMOS_VERSION;
}

}  // namespace rtapi
