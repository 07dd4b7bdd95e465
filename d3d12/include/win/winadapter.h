// SPDX-License-Identifier: MIT
// The header that wsl/wrladapter.h includes.
#pragma once

#include <windows.h>
