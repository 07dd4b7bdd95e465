// SPDX-License-Identifier: MIT
#pragma once

#include <atlbase.h>
