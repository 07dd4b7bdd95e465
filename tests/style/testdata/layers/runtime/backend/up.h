// SPDX-License-Identifier: MIT
#include <rtapi/device.h>
#include "rtapi/src/device_impl.h"
