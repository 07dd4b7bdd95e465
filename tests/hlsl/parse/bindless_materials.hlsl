// SPDX-License-Identifier: MIT
// Bindless materials like Northlight's: a constant table, textures in one unbounded array,
// templates and methods for shading, a local root signature per hit group.

namespace northlight
{

template<typename T>
T Square(T x) { return x * x; }

template<typename T, int N>
struct SmallArray
{
    T items[N];
    int count;

    void Clear() { count = 0; }
    bool Push(T item)
    {
        if (count >= N)
            return false;
        items[count++] = item;
        return true;
    }
    T Get(int i) { return items[clamp(i, 0, N - 1)]; }
    T operator[](int i) { return Get(i); }
};

enum class MaterialKind : uint
{
    Opaque = 0,
    AlphaTested = 1 << 0,
    TwoSided = 1 << 1,
};

struct MaterialConstants
{
    float4 base_color;
    float roughness, metalness;
    uint flags;
    uint texture_ids[4];

    static const uint kInvalidTexture = 0xFFFFFFFFu;

    bool Has(MaterialKind kind) { return (flags & (uint)kind) != 0; }
    bool HasTexture(uint slot) { return this.texture_ids[slot] != kInvalidTexture; }
};

struct SurfaceBase
{
    float3 position;
    float3 normal;
    float3 ToWorld(float3 v)
    {
        float3 t = abs(normal.x) > 0.9f ? float3(0, 1, 0) : float3(1, 0, 0);
        float3 b = normalize(cross(normal, t));
        return v.x * cross(b, normal) + v.y * b + v.z * normal;
    }
};

struct Surface : SurfaceBase
{
    float4 color;
    float alpha;
    float3 Shade(float3 l) { return color.rgb * saturate(dot(normal, l)); }
};

namespace brdf
{
static const float kPi = 3.14159274f;

struct Lambert
{
    float3 albedo;
    float3 Evaluate(float3 wi, float3 wo) { return albedo / kPi; }
};

struct Ggx
{
    float alpha2;
    float3 f0;
    static Ggx Make(float roughness, float3 f0)
    {
        Ggx result;
        result.alpha2 = Square(Square(roughness));
        result.f0 = f0;
        return result;
    }
    float Distribution(float n_dot_h)
    {
        float d = Square(n_dot_h) * (alpha2 - 1) + 1;
        return alpha2 / (kPi * Square(d));
    }
    float3 Evaluate(float3 wi, float3 wo)
    {
        float3 h = normalize(wi + wo);
        float3 f = f0 + (1 - f0) * pow(1 - saturate(dot(wo, h)), 5);
        return f * Distribution(h.z) / max(4 * wi.z * wo.z, 1e-5);
    }
};

template<typename TFirst, typename TSecond = Lambert>
struct Layered
{
    TFirst first;
    TSecond second;
    float weight;
    float3 Evaluate(float3 wi, float3 wo)
    {
        return lerp(second.Evaluate(wi, wo), first.Evaluate(wi, wo), weight);
    }
};

typedef Layered<Ggx> Standard;
using Coated = Layered<Ggx, Layered<Ggx, Lambert>>;
} // namespace brdf

} // namespace northlight

using namespace northlight;

struct HitConstants
{
    uint material_id;
    uint index_offset;
};

struct [raypayload] Payload
{
    float3 color : read(caller) : write(closesthit, miss);
    float hit_t  : read(caller) : write(closesthit, miss);
};

ConstantBuffer<HitConstants> hit_constants : register(b0, space10);
ByteAddressBuffer indices : register(t0, space10);
ByteAddressBuffer vertices : register(t1, space10);
StructuredBuffer<MaterialConstants> materials : register(t0, space1);
Texture2D textures[] : register(t0, space2);
SamplerState linear_wrap : register(s0);
RaytracingAccelerationStructure scene : register(t0);
RWTexture2D<float4> output : register(u0);

LocalRootSignature HitRoot = { "CBV(b0, space = 10),"
                               "SRV(t0, space = 10),"
                               "SRV(t1, space = 10)" };
TriangleHitGroup Opaque = { "", "ShadeHit" };
TriangleHitGroup Masked = { "TestAlpha", "ShadeHit" };
SubobjectToExportsAssociation HitRootUse = { "HitRoot", "Opaque;Masked" };
RaytracingShaderConfig ShaderConfig = { 16, 8 };
RaytracingPipelineConfig PipelineConfig = { 1 };

template<typename T>
T LoadVertex(uint index, uint offset)
{
    return vertices.Load<T>(index * 32 + offset);
}

float4 SampleMaterial(MaterialConstants material, uint slot, float2 uv)
{
    if (!material.HasTexture(slot)) return material.base_color;
    Texture2D texture = textures[NonUniformResourceIndex(material.texture_ids[slot])];
    return texture.SampleLevel(linear_wrap, uv, 0) * material.base_color;
}

Surface MakeSurface(float2 barycentrics)
{
    const uint3 tri = indices.Load3((hit_constants.index_offset + PrimitiveIndex() * 3) * 4);
    const float3 w = float3(1.0f - barycentrics.x - barycentrics.y, barycentrics);
    Surface s = (Surface)0;
    float2 uv = 0;
    for (uint i = 0, n = 3; i < n; ++i)
    {
        s.normal += w[i] * LoadVertex<float3>(tri[i], 12);
        uv += w[i] * LoadVertex<float2>(tri[i], 24);
    }
    s.normal = normalize(mul((float3x3)ObjectToWorld3x4(), s.normal));
    s.position = mul(ObjectToWorld3x4(), float4(ObjectRayOrigin() + RayTCurrent() * ObjectRayDirection(), 1));
    s.color = SampleMaterial(materials[hit_constants.material_id], 0, uv);
    s.alpha = s.color.a;
    return s;
}

[shader("anyhit")]
void TestAlpha(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes)
{
    if (MakeSurface(attributes.barycentrics).alpha < 0.5) { IgnoreHit(); }
}

[shader("closesthit")]
void ShadeHit(inout Payload payload, in BuiltInTriangleIntersectionAttributes attributes)
{
    const MaterialConstants material = materials[hit_constants.material_id];
    Surface surface = MakeSurface(attributes.barycentrics);
    brdf::Standard standard;
    standard.first = brdf::Ggx::Make(material.roughness, lerp(0.04, surface.color.rgb, material.metalness));
    standard.second.albedo = surface.color.rgb * (1 - material.metalness);
    standard.weight = 0.5;
    brdf::Layered<brdf::Ggx, brdf::Layered<brdf::Ggx>> coated = (brdf::Coated)0;
    SmallArray<float3, 4> lights;
    lights.Clear();
    lights.Push(float3(0, 1, 0));
    lights.Push(normalize(float3(1, 1, 1)));
    float3 sum = 0;
    [loop] for (int i = 0; i < lights.count; ++i)
    {
        float3 l = lights[i];
        sum += surface.Shade(l) * standard.Evaluate(surface.ToWorld(l), -WorldRayDirection());
    }
    switch ((uint)material.Has(MaterialKind::TwoSided))
    {
        case 0:
        case 1u: sum *= 0.5; break;
        default:
        {
            sum = 0;
        }
    }
    payload.color = sum + coated.weight;
    payload.hit_t = RayTCurrent();
}

[shader("miss")]
void Sky(inout Payload payload) { payload.color = float3(0.3, 0.5, 0.9); payload.hit_t = -1; }

[shader("raygeneration")]
void Render()
{
    const uint2 pixel = DispatchRaysIndex().xy;
    const float2 uv = (pixel + 0.5) / DispatchRaysDimensions().xy;
    RayDesc ray;
    ray.Origin = float3(0, 0, -4);
    ray.Direction = normalize(float3(uv * 2 - 1, 1));
    ray.TMin = 0;
    ray.TMax = 3.402823466e+38f;
    Payload payload;
    TraceRay(scene, RAY_FLAG_NONE, 0xff, 0, 1, 0, ray, payload);
    output[pixel] = float4(payload.color, payload.hit_t < 0 ? 0 : 1);
}
