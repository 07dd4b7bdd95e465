// SPDX-License-Identifier: MIT
#pragma once

int straight(int x);
