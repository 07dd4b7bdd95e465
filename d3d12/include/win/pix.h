// SPDX-License-Identifier: MIT
#pragma once

#include <pix3.h>
