// SPDX-License-Identifier: MIT
#include "hand_vulkan_raster.h"

#include <malloc.h>
#include <volk.h>

#include <cstddef>
#include <cstring>
#include <stdexcept>

#include "tests/vulkan/raw_gpu.h"

namespace kaamos::bench {
namespace {

constexpr const char* kConstants = R"(#version 460
layout(push_constant, std430) uniform Constants {
  vec4 clip[4];
  vec4 before[3];
  uint first_triangle;
};
vec4 to_clip(vec3 position) {
  const vec4 p = vec4(position, 1.0);
  return vec4(dot(clip[0], p), dot(clip[1], p), dot(clip[2], p), dot(clip[3], p));
}
)";

constexpr const char* kShadowVertex = R"(
layout(location = 0) in vec3 position;
void main() { gl_Position = to_clip(position); }
)";

constexpr const char* kGBufferVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 now;
layout(location = 2) out vec3 then;
void main() {
  const vec4 p = vec4(position, 1.0);
  gl_Position = to_clip(position);
  world = position;
  now = gl_Position.xyw;
  then = vec3(dot(before[0], p), dot(before[1], p), dot(before[2], p));
}
)";

constexpr const char* kGBufferPixel = R"(
layout(location = 0) in vec3 world;
layout(location = 1) in vec3 now;
layout(location = 2) in vec3 then;
layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal_and_depth;
layout(location = 2) out vec4 material;
layout(location = 3) out vec2 motion;
layout(location = 4) out uint id;
void main() {
  const vec3 normal = normalize(cross(dFdxFine(world), dFdyFine(world)));
  albedo = vec4(clamp(0.05 * world + 0.5, 0.0, 1.0), 1.0);
  normal_and_depth = vec4(normal, now.z);
  material = vec4(0.3 + 0.4 * abs(normal.y), 0.0, 1.0, 0.5);
  motion = now.xy / now.z - then.xy / then.z;
  id = first_triangle + gl_PrimitiveID;
}
)";

constexpr VkFormat kFormats[kGBufferTargets] = {
    VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_UNORM,
    VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_R32_UINT};

void check_vk(VkResult result, const char* call) {
  if (result != VK_SUCCESS) {
    throw std::runtime_error(std::string(call) + " gave VkResult " + std::to_string(result));
  }
}

// The driver gives memory of each frame back to the heap, which by default returns it to the
// kernel and then faults every page in again: frames take 2 to 4 times as long, at random. With
// these settings, which programs can make as MALLOC_TRIM_THRESHOLD_, MALLOC_TOP_PAD_ and
// MALLOC_MMAP_THRESHOLD_, the heap keeps it.
void keep_heap() {
  constexpr int kGigabyte = 1 << 30;
  constexpr int kOneHeap = 64 << 20;  // of another thread than the first, at most
  constexpr int kLargestAllowed = 32 << 20;
  if (mallopt(M_TRIM_THRESHOLD, kGigabyte) == 0 || mallopt(M_TOP_PAD, kOneHeap) == 0 ||
      mallopt(M_MMAP_THRESHOLD, kLargestAllowed) == 0) {
    throw std::runtime_error("mallopt refuses a setting");
  }
}

raw::Gpu& keep_heap_and_open(std::unique_ptr<raw::Gpu>& gpu) {
  keep_heap();
  gpu = std::make_unique<raw::Gpu>();
  return *gpu;
}

}  // namespace

struct HandVulkanRaster::State {
  const RasterScene& scene;
  std::unique_ptr<raw::Gpu> opened;
  raw::Gpu& gpu;
  raw::Buffer vertices, indices;
  raw::Image depth;
  std::vector<raw::Image> colors;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;

  explicit State(const RasterScene& s) : scene(s), gpu(keep_heap_and_open(opened)) {
    vertices = upload(scene.positions);
    indices = upload(scene.indices);
    depth = gpu.target(VK_FORMAT_D32_SFLOAT, scene.width, scene.height);
    if (!is_shadow()) {
      for (const VkFormat format : kFormats) {
        colors.push_back(gpu.target(format, scene.width, scene.height));
      }
    }
    create_pipeline();
  }
  ~State() {
    vkDestroyPipeline(gpu.device(), pipeline, nullptr);
    vkDestroyPipelineLayout(gpu.device(), layout, nullptr);
    for (raw::Image& color : colors) gpu.free(color);
    gpu.free(depth);
    gpu.free(indices);
    gpu.free(vertices);
  }

  bool is_shadow() const { return scene.pass == RasterPass::kShadow; }

  template <class T>
  raw::Buffer upload(const std::vector<T>& values) {
    const raw::Buffer buffer = gpu.buffer(values.size() * sizeof(T));
    std::memcpy(buffer.data, values.data(), values.size() * sizeof(T));
    return buffer;
  }

  VkShaderModule module(VkShaderStageFlagBits stage, const char* text) {
    const std::vector<uint32_t> code = raw::compile(stage, std::string(kConstants) + text);
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size() * 4;
    info.pCode = code.data();
    VkShaderModule result = VK_NULL_HANDLE;
    check_vk(vkCreateShaderModule(gpu.device(), &info, nullptr, &result), "vkCreateShaderModule");
    return result;
  }

  void create_pipeline() {
    const VkPushConstantRange range{VK_SHADER_STAGE_ALL_GRAPHICS, 0, sizeof(RasterConstants)};
    VkPipelineLayoutCreateInfo layout_info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layout_info.pushConstantRangeCount = 1;
    layout_info.pPushConstantRanges = &range;
    check_vk(vkCreatePipelineLayout(gpu.device(), &layout_info, nullptr, &layout),
             "vkCreatePipelineLayout");

    std::vector<VkPipelineShaderStageCreateInfo> stages;
    const auto add_stage = [&](VkShaderStageFlagBits stage, const char* text) {
      VkPipelineShaderStageCreateInfo& info = stages.emplace_back();
      info = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
      info.stage = stage;
      info.module = module(stage, text);
      info.pName = "main";
    };
    add_stage(VK_SHADER_STAGE_VERTEX_BIT, is_shadow() ? kShadowVertex : kGBufferVertex);
    if (!is_shadow()) add_stage(VK_SHADER_STAGE_FRAGMENT_BIT, kGBufferPixel);

    const VkVertexInputBindingDescription binding{0, 12, VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
    VkPipelineVertexInputStateCreateInfo input{
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = 1;
    input.pVertexAttributeDescriptions = &attribute;
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    // y up, as in Direct3D.
    const auto height = static_cast<float>(scene.height);
    const VkViewport viewport{0, height, static_cast<float>(scene.width), -height, 0, 1};
    const VkRect2D scissor{{0, 0}, {scene.width, scene.height}};
    VkPipelineViewportStateCreateInfo views{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    views.viewportCount = views.scissorCount = 1;
    views.pViewports = &viewport;
    views.pScissors = &scissor;
    VkPipelineRasterizationStateCreateInfo raster{
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo samples{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo test{
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    test.depthTestEnable = test.depthWriteEnable = VK_TRUE;
    test.depthCompareOp = is_shadow() ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_GREATER;
    VkPipelineColorBlendAttachmentState opaque{};
    opaque.colorWriteMask = 0xF;
    const std::vector<VkPipelineColorBlendAttachmentState> blends(colors.size(), opaque);
    VkPipelineColorBlendStateCreateInfo blend{
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<uint32_t>(blends.size());
    blend.pAttachments = blends.data();
    VkPipelineRenderingCreateInfo targets{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    targets.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    targets.pColorAttachmentFormats = kFormats;
    targets.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &targets};
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &views;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &test;
    info.pColorBlendState = &blend;
    info.layout = layout;
    const VkResult made =
        vkCreateGraphicsPipelines(gpu.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
    for (const auto& stage : stages) vkDestroyShaderModule(gpu.device(), stage.module, nullptr);
    check_vk(made, "vkCreateGraphicsPipelines");
  }

  VkRenderingAttachmentInfo attachment(const raw::Image& image, const VkClearValue& clear) {
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view;
    info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    info.clearValue = clear;
    return info;
  }

  void record(VkCommandBuffer list) {
    VkClearValue far{};
    far.depthStencil.depth = scene.cleared_depth();
    const VkRenderingAttachmentInfo depth_info = attachment(depth, far);
    std::vector<VkRenderingAttachmentInfo> color_infos;
    for (const raw::Image& color : colors) color_infos.push_back(attachment(color, {}));
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea = {{0, 0}, {scene.width, scene.height}};
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<uint32_t>(color_infos.size());
    info.pColorAttachments = color_infos.data();
    info.pDepthAttachment = &depth_info;
    vkCmdBeginRendering(list, &info);
    vkCmdBindPipeline(list, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(list, 0, 1, &vertices.buffer, &offset);
    vkCmdBindIndexBuffer(list, indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdPushConstants(list, layout, VK_SHADER_STAGE_ALL_GRAPHICS, 0, sizeof(RasterConstants),
                       &scene.constants);
    const uint32_t triangles = scene.triangles_per_draw();
    for (uint32_t draw = 0; draw < scene.draws; ++draw) {
      const uint32_t first = draw * triangles;
      vkCmdPushConstants(list, layout, VK_SHADER_STAGE_ALL_GRAPHICS,
                         offsetof(RasterConstants, first_triangle), 4, &first);
      vkCmdDrawIndexed(list, 3 * triangles, 1, 3 * first, 0, 0);
    }
    vkCmdEndRendering(list);
  }

  std::vector<std::byte> read(const raw::Image& image, VkImageAspectFlags aspect, uint32_t bytes) {
    const size_t size = size_t{scene.width} * scene.height * bytes;
    raw::Buffer buffer = gpu.buffer(size);
    gpu.run([&](VkCommandBuffer list) {
      VkBufferImageCopy copy{};
      copy.imageSubresource = {aspect, 0, 0, 1};
      copy.imageExtent = {scene.width, scene.height, 1};
      vkCmdCopyImageToBuffer(list, image.image, VK_IMAGE_LAYOUT_GENERAL, buffer.buffer, 1, &copy);
    });
    const auto* begin = reinterpret_cast<const std::byte*>(buffer.data);
    std::vector<std::byte> out(begin, begin + size);
    gpu.free(buffer);
    return out;
  }
};

HandVulkanRaster::HandVulkanRaster(const RasterScene& scene)
    : state_(std::make_unique<State>(scene)) {}

HandVulkanRaster::~HandVulkanRaster() = default;

void HandVulkanRaster::run() {
  state_->gpu.run([this](VkCommandBuffer list) { state_->record(list); });
}

RasterPictures HandVulkanRaster::pictures() {
  RasterPictures pictures;
  const std::vector<std::byte> depth = state_->read(state_->depth, VK_IMAGE_ASPECT_DEPTH_BIT, 4);
  pictures.depth.resize(depth.size() / sizeof(float));
  std::memcpy(pictures.depth.data(), depth.data(), depth.size());
  for (size_t i = 0; i < state_->colors.size(); ++i) {
    pictures.colors.push_back(
        state_->read(state_->colors[i], VK_IMAGE_ASPECT_COLOR_BIT, kGBufferBytes[i]));
  }
  return pictures;
}

}  // namespace kaamos::bench
