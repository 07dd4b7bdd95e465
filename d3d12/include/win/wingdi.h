// SPDX-License-Identifier: MIT
#pragma once

#include <winuser.h>
