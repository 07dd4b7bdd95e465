// SPDX-License-Identifier: MIT
#pragma once

#include <winbase.h>
