// SPDX-License-Identifier: MIT
// Microsoft::WRL::ComPtr, of Microsoft's own adapter for Linux.
#pragma once

#include <wrladapter.h>
