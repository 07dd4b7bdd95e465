// SPDX-License-Identifier: MIT
#pragma once
namespace house {
enum class Kind : int { kRoom };
struct Room {
  int doors = 1;
};
struct Garden;
class Stub {};
namespace {
struct Local {
  int a = 1;
};
}  // namespace
}  // namespace house
