// SPDX-License-Identifier: MIT
// FEATURE: extended a constant struct as an inout argument
// EXPECT u32 0 8
// EXPECT u32 4 3
#include "scene.hlsli"

struct Path {
  uint vertices;
  float3 radiance;
  void extend() { ++vertices; }
};

struct Store {
  void commit(inout Path path) { path.extend(); }
};

uint commit_twice(const Path path, const Store store) {
  store.commit(path);
  store.commit(path);
  return path.vertices;
}

[shader("raygeneration")]
void Main() {
  Path path = {6, float3(0, 0, 0)};
  results.Store(0, commit_twice(path, (Store)0));
  const Path fixed = {2, float3(0, 0, 0)};
  Store store;
  store.commit(fixed);
  results.Store(4, fixed.vertices);
}
