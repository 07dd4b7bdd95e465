// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_container.h"

#include <algorithm>

#include "d3d12/com/report.h"
#include "d3d12/compiler/dxc_blob.h"
#include "d3d12/compiler/dxc_result.h"
#include "d3d12/compiler/reflection.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

HRESULT DxcContainerReflection::Load(IDxcBlob* container) {
  parts_.clear();
  container_ = container;
  if (container == nullptr) return S_OK;
  auto parts = read_container(container->GetBufferPointer(), container->GetBufferSize());
  if (!parts) {
    container_ = nullptr;
    return fail(parts.error());
  }
  parts_ = *std::move(parts);
  return S_OK;
}

HRESULT DxcContainerReflection::GetPartCount(UINT32* count) {
  if (count == nullptr) return E_POINTER;
  *count = static_cast<UINT32>(parts_.size());
  return S_OK;
}

HRESULT DxcContainerReflection::GetPartKind(UINT32 index, UINT32* kind) {
  if (kind == nullptr) return E_POINTER;
  if (index >= parts_.size()) return E_BOUNDS;
  *kind = parts_[index].fourcc;
  return S_OK;
}

HRESULT DxcContainerReflection::GetPartContent(UINT32 index, IDxcBlob** content) {
  if (content == nullptr) return E_POINTER;
  *content = nullptr;
  if (index >= parts_.size()) return E_BOUNDS;
  const auto bytes = parts_[index].bytes;
  *content = new DxcBlob(bytes.data(), bytes.size(), std::nullopt, container_.Get());
  return S_OK;
}

HRESULT DxcContainerReflection::FindFirstPartKind(UINT32 kind, UINT32* index) {
  if (index == nullptr) return E_POINTER;
  *index = 0;
  for (size_t i = 0; i < parts_.size(); ++i) {
    if (!is_part(parts_[i], kind)) continue;
    *index = static_cast<UINT32>(i);
    return S_OK;
  }
  return HRESULT_FROM_WIN32(ERROR_NOT_FOUND);
}

HRESULT DxcContainerReflection::GetPartReflection(UINT32 index, REFIID riid, void** object) {
  if (object == nullptr) return E_POINTER;
  *object = nullptr;
  if (index >= parts_.size()) return E_BOUNDS;
  if (parts_[index].fourcc != kSourcePart) return E_NOTIMPL;  // as DXC for any other part
  return create_reflection(container_->GetBufferPointer(), container_->GetBufferSize(), riid,
                           object);
}

HRESULT DxcContainerBuilder::Load(IDxcBlob* container) {
  if (container == nullptr) return E_POINTER;
  const auto parts = read_container(container->GetBufferPointer(), container->GetBufferSize());
  if (!parts) return fail(parts.error());
  parts_.clear();
  for (const Part& part : *parts) {
    parts_.push_back({part.fourcc, {part.bytes.begin(), part.bytes.end()}});
  }
  return S_OK;
}

HRESULT DxcContainerBuilder::AddPart(UINT32 kind, IDxcBlob* source) {
  if (source == nullptr) return E_POINTER;
  for (const OwnedPart& part : parts_) {
    if (part.fourcc == kind) {
      return fail(ErrorId::kCompiler, "AddPart: the container has such a part; remove it first.");
    }
  }
  const auto* bytes = static_cast<const std::byte*>(source->GetBufferPointer());
  parts_.push_back({kind, {bytes, bytes + source->GetBufferSize()}});
  return S_OK;
}

HRESULT DxcContainerBuilder::RemovePart(UINT32 kind) {
  const size_t removed =
      std::erase_if(parts_, [kind](const OwnedPart& part) { return part.fourcc == kind; });
  return removed != 0 ? S_OK : HRESULT_FROM_WIN32(ERROR_NOT_FOUND);
}

HRESULT DxcContainerBuilder::SerializeContainer(IDxcOperationResult** result) {
  if (result == nullptr) return E_POINTER;
  std::vector<Part> parts;
  for (const OwnedPart& part : parts_) parts.push_back({part.fourcc, part.bytes});
  const auto bytes = write_container(parts);
  auto* made = new DxcResult(S_OK, DXC_OUT_OBJECT);
  made->add(DXC_OUT_OBJECT,
            static_cast<IDxcBlobUtf8*>(new DxcBlob(bytes.data(), bytes.size(), std::nullopt)));
  made->add_messages("");
  *result = made;
  return S_OK;
}

HRESULT DxcValidator::Validate(IDxcBlob* shader, UINT32, IDxcOperationResult** result) {
  if (shader == nullptr || result == nullptr) return E_POINTER;
  const void* bytes = shader->GetBufferPointer();
  const size_t size = shader->GetBufferSize();
  const auto source = source_of_container(bytes, size);
  auto* made = new DxcResult(source ? S_OK : E_FAIL, DXC_OUT_OBJECT);
  if (source) {
    made->add(DXC_OUT_OBJECT, static_cast<IDxcBlobUtf8*>(new DxcBlob(bytes, size, std::nullopt)));
  }
  made->add_messages(source ? "" : source.error().message + "\n");
  *result = made;
  return S_OK;
}

HRESULT DxcValidator::GetVersion(UINT32* major, UINT32* minor) {
  if (major == nullptr || minor == nullptr) return E_POINTER;
  *major = 1;
  *minor = 8;
  return S_OK;
}

HRESULT DxcValidator::GetFlags(UINT32* flags) {
  if (flags == nullptr) return E_POINTER;
  *flags = DxcVersionInfoFlags_None;
  return S_OK;
}

}  // namespace kaamos::d3d12
