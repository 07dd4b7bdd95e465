// SPDX-License-Identifier: MIT
// Morphs and skins vertices, one thread per vertex. effects/assets/scene/animation.h is the same for the host.
// [Northlight deck: Skinned Meshes]

struct SkinningConstants {
  uint vertex_count;
  uint keep_history;  // 0: no previous frame, so the previous position is the new one
  uint has_more;      // 1: 16 bytes follow what else a vertex has: colour, second coordinates
  uint morph_targets;  // 0: nothing but joints moves it
};

ConstantBuffer<SkinningConstants> constants : register(b0);
ByteAddressBuffer bind_vertices : register(t0);  // Vertex of effects/assets/scene/mesh.h
ByteAddressBuffer skin : register(t1);           // SkinVertex
ByteAddressBuffer joints : register(t2);         // three float4 rows each
// Vertex, followed by its previous position. Holds the previous frame when the pass starts.
RWByteAddressBuffer deformed : register(u0);
ByteAddressBuffer morph_moves : register(t3);    // MorphMove, morph_targets of them for each vertex
ByteAddressBuffer morph_weights : register(t4);  // a float for each target

static const uint kBindStride = 48;
static const uint kSkinStride = 24;
static const uint kDeformedStride = 64;
static const uint kPreviousOffset = 48;
static const uint kColorStride = 16;
static const uint kMoveStride = 36;

struct Bind {
  float3 position;
  float3 normal;
  float4 tangent;
};

// The vertex as morph targets move it. [glTF 2.0: Morph Targets]
Bind LoadBind(uint vertex, uint from) {
  Bind bind;
  bind.position = asfloat(bind_vertices.Load3(from));
  bind.normal = asfloat(bind_vertices.Load3(from + 12));
  bind.tangent = asfloat(bind_vertices.Load4(from + 24));
  if (constants.morph_targets == 0) return bind;
  float3 normal = bind.normal;
  float3 tangent = bind.tangent.xyz;
  for (uint t = 0; t < constants.morph_targets; ++t) {
    const float weight = asfloat(morph_weights.Load(4 * t));
    if (weight == 0.0) continue;
    const uint at = (vertex * constants.morph_targets + t) * kMoveStride;
    bind.position += weight * asfloat(morph_moves.Load3(at));
    normal += weight * asfloat(morph_moves.Load3(at + 12));
    tangent += weight * asfloat(morph_moves.Load3(at + 24));
  }
  if (dot(normal, normal) > 0.0) bind.normal = normalize(normal);
  if (dot(tangent, tangent) > 0.0) bind.tangent.xyz = normalize(tangent);
  return bind;
}

[shader("compute")]
[numthreads(64, 1, 1)]
void SkinVertices(uint3 thread : SV_DispatchThreadID) {
  if (thread.x >= constants.vertex_count) {
    return;
  }
  const uint colored = constants.has_more * kColorStride;
  const uint from = thread.x * (kBindStride + colored);
  const uint to = thread.x * (kDeformedStride + colored);
  const uint2 packed = skin.Load2(thread.x * kSkinStride);
  const float4 weights = asfloat(skin.Load4(thread.x * kSkinStride + 8));
  const uint ids[4] = {packed.x & 0xFFFFu, packed.x >> 16, packed.y & 0xFFFFu, packed.y >> 16};
  float4 row0 = float4(0, 0, 0, 0);
  float4 row1 = row0;
  float4 row2 = row0;
  for (uint k = 0; k < 4; ++k) {
    const uint joint = ids[k] * 48;
    row0 += asfloat(joints.Load4(joint)) * weights[k];
    row1 += asfloat(joints.Load4(joint + 16)) * weights[k];
    row2 += asfloat(joints.Load4(joint + 32)) * weights[k];
  }

  const Bind moved = LoadBind(thread.x, from);
  const float4 bind = float4(moved.position, 1.0);
  const float3 position = float3(dot(row0, bind), dot(row1, bind), dot(row2, bind));
  // Normals are transformed by the matrix of cofactors, which needs no inverse.
  const float3 c0 = cross(row1.xyz, row2.xyz);
  const float3 c1 = cross(row2.xyz, row0.xyz);
  const float3 c2 = cross(row0.xyz, row1.xyz);
  const float side = dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
  float3 normal = moved.normal;
  const float3 turned = side * float3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
  if (dot(turned, turned) > 0.0) {
    normal = normalize(turned);
  }
  float4 tangent = moved.tangent;
  const float3 along = float3(dot(row0.xyz, tangent.xyz), dot(row1.xyz, tangent.xyz),
                              dot(row2.xyz, tangent.xyz));
  if (dot(along, along) > 0.0) {
    tangent = float4(normalize(along), side * tangent.w);
  }

  const uint3 before = deformed.Load3(to);
  deformed.Store3(to + kPreviousOffset, constants.keep_history != 0 ? before : asuint(position));
  deformed.Store3(to, asuint(position));
  deformed.Store3(to + 12, asuint(normal));
  deformed.Store4(to + 24, asuint(tangent));
  deformed.Store2(to + 40, bind_vertices.Load2(from + 40));
  if (constants.has_more != 0) {
    deformed.Store4(to + kDeformedStride, bind_vertices.Load4(from + kBindStride));
  }
}
