// SPDX-License-Identifier: MIT
// RuntimeClass is Base and Make of DirectX-Headers.
#pragma once

#include <wrladapter.h>
