// SPDX-License-Identifier: MIT
#pragma once

#include <minwindef.h>
