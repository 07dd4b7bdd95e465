// SPDX-License-Identifier: MIT
#include "rtapi/src/device_impl.h"
