// SPDX-License-Identifier: MIT
//
// D3DCompile and its relatives, over the same compiler as dxcompiler's.
#include <d3dcompiler.h>

#include <cstring>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "d3d12/com/blob.h"
#include "d3d12/com/report.h"
#include "d3d12/com/text.h"
#include "d3d12/compiler/compile.h"
#include "d3d12/compiler/reflection.h"
#include "runtime/files/write_file.h"

namespace kaamos::d3d12 {

namespace {

struct FlagArgument {
  UINT flag;
  const char* word;
};
constexpr FlagArgument kFlagArguments[] = {{D3DCOMPILE_DEBUG, "-Zi"},
                                           {D3DCOMPILE_SKIP_OPTIMIZATION, "-Od"},
                                           {D3DCOMPILE_PACK_MATRIX_ROW_MAJOR, "-Zpr"},
                                           {D3DCOMPILE_OPTIMIZATION_LEVEL3, "-O3"},
                                           {D3DCOMPILE_WARNINGS_ARE_ERRORS, "-WX"}};

// Asks a handler for what was written in `#include`: the path from the source's folder, or, in a
// file of another folder, the name.
class HandlerFiles {
 public:
  HandlerFiles(ID3DInclude* handler, const std::string& source)
      : handler_(handler), folder_(std::filesystem::path(source).parent_path()) {}

  std::optional<std::string> read(const std::string& path) const {
    const std::filesystem::path whole(path);
    const auto relative = folder_.empty() ? whole : whole.lexically_relative(folder_);
    auto text = open(relative.generic_string());
    return text ? text : open(whole.filename().generic_string());
  }

 private:
  std::optional<std::string> open(const std::string& name) const {
    LPCVOID data = nullptr;
    UINT size = 0;
    const HRESULT result = handler_->Open(D3D_INCLUDE_LOCAL, name.c_str(), nullptr, &data, &size);
    if (FAILED(result)) return std::nullopt;
    std::string text(static_cast<const char*>(data), size);
    handler_->Close(data);
    return text;
  }

  ID3DInclude* handler_;
  std::filesystem::path folder_;
};

void set_includes(rtapi::ShaderCompileOptions& options, ID3DInclude* includes) {
  if (includes == D3D_COMPILE_STANDARD_FILE_INCLUDE) return;
  if (includes == nullptr) {
    options.ReadFile = [](const std::string&) { return std::nullopt; };
    return;
  }
  options.ReadFile = [files = HandlerFiles(includes, options.File)](const std::string& path) {
    return files.read(path);
  };
}

void add_defines(rtapi::ShaderCompileOptions& options, const D3D_SHADER_MACRO* defines) {
  for (; defines != nullptr && defines->Name != nullptr; ++defines) {
    options.Defines.push_back(
        {defines->Name, defines->Definition != nullptr ? defines->Definition : ""});
  }
}

// The language is that of these profiles: functions without a prototype's strictness of 2021.
DxcArguments arguments_of(const char* name, std::string source, const D3D_SHADER_MACRO* defines,
                          ID3DInclude* includes) {
  DxcArguments out;
  out.options.File = name != nullptr && *name != '\0' ? to_path(name) : "Shader@0";
  out.options.Source = std::move(source);
  out.options.HlslVersion = "2018";
  add_defines(out.options, defines);
  set_includes(out.options, includes);
  return out;
}

HRESULT hand_out_text(const std::string& text, ID3DBlob** out) {
  if (out != nullptr) *out = text.empty() ? nullptr : new Blob(std::string_view(text));
  return S_OK;
}

HRESULT compile(std::string source, const char* name, const D3D_SHADER_MACRO* defines,
                ID3DInclude* includes, const char* entry, const char* target, UINT flags,
                ID3DBlob** code, ID3DBlob** errors) {
  if (code != nullptr) *code = nullptr;
  if (errors != nullptr) *errors = nullptr;
  if (target == nullptr || code == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer, "D3DCompile: pTarget or ppCode is null.");
  }
  std::vector<std::string> words = {"-T", target};
  if (entry != nullptr && *entry != '\0') words.insert(words.end(), {"-E", entry});
  for (const FlagArgument& one : kFlagArguments) {
    if ((flags & one.flag) != 0) words.emplace_back(one.word);
  }
  const auto parsed = parse_dxc_arguments(words);
  if (!parsed) return process_reporter().fail(parsed.error());
  DxcArguments arguments = arguments_of(name, std::move(source), defines, includes);
  arguments.options.Target = parsed->options.Target;
  arguments.options.EntryPoint = parsed->options.EntryPoint;
  arguments.options.RowMajorMatrices = parsed->options.RowMajorMatrices;
  // As FXC does for the models before 5.1.
  arguments.options.ReserveUnusedRegisters = !std::string_view(target).ends_with("_5_1");
  arguments.options.Debug = parsed->options.Debug;
  arguments.absolute_paths = parsed->absolute_paths;
  arguments.warnings_as_errors = parsed->warnings_as_errors;
  CompiledSource compiled = compile_source(arguments);
  hand_out_text(compiled.messages, errors);
  if (!compiled.ok) return E_FAIL;
  *code = new Blob(std::move(compiled.container));
  return S_OK;
}

std::string source_text(LPCVOID data, SIZE_T size) {
  std::string out(static_cast<const char*>(data), size);
  while (!out.empty() && out.back() == '\0') out.pop_back();
  return out;
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;

STDAPI D3DCompile(LPCVOID pSrcData, SIZE_T SrcDataSize, LPCSTR pSourceName,
                  const D3D_SHADER_MACRO* pDefines, ID3DInclude* pInclude, LPCSTR pEntrypoint,
                  LPCSTR pTarget, UINT Flags1, UINT, ID3DBlob** ppCode, ID3DBlob** ppErrorMsgs) {
  if (pSrcData == nullptr)
    return process_reporter().fail(ErrorId::kNullPointer, "D3DCompile: pSrcData is null.");
  return compile(source_text(pSrcData, SrcDataSize), pSourceName, pDefines, pInclude, pEntrypoint,
                 pTarget, Flags1, ppCode, ppErrorMsgs);
}

STDAPI D3DCompile2(LPCVOID pSrcData, SIZE_T SrcDataSize, LPCSTR pSourceName,
                   const D3D_SHADER_MACRO* pDefines, ID3DInclude* pInclude, LPCSTR pEntrypoint,
                   LPCSTR pTarget, UINT Flags1, UINT Flags2, UINT, LPCVOID, SIZE_T,
                   ID3DBlob** ppCode, ID3DBlob** ppErrorMsgs) {
  return D3DCompile(pSrcData, SrcDataSize, pSourceName, pDefines, pInclude, pEntrypoint, pTarget,
                    Flags1, Flags2, ppCode, ppErrorMsgs);
}

STDAPI D3DCompileFromFile(LPCWSTR pFileName, const D3D_SHADER_MACRO* pDefines,
                          ID3DInclude* pInclude, LPCSTR pEntrypoint, LPCSTR pTarget, UINT Flags1,
                          UINT, ID3DBlob** ppCode, ID3DBlob** ppErrorMsgs) {
  if (pFileName == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer, "D3DCompileFromFile: pFileName is null.");
  }
  const std::string path = to_path(pFileName);
  const auto source = read_file(path);
  if (!source) return HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND);
  return compile(source_text(source->data(), source->size()), path.c_str(), pDefines, pInclude,
                 pEntrypoint, pTarget, Flags1, ppCode, ppErrorMsgs);
}

STDAPI D3DPreprocess(LPCVOID pSrcData, SIZE_T SrcDataSize, LPCSTR pSourceName,
                     const D3D_SHADER_MACRO* pDefines, ID3DInclude* pInclude, ID3DBlob** ppCodeText,
                     ID3DBlob** ppErrorMsgs) {
  if (pSrcData == nullptr || ppCodeText == nullptr) {
    return process_reporter().fail(ErrorId::kNullPointer,
                                   "D3DPreprocess: pSrcData or ppCodeText is null.");
  }
  *ppCodeText = nullptr;
  const PreprocessedSource text = preprocess_source(
      arguments_of(pSourceName, source_text(pSrcData, SrcDataSize), pDefines, pInclude));
  hand_out_text(text.messages, ppErrorMsgs);
  if (!text.ok) return E_FAIL;
  *ppCodeText = new Blob(std::string_view(text.text));
  return S_OK;
}

STDAPI D3DReflect(LPCVOID pSrcData, SIZE_T SrcDataSize, REFIID pInterface, void** ppReflector) {
  return create_reflection(pSrcData, SrcDataSize, pInterface, ppReflector);
}

STDAPI D3DReflectLibrary(LPCVOID pSrcData, SIZE_T SrcDataSize, REFIID pInterface,
                         void** ppReflector) {
  return create_reflection(pSrcData, SrcDataSize, pInterface, ppReflector);
}

STDAPI D3DGetBlobPart(LPCVOID pSrcData, SIZE_T SrcDataSize, D3D_BLOB_PART Part, UINT,
                      ID3DBlob** ppPart) {
  if (ppPart == nullptr) return E_POINTER;
  *ppPart = nullptr;
  const auto parts = read_container(pSrcData, SrcDataSize);
  if (!parts) return process_reporter().fail(parts.error());
  for (const kaamos::d3d12::Part& part : *parts) {
    if (Part != D3D_BLOB_ROOT_SIGNATURE || part.fourcc != fourcc("RTS0")) continue;
    *ppPart = new Blob(write_container({&part, 1}));
    return S_OK;
  }
  return E_FAIL;
}

STDAPI D3DCreateBlob(SIZE_T Size, ID3DBlob** ppBlob) {
  if (ppBlob == nullptr) return E_POINTER;
  *ppBlob = new Blob(std::vector<std::byte>(Size));
  return S_OK;
}

STDAPI D3DReadFileToBlob(LPCWSTR pFileName, ID3DBlob** ppContents) {
  if (pFileName == nullptr || ppContents == nullptr) return E_POINTER;
  *ppContents = nullptr;
  const auto text = read_file(to_path(pFileName));
  if (!text) return HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND);
  std::vector<std::byte> bytes(text->size());
  if (!bytes.empty()) std::memcpy(bytes.data(), text->data(), bytes.size());
  *ppContents = new Blob(std::move(bytes));
  return S_OK;
}

STDAPI D3DWriteBlobToFile(ID3DBlob* pBlob, LPCWSTR pFileName, BOOL bOverwrite) {
  if (pBlob == nullptr || pFileName == nullptr) return E_POINTER;
  const std::string path = to_path(pFileName);
  std::error_code ignored;
  if (bOverwrite == FALSE && std::filesystem::exists(path, ignored)) {
    return HRESULT_FROM_WIN32(ERROR_FILE_EXISTS);
  }
  const int error = kaamos::files::write_file(
      path, {static_cast<const char*>(pBlob->GetBufferPointer()), pBlob->GetBufferSize()});
  return error == 0 ? S_OK : HRESULT_FROM_WIN32(ERROR_ACCESS_DENIED);
}
