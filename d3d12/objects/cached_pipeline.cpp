// SPDX-License-Identifier: MIT
#include "d3d12/objects/cached_pipeline.h"

#include <windows.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>

#include <rtapi/version.h>

#include "d3d12/container/container.h"

namespace kaamos::d3d12 {
namespace {

using Bytes = std::span<const std::byte>;

constexpr uint32_t kVersionPart = fourcc("KVER");   // Kaamos' version, a text
constexpr uint32_t kBackendPart = fourcc("KBKD");   // the device's backend, a text
constexpr uint32_t kPipelinePart = fourcc("KPSO");  // an Identity
constexpr uint32_t kLibraryPart = fourcc("KPLB");   // for each pipeline: an Identity, the size of
                                                    // its name (4 bytes), the name

Bytes bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::vector<std::byte> write(const rtapi::Device& device, uint32_t kind, Bytes content) {
  const Part parts[] = {{kVersionPart, bytes_of(rtapi::GetVersion())},
                        {kBackendPart, bytes_of(device.GetDesc().Backend)},
                        {kind, content}};
  return write_container(parts);
}

HRESULT refuse(Reporter& reporter, const std::string& detail, HRESULT result = E_INVALIDARG) {
  reporter.fail(ErrorId::kCachedPipeline, detail);
  return result;
}

// Reads the part `kind` of a blob that this version of Kaamos wrote for the device's backend.
// `what`: "CachedPSO" for messages.
HRESULT read(const rtapi::Device& device, const void* data, size_t size, uint32_t kind,
             const std::string& what, Bytes& content, Reporter& reporter) {
  const auto parts = data != nullptr ? read_container(data, size)
                                     : rtapi::Result<std::vector<Part>>(std::vector<Part>());
  const auto find = [&](uint32_t wanted) -> std::optional<Bytes> {
    if (!parts) return std::nullopt;
    for (const Part& part : *parts) {
      if (part.fourcc == wanted) return part.bytes;
    }
    return std::nullopt;
  };
  const auto version = find(kVersionPart), backend = find(kBackendPart), found = find(kind);
  if (!version || !backend || !found) {
    return refuse(reporter, what + ": its " + std::to_string(size) +
                                " bytes are no such blob, or are damaged.");
  }
  const auto text = [](Bytes bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  // Parts are padded to words.
  const std::string wrote = text(*version).c_str(), made_for = text(*backend).c_str();
  if (wrote != rtapi::GetVersion()) {
    return refuse(reporter,
                  what + ": Kaamos " + wrote + " wrote it; this is " + rtapi::GetVersion() + ".",
                  D3D12_ERROR_DRIVER_VERSION_MISMATCH);
  }
  if (made_for != device.GetDesc().Backend) {
    return refuse(reporter,
                  what + ": it is of the backend \"" + made_for + "\"; the device is of \"" +
                      device.GetDesc().Backend + "\".",
                  D3D12_ERROR_ADAPTER_NOT_FOUND);
  }
  content = *found;
  return S_OK;
}

}  // namespace

std::vector<std::byte> write_cached_pipeline(const rtapi::Device& device,
                                             const Identity& identity) {
  return write(device, kPipelinePart, std::as_bytes(std::span(identity)));
}

HRESULT check_cached_pipeline(const rtapi::Device& device,
                              const D3D12_CACHED_PIPELINE_STATE& cached, const Identity& identity,
                              Reporter& reporter) {
  if (cached.pCachedBlob == nullptr && cached.CachedBlobSizeInBytes == 0) return S_OK;
  Bytes content;
  const HRESULT result = read(device, cached.pCachedBlob, cached.CachedBlobSizeInBytes,
                              kPipelinePart, "CachedPSO", content, reporter);
  if (FAILED(result)) return result;
  if (!std::ranges::equal(content, std::as_bytes(std::span(identity)))) {
    return refuse(reporter,
                  "CachedPSO: it is that of a pipeline with other shaders, another root "
                  "signature or other states.");
  }
  return S_OK;
}

std::vector<std::byte> write_pipeline_library(const rtapi::Device& device,
                                              const NamedIdentities& pipelines) {
  std::vector<std::byte> content;
  const auto put = [&](Bytes bytes) { content.insert(content.end(), bytes.begin(), bytes.end()); };
  for (const auto& [name, identity] : pipelines) {
    const auto length = static_cast<uint32_t>(name.size());
    put(std::as_bytes(std::span(identity)));
    put(std::as_bytes(std::span(&length, 1)));
    put(bytes_of(name));
    content.resize((content.size() + 3) / 4 * 4);
  }
  return write(device, kLibraryPart, content);
}

HRESULT read_pipeline_library(const rtapi::Device& device, const void* data, size_t size,
                              NamedIdentities& pipelines, Reporter& reporter) {
  const std::string what = "CreatePipelineLibrary: pLibraryBlob";
  Bytes content;
  const HRESULT result = read(device, data, size, kLibraryPart, what, content, reporter);
  if (FAILED(result)) return result;
  while (!content.empty()) {
    Identity identity;
    uint32_t length = 0;
    const size_t head = sizeof identity + sizeof length;
    if (content.size() < head) return refuse(reporter, what + ": it ends within a pipeline.");
    std::memcpy(&identity, content.data(), sizeof identity);
    std::memcpy(&length, content.data() + sizeof identity, sizeof length);
    content = content.subspan(head);
    if (length > content.size()) return refuse(reporter, what + ": it ends within a name.");
    pipelines[std::string(reinterpret_cast<const char*>(content.data()), length)] = identity;
    content = content.subspan(std::min(content.size(), (size_t{length} + 3) / 4 * 4));
  }
  return S_OK;
}

}  // namespace kaamos::d3d12
