// SPDX-License-Identifier: MIT
#pragma once

#include <timeapi.h>
