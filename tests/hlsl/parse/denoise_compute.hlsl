// SPDX-License-Identifier: MIT
// Compute passes: groupshared tiles, barriers, atomics, typed UAVs, gathers.
#pragma pack_matrix(row_major)

#define GROUP 8
#define BORDER 2
#define TILE (GROUP + 2 * BORDER)
#define DECLARE_HISTOGRAM(name, bins) groupshared uint name[bins]
#define FOR_EACH_NEIGHBOUR(x, y, radius) \
    for (int y = -(radius); y <= (radius); ++y) \
        for (int x = -(radius); x <= (radius); ++x)

struct Constants
{
    float4x4 current_to_previous;
    uint2 size;
    float2 inv_size;
    float sigma_depth, sigma_normal, sigma_luminance;
    uint pass_index;
};

ConstantBuffer<Constants> constants : register(b0);
Texture2D<float3> color_in : register(t0);
Texture2D<float> depth_in : register(t1);
Texture2D<float2> motion_in : register(t2);
Texture2DArray<float4> history : register(t3);
TextureCube<float4> sky : register(t4);
Texture3D<half4> lut : register(t5);
SamplerState point_clamp : register(s0), linear_clamp : register(s1);
SamplerComparisonState shadow_sampler : register(s2);
RWTexture2D<float4> color_out : register(u0);
RWTexture2DArray<float2> moments_out : register(u1);
RWByteAddressBuffer statistics : register(u2);
AppendStructuredBuffer<uint2> holes : register(u3);

groupshared float3 g_tile[TILE][TILE];
groupshared float g_depth[TILE * TILE];
DECLARE_HISTOGRAM(g_histogram, 64);

float Luminance(const float3 c) { return dot(c, float3(0.2126f, 0.7152f, 0.0722f)); }
min16float Luminance(min16float3 c) { return dot(c, min16float3(0.2126, 0.7152, 0.0722)); }

uint2 Swizzled(uint index)
{
    uint2 r = 0;
    r.x = (index & 1u) | (index >> 1 & 2u) | (index >> 2 & 4u);
    r.y = (index >> 1 & 1u) | (index >> 2 & 2u) | (index >> 3 & 4u);
    return r;
}

void LoadTile(uint2 group, uint flat)
{
    for (uint i = flat; i < TILE * TILE; i += GROUP * GROUP)
    {
        const int2 local = int2(i % TILE, i / TILE);
        const int2 p = clamp(int2(group * GROUP) + local - BORDER, 0, int2(constants.size) - 1);
        g_tile[local.y][local.x] = color_in[p];
        g_depth[i] = depth_in.Load(int3(p, 0));
    }
}

precise float Weight(float centre, float other, float sigma)
{
    precise float d = abs(centre - other) * rcp(max(sigma, 1e-6f));
    return exp(-d * d);
}

[numthreads(GROUP, GROUP, 1)]
void FilterSpatial(uint3 id : SV_DispatchThreadID, uint3 group : SV_GroupID,
                   uint3 local : SV_GroupThreadID, uint flat : SV_GroupIndex)
{
    LoadTile(group.xy, flat);
    if (flat < 64) g_histogram[flat] = 0u;
    GroupMemoryBarrierWithGroupSync();

    if (any(id.xy >= constants.size))
        return;

    const uint2 c = local.xy + BORDER;
    const float centre_depth = g_depth[c.y * TILE + c.x];
    const float centre_luminance = Luminance(g_tile[c.y][c.x]);
    float4 sum = 0;
    FOR_EACH_NEIGHBOUR(x, y, BORDER)
    {
        const uint2 n = uint2(int2(c) + int2(x, y));
        const float3 colour = g_tile[n.y][n.x];
        float w = Weight(centre_depth, g_depth[n.y * TILE + n.x], constants.sigma_depth);
        w *= Weight(centre_luminance, Luminance(colour), constants.sigma_luminance);
        sum += float4(colour, 1) * w;
    }
    sum.rgb /= max(sum.a, 1e-6);
    color_out[id.xy] = float4(sum.rgb, 1.f);
    InterlockedAdd(g_histogram[min(63u, (uint)(centre_luminance * 64))], 1);
    GroupMemoryBarrierWithGroupSync();
    uint ignored;
    if (flat < 64) statistics.InterlockedAdd(flat * 4, g_histogram[flat], ignored);
}

[numthreads(64, 1, 1)]
void AccumulateTemporal(uint index : SV_GroupIndex, uint2 group : SV_GroupID)
{
    const uint2 p = group * 8 + Swizzled(index);
    const float2 uv = (p + 0.5) * constants.inv_size;
    const float2 previous = uv - motion_in.SampleLevel(point_clamp, uv, 0);
    float4 clip = mul(float4(previous * 2 - 1, depth_in[p], 1), constants.current_to_previous);
    bool valid = all(previous == saturate(previous)) && clip.w > 0;
    [flatten]
    if (!valid) holes.Append(p);
    float4 old = valid ? history.SampleLevel(linear_clamp, float3(previous, 0), 0) : 0;
    float4 reds = history.GatherRed(linear_clamp, float3(previous, 0), int2(1, 0));
    uint w, h, layers, levels;
    history.GetDimensions(0, w, h, layers, levels);
    float3 low = 1e30, high = -1e30;
    do
    {
        low = min(low, reds.xyz);
        high = max(high, reds.yzw);
    } while (--layers > 0 && layers < 4);
    float3 blended = lerp(clamp(old.rgb, low, high), color_in[p], valid ? 0.1 : 1.0);
    blended += sky.SampleLevel(linear_clamp, float3(uv, 1), 0).rgb * 0;
    blended *= (float3)lut.Load(int4(0, 0, 0, 0)).rgb;
    color_out[p] = float4(blended, 1), moments_out[uint3(p, 0)].xy = float2(Luminance(blended), 0);
    moments_out[uint3(p, 1)] += float2(1, 2) * float(levels + h + w > 0);
}
