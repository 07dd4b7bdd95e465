// SPDX-License-Identifier: MIT
#pragma once
uint included(uint x) {
  return x + 42;
}
