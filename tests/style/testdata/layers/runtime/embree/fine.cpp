// SPDX-License-Identifier: MIT
#include "runtime/backend/up.h"
#include "runtime/embree/own.h"
