// SPDX-License-Identifier: MIT
// FEATURE: extended RAY_FLAG, CANDIDATE_TYPE and COMMITTED_STATUS as types
// EXPECT u32 0 64 129 2 1
// EXPECT u32 16 65
RWByteAddressBuffer results : register(u0);

template <RAY_FLAG Flags>
RAY_FLAG flags_of(RayQuery<Flags> query) {
  return Flags;
}

template <RAY_FLAG Flags>
struct Traversal {
  uint with(RAY_FLAG more) { return Flags | more; }
};

[shader("compute")]
[numthreads(1, 1, 1)]
void main() {
  const uint z = results.Load(65532);  // 0, known at run time only
  RayQuery<RAY_FLAG_CULL_OPAQUE> query;
  RAY_FLAG flags = RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_CULL_NON_OPAQUE;
  COMMITTED_STATUS status = COMMITTED_PROCEDURAL_PRIMITIVE_HIT;
  CANDIDATE_TYPE type = CANDIDATE_PROCEDURAL_PRIMITIVE;
  results.Store4(0, uint4(flags_of(query), flags, status, type) + z);
  Traversal<RAY_FLAG_CULL_OPAQUE> traversal;
  results.Store(16, traversal.with(RAY_FLAG_FORCE_OPAQUE) + z);
}
