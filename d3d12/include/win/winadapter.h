// SPDX-License-Identifier: MIT
// What wsl/wrladapter.h includes.
#pragma once

#include <windows.h>
