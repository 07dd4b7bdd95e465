// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_compiler.h"

#include <fstream>
#include <iterator>

#include "d3d12/com/report.h"
#include "d3d12/com/text.h"
#include "d3d12/compiler/compile.h"
#include "d3d12/compiler/dxc_blob.h"
#include "d3d12/compiler/dxc_result.h"
#include "d3d12/compiler/dxc_text.h"
#include "d3d12/container/shader_source.h"

namespace kaamos::d3d12 {

namespace {

using Microsoft::WRL::ComPtr;

// As in DXC, a handler is asked for "./a.hlsli", not "a.hlsli".
std::wstring handler_path(const std::string& path) {
  const bool is_plain =
      !path.starts_with('/') && !path.starts_with("./") && !path.starts_with("../");
  return to_wide(is_plain ? "./" + path : path);
}

void set_includes(rtapi::ShaderCompileOptions& options, IDxcIncludeHandler* includes) {
  ComPtr<IUnknown> own;  // no dynamic_cast: the program may be compiled without RTTI
  if (includes != nullptr &&
      SUCCEEDED(includes->QueryInterface(kDefaultIncludeHandler,
                                         reinterpret_cast<void**>(own.GetAddressOf())))) {
    return;
  }
  options.ReadFile = [includes](const std::string& path) -> std::optional<std::string> {
    if (includes == nullptr) return std::nullopt;
    ComPtr<IDxcBlob> source;
    const HRESULT result = includes->LoadSource(handler_path(path).c_str(), source.GetAddressOf());
    if (FAILED(result) || !source) return std::nullopt;
    return text_of_blob(source.Get());
  };
}

// A failed compilation has messages and no object.
DxcResult* failed_result(const std::string& messages) {
  auto* result = new DxcResult(E_FAIL, DXC_OUT_OBJECT);
  result->add_messages(messages);
  return result;
}

IUnknown* bytes_blob(const void* bytes, size_t size) {
  return static_cast<IDxcBlobUtf8*>(new DxcBlob(bytes, size, std::nullopt));
}

std::string hash_text(const ShaderHash& hash) {
  std::string out;
  for (const uint32_t word : hash.digest) {
    char digits[9];
    std::snprintf(digits, sizeof(digits), "%08x", word);
    out += digits;
  }
  return out;
}

DxcResult* result_of(const DxcArguments& arguments, const CompiledSource& compiled) {
  if (!compiled.ok) return failed_result(compiled.messages);
  auto* result = new DxcResult(S_OK, DXC_OUT_OBJECT);
  const auto& container = compiled.container;
  result->add(DXC_OUT_OBJECT, bytes_blob(container.data(), container.size()),
              to_wide(arguments.object));
  result->add_messages(compiled.messages);
  result->add(DXC_OUT_SHADER_HASH, bytes_blob(&compiled.hash, sizeof(compiled.hash)),
              to_wide(arguments.hash));
  // IDxcUtils::CreateReflection makes it of the container.
  result->add(DXC_OUT_REFLECTION, bytes_blob(container.data(), container.size()));
  // The container holds the sources: it is its own debug file.
  if (arguments.debug_info) {
    result->add(DXC_OUT_PDB, bytes_blob(container.data(), container.size()),
                to_wide(arguments.debug_file.empty() ? hash_text(compiled.hash) + ".pdb"
                                                     : arguments.debug_file));
  }
  if (!compiled.root_signature.empty()) {
    result->add(DXC_OUT_ROOT_SIGNATURE,
                bytes_blob(compiled.root_signature.data(), compiled.root_signature.size()));
  }
  return result;
}

DxcResult* preprocessed_result(const DxcArguments& arguments) {
  const PreprocessedSource text = preprocess_source(arguments);
  if (!text.ok) return failed_result(text.messages);
  auto* result = new DxcResult(S_OK, DXC_OUT_HLSL);
  result->add(DXC_OUT_HLSL, static_cast<IDxcBlobUtf8*>(new DxcBlob(text.text)),
              to_wide(arguments.preprocessed));
  result->add_messages(text.messages);
  return result;
}

// Compiles or, with -P, preprocesses.
// `name`: of the source; none: it is among the words.
DxcResult* run(const std::vector<std::string>& words, LPCWSTR name, std::string source,
               IDxcIncludeHandler* includes) {
  auto parsed = parse_dxc_arguments(words);
  if (!parsed) return failed_result(parsed.error().message + "\n");
  if (name != nullptr && *name != L'\0') parsed->options.File = to_path(name);
  if (parsed->options.File.empty()) parsed->options.File = "hlsl.hlsl";
  if (parsed->options.Target.empty() && !parsed->preprocess) {
    return failed_result(
        make_error(ErrorId::kCompiler, "no profile given: pass -T, such as -T lib_6_3.").message +
        "\n");
  }
  parsed->options.Source = std::move(source);
  set_includes(parsed->options, includes);
  if (parsed->preprocess) return preprocessed_result(*parsed);
  return result_of(*parsed, compile_source(*parsed));
}

std::vector<std::string> words_of(LPCWSTR* arguments, UINT32 count) {
  std::vector<std::string> words;
  for (UINT32 i = 0; arguments != nullptr && i < count; ++i) words.push_back(to_utf8(arguments[i]));
  return words;
}

void add_defines(std::vector<std::string>& words, const DxcDefine* defines, UINT32 count) {
  for (UINT32 i = 0; defines != nullptr && i < count; ++i) {
    words.push_back("-D");
    words.push_back(to_utf8(defines[i].Name) +
                    (defines[i].Value != nullptr ? "=" + to_utf8(defines[i].Value) : ""));
  }
}

}  // namespace

HRESULT DxcCompiler::Compile(IDxcBlob* source, LPCWSTR name, LPCWSTR entry, LPCWSTR profile,
                             LPCWSTR* arguments, UINT32 argument_count, const DxcDefine* defines,
                             UINT32 define_count, IDxcIncludeHandler* includes,
                             IDxcOperationResult** result) {
  if (source == nullptr || profile == nullptr || result == nullptr) {
    return fail(ErrorId::kNullPointer,
                "IDxcCompiler::Compile: pSource, pTargetProfile or ppResult is null.");
  }
  std::vector<std::string> words = words_of(arguments, argument_count);
  words.insert(words.end(), {"-T", to_utf8(profile)});
  if (entry != nullptr && *entry != L'\0') words.insert(words.end(), {"-E", to_utf8(entry)});
  add_defines(words, defines, define_count);
  *result = run(words, name, text_of_blob(source), includes);
  return S_OK;
}

HRESULT DxcCompiler::CompileWithDebug(IDxcBlob* source, LPCWSTR name, LPCWSTR entry,
                                      LPCWSTR profile, LPCWSTR* arguments, UINT32 argument_count,
                                      const DxcDefine* defines, UINT32 define_count,
                                      IDxcIncludeHandler* includes, IDxcOperationResult** result,
                                      LPWSTR* debug_name, IDxcBlob** debug) {
  // There is no debug file: the container holds the sources.
  if (debug_name != nullptr) *debug_name = nullptr;
  if (debug != nullptr) *debug = nullptr;
  return Compile(source, name, entry, profile, arguments, argument_count, defines, define_count,
                 includes, result);
}

HRESULT DxcCompiler::Preprocess(IDxcBlob* source, LPCWSTR name, LPCWSTR* arguments,
                                UINT32 argument_count, const DxcDefine* defines,
                                UINT32 define_count, IDxcIncludeHandler* includes,
                                IDxcOperationResult** result) {
  if (source == nullptr || result == nullptr) {
    return fail(ErrorId::kNullPointer, "IDxcCompiler::Preprocess: pSource or ppResult is null.");
  }
  std::vector<std::string> words = words_of(arguments, argument_count);
  words.emplace_back("-P");
  add_defines(words, defines, define_count);
  *result = run(words, name, text_of_blob(source), includes);
  return S_OK;
}

HRESULT DxcCompiler::Compile(const DxcBuffer* source, LPCWSTR* arguments, UINT32 argument_count,
                             IDxcIncludeHandler* includes, REFIID riid, LPVOID* result) {
  if (source == nullptr || source->Ptr == nullptr || result == nullptr) {
    return fail(ErrorId::kNullPointer, "IDxcCompiler3::Compile: pSource or ppResult is null.");
  }
  return hand_out(run(words_of(arguments, argument_count), nullptr,
                      decode_text(source->Ptr, source->Size, source->Encoding), includes),
                  riid, result);
}

namespace {

rtapi::Result<std::string> disassemble(const void* bytes, size_t size) {
  auto source = source_of_container(bytes, size);
  if (!source) return source.error();
  rtapi::ShaderCompileOptions options = compile_options(*std::move(source));
  options.CheckOnly = true;
  const auto compiled = rtapi::CompileShaderLibrary(options);
  if (!compiled.Status.ok()) return compiled.Status.error();
  return list_reflection(compiled.Reflection, options.Target);
}

}  // namespace

HRESULT DxcCompiler::Disassemble(IDxcBlob* source, IDxcBlobEncoding** text) {
  if (source == nullptr || text == nullptr) {
    return fail(ErrorId::kNullPointer, "IDxcCompiler::Disassemble: a pointer is null.");
  }
  const auto listing = disassemble(source->GetBufferPointer(), source->GetBufferSize());
  if (!listing) return fail(listing.error());
  *text = new DxcBlob(*listing);
  return S_OK;
}

HRESULT DxcCompiler::Disassemble(const DxcBuffer* object, REFIID riid, LPVOID* result) {
  if (object == nullptr || result == nullptr) {
    return fail(ErrorId::kNullPointer, "IDxcCompiler3::Disassemble: a pointer is null.");
  }
  const auto listing = disassemble(object->Ptr, object->Size);
  auto* made = new DxcResult(listing ? S_OK : E_FAIL, DXC_OUT_DISASSEMBLY);
  if (listing) {
    made->add(DXC_OUT_DISASSEMBLY, static_cast<IDxcBlobUtf8*>(new DxcBlob(*listing)));
  }
  made->add_messages(listing ? "" : listing.error().message + "\n");
  return hand_out(made, riid, result);
}

// That of the DXC whose interfaces and options these are.
HRESULT DxcCompiler::GetVersion(UINT32* major, UINT32* minor) {
  if (major == nullptr || minor == nullptr) return E_POINTER;
  *major = 1;
  *minor = 8;
  return S_OK;
}

HRESULT DxcCompiler::GetFlags(UINT32* flags) {
  if (flags == nullptr) return E_POINTER;
  *flags = DxcVersionInfoFlags_None;
  return S_OK;
}

HRESULT DxcDefaultIncludeHandler::LoadSource(LPCWSTR name, IDxcBlob** source) {
  if (name == nullptr || source == nullptr) return E_POINTER;
  *source = nullptr;
  IDxcBlobEncoding* blob = nullptr;
  const HRESULT result = load_file(name, nullptr, &blob);
  *source = blob;
  return result;
}

HRESULT load_file(LPCWSTR name, const UINT32* code_page, IDxcBlobEncoding** blob) {
  if (name == nullptr || blob == nullptr) return E_POINTER;
  *blob = nullptr;
  const auto bytes = read_file(to_path(name));
  if (!bytes) return HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND);
  *blob = new DxcBlob(bytes->data(), bytes->size(),
                      code_page != nullptr ? *code_page : UINT32{DXC_CP_ACP});
  return S_OK;
}

}  // namespace kaamos::d3d12
