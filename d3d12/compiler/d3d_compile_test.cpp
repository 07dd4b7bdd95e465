// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <windows.h>

#include <d3d12shader.h>
#include <d3dcompiler.h>
#include <directx/d3d12.h>
#include <wrl/client.h>

#include "d3d12/com/text.h"
#include "d3d12/container/shader_bytecode.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {
namespace {

using Microsoft::WRL::ComPtr;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kCompute[] =
    "#include \"size.h\"\n[RootSignature(\"UAV(u0)\")] [numthreads(SIZE, COUNT, 1)] void Main() {}";

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
class TestFiles final : public ID3DInclude {
 public:
  virtual ~TestFiles() = default;
  HRESULT STDMETHODCALLTYPE Open(D3D_INCLUDE_TYPE, LPCSTR name, LPCVOID, LPCVOID* data,
                                 UINT* size) override {
    asked.emplace_back(name);
    const auto found = files.find(name);
    if (found == files.end()) return E_FAIL;
    *data = found->second.data();
    *size = static_cast<UINT>(found->second.size());
    ++open;
    return S_OK;
  }
  HRESULT STDMETHODCALLTYPE Close(LPCVOID) override {
    --open;
    return S_OK;
  }
  std::map<std::string, std::string> files;
  std::vector<std::string> asked;
  int open = 0;
};
#pragma GCC diagnostic pop

struct Compiled {
  HRESULT result = E_UNEXPECTED;
  ComPtr<ID3DBlob> code, errors;
  std::string text() const {
    return errors ? static_cast<const char*>(errors->GetBufferPointer()) : "";
  }
};

Compiled compile(const char* source, ID3DInclude* includes, const char* target = "cs_5_0",
                 UINT flags = 0, const char* name = "shaders/size.hlsl") {
  const D3D_SHADER_MACRO defines[] = {{"COUNT", "4"}, {nullptr, nullptr}};
  Compiled out;
  out.result = D3DCompile(source, std::strlen(source), name, defines, includes, "Main", target,
                          flags, 0, out.code.GetAddressOf(), out.errors.GetAddressOf());
  return out;
}

TEST(D3DCompileCall, OldProfilesCompileWithTheirIncludes) {
  TestFiles files;
  files.files["size.h"] = "#define SIZE 8\n";
  const Compiled compiled = compile(kCompute, &files);
  ASSERT_EQ(compiled.result, S_OK) << compiled.text();
  EXPECT_EQ(compiled.errors, nullptr);
  EXPECT_THAT(files.asked, ElementsAre("size.h"));
  EXPECT_EQ(files.open, 0);
  ComPtr<ID3D12ShaderReflection> shader;
  ASSERT_EQ(D3DReflect(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize(),
                       IID_ID3D12ShaderReflection, reinterpret_cast<void**>(shader.GetAddressOf())),
            S_OK);
  UINT x = 0, y = 0;
  shader->GetThreadGroupSize(&x, &y, nullptr);
  EXPECT_EQ(x, 8u);
  EXPECT_EQ(y, 4u);
  const auto source =
      source_of_container(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize());
  ASSERT_TRUE(source);
  EXPECT_EQ(source->options.Target, "cs_6_0");
  EXPECT_FALSE(source->options.Debug);
  ComPtr<ID3DBlob> root;
  EXPECT_EQ(D3DGetBlobPart(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize(),
                           D3D_BLOB_ROOT_SIGNATURE, 0, root.GetAddressOf()),
            S_OK);
  EXPECT_EQ(D3DGetBlobPart(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize(),
                           D3D_BLOB_PDB, 0, root.ReleaseAndGetAddressOf()),
            E_FAIL);
}

TEST(D3DCompileCall, FilesOfOtherFoldersAreAskedForByName) {
  TestFiles files;
  files.files["part/size.h"] = "#include \"deeper.h\"\n";
  files.files["deeper.h"] = "#define SIZE 2\n";
  const Compiled compiled =
      compile("#include \"part/size.h\"\n[numthreads(SIZE, 1, 1)] void Main() {}", &files);
  ASSERT_EQ(compiled.result, S_OK) << compiled.text();
  EXPECT_THAT(files.asked, ElementsAre("part/size.h", "part/deeper.h", "deeper.h"));
}

TEST(D3DCompileCall, FlagsAreOptions) {
  const UINT flags = D3DCOMPILE_DEBUG | D3DCOMPILE_SKIP_OPTIMIZATION |
                     D3DCOMPILE_PACK_MATRIX_ROW_MAJOR | D3DCOMPILE_ENABLE_STRICTNESS;
  const Compiled compiled =
      compile("[numthreads(1, 1, 1)] void Main() {}", nullptr, "cs_5_1", flags);
  ASSERT_EQ(compiled.result, S_OK) << compiled.text();
  const auto source =
      source_of_container(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize());
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->options.Debug);
  EXPECT_TRUE(source->options.RowMajorMatrices);
}

// FXC leaves the registers of what nothing reads alone, up to model 5.0.
TEST(D3DCompileCall, UnusedRegistersAreReservedBeforeModel51) {
  for (const auto& [target, reserved] : {std::pair("cs_5_0", true), std::pair("cs_5_1", false)}) {
    const Compiled compiled = compile("[numthreads(1, 1, 1)] void Main() {}", nullptr, target);
    ASSERT_EQ(compiled.result, S_OK) << compiled.text();
    const auto source =
        source_of_container(compiled.code->GetBufferPointer(), compiled.code->GetBufferSize());
    ASSERT_TRUE(source);
    EXPECT_EQ(source->options.ReserveUnusedRegisters, reserved) << target;
  }
}

TEST(D3DCompileCall, ErrorsAreText) {
  const Compiled compiled = compile(kCompute, nullptr);
  EXPECT_EQ(compiled.result, E_FAIL);
  EXPECT_EQ(compiled.code, nullptr);
  EXPECT_THAT(compiled.text(), HasSubstr("shaders/size.hlsl:1:"));
  EXPECT_THAT(compiled.text(), HasSubstr("size.h"));
  ComPtr<ID3DBlob> code;
  EXPECT_EQ(D3DCompile(nullptr, 0, nullptr, nullptr, nullptr, "Main", "cs_5_0", 0, 0,
                       code.GetAddressOf(), nullptr),
            E_INVALIDARG);
  EXPECT_EQ(D3DCompile("", 0, nullptr, nullptr, nullptr, "Main", nullptr, 0, 0, code.GetAddressOf(),
                       nullptr),
            E_INVALIDARG);
}

TEST(D3DCompileCall, FromFileAndFilesOfBlobs) {
  const auto folder = std::filesystem::path(testing::TempDir()) /
                      ("kaamos_d3d_compile_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "size.hlsl") << kCompute;
  std::ofstream(folder / "size.h") << "#define SIZE 16\n#define COUNT 1\n";
  ComPtr<ID3DBlob> code, errors;
  const std::wstring name = to_wide((folder / "size.hlsl").string());
  ASSERT_EQ(D3DCompileFromFile(name.c_str(), nullptr, D3D_COMPILE_STANDARD_FILE_INCLUDE, "Main",
                               "cs_5_0", 0, 0, code.GetAddressOf(), errors.GetAddressOf()),
            S_OK);
  const std::wstring object = to_wide((folder / "size.cso").string());
  ASSERT_EQ(D3DWriteBlobToFile(code.Get(), object.c_str(), FALSE), S_OK);
  EXPECT_EQ(D3DWriteBlobToFile(code.Get(), object.c_str(), FALSE),
            HRESULT_FROM_WIN32(ERROR_FILE_EXISTS));
  ComPtr<ID3DBlob> read;
  ASSERT_EQ(D3DReadFileToBlob(object.c_str(), read.GetAddressOf()), S_OK);
  ASSERT_EQ(read->GetBufferSize(), code->GetBufferSize());
  EXPECT_EQ(std::memcmp(read->GetBufferPointer(), code->GetBufferPointer(), read->GetBufferSize()),
            0);
  const std::wstring backslashes = to_wide(folder.string()) + L"\\size.cso";
  EXPECT_EQ(D3DReadFileToBlob(backslashes.c_str(), read.ReleaseAndGetAddressOf()), S_OK);
  const std::wstring no_file = to_wide(folder.string());
  EXPECT_EQ(D3DReadFileToBlob(no_file.c_str(), read.ReleaseAndGetAddressOf()),
            HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND));
  EXPECT_EQ(D3DReadFileToBlob(L"no/such/file", read.ReleaseAndGetAddressOf()),
            HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND));
  EXPECT_EQ(D3DCompileFromFile(L"no/such/file", nullptr, nullptr, "Main", "cs_5_0", 0, 0,
                               code.ReleaseAndGetAddressOf(), nullptr),
            HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND));
  std::filesystem::remove_all(folder);
}

TEST(D3DCompileCall, PreprocessAndCreateBlob) {
  const char source[] = "#define X 1\nint a = X;";
  ComPtr<ID3DBlob> text, blob;
  ASSERT_EQ(D3DPreprocess(source, sizeof(source), "a.hlsl", nullptr, nullptr, text.GetAddressOf(),
                          nullptr),
            S_OK);
  EXPECT_THAT(static_cast<const char*>(text->GetBufferPointer()), HasSubstr("int a = 1 ;"));
  ASSERT_EQ(D3DCreateBlob(10, blob.GetAddressOf()), S_OK);
  EXPECT_EQ(blob->GetBufferSize(), 10u);
}

}  // namespace
}  // namespace kaamos::d3d12
