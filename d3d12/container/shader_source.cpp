// SPDX-License-Identifier: MIT
//
// The part: its version, then the members in a fixed order, each text after its size in bytes.
#include "d3d12/container/shader_source.h"

#include <cstring>
#include <filesystem>
#include <map>
#include <memory>

#include "d3d12/com/errors.h"

namespace kaamos::d3d12 {

namespace {

constexpr uint32_t kVersion = 1;

class SourceWriter {
 public:
  void add(uint32_t number) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    out_.insert(out_.end(), bytes, bytes + sizeof(number));
  }
  void add(const std::string& text) {
    add(static_cast<uint32_t>(text.size()));
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    out_.insert(out_.end(), bytes, bytes + text.size());
  }
  void add(const std::vector<std::string>& list) {
    add(static_cast<uint32_t>(list.size()));
    for (const std::string& text : list) add(text);
  }
  std::vector<std::byte> take() { return std::move(out_); }

 private:
  std::vector<std::byte> out_;
};

class SourceReader {
 public:
  explicit SourceReader(std::span<const std::byte> rest) : rest_(rest) {}
  uint32_t number() {
    uint32_t out = 0;
    if (rest_.size() < sizeof(out)) {
      fail();
      return 0;
    }
    std::memcpy(&out, rest_.data(), sizeof(out));
    rest_ = rest_.subspan(sizeof(out));
    return out;
  }
  std::string text() {
    const uint32_t size = number();
    if (size > rest_.size()) {
      fail();
      return {};
    }
    std::string out(reinterpret_cast<const char*>(rest_.data()), size);
    rest_ = rest_.subspan(size);
    return out;
  }
  std::vector<std::string> list() {
    std::vector<std::string> out;
    for (uint32_t left = number(); left > 0 && ok_; --left) out.push_back(text());
    return out;
  }
  bool ok() const { return ok_; }
  bool at_end() const { return rest_.empty(); }

 private:
  void fail() {
    ok_ = false;
    rest_ = {};
  }
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

std::string normal(const std::string& path) {
  return std::filesystem::path(path).lexically_normal().generic_string();
}

// 0: not given, else 1 more than the value.
uint32_t number_of(const std::optional<bool>& given) {
  return given ? 1u + (*given ? 1u : 0u) : 0u;
}

}  // namespace

std::vector<std::byte> write_source(const ShaderSource& source) {
  const rtapi::ShaderCompileOptions& options = source.options;
  SourceWriter out;
  out.add(kVersion);
  out.add(options.File);
  out.add(options.Source.value_or(""));
  out.add(options.Target);
  out.add(options.EntryPoint);
  out.add(static_cast<uint32_t>(options.Defines.size()));
  for (const rtapi::ShaderDefine& define : options.Defines) {
    out.add(define.Name);
    out.add(define.Value);
  }
  out.add(options.IncludeDirectories);
  out.add(options.Exports);
  out.add(options.AutoBindingSpace ? 1u : 0u);
  out.add(options.AutoBindingSpace.value_or(0));
  out.add(options.HlslVersion);
  out.add(number_of(options.PayloadQualifiers));
  for (const bool flag :
       {options.RowMajorMatrices, options.Native16BitTypes, options.ExternalLinkage, options.Strict,
        options.Debug, options.ReserveUnusedRegisters}) {
    out.add(uint32_t{flag});
  }
  out.add(static_cast<uint32_t>(source.files.size()));
  for (const rtapi::ShaderSourceFile& file : source.files) {
    out.add(file.Path);
    out.add(file.Text);
  }
  return out.take();
}

rtapi::Result<ShaderSource> read_source(std::span<const std::byte> part) {
  SourceReader in(part);
  const uint32_t version = in.number();
  if (in.ok() && version != kVersion) {
    return make_error(ErrorId::kBytecode,
                      "it was made by another version of kaamos-dxc: its part KAAM has format " +
                          std::to_string(version) + ", and this library reads format " +
                          std::to_string(kVersion) + ". Compile the HLSL again.");
  }
  ShaderSource out;
  rtapi::ShaderCompileOptions& options = out.options;
  options.File = in.text();
  options.Source = in.text();
  options.Target = in.text();
  options.EntryPoint = in.text();
  for (uint32_t left = in.number(); left > 0 && in.ok(); --left) {
    std::string name = in.text();
    options.Defines.push_back({std::move(name), in.text()});
  }
  options.IncludeDirectories = in.list();
  options.Exports = in.list();
  const bool has_space = in.number() != 0;
  const uint32_t space = in.number();
  if (has_space) options.AutoBindingSpace = space;
  options.HlslVersion = in.text();
  if (const uint32_t given = in.number()) options.PayloadQualifiers = given == 2;
  options.Experimental = true;  // what was allowed when it was compiled
  for (bool* flag : {&options.RowMajorMatrices, &options.Native16BitTypes, &options.ExternalLinkage,
                     &options.Strict, &options.Debug, &options.ReserveUnusedRegisters}) {
    *flag = in.number() != 0;
  }
  for (uint32_t left = in.number(); left > 0 && in.ok(); --left) {
    std::string path = in.text();
    out.files.push_back({std::move(path), in.text()});
  }
  if (!in.ok() || !in.at_end()) {
    return make_error(ErrorId::kBytecode,
                      "its part KAAM of " + std::to_string(part.size()) +
                          " bytes is damaged. Compile the HLSL again with kaamos-dxc.");
  }
  return out;
}

rtapi::Result<ShaderSource> source_of_container(const void* bytes, size_t size) {
  const auto parts = read_container(bytes, size);
  if (!parts) return parts.error();
  const char* kind = nullptr;
  for (const Part& part : *parts) {
    if (part.fourcc == kSourcePart) return read_source(part.bytes);
    if (part.fourcc == fourcc("DXIL") || part.fourcc == fourcc("ILDB")) kind = "DXIL";
    if (part.fourcc == fourcc("SHDR") || part.fourcc == fourcc("SHEX")) kind = "DXBC";
  }
  if (kind == nullptr) {
    return make_error(ErrorId::kBytecode,
                      "the container has no part KAAM, in which kaamos-dxc puts the HLSL. Pass a "
                      "compiled shader, not a serialized root signature or reflection data.");
  }
  return make_error(
      ErrorId::kBytecode,
      std::string("it is ") + kind +
          ", which Microsoft's compiler made; it holds no HLSL. Compile the HLSL with "
          "kaamos-dxc, which takes dxc's command line, or at run time with "
          "DxcCreateInstance or D3DCompile of this library.");
}

rtapi::ShaderCompileOptions compile_options(ShaderSource source) {
  auto files = std::make_shared<std::map<std::string, std::string>>();
  for (rtapi::ShaderSourceFile& file : source.files) {
    files->emplace(normal(file.Path), std::move(file.Text));
  }
  source.options.ReadFile = [files](const std::string& path) -> std::optional<std::string> {
    const auto found = files->find(normal(path));
    return found == files->end() ? std::nullopt : std::optional(found->second);
  };
  return std::move(source.options);
}

}  // namespace kaamos::d3d12
