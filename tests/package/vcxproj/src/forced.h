// SPDX-License-Identifier: MIT
// Included by the project into every source.
#pragma once

#define FORCED 7
