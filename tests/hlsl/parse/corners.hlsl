// SPDX-License-Identifier: MIT
// Constructs that are easily confused: casts and parentheses, '<' as less-than and in template
// arguments, old and new spellings.
struct A { float x; };
typedef A B;
static A ga = (A)0;
const static uint kA[] = { 1u, 2u };
float3 operator*(A a, float3 b) { return a.x * b; }
template<typename T> struct Stack { T v[4]; struct Node { T t; }; Node Top() { Node n; n.t = v[0]; return n; } static const int kSize = 4; };
template<typename T> T Max(T a, T b) { return a < b ? b : a; }
template<typename T, typename U> void Both(T a, out U b) { b = (U)a; Stack<T>::Node n; typename Stack<T>::Node m; b = n.t; }
void f(const inout float a, A arr[2] = { { 1 }, { 2 } }) {
  int x = 0, y = 1, z = 2;
  bool q = x < y, r = y > z;
  q = x < y && (y) > z;
  if (x < y || Max<int>(x, y) > (z)) x = 1;
  for (int i = 0; i < 3; i++) for (int j = 0; j < i; j++) { x += i < j ? 1 : 2; }
  float v = float(x) < float(y) ? float(x) : float(y);
  uint a2 = (uint)x ? 1 : 2, b2 = (x) ? y : z, c2 = (x) + (y), d2 = (uint)(x) - 1;
  float4x4 m = (float4x4)0; m[0] = 1; m._m00 = m._11; m[1].xy = 2;
  A aa = { 1 }; B bb = aa; A::x;
  Stack<A> s; Stack<A>::Node n = s.Top(); int k = Stack<float>::kSize; Stack<Stack<A>> ss;
  do x++; while (x < 3);
  switch (x) { default: break; case 0x10: case kA[0]: { break; } }
  while (x --> 0);
  Texture2D t2[2]; ByteAddressBuffer bab; float4 l4 = bab.Load<float4>(x < y ? 4 : 8);
  float w = ga.x < bab.Load<float>(4);
  uint64_t big = 0xFFFFFFFFFFFFFFFFull; min16float h = 1.0h;
  ; ;
  { }
  x = y = z, x++;
  return;
}
[numthreads(8,8,1)] void cs(uint3 id : SV_DispatchThreadID, uint gi : SV_GroupIndex) { }
export float4 g() : SV_Target { return 0..xxxx; }
float undeclaredSize[4 * 2];
cbuffer Empty { }
cbuffer WithInit { float init = 3.0; };
struct { float4 p : SV_Position; } gstruct;
typedef vector<float, 4> V4; typedef matrix<float, 3, 3> M3;
namespace N { static const int A = 3; enum E { e0, e1 }; } using namespace N;
N::E ne = N::e0; 
static const float arr2[] = { 1, 2, 3 };
RWStructuredBuffer<A> rw : register(u0, space3);
struct D : A { float y; float sum() { return A::x + y; } };
unsigned int ui(unsigned int p) { return p; }
void g2() { f((float)1); Both(1, ga.x); (void)0; sizeof(A); precise float p = 1; sample = 3; vk::RawBufferLoad<uint>(3); this_is; }
struct Fwd; struct Fwd { int i; }; Fwd fwd; Fwd fwd2 = { 3 };
float4 swz(float4 v) { v.wzyx.xy = v.rg; return v.xxxx; }
[shader("miss")]
[WaveSize(16)]
void entry(inout A p) { p.x = 1; }
static RWTexture2D<float4> localAlias = ResourceDescriptorHeap[3];
