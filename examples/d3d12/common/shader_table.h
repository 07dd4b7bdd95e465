// SPDX-License-Identifier: MIT
// The records of a shader table.
#pragma once

#include <d3d12.h>
#include <windows.h>
#include <wrl/client.h>

#include <cstddef>
#include <vector>

// Records of one stride: the identifier of an export, and behind it the arguments of its local
// root signature.
class ShaderTable {
 public:
  explicit ShaderTable(ID3D12StateObject* pipeline);

  void AddRecord(const wchar_t* name) { AddRecord(name, nullptr, 0); }
  // `arguments`: as the local root signature lays them out; all records of a table have one size.
  template <class Arguments>
  void AddRecord(const wchar_t* name, const Arguments& arguments) {
    AddRecord(name, &arguments, sizeof(arguments));
  }

  UINT64 Stride() const { return stride_; }
  const std::vector<BYTE>& Records() const { return records_; }

 private:
  void AddRecord(const wchar_t* name, const void* arguments, size_t bytes);

  Microsoft::WRL::ComPtr<ID3D12StateObjectProperties> properties_;
  UINT64 stride_ = 0;
  std::vector<BYTE> records_;
};
