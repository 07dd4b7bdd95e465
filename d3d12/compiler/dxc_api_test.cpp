// SPDX-License-Identifier: MIT
//
// dxcompiler as programs call it.
#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <windows.h>

#include <directx/d3d12.h>
#include <dxcapi.h>
#include <wrl/client.h>

#include "d3d12/com/text.h"
#include "d3d12/container/shader_bytecode.h"

namespace kaamos::d3d12 {
namespace {

using Microsoft::WRL::ComPtr;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr char kSource[] = R"(#include "colour.hlsli"
struct Payload { float3 color; };
[shader("miss")] void Sky(inout Payload p) { p.color = COLOUR; }
)";

template <class T>
ComPtr<T> create(REFCLSID id) {
  ComPtr<T> out;
  EXPECT_EQ(DxcCreateInstance(id, IID_PPV_ARGS(out.GetAddressOf())), S_OK);
  return out;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
// Files in memory; notes what it was asked for.
class TestIncludes final : public IDxcIncludeHandler {
 public:
  virtual ~TestIncludes() = default;
  HRESULT STDMETHODCALLTYPE QueryInterface(REFIID, void** out) override {
    *out = nullptr;
    return E_NOINTERFACE;
  }
  ULONG STDMETHODCALLTYPE AddRef() override { return 2; }
  ULONG STDMETHODCALLTYPE Release() override { return 1; }
  HRESULT STDMETHODCALLTYPE LoadSource(LPCWSTR name, IDxcBlob** out) override {
    asked.push_back(to_utf8(name));
    *out = nullptr;
    const auto found = files.find(asked.back());
    if (found == files.end()) return HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND);
    ComPtr<IDxcBlobEncoding> blob;
    create<IDxcUtils>(CLSID_DxcUtils)
        ->CreateBlob(found->second.data(), static_cast<UINT32>(found->second.size()), DXC_CP_UTF8,
                     blob.GetAddressOf());
    *out = blob.Detach();
    return S_OK;
  }

  std::map<std::string, std::string> files;
  std::vector<std::string> asked;
};
#pragma GCC diagnostic pop

ComPtr<IDxcResult> compile(const std::string& source, std::vector<LPCWSTR> arguments,
                           IDxcIncludeHandler* includes = nullptr) {
  const DxcBuffer buffer = {source.data(), source.size(), DXC_CP_UTF8};
  ComPtr<IDxcResult> result;
  EXPECT_EQ(create<IDxcCompiler3>(CLSID_DxcCompiler)
                ->Compile(&buffer, arguments.data(), static_cast<UINT32>(arguments.size()),
                          includes, IID_PPV_ARGS(result.GetAddressOf())),
            S_OK);
  return result;
}

std::string errors_of(IDxcResult* result) {
  ComPtr<IDxcBlobUtf8> errors;
  EXPECT_EQ(result->GetOutput(DXC_OUT_ERRORS, IID_PPV_ARGS(errors.GetAddressOf()), nullptr), S_OK);
  return {errors->GetStringPointer(), errors->GetStringLength()};
}

HRESULT status_of(IDxcOperationResult* result) {
  HRESULT status = E_UNEXPECTED;
  EXPECT_EQ(result->GetStatus(&status), S_OK);
  return status;
}

TEST(DxcApi, Compiler3CompilesALibraryWithAnIncludeHandler) {
  TestIncludes includes;
  includes.files["./shaders/colour.hlsli"] = "#define COLOUR float3(1, 2, 3)\n";
  const auto result = compile(kSource, {L"shaders/sky.hlsl", L"-T", L"lib_6_3"}, &includes);
  ASSERT_EQ(status_of(result.Get()), S_OK) << errors_of(result.Get());
  EXPECT_EQ(errors_of(result.Get()), "");
  EXPECT_THAT(includes.asked, ElementsAre("./shaders/colour.hlsli"));
  ComPtr<IDxcBlob> object;
  ASSERT_EQ(result->GetOutput(DXC_OUT_OBJECT, IID_PPV_ARGS(object.GetAddressOf()), nullptr), S_OK);
  const auto library =
      load_shader(object->GetBufferPointer(), object->GetBufferSize(), process_reporter());
  ASSERT_TRUE(library) << library.error().message;
  EXPECT_NE(library->FindExport("Sky"), nullptr);
  // The same as an ID3DBlob.
  ComPtr<ID3DBlob> blob;
  ASSERT_EQ(object->QueryInterface(IID_ID3DBlob, reinterpret_cast<void**>(blob.GetAddressOf())),
            S_OK);
  EXPECT_EQ(blob->GetBufferPointer(), object->GetBufferPointer());
}

TEST(DxcApi, WithoutAHandlerNothingIsIncluded) {
  const auto result = compile(kSource, {L"-T", L"lib_6_3"});
  EXPECT_EQ(status_of(result.Get()), E_FAIL);
  EXPECT_THAT(errors_of(result.Get()), HasSubstr("hlsl.hlsl:1:"));
  EXPECT_THAT(errors_of(result.Get()), HasSubstr("colour.hlsli"));
  EXPECT_FALSE(result->HasOutput(DXC_OUT_OBJECT));
  ComPtr<IDxcBlob> object;
  EXPECT_EQ(result->GetOutput(DXC_OUT_OBJECT, IID_PPV_ARGS(object.GetAddressOf()), nullptr),
            E_INVALIDARG);
}

TEST(DxcApi, DefaultHandlerReadsFiles) {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("kaamos_dxc_api_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "Colour.hlsli") << "#define COLOUR 1\n";
  ComPtr<IDxcIncludeHandler> handler;
  ASSERT_EQ(create<IDxcUtils>(CLSID_DxcUtils)->CreateDefaultIncludeHandler(handler.GetAddressOf()),
            S_OK);
  const std::wstring name = to_wide((folder / "sky.hlsl").string());
  // Windows takes any case of a file's name.
  const auto result = compile(kSource, {name.c_str(), L"-T", L"lib_6_3"}, handler.Get());
  EXPECT_EQ(status_of(result.Get()), S_OK) << errors_of(result.Get());
  ComPtr<IDxcBlob> text;
  EXPECT_EQ(
      handler->LoadSource(to_wide((folder / "Colour.hlsli").string()).c_str(), text.GetAddressOf()),
      S_OK);
  EXPECT_EQ(text->GetBufferSize(), 17u);
  EXPECT_EQ(handler->LoadSource(L"no/such/file", text.ReleaseAndGetAddressOf()),
            HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND));
  std::filesystem::remove_all(folder);
}

TEST(DxcApi, FirstCompilerIncludesFromTheFolderOfABackslashPath) {
  const std::string source = "#include \"colour.hlsli\"\nfloat4 Main() : SV_Target { return 1; }";
  ComPtr<IDxcBlobEncoding> blob;
  ASSERT_EQ(
      create<IDxcLibrary>(CLSID_DxcLibrary)
          ->CreateBlobWithEncodingFromPinned(source.data(), static_cast<UINT32>(source.size()),
                                             DXC_CP_UTF8, blob.GetAddressOf()),
      S_OK);
  TestIncludes includes;
  ComPtr<IDxcOperationResult> result;
  ASSERT_EQ(create<IDxcCompiler>(CLSID_DxcCompiler)
                ->Compile(blob.Get(), L"shaders\\sky.hlsl", L"Main", L"ps_6_0", nullptr, 0, nullptr,
                          0, &includes, result.GetAddressOf()),
            S_OK);
  EXPECT_THAT(includes.asked, ElementsAre("./shaders/colour.hlsli"));
}

TEST(DxcApi, FirstCompilerTakesEntryProfileAndDefines) {
  const std::string source = "float4 Main() : SV_Target { return COLOUR; }";
  auto library = create<IDxcLibrary>(CLSID_DxcLibrary);
  ComPtr<IDxcBlobEncoding> blob;
  ASSERT_EQ(
      library->CreateBlobWithEncodingFromPinned(source.data(), static_cast<UINT32>(source.size()),
                                                DXC_CP_UTF8, blob.GetAddressOf()),
      S_OK);
  EXPECT_EQ(blob->GetBufferPointer(), source.data());
  const DxcDefine defines[] = {{L"COLOUR", L"float4(1, 2, 3, 4)"}, {L"UNUSED", nullptr}};
  LPCWSTR arguments[] = {L"-Zpr"};
  ComPtr<IDxcOperationResult> result;
  auto compiler = create<IDxcCompiler>(CLSID_DxcCompiler);
  ASSERT_EQ(compiler->Compile(blob.Get(), L"colour.hlsl", L"Main", L"ps_6_0", arguments, 1, defines,
                              2, nullptr, result.GetAddressOf()),
            S_OK);
  ASSERT_EQ(status_of(result.Get()), S_OK);
  ComPtr<IDxcBlob> object;
  ASSERT_EQ(result->GetResult(object.GetAddressOf()), S_OK);
  ComPtr<IDxcBlobEncoding> listing;
  ASSERT_EQ(compiler->Disassemble(object.Get(), listing.GetAddressOf()), S_OK);
  EXPECT_THAT(static_cast<const char*>(listing->GetBufferPointer()), HasSubstr("Main"));
  // A wrong argument is an error of the compilation, not of the call.
  arguments[0] = L"-nonsense";
  ASSERT_EQ(compiler->Compile(blob.Get(), L"colour.hlsl", L"Main", L"ps_6_0", arguments, 1, defines,
                              2, nullptr, result.ReleaseAndGetAddressOf()),
            S_OK);
  EXPECT_EQ(status_of(result.Get()), E_FAIL);
  ASSERT_EQ(result->GetResult(object.ReleaseAndGetAddressOf()), S_OK);
  EXPECT_EQ(object, nullptr);
  ComPtr<IDxcBlobEncoding> errors;
  ASSERT_EQ(result->GetErrorBuffer(errors.GetAddressOf()), S_OK);
  EXPECT_THAT(static_cast<const char*>(errors->GetBufferPointer()), HasSubstr("-nonsense"));
}

TEST(DxcApi, PreprocessIsAnOutputOfItsOwn) {
  const auto result = compile("#define X int\nX a;", {L"-P"});
  ASSERT_EQ(status_of(result.Get()), S_OK) << errors_of(result.Get());
  EXPECT_EQ(result->PrimaryOutput(), DXC_OUT_HLSL);
  ComPtr<IDxcBlobUtf8> text;
  ASSERT_EQ(result->GetOutput(DXC_OUT_HLSL, IID_PPV_ARGS(text.GetAddressOf()), nullptr), S_OK);
  EXPECT_THAT(text->GetStringPointer(), HasSubstr("int a;"));
  EXPECT_FALSE(result->HasOutput(DXC_OUT_OBJECT));
}

TEST(DxcApi, OutputsHaveNamesAndAHash) {
  const auto result = compile("[shader(\"compute\")] [numthreads(1, 1, 1)] void Main() {}",
                              {L"-T", L"lib_6_3", L"-Fo", L"main.cso"});
  ASSERT_EQ(status_of(result.Get()), S_OK);
  ComPtr<IDxcBlob> object, hash;
  ComPtr<IDxcBlobWide> name;
  ASSERT_EQ(
      result->GetOutput(DXC_OUT_OBJECT, IID_PPV_ARGS(object.GetAddressOf()), name.GetAddressOf()),
      S_OK);
  EXPECT_EQ(std::wstring(name->GetStringPointer()), L"main.cso");
  ASSERT_EQ(result->GetOutput(DXC_OUT_SHADER_HASH, IID_PPV_ARGS(hash.GetAddressOf()), nullptr),
            S_OK);
  ASSERT_EQ(hash->GetBufferSize(), sizeof(DxcShaderHash));
  const DxcBuffer shader = {object->GetBufferPointer(), object->GetBufferSize(), 0};
  void* part = nullptr;
  UINT32 size = 0;
  const auto utils = create<IDxcUtils>(CLSID_DxcUtils);
  ASSERT_EQ(utils->GetDxilContainerPart(&shader, DXC_PART_SHADER_HASH, &part, &size), S_OK);
  ASSERT_EQ(size, sizeof(DxcShaderHash));
  EXPECT_EQ(std::memcmp(part, hash->GetBufferPointer(), size), 0);
  EXPECT_EQ(utils->GetDxilContainerPart(&shader, DXC_PART_PDB, &part, &size),
            HRESULT_FROM_WIN32(ERROR_NOT_FOUND));
  UINT32 outputs = 0;
  for (UINT32 i = 0; i < result->GetNumOutputs(); ++i) {
    outputs += result->HasOutput(result->GetOutputByIndex(i)) ? 1 : 0;
  }
  EXPECT_EQ(outputs, result->GetNumOutputs());
}

TEST(DxcApi, DebugInformationIsAFileWithAName) {
  const auto result = compile("[shader(\"compute\")] [numthreads(1, 1, 1)] void Main() {}",
                              {L"-T", L"lib_6_3", L"-Zi", L"-Fd", L"main.pdb"});
  ComPtr<IDxcBlob> pdb;
  ComPtr<IDxcBlobWide> name;
  ASSERT_EQ(result->GetOutput(DXC_OUT_PDB, IID_PPV_ARGS(pdb.GetAddressOf()), name.GetAddressOf()),
            S_OK);
  EXPECT_EQ(std::wstring(name->GetStringPointer()), L"main.pdb");
  const auto unnamed = compile("[shader(\"compute\")] [numthreads(1, 1, 1)] void Main() {}",
                               {L"-T", L"lib_6_3", L"-Zi"});
  ASSERT_EQ(unnamed->GetOutput(DXC_OUT_PDB, IID_PPV_ARGS(pdb.ReleaseAndGetAddressOf()),
                               name.ReleaseAndGetAddressOf()),
            S_OK);
  EXPECT_EQ(std::wstring(name->GetStringPointer()).size(), 32u + 4u);
  const auto plain =
      compile("[shader(\"compute\")] [numthreads(1, 1, 1)] void Main() {}", {L"-T", L"lib_6_3"});
  EXPECT_FALSE(plain->HasOutput(DXC_OUT_PDB));
}

TEST(DxcApi, RootSignatureOfTheEntryPointIsAPart) {
  const auto result = compile("[RootSignature(\"UAV(u0)\")] [numthreads(1, 1, 1)] void Main() {}",
                              {L"-T", L"cs_6_0", L"-E", L"Main"});
  ASSERT_EQ(status_of(result.Get()), S_OK) << errors_of(result.Get());
  ComPtr<IDxcBlob> object, root;
  ASSERT_EQ(result->GetOutput(DXC_OUT_ROOT_SIGNATURE, IID_PPV_ARGS(root.GetAddressOf()), nullptr),
            S_OK);
  result->GetResult(object.GetAddressOf());
  const DxcBuffer shader = {object->GetBufferPointer(), object->GetBufferSize(), 0};
  void* part = nullptr;
  UINT32 size = 0;
  ASSERT_EQ(create<IDxcUtils>(CLSID_DxcUtils)
                ->GetDxilContainerPart(&shader, DXC_PART_ROOT_SIGNATURE, &part, &size),
            S_OK);
  // Version 1.1, one parameter at 24, no sampler; the parameter: an unordered access view.
  const auto* words = static_cast<const uint32_t*>(part);
  ASSERT_EQ(size, 48u);
  EXPECT_THAT(std::vector<uint32_t>(words, words + 4), ElementsAre(2, 1, 24, 0));
  EXPECT_EQ(words[6], uint32_t{D3D12_ROOT_PARAMETER_TYPE_UAV});
  const auto wrong = compile("[RootSignature(\"UAV(x0)\")] [numthreads(1, 1, 1)] void Main() {}",
                             {L"-T", L"cs_6_0", L"-E", L"Main"});
  EXPECT_EQ(status_of(wrong.Get()), E_FAIL);
}

TEST(DxcApi, TextsOfEveryEncodingAreTheSame) {
  const std::wstring wide = L"\u00e4\U0001f600x";
  const std::string utf8 = to_utf8(wide);
  const std::u16string utf16 = u"\u00e4\U0001f600x";
  const std::u16string marked = u"\ufeff\u00e4\U0001f600x";
  const std::string marked8 = "\xEF\xBB\xBF" + utf8;
  struct Case {
    const void* bytes;
    size_t size;
    UINT32 code_page;
  };
  const Case cases[] = {{utf8.data(), utf8.size(), DXC_CP_UTF8},
                        {utf8.c_str(), utf8.size() + 1, DXC_CP_UTF8},
                        {utf8.data(), utf8.size(), DXC_CP_ACP},
                        {marked8.data(), marked8.size(), DXC_CP_ACP},
                        {utf16.data(), utf16.size() * 2, DXC_CP_UTF16},
                        {marked.data(), marked.size() * 2, DXC_CP_ACP},
                        {wide.data(), wide.size() * sizeof(wchar_t), DXC_CP_WIDE}};
  const auto utils = create<IDxcUtils>(CLSID_DxcUtils);
  for (const Case& one : cases) {
    ComPtr<IDxcBlobEncoding> blob;
    ASSERT_EQ(utils->CreateBlob(one.bytes, static_cast<UINT32>(one.size), one.code_page,
                                blob.GetAddressOf()),
              S_OK);
    ComPtr<IDxcBlobUtf8> as_utf8;
    ASSERT_EQ(utils->GetBlobAsUtf8(blob.Get(), as_utf8.GetAddressOf()), S_OK);
    EXPECT_EQ(as_utf8->GetStringPointer(), utf8);
    EXPECT_EQ(as_utf8->GetStringLength(), utf8.size());
    ComPtr<IDxcBlobWide> as_wide;
    ASSERT_EQ(utils->GetBlobAsUtf16(blob.Get(), as_wide.GetAddressOf()), S_OK);
    EXPECT_EQ(as_wide->GetStringPointer(), wide);
    EXPECT_EQ(as_wide->GetBufferSize(), (wide.size() + 1) * sizeof(wchar_t));
  }
}

TEST(DxcApi, BlobsOfBlobsKeepTheOuterOne) {
  const auto utils = create<IDxcUtils>(CLSID_DxcUtils);
  ComPtr<IDxcBlobEncoding> outer;
  ASSERT_EQ(utils->CreateBlob("abcdef", 6, DXC_CP_ACP, outer.GetAddressOf()), S_OK);
  ComPtr<IDxcBlob> inner, outside;
  ASSERT_EQ(utils->CreateBlobFromBlob(outer.Get(), 2, 3, inner.GetAddressOf()), S_OK);
  EXPECT_EQ(utils->CreateBlobFromBlob(outer.Get(), 4, 3, outside.GetAddressOf()), E_FAIL);
  EXPECT_EQ(outside, nullptr);
  EXPECT_EQ(outer.Reset(), 1u);
  EXPECT_EQ(std::memcmp(inner->GetBufferPointer(), "cde", 3), 0);
  // Bytes are no text.
  ComPtr<IDxcBlobUtf8> text;
  EXPECT_EQ(inner->QueryInterface(IID_PPV_ARGS(text.GetAddressOf())), E_NOINTERFACE);
}

TEST(DxcApi, ArgumentsAreBuilt) {
  const DxcDefine defines[] = {{L"A", L"1"}, {L"B", nullptr}};
  LPCWSTR given[] = {L"-Zi"};
  ComPtr<IDxcCompilerArgs> arguments;
  ASSERT_EQ(create<IDxcUtils>(CLSID_DxcUtils)
                ->BuildArguments(L"a.hlsl", L"Main", L"cs_6_0", given, 1, defines, 2,
                                 arguments.GetAddressOf()),
            S_OK);
  LPCSTR more[] = {"-WX"};
  ASSERT_EQ(arguments->AddArgumentsUTF8(more, 1), S_OK);
  std::vector<std::wstring> words(arguments->GetArguments(),
                                  arguments->GetArguments() + arguments->GetCount());
  EXPECT_THAT(words, ElementsAre(L"a.hlsl", L"-E", L"Main", L"-T", L"cs_6_0", L"-Zi", L"-D", L"A=1",
                                 L"-D", L"B", L"-WX"));
}

TEST(DxcApi, ContainersAreTakenApartAndBuilt) {
  const auto result = compile("[numthreads(1, 1, 1)] void main() {}", {L"-T", L"cs_6_0"});
  ComPtr<IDxcBlob> object;
  ASSERT_EQ(result->GetResult(object.GetAddressOf()), S_OK);
  const auto builder = create<IDxcContainerBuilder>(CLSID_DxcContainerBuilder);
  ASSERT_EQ(builder->Load(object.Get()), S_OK);
  EXPECT_EQ(builder->RemovePart(DXC_PART_SHADER_HASH), S_OK);
  EXPECT_EQ(builder->RemovePart(DXC_PART_SHADER_HASH), HRESULT_FROM_WIN32(ERROR_NOT_FOUND));
  ComPtr<IDxcBlobEncoding> secret;
  create<IDxcUtils>(CLSID_DxcUtils)->CreateBlob("secret", 6, 0, secret.GetAddressOf());
  EXPECT_EQ(builder->AddPart(DXC_PART_PRIVATE_DATA, secret.Get()), S_OK);
  EXPECT_EQ(builder->AddPart(DXC_PART_PRIVATE_DATA, secret.Get()), E_FAIL);
  ComPtr<IDxcOperationResult> built;
  ASSERT_EQ(builder->SerializeContainer(built.GetAddressOf()), S_OK);
  ASSERT_EQ(built->GetResult(object.ReleaseAndGetAddressOf()), S_OK);

  const auto reader = create<IDxcContainerReflection>(CLSID_DxcContainerReflection);
  ASSERT_EQ(reader->Load(object.Get()), S_OK);
  UINT32 count = 0, index = 0, kind = 0;
  ASSERT_EQ(reader->GetPartCount(&count), S_OK);
  EXPECT_EQ(count, 2u);
  ASSERT_EQ(reader->FindFirstPartKind(DXC_PART_PRIVATE_DATA, &index), S_OK);
  ASSERT_EQ(reader->GetPartKind(index, &kind), S_OK);
  EXPECT_EQ(kind, DXC_PART_PRIVATE_DATA);
  ComPtr<IDxcBlob> content;
  ASSERT_EQ(reader->GetPartContent(index, content.GetAddressOf()), S_OK);
  EXPECT_EQ(content->GetBufferSize(), 6u);
  EXPECT_EQ(reader->FindFirstPartKind(DXC_PART_PDB, &index), HRESULT_FROM_WIN32(ERROR_NOT_FOUND));
  EXPECT_EQ(reader->GetPartKind(2, &kind), E_BOUNDS);
  EXPECT_NE(reader->Load(secret.Get()), S_OK);

  ComPtr<IDxcOperationResult> valid;
  const auto validator = create<IDxcValidator>(CLSID_DxcValidator);
  ASSERT_EQ(validator->Validate(object.Get(), DxcValidatorFlags_Default, valid.GetAddressOf()),
            S_OK);
  EXPECT_EQ(status_of(valid.Get()), S_OK);
  ASSERT_EQ(
      validator->Validate(secret.Get(), DxcValidatorFlags_Default, valid.ReleaseAndGetAddressOf()),
      S_OK);
  EXPECT_EQ(status_of(valid.Get()), E_FAIL);
}

TEST(DxcApi, ClassesAndBadArguments) {
  ComPtr<IUnknown> object;
  const GUID unknown = {1, 2, 3, {}};
  EXPECT_EQ(DxcCreateInstance(unknown, IID_PPV_ARGS(object.GetAddressOf())), REGDB_E_CLASSNOTREG);
  EXPECT_EQ(DxcCreateInstance(CLSID_DxcCompiler, unknown,
                              reinterpret_cast<void**>(object.GetAddressOf())),
            E_NOINTERFACE);
  EXPECT_EQ(DxcCreateInstance(CLSID_DxcCompiler, IID_IUnknown, nullptr), E_POINTER);
  EXPECT_EQ(DxcCreateInstance2(nullptr, CLSID_DxcLinker, IID_PPV_ARGS(object.GetAddressOf())),
            S_OK);
  const auto compiler = create<IDxcCompiler3>(CLSID_DxcCompiler);
  ComPtr<IDxcResult> result;
  EXPECT_EQ(compiler->Compile(nullptr, nullptr, 0, nullptr, IID_PPV_ARGS(result.GetAddressOf())),
            E_INVALIDARG);
  ComPtr<IDxcVersionInfo> version;
  ASSERT_EQ(compiler.As(&version), S_OK);
  UINT32 major = 0, minor = 0;
  EXPECT_EQ(version->GetVersion(&major, &minor), S_OK);
  EXPECT_EQ(major, 1u);
  // No profile, and one that there is not.
  EXPECT_EQ(status_of(compile("", {}).Get()), E_FAIL);
  EXPECT_EQ(status_of(compile("", {L"-T", L"hs_6_0"}).Get()), E_FAIL);
}

}  // namespace
}  // namespace kaamos::d3d12
