// SPDX-License-Identifier: MIT
// Procedural primitives: intersection shaders, custom attributes, callable shaders, signed distance
// fields.

struct Attributes { float3 normal; };
struct ProceduralAttributes { float3 normal; uint id; float2 uv; };
struct Payload { float4 color; uint depth; };
struct CallableData { float3 position; float3 color; };
struct Aabb { float3 lower, upper; };
struct Ray { float3 origin; float3 direction; };

namespace PrimitiveKind { enum Enum { Sphere = 0, Box, MetaBalls, Count }; }

cbuffer Scene : register(b0) { float4x4 to_world; float time; uint max_depth; }
cbuffer Primitive : register(b1, space0) { struct { float4 albedo; float reflectance; } material; PrimitiveKind::Enum kind; };
tbuffer Table : register(t4) { float4 table[16]; }

RaytracingAccelerationStructure scene : register(t0, space0);
StructuredBuffer<Aabb> boxes : register(t1);
Buffer<float4> typed : register(t2);
RWBuffer<uint> counters : register(u1);
RWTexture2D<unorm float4> image : register(u0);

static const int kSteps = 64;
static const float3x3 kRotation = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
static const struct { float3 center; float radius; } kBalls[2] = { { float3(0, 0, 0), 1 }, { { 1, 0, 0 }, .5f } };

void Swap(inout float a, inout float b) { const float t = a; a = b; b = t; }

bool SolveQuadratic(float a, float b, float c, out float x0, out float x1)
{
    float d = b * b - 4.0f * a * c;
    x0 = x1 = 0;
    if (d < 0) return false;
    else if (d == 0) x0 = x1 = -0.5f * b / a;
    else
    {
        float q = b > 0 ? -0.5f * (b + sqrt(d)) : -0.5f * (b - sqrt(d));
        x0 = q / a, x1 = c / q;
    }
    if (x0 > x1) Swap(x0, x1);
    return true;
}

bool HitSphere(in Ray ray, out float t, out ProceduralAttributes attr, in float3 center = float3(0, 0, 0), in float radius = 1)
{
    float t0, t1;
    attr = (ProceduralAttributes)0;
    t = 0;
    float3 l = ray.origin - center;
    if (!SolveQuadratic(dot(ray.direction, ray.direction), 2 * dot(ray.direction, l), dot(l, l) - radius * radius, t0, t1)) return false;
    t = t0 >= RayTMin() ? t0 : t1;
    attr.normal = normalize(l + t * ray.direction);
    return t >= RayTMin() && t <= RayTCurrent();
}

bool HitBox(Ray ray, Aabb box, out float t_min, out float t_max)
{
    float3 lo = (box.lower - ray.origin) / ray.direction, hi = (box.upper - ray.origin) / ray.direction;
    float3 a = min(lo, hi), b = max(lo, hi);
    t_min = max(max(a.x, a.y), a.z);
    t_max = min(min(b.x, b.y), b.z);
    return t_max >= max(t_min, 0.0);
}

float Field(float3 p, uint index)
{
    float d = 0;
    [unroll(2)]
    for (uint i = 0; i < 2; i++) d += kBalls[i].radius / max(1e-3, distance(p, kBalls[i].center));
    return d - float(index) * table[index & 15].x;
}

[shader("intersection")]
void IntersectAnalytic()
{
    Ray ray = { ObjectRayOrigin(), ObjectRayDirection() };
    float t;
    ProceduralAttributes attr;
    [branch]
    switch (kind)
    {
        case PrimitiveKind::Sphere: if (HitSphere(ray, t, attr)) ReportHit(t, /*kind*/ 0, attr); break;
        case PrimitiveKind::Box:
        {
            float far;
            if (HitBox(ray, boxes[PrimitiveIndex()], t, far)) { attr.normal = 0; ReportHit(t, 1, attr); }
        }
        break;
        default: break;
    }
}

[shader("intersection")]
void IntersectField()
{
    const Ray ray = { ObjectRayOrigin(), ObjectRayDirection() };
    float t = RayTMin(), step = (RayTCurrent() - t) / kSteps;
    int i = 0;
    while (i++ < kSteps)
    {
        float3 p = ray.origin + t * ray.direction;
        if (Field(p, i) > 1.0f)
        {
            Attributes a;
            const float e = 1e-3;
            a.normal = -normalize(float3(Field(p + float3(e, 0, 0), 0), Field(p + float3(0, e, 0), 0), Field(p + float3(0, 0, e), 0)) - Field(p, 0).xxx);
            if (ReportHit(t, 0u, a)) return;
        }
        t += step;
    }
}

[shader("callable")]
void Checker(inout CallableData data)
{
    int3 cell = int3(floor(data.position));
    data.color = ((cell.x ^ cell.y ^ cell.z) & 1) ? float3(1, 1, 1) : 0.2.xxx;
}

[shader("anyhit")] void Count(inout Payload payload, ProceduralAttributes attr)
{
    uint before;
    InterlockedAdd(counters[0], 1, before);
    if (before > 1000000) AcceptHitAndEndSearch();
}

[shader("closesthit")]
void Shade(inout Payload payload, ProceduralAttributes attr)
{
    CallableData data;
    data.position = mul(ObjectToWorld3x4(), float4(ObjectRayOrigin() + RayTCurrent() * ObjectRayDirection(), 1)).xyz;
    CallShader(0, data);
    float3 n = normalize(mul(attr.normal, (float3x3)WorldToObject4x3()));
    payload.color = float4(data.color * material.albedo.rgb * (n.y * .5 + .5), 1);
    if (payload.depth + 1 < max_depth && material.reflectance > 0.001)
    {
        Payload next = { float4(0, 0, 0, 0), payload.depth + 1 };
        RayDesc r = { data.position, 0.01, reflect(WorldRayDirection(), n), 1e4 };
        TraceRay(scene, RAY_FLAG_CULL_BACK_FACING_TRIANGLES, ~0u, 0, 1, 0, r, next);
        payload.color.rgb = lerp(payload.color.rgb, next.color.rgb, material.reflectance);
    }
}

[shader("miss")] void Background(inout Payload p) { p.color = typed[0] * time; }

[shader("raygeneration")]
void Main()
{
    float2 d = (DispatchRaysIndex().xy + .5) / DispatchRaysDimensions().xy * 2 - 1;
    RayDesc ray; ray.Origin = to_world._m03_m13_m23; ray.TMin = 0; ray.TMax = 1e4;
    ray.Direction = mul(kRotation, normalize(float3(d.x, -d.y, 1)));
    Payload p = (Payload)0;
    TraceRay(scene, 0, 0xFF, 0, 0, 0, ray, p);
    image[DispatchRaysIndex().xy] = p.color;
}
