// SPDX-License-Identifier: MIT
// A path tracer in the style of the DXR samples: one library, recursion through a payload, bindless
// geometry in unbounded arrays, next-event estimation with shadow rays.

#define MAX_BOUNCES 8
#define PI 3.14159265358979323846f
#define ONE_OVER(x) (1.0f / (x))

typedef BuiltInTriangleIntersectionAttributes MyAttributes;

enum RayType
{
    RayTypeRadiance = 0,
    RayTypeShadow,
    RayTypeCount
};

struct RadiancePayload
{
    float3 radiance;
    float3 throughput;
    float3 next_origin;
    float3 next_direction;
    uint   seed;
    uint   bounce : BOUNCE;
    bool   done;
};

struct ShadowPayload
{
    float visibility;
};

struct Vertex
{
    float3 position;
    float3 normal;
    float2 uv;
};

struct InstanceData
{
    row_major float3x4 normal_matrix;
    uint material;
    uint first_index;
    uint2 padding;
};

struct Light
{
    float3 position; float radius;
    float3 emission; uint  type;
};

cbuffer FrameConstants : register(b0)
{
    float4x4 g_view_to_world;
    float4x4 g_clip_to_view;
    float2   g_jitter;
    uint     g_frame_index : packoffset(c8.z);
    uint     g_light_count;
    float3   g_sky_color;
    float    g_exposure;
};

RaytracingAccelerationStructure g_scene : register(t0, space0);
StructuredBuffer<InstanceData>  g_instances : register(t1);
StructuredBuffer<Light>         g_lights : register(t2);
Texture2D<float4>               g_textures[] : register(t0, space1);
ByteAddressBuffer               g_index_buffers[] : register(t0, space2);
StructuredBuffer<Vertex>        g_vertex_buffers[] : register(t0, space3);
SamplerState                    g_linear_wrap : register(s0);
RWTexture2D<float4>             g_output : register(u0);
globallycoherent RWStructuredBuffer<uint> g_counters : register(u1);

static const float2 kDiscSamples[4] =
{
    float2(-0.94201624f, -0.39906216f),
    float2( 0.94558609f, -0.76890725f),
    float2(-0.09418410f, -0.92938870f),
    float2( 0.34495938f,  0.29387760f),
};

static uint s_rays = 0;

// ---- Random numbers

uint Pcg(inout uint state)
{
    state = state * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float NextFloat(inout uint state) { return asfloat(0x3f800000u | (Pcg(state) >> 9)) - 1.0f; }

float2 NextFloat2(inout uint state)
{
    const float a = NextFloat(state), b = NextFloat(state);
    return float2(a, b);
}

float3 CosineHemisphere(float2 u, out float pdf)
{
    float r = sqrt(u.x), phi = 2.0f * PI * u.y, s, c;
    sincos(phi, s, c);
    float z = sqrt(max(0.0f, 1.0f - u.x));
    pdf = z * ONE_OVER(PI);
    return float3(r * c, r * s, z);
}

float3x3 Basis(float3 n)
{
    float sign = n.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return float3x3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x,
                    b, sign + n.y * n.y * a, -n.y,
                    n);
}

// ---- Geometry

uint3 LoadTriangle(uint buffer, uint face)
{
    ByteAddressBuffer indices = g_index_buffers[NonUniformResourceIndex(buffer)];
    return indices.Load3(face * 12);
}

Vertex Interpolate(uint buffer, uint primitive, float2 bary)
{
    const uint3 tri = LoadTriangle(buffer, primitive);
    const float3 w = float3(1 - bary.x - bary.y, bary);
    Vertex result = (Vertex)0;
    [unroll]
    for (int i = 0; i < 3; i++)
    {
        Vertex v = g_vertex_buffers[NonUniformResourceIndex(buffer)][tri[i]];
        result.position += w[i] * v.position;
        result.normal   += w[i] * v.normal;
        result.uv       += w[i] * v.uv;
    }
    result.normal = normalize(result.normal);
    return result;
}

float TraceShadow(float3 origin, float3 target, float bias = 1e-3f)
{
    float3 d = target - origin;
    float  len = length(d);
    RayDesc ray;
    ray.Origin = origin;
    ray.Direction = d / len;
    ray.TMin = bias; ray.TMax = len - bias;

    ShadowPayload shadow = { 0.0f };
    TraceRay(g_scene,
             RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER,
             ~0, RayTypeShadow, RayTypeCount, RayTypeShadow, ray, shadow);
    s_rays++;
    return shadow.visibility;
}

float3 DirectLight(in Vertex v, inout uint seed)
{
    if (g_light_count == 0) return 0;
    uint pick = min(uint(NextFloat(seed) * g_light_count), g_light_count - 1);
    Light light = g_lights[pick];
    float3 p = light.position;
    p.xy += light.radius * kDiscSamples[pick & 3];
    float3 l = p - v.position;
    float d2 = dot(l, l);
    float cos_theta = saturate(dot(v.normal, l * rsqrt(d2)));
    [branch]
    if (cos_theta <= 0.0f || !any(light.emission > 0))
        return 0.0.xxx;
    return light.emission * cos_theta / d2 * g_light_count * TraceShadow(v.position, p);
}

// ---- Shaders

[shader("raygeneration")]
void RayGen()
{
    uint2 pixel = DispatchRaysIndex().xy, size = DispatchRaysDimensions().xy;
    float2 ndc = ((float2)pixel + 0.5f + g_jitter) / (float2)size * float2(2, -2) + float2(-1, 1);
    float4 view = mul(g_clip_to_view, float4(ndc, 0.0, 1.0));
    view /= view.w;

    RayDesc ray = { mul(g_view_to_world, float4(0, 0, 0, 1)).xyz, 0.0f,
                    normalize(mul((float3x3)g_view_to_world, view.xyz)), 1e38f };

    RadiancePayload payload;
    payload.radiance = 0; payload.throughput = float3(1, 1, 1);
    payload.seed = pixel.x + pixel.y * size.x + g_frame_index * 9781u;
    payload.bounce = 0u; payload.done = false;

    [loop]
    for (uint bounce = 0; bounce < MAX_BOUNCES && !payload.done; ++bounce)
    {
        payload.bounce = bounce;
        TraceRay(g_scene, RAY_FLAG_NONE, 0xFF, RayTypeRadiance, RayTypeCount, RayTypeRadiance, ray,
                 payload);
        ray.Origin = payload.next_origin;
        ray.Direction = payload.next_direction;
        ray.TMin = 1e-4f;

        if (bounce > 2)
        {
            float survive = max(payload.throughput.r, max(payload.throughput.g, payload.throughput.b));
            if (NextFloat(payload.seed) > survive) break; else payload.throughput /= survive;
        }
    }
    float4 previous = g_output[pixel];
    g_output[pixel] = lerp(previous, float4(payload.radiance * g_exposure, 1), 1.0f / (g_frame_index + 1));
    uint old; InterlockedAdd(g_counters[0], s_rays, old);
}

[shader("closesthit")]
void ClosestHit(inout RadiancePayload payload : SV_RayPayload, in MyAttributes attr : SV_IntersectionAttributes)
{
    InstanceData instance = g_instances[InstanceID()];
    Vertex v = Interpolate(instance.first_index, PrimitiveIndex(), attr.barycentrics);
    v.position = WorldRayOrigin() + RayTCurrent() * WorldRayDirection();
    v.normal = normalize(mul((float3x3)instance.normal_matrix, v.normal));
    if (HitKind() == HIT_KIND_TRIANGLE_BACK_FACE) v.normal = -v.normal;

    float4 albedo = g_textures[NonUniformResourceIndex(instance.material)].SampleLevel(g_linear_wrap, v.uv, 0);
    payload.radiance += payload.throughput * albedo.rgb * DirectLight(v, payload.seed) / PI;

    float pdf;
    float3 local = CosineHemisphere(NextFloat2(payload.seed), pdf);
    payload.next_origin = v.position;
    payload.next_direction = mul(local, Basis(v.normal));
    payload.throughput *= albedo.rgb;
}

[shader("anyhit")]
void AlphaTest(inout RadiancePayload payload, MyAttributes attr)
{
    InstanceData instance = g_instances[InstanceID()];
    Vertex v = Interpolate(instance.first_index, PrimitiveIndex(), attr.barycentrics);
    if (g_textures[instance.material].SampleLevel(g_linear_wrap, v.uv, 0).a < 0.5f)
        IgnoreHit();
}

[shader("miss")]
void Miss(inout RadiancePayload payload)
{
    float t = 0.5f * (WorldRayDirection().y + 1.0f);
    payload.radiance += payload.throughput * lerp(float3(1, 1, 1), g_sky_color, t);
    payload.done = true;
}

[shader("miss")]
void ShadowMiss(inout ShadowPayload payload) { payload.visibility = 1.0f; }
