// SPDX-License-Identifier: MIT
#pragma once
namespace house {
struct Room {
  int windows = 2;
};
struct Garden;
class Stub {
  int is_none = 1;
};
namespace {
struct Local {
  int b = 1;
};
}  // namespace
}  // namespace house
namespace garden {
enum class Kind : int { kBed };
}  // namespace garden
namespace house {
enum class Kind : int { kHall };
}  // namespace house
