// SPDX-License-Identifier: MIT
#include "shader_table.h"

#include <cstring>
#include <stdexcept>

#include "program.h"

ShaderTable::ShaderTable(ID3D12StateObject* pipeline) {
  CHECK(pipeline->QueryInterface(IID_PPV_ARGS(&properties_)));
}

void ShaderTable::AddRecord(const wchar_t* name, const void* arguments, size_t bytes) {
  const void* identifier = properties_->GetShaderIdentifier(name);
  if (identifier == nullptr) throw std::runtime_error("the pipeline lacks an export of a table");
  constexpr size_t kIdentifier = D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES;
  constexpr size_t kAlignment = D3D12_RAYTRACING_SHADER_RECORD_BYTE_ALIGNMENT;
  stride_ = (kIdentifier + bytes + kAlignment - 1) / kAlignment * kAlignment;
  const size_t record = records_.size();
  records_.resize(record + stride_);
  memcpy(&records_[record], identifier, kIdentifier);
  if (bytes != 0) memcpy(&records_[record + kIdentifier], arguments, bytes);
}
