// SPDX-License-Identifier: MIT
#include "runtime/embree/own.h"
