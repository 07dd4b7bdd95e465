// SPDX-License-Identifier: MIT
// Serializing and deserializing root signatures.
#include "d3d12/com/blob.h"
#include "d3d12/com/report.h"
#include "d3d12/container/container.h"
#include "d3d12/container/root_signature_blob.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint32_t kRootSignaturePart = 0x30535452;  // "RTS0"

HRESULT serialize(const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* desc, ID3DBlob** blob,
                  ID3DBlob** error_blob) {
  if (error_blob != nullptr) *error_blob = nullptr;
  if (blob == nullptr || desc == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer,
                                   "D3D12SerializeRootSignature: pRootSignature or ppBlob.");
  }
  *blob = nullptr;
  const auto converted = root_signature_desc(*desc);
  const auto refuse = [&](const rtapi::Error& error) {
    if (error_blob != nullptr) *error_blob = new Blob(error.message);
    return process_reporter().fail(error);
  };
  if (!converted) return refuse(converted.error());
  if (const auto status = rtapi::CheckRootSignature(*converted); !status.ok()) {
    return refuse(status.error());
  }
  const std::vector<std::byte> part = write_root_signature(*converted, desc->Version);
  const Part parts[] = {{kRootSignaturePart, part}};
  *blob = new Blob(write_container(parts));
  return S_OK;
}

// The interface and nothing else: not even IUnknown, as of Microsoft's.
template <class Entries>
class DeserializerObject : public ComObject<Entries> {
 public:
  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID riid, void** object) override {
    if (object == nullptr || riid != kIUnknown) {
      return ComObject<Entries>::QueryInterface(riid, object);
    }
    *object = nullptr;
    return E_NOINTERFACE;
  }
};

// All versions' structures are made when the object is.
class VersionedDeserializer final
    : public DeserializerObject<ID3D12VersionedRootSignatureDeserializerEntries> {
 public:
  VersionedDeserializer(const rtapi::RootSignatureDesc& desc, D3D_ROOT_SIGNATURE_VERSION version)
      : unconverted_(version),
        v1_0_(desc, D3D_ROOT_SIGNATURE_VERSION_1_0),
        v1_1_(desc, D3D_ROOT_SIGNATURE_VERSION_1_1, version),
        v1_2_(desc, D3D_ROOT_SIGNATURE_VERSION_1_2, version) {}

  HRESULT STDMETHODCALLTYPE
  GetRootSignatureDescAtVersion(D3D_ROOT_SIGNATURE_VERSION version,
                                const D3D12_VERSIONED_ROOT_SIGNATURE_DESC** desc) override {
    if (desc == nullptr) return E_INVALIDARG;
    *desc = at(version);
    return *desc != nullptr ? S_OK : E_INVALIDARG;
  }
  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* STDMETHODCALLTYPE
  GetUnconvertedRootSignatureDesc() override {
    return at(unconverted_);
  }

 private:
  const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* at(D3D_ROOT_SIGNATURE_VERSION version) const {
    if (version == D3D_ROOT_SIGNATURE_VERSION_1_0) return &v1_0_.desc();
    if (version == D3D_ROOT_SIGNATURE_VERSION_1_1) return &v1_1_.desc();
    return version == D3D_ROOT_SIGNATURE_VERSION_1_2 ? &v1_2_.desc() : nullptr;
  }

  D3D_ROOT_SIGNATURE_VERSION unconverted_;
  RootSignatureTree v1_0_;
  RootSignatureTree v1_1_;
  RootSignatureTree v1_2_;
};

class Deserializer final : public DeserializerObject<ID3D12RootSignatureDeserializerEntries> {
 public:
  explicit Deserializer(const rtapi::RootSignatureDesc& desc)
      : v1_0_(desc, D3D_ROOT_SIGNATURE_VERSION_1_0) {}

  const D3D12_ROOT_SIGNATURE_DESC* STDMETHODCALLTYPE GetRootSignatureDesc() override {
    return &v1_0_.desc().Desc_1_0;
  }

 private:
  RootSignatureTree v1_0_;
};

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the exported functions below are global

extern "C" {

HRESULT WINAPI D3D12SerializeRootSignature(const D3D12_ROOT_SIGNATURE_DESC* desc,
                                           D3D_ROOT_SIGNATURE_VERSION version, ID3DBlob** blob,
                                           ID3DBlob** error_blob) {
  if (error_blob != nullptr) *error_blob = nullptr;
  if (desc == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer,
                                   "D3D12SerializeRootSignature: pRootSignature.");
  }
  // Like Microsoft's, this call leaves ppBlob as it is then.
  if (version != D3D_ROOT_SIGNATURE_VERSION_1_0) {
    const rtapi::Error error =
        make_error(ErrorId::kRootSignatureBlob,
                   "D3D12SerializeRootSignature: Version is " + std::to_string(version) +
                       "; it is 1 (1.0). D3D12SerializeVersionedRootSignature takes others.");
    if (error_blob != nullptr) *error_blob = new Blob(error.message);
    return process_reporter().fail(error);
  }
  D3D12_VERSIONED_ROOT_SIGNATURE_DESC versioned = {};
  versioned.Version = version;
  versioned.Desc_1_0 = *desc;
  return serialize(&versioned, blob, error_blob);
}

HRESULT WINAPI D3D12SerializeVersionedRootSignature(const D3D12_VERSIONED_ROOT_SIGNATURE_DESC* desc,
                                                    ID3DBlob** blob, ID3DBlob** error_blob) {
  return serialize(desc, blob, error_blob);
}

HRESULT WINAPI D3D12CreateRootSignatureDeserializer(LPCVOID data, SIZE_T size, REFIID riid,
                                                    void** deserializer) {
  if (deserializer != nullptr) *deserializer = nullptr;
  const auto desc = root_signature_of_blob(data, size);
  if (!desc) return process_reporter().fail(desc.error());
  return hand_out(new Deserializer(*desc), riid, deserializer);
}

HRESULT WINAPI D3D12CreateVersionedRootSignatureDeserializer(LPCVOID data, SIZE_T size, REFIID riid,
                                                             void** deserializer) {
  if (deserializer != nullptr) *deserializer = nullptr;
  D3D_ROOT_SIGNATURE_VERSION version = D3D_ROOT_SIGNATURE_VERSION_1_1;
  const auto desc = root_signature_of_blob(data, size, &version);
  if (!desc) return process_reporter().fail(desc.error());
  return hand_out(new VersionedDeserializer(*desc, version), riid, deserializer);
}

}  // extern "C"
