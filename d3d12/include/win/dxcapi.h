// SPDX-License-Identifier: MIT
// The interfaces of dxcompiler: DxcCreateInstance makes them. What they compile, CreateStateObject
// and the pipelines take. [DXC: dxcapi.h]
#pragma once

#include <objbase.h>
#include <objidlbase.h>

#ifndef DXC_API_IMPORT
#define DXC_API_IMPORT
#endif

#define DXC_CP_UTF8 65001
#define DXC_CP_UTF16 1200
#define DXC_CP_UTF32 12000
#define DXC_CP_ACP 0
// wchar_t has 4 bytes here.
#define DXC_CP_WIDE DXC_CP_UTF32

#define DXC_HASHFLAG_INCLUDES_SOURCE 1
typedef struct DxcShaderHash {
  UINT32 Flags;
  BYTE HashDigest[16];
} DxcShaderHash;

#define DXC_FOURCC(a, b, c, d)                                               \
  ((UINT32)(UINT8)(a) | (UINT32)(UINT8)(b) << 8 | (UINT32)(UINT8)(c) << 16 | \
   (UINT32)(UINT8)(d) << 24)
#define DXC_PART_PDB DXC_FOURCC('I', 'L', 'D', 'B')
#define DXC_PART_PDB_NAME DXC_FOURCC('I', 'L', 'D', 'N')
#define DXC_PART_PRIVATE_DATA DXC_FOURCC('P', 'R', 'I', 'V')
#define DXC_PART_ROOT_SIGNATURE DXC_FOURCC('R', 'T', 'S', '0')
#define DXC_PART_DXIL DXC_FOURCC('D', 'X', 'I', 'L')
#define DXC_PART_REFLECTION_DATA DXC_FOURCC('S', 'T', 'A', 'T')
#define DXC_PART_SHADER_HASH DXC_FOURCC('H', 'A', 'S', 'H')
#define DXC_PART_INPUT_SIGNATURE DXC_FOURCC('I', 'S', 'G', '1')
#define DXC_PART_OUTPUT_SIGNATURE DXC_FOURCC('O', 'S', 'G', '1')
#define DXC_PART_PATCH_CONSTANT_SIGNATURE DXC_FOURCC('P', 'S', 'G', '1')

#define DXC_ARG_DEBUG L"-Zi"
#define DXC_ARG_SKIP_VALIDATION L"-Vd"
#define DXC_ARG_SKIP_OPTIMIZATIONS L"-Od"
#define DXC_ARG_PACK_MATRIX_ROW_MAJOR L"-Zpr"
#define DXC_ARG_PACK_MATRIX_COLUMN_MAJOR L"-Zpc"
#define DXC_ARG_AVOID_FLOW_CONTROL L"-Gfa"
#define DXC_ARG_PREFER_FLOW_CONTROL L"-Gfp"
#define DXC_ARG_ENABLE_STRICTNESS L"-Ges"
#define DXC_ARG_ENABLE_BACKWARDS_COMPATIBILITY L"-Gec"
#define DXC_ARG_IEEE_STRICTNESS L"-Gis"
#define DXC_ARG_OPTIMIZATION_LEVEL0 L"-O0"
#define DXC_ARG_OPTIMIZATION_LEVEL1 L"-O1"
#define DXC_ARG_OPTIMIZATION_LEVEL2 L"-O2"
#define DXC_ARG_OPTIMIZATION_LEVEL3 L"-O3"
#define DXC_ARG_WARNINGS_ARE_ERRORS L"-WX"
#define DXC_ARG_RESOURCES_MAY_ALIAS L"-res_may_alias"
#define DXC_ARG_ALL_RESOURCES_BOUND L"-all_resources_bound"
#define DXC_ARG_DEBUG_NAME_FOR_SOURCE L"-Zss"
#define DXC_ARG_DEBUG_NAME_FOR_BINARY L"-Zsb"

// Bytes or text. Encoding 0: bytes, or text whose byte order mark says which; else a DXC_CP.
typedef struct DxcBuffer {
  LPCVOID Ptr;
  SIZE_T Size;
  UINT Encoding;
} DxcText;

struct DxcDefine {
  LPCWSTR Name;
  LPCWSTR Value;
};

struct DxcArgPair {
  const WCHAR* pName;
  const WCHAR* pValue;
};

MIDL_INTERFACE("8BA5FB08-5195-40E2-AC58-0D989C3A0102")
IDxcBlob : public IUnknown {
 public:
  virtual LPVOID STDMETHODCALLTYPE GetBufferPointer() = 0;
  virtual SIZE_T STDMETHODCALLTYPE GetBufferSize() = 0;
};

MIDL_INTERFACE("7241D424-2646-4191-97C0-98E96E42FC68")
IDxcBlobEncoding : public IDxcBlob {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetEncoding(BOOL * pKnown, UINT32 * pCodePage) = 0;
};

// Text with a terminating zero, which GetBufferSize counts and GetStringLength does not.
MIDL_INTERFACE("A3F84EAB-0FAA-497E-A39C-EE6ED60B2D84")
IDxcBlobWide : public IDxcBlobEncoding {
 public:
  virtual LPCWSTR STDMETHODCALLTYPE GetStringPointer() = 0;
  virtual SIZE_T STDMETHODCALLTYPE GetStringLength() = 0;
};
typedef IDxcBlobWide IDxcBlobUtf16;

MIDL_INTERFACE("3DA636C9-BA71-4024-A301-30CBF125305B")
IDxcBlobUtf8 : public IDxcBlobEncoding {
 public:
  virtual LPCSTR STDMETHODCALLTYPE GetStringPointer() = 0;
  virtual SIZE_T STDMETHODCALLTYPE GetStringLength() = 0;
};

MIDL_INTERFACE("7F61FC7D-950D-467F-B3E3-3C02FB49187C")
IDxcIncludeHandler : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE LoadSource(LPCWSTR pFilename, IDxcBlob * *ppIncludeSource) = 0;
};

MIDL_INTERFACE("73EFFE2A-70DC-45F8-9690-EFF64C02429D")
IDxcCompilerArgs : public IUnknown {
 public:
  virtual LPCWSTR* STDMETHODCALLTYPE GetArguments() = 0;
  virtual UINT32 STDMETHODCALLTYPE GetCount() = 0;
  virtual HRESULT STDMETHODCALLTYPE AddArguments(LPCWSTR * pArguments, UINT32 argCount) = 0;
  virtual HRESULT STDMETHODCALLTYPE AddArgumentsUTF8(LPCSTR * pArguments, UINT32 argCount) = 0;
  virtual HRESULT STDMETHODCALLTYPE AddDefines(const DxcDefine* pDefines, UINT32 defineCount) = 0;
};

MIDL_INTERFACE("E5204DC7-D18C-4C3C-BDFB-851673980FE7")
IDxcLibrary : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE SetMalloc(IMalloc * pMalloc) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobFromBlob(IDxcBlob * pBlob, UINT32 offset,
                                                       UINT32 length, IDxcBlob * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobFromFile(LPCWSTR pFileName, UINT32 * codePage,
                                                       IDxcBlobEncoding * *pBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingFromPinned(
      LPCVOID pText, UINT32 size, UINT32 codePage, IDxcBlobEncoding * *pBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingOnHeapCopy(
      LPCVOID pText, UINT32 size, UINT32 codePage, IDxcBlobEncoding * *pBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobWithEncodingOnMalloc(
      LPCVOID pText, IMalloc * pIMalloc, UINT32 size, UINT32 codePage,
      IDxcBlobEncoding * *pBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateIncludeHandler(IDxcIncludeHandler * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateStreamFromBlobReadOnly(IDxcBlob * pBlob,
                                                                 IStream * *ppStream) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBlobAsUtf8(IDxcBlob * pBlob,
                                                  IDxcBlobEncoding * *pBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBlobAsWide(IDxcBlob * pBlob,
                                                  IDxcBlobEncoding * *pBlobEncoding) = 0;
  HRESULT GetBlobAsUtf16(IDxcBlob * pBlob, IDxcBlobEncoding * *pBlobEncoding) {
    return GetBlobAsWide(pBlob, pBlobEncoding);
  }
};

MIDL_INTERFACE("CEDB484A-D4E9-445A-B991-CA21CA157DC2")
IDxcOperationResult : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetStatus(HRESULT * pStatus) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetResult(IDxcBlob * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetErrorBuffer(IDxcBlobEncoding * *ppErrors) = 0;
};

MIDL_INTERFACE("8C210BF3-011F-4422-8D70-6F9ACB8DB617")
IDxcCompiler : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE Compile(
      IDxcBlob * pSource, LPCWSTR pSourceName, LPCWSTR pEntryPoint, LPCWSTR pTargetProfile,
      LPCWSTR * pArguments, UINT32 argCount, const DxcDefine* pDefines, UINT32 defineCount,
      IDxcIncludeHandler* pIncludeHandler, IDxcOperationResult** ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE Preprocess(
      IDxcBlob * pSource, LPCWSTR pSourceName, LPCWSTR * pArguments, UINT32 argCount,
      const DxcDefine* pDefines, UINT32 defineCount, IDxcIncludeHandler* pIncludeHandler,
      IDxcOperationResult** ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE Disassemble(IDxcBlob * pSource,
                                                IDxcBlobEncoding * *ppDisassembly) = 0;
};

MIDL_INTERFACE("A005A9D9-B8BB-4594-B5C9-0E633BEC4D37")
IDxcCompiler2 : public IDxcCompiler {
 public:
  virtual HRESULT STDMETHODCALLTYPE CompileWithDebug(
      IDxcBlob * pSource, LPCWSTR pSourceName, LPCWSTR pEntryPoint, LPCWSTR pTargetProfile,
      LPCWSTR * pArguments, UINT32 argCount, const DxcDefine* pDefines, UINT32 defineCount,
      IDxcIncludeHandler* pIncludeHandler, IDxcOperationResult** ppResult, LPWSTR* ppDebugBlobName,
      IDxcBlob** ppDebugBlob) = 0;
};

MIDL_INTERFACE("F1B5BE2A-62DD-4327-A1C2-42AC1E1E78E6")
IDxcLinker : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE RegisterLibrary(LPCWSTR pLibName, IDxcBlob * pLib) = 0;
  virtual HRESULT STDMETHODCALLTYPE Link(
      LPCWSTR pEntryName, LPCWSTR pTargetProfile, const LPCWSTR* pLibNames, UINT32 libCount,
      const LPCWSTR* pArguments, UINT32 argCount, IDxcOperationResult** ppResult) = 0;
};

MIDL_INTERFACE("4605C4CB-2019-492A-ADA4-65F20BB7D67F")
IDxcUtils : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE CreateBlobFromBlob(IDxcBlob * pBlob, UINT32 offset,
                                                       UINT32 length, IDxcBlob * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlobFromPinned(
      LPCVOID pData, UINT32 size, UINT32 codePage, IDxcBlobEncoding * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE MoveToBlob(LPCVOID pData, IMalloc * pIMalloc, UINT32 size,
                                               UINT32 codePage,
                                               IDxcBlobEncoding * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateBlob(LPCVOID pData, UINT32 size, UINT32 codePage,
                                               IDxcBlobEncoding * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE LoadFile(LPCWSTR pFileName, UINT32 * pCodePage,
                                             IDxcBlobEncoding * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateReadOnlyStreamFromBlob(IDxcBlob * pBlob,
                                                                 IStream * *ppStream) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateDefaultIncludeHandler(IDxcIncludeHandler * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBlobAsUtf8(IDxcBlob * pBlob,
                                                  IDxcBlobUtf8 * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetBlobAsWide(IDxcBlob * pBlob,
                                                  IDxcBlobWide * *ppBlobEncoding) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDxilContainerPart(
      const DxcBuffer* pShader, UINT32 DxcPart, void** ppPartData, UINT32* pPartSizeInBytes) = 0;
  virtual HRESULT STDMETHODCALLTYPE CreateReflection(const DxcBuffer* pData, REFIID iid,
                                                     void** ppvReflection) = 0;
  virtual HRESULT STDMETHODCALLTYPE BuildArguments(
      LPCWSTR pSourceName, LPCWSTR pEntryPoint, LPCWSTR pTargetProfile, LPCWSTR * pArguments,
      UINT32 argCount, const DxcDefine* pDefines, UINT32 defineCount,
      IDxcCompilerArgs** ppArgs) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPDBContents(IDxcBlob * pPDBBlob, IDxcBlob * *ppHash,
                                                   IDxcBlob * *ppContainer) = 0;
  HRESULT GetBlobAsUtf16(IDxcBlob * pBlob, IDxcBlobWide * *ppBlobEncoding) {
    return GetBlobAsWide(pBlob, ppBlobEncoding);
  }
};

typedef enum DXC_OUT_KIND {
  DXC_OUT_NONE = 0,
  DXC_OUT_OBJECT = 1,
  DXC_OUT_ERRORS = 2,
  DXC_OUT_PDB = 3,
  DXC_OUT_SHADER_HASH = 4,
  DXC_OUT_DISASSEMBLY = 5,
  DXC_OUT_HLSL = 6,
  DXC_OUT_TEXT = 7,
  DXC_OUT_REFLECTION = 8,
  DXC_OUT_ROOT_SIGNATURE = 9,
  DXC_OUT_EXTRA_OUTPUTS = 10,
  DXC_OUT_REMARKS = 11,
  DXC_OUT_TIME_REPORT = 12,
  DXC_OUT_TIME_TRACE = 13,
  DXC_OUT_LAST = DXC_OUT_TIME_TRACE,
  DXC_OUT_NUM_ENUMS,
  DXC_OUT_FORCE_DWORD = 0x7FFFFFFF
} DXC_OUT_KIND;

MIDL_INTERFACE("58346CDA-DDE7-4497-9461-6F87AF5E0659")
IDxcResult : public IDxcOperationResult {
 public:
  virtual BOOL STDMETHODCALLTYPE HasOutput(DXC_OUT_KIND dxcOutKind) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetOutput(DXC_OUT_KIND dxcOutKind, REFIID iid, void** ppvObject,
                                              IDxcBlobWide** ppOutputName) = 0;
  virtual UINT32 STDMETHODCALLTYPE GetNumOutputs() = 0;
  virtual DXC_OUT_KIND STDMETHODCALLTYPE GetOutputByIndex(UINT32 Index) = 0;
  virtual DXC_OUT_KIND STDMETHODCALLTYPE PrimaryOutput() = 0;
};

#define DXC_EXTRA_OUTPUT_NAME_STDOUT L"*stdout*"
#define DXC_EXTRA_OUTPUT_NAME_STDERR L"*stderr*"

MIDL_INTERFACE("319B37A2-A5C2-494A-A5DE-4801B2FAF989")
IDxcExtraOutputs : public IUnknown {
 public:
  virtual UINT32 STDMETHODCALLTYPE GetOutputCount() = 0;
  virtual HRESULT STDMETHODCALLTYPE GetOutput(UINT32 uIndex, REFIID iid, void** ppvObject,
                                              IDxcBlobWide** ppOutputType,
                                              IDxcBlobWide** ppOutputName) = 0;
};

MIDL_INTERFACE("228B4687-5A6A-4730-900C-9702B2203F54")
IDxcCompiler3 : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE Compile(const DxcBuffer* pSource, LPCWSTR* pArguments,
                                            UINT32 argCount, IDxcIncludeHandler* pIncludeHandler,
                                            REFIID riid, LPVOID* ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE Disassemble(const DxcBuffer* pObject, REFIID riid,
                                                LPVOID* ppResult) = 0;
};

static const UINT32 DxcValidatorFlags_Default = 0;
static const UINT32 DxcValidatorFlags_InPlaceEdit = 1;
static const UINT32 DxcValidatorFlags_RootSignatureOnly = 2;
static const UINT32 DxcValidatorFlags_ModuleOnly = 4;
static const UINT32 DxcValidatorFlags_ValidMask = 7;

MIDL_INTERFACE("A6E82BD2-1FD7-4826-9811-2857E797F49A")
IDxcValidator : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE Validate(IDxcBlob * pShader, UINT32 Flags,
                                             IDxcOperationResult * *ppResult) = 0;
};

MIDL_INTERFACE("334B1F50-2292-4B35-99A1-25588D8C17FE")
IDxcContainerBuilder : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE Load(IDxcBlob * pDxilContainerHeader) = 0;
  virtual HRESULT STDMETHODCALLTYPE AddPart(UINT32 fourCC, IDxcBlob * pSource) = 0;
  virtual HRESULT STDMETHODCALLTYPE RemovePart(UINT32 fourCC) = 0;
  virtual HRESULT STDMETHODCALLTYPE SerializeContainer(IDxcOperationResult * *ppResult) = 0;
};

MIDL_INTERFACE("091F7A26-1C1F-4948-904B-E6E3A8A771D5")
IDxcAssembler : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE AssembleToContainer(IDxcBlob * pShader,
                                                        IDxcOperationResult * *ppResult) = 0;
};

MIDL_INTERFACE("D2C21B26-8350-4BDC-976A-331CE6F4C54C")
IDxcContainerReflection : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE Load(IDxcBlob * pContainer) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPartCount(UINT32 * pResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPartKind(UINT32 idx, UINT32 * pResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPartContent(UINT32 idx, IDxcBlob * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE FindFirstPartKind(UINT32 kind, UINT32 * pResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetPartReflection(UINT32 idx, REFIID iid, void** ppvObject) = 0;
};

MIDL_INTERFACE("AE2CD79F-CC22-453F-9B6B-B124E7A5204C")
IDxcOptimizerPass : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetOptionName(LPWSTR * ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetDescription(LPWSTR * ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetOptionArgCount(UINT32 * pCount) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetOptionArgName(UINT32 argIndex, LPWSTR * ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetOptionArgDescription(UINT32 argIndex, LPWSTR * ppResult) = 0;
};

MIDL_INTERFACE("25740E2E-9CBA-401B-9119-4FB42F39F270")
IDxcOptimizer : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetAvailablePassCount(UINT32 * pCount) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetAvailablePass(UINT32 index,
                                                     IDxcOptimizerPass * *ppResult) = 0;
  virtual HRESULT STDMETHODCALLTYPE RunOptimizer(IDxcBlob * pBlob, LPCWSTR * ppOptions,
                                                 UINT32 optionCount, IDxcBlob * *pOutputModule,
                                                 IDxcBlobEncoding * *ppOutputText) = 0;
};

static const UINT32 DxcVersionInfoFlags_None = 0;
static const UINT32 DxcVersionInfoFlags_Debug = 1;
static const UINT32 DxcVersionInfoFlags_Internal = 2;

MIDL_INTERFACE("B04F5B50-2059-4F12-A8FF-A1E0CDE1CC7E")
IDxcVersionInfo : public IUnknown {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetVersion(UINT32 * pMajor, UINT32 * pMinor) = 0;
  virtual HRESULT STDMETHODCALLTYPE GetFlags(UINT32 * pFlags) = 0;
};

MIDL_INTERFACE("FB6904C4-42F0-4B62-9C46-983AF7DA7C83")
IDxcVersionInfo2 : public IDxcVersionInfo {
 public:
  virtual HRESULT STDMETHODCALLTYPE GetCommitInfo(UINT32 * pCommitCount, char** pCommitHash) = 0;
};

EXTERN_C const IID IID_IDxcBlob;
EXTERN_C const IID IID_IDxcBlobEncoding;
EXTERN_C const IID IID_IDxcBlobWide;
EXTERN_C const IID IID_IDxcBlobUtf8;
EXTERN_C const IID IID_IDxcIncludeHandler;
EXTERN_C const IID IID_IDxcCompilerArgs;
EXTERN_C const IID IID_IDxcLibrary;
EXTERN_C const IID IID_IDxcOperationResult;
EXTERN_C const IID IID_IDxcCompiler;
EXTERN_C const IID IID_IDxcCompiler2;
EXTERN_C const IID IID_IDxcLinker;
EXTERN_C const IID IID_IDxcUtils;
EXTERN_C const IID IID_IDxcResult;
EXTERN_C const IID IID_IDxcExtraOutputs;
EXTERN_C const IID IID_IDxcCompiler3;
EXTERN_C const IID IID_IDxcValidator;
EXTERN_C const IID IID_IDxcContainerBuilder;
EXTERN_C const IID IID_IDxcAssembler;
EXTERN_C const IID IID_IDxcContainerReflection;
EXTERN_C const IID IID_IDxcOptimizerPass;
EXTERN_C const IID IID_IDxcOptimizer;
EXTERN_C const IID IID_IDxcVersionInfo;
EXTERN_C const IID IID_IDxcVersionInfo2;
#ifdef __CRT_UUID_DECL
__CRT_UUID_DECL(IDxcBlob, 0x8BA5FB08, 0x5195, 0x40E2, 0xAC, 0x58, 0x0D, 0x98, 0x9C, 0x3A, 0x01,
                0x02)
__CRT_UUID_DECL(IDxcBlobEncoding, 0x7241D424, 0x2646, 0x4191, 0x97, 0xC0, 0x98, 0xE9, 0x6E, 0x42,
                0xFC, 0x68)
__CRT_UUID_DECL(IDxcBlobWide, 0xA3F84EAB, 0x0FAA, 0x497E, 0xA3, 0x9C, 0xEE, 0x6E, 0xD6, 0x0B, 0x2D,
                0x84)
__CRT_UUID_DECL(IDxcBlobUtf8, 0x3DA636C9, 0xBA71, 0x4024, 0xA3, 0x01, 0x30, 0xCB, 0xF1, 0x25, 0x30,
                0x5B)
__CRT_UUID_DECL(IDxcIncludeHandler, 0x7F61FC7D, 0x950D, 0x467F, 0xB3, 0xE3, 0x3C, 0x02, 0xFB, 0x49,
                0x18, 0x7C)
__CRT_UUID_DECL(IDxcCompilerArgs, 0x73EFFE2A, 0x70DC, 0x45F8, 0x96, 0x90, 0xEF, 0xF6, 0x4C, 0x02,
                0x42, 0x9D)
__CRT_UUID_DECL(IDxcLibrary, 0xE5204DC7, 0xD18C, 0x4C3C, 0xBD, 0xFB, 0x85, 0x16, 0x73, 0x98, 0x0F,
                0xE7)
__CRT_UUID_DECL(IDxcOperationResult, 0xCEDB484A, 0xD4E9, 0x445A, 0xB9, 0x91, 0xCA, 0x21, 0xCA, 0x15,
                0x7D, 0xC2)
__CRT_UUID_DECL(IDxcCompiler, 0x8C210BF3, 0x011F, 0x4422, 0x8D, 0x70, 0x6F, 0x9A, 0xCB, 0x8D, 0xB6,
                0x17)
__CRT_UUID_DECL(IDxcCompiler2, 0xA005A9D9, 0xB8BB, 0x4594, 0xB5, 0xC9, 0x0E, 0x63, 0x3B, 0xEC, 0x4D,
                0x37)
__CRT_UUID_DECL(IDxcLinker, 0xF1B5BE2A, 0x62DD, 0x4327, 0xA1, 0xC2, 0x42, 0xAC, 0x1E, 0x1E, 0x78,
                0xE6)
__CRT_UUID_DECL(IDxcUtils, 0x4605C4CB, 0x2019, 0x492A, 0xAD, 0xA4, 0x65, 0xF2, 0x0B, 0xB7, 0xD6,
                0x7F)
__CRT_UUID_DECL(IDxcResult, 0x58346CDA, 0xDDE7, 0x4497, 0x94, 0x61, 0x6F, 0x87, 0xAF, 0x5E, 0x06,
                0x59)
__CRT_UUID_DECL(IDxcExtraOutputs, 0x319B37A2, 0xA5C2, 0x494A, 0xA5, 0xDE, 0x48, 0x01, 0xB2, 0xFA,
                0xF9, 0x89)
__CRT_UUID_DECL(IDxcCompiler3, 0x228B4687, 0x5A6A, 0x4730, 0x90, 0x0C, 0x97, 0x02, 0xB2, 0x20, 0x3F,
                0x54)
__CRT_UUID_DECL(IDxcValidator, 0xA6E82BD2, 0x1FD7, 0x4826, 0x98, 0x11, 0x28, 0x57, 0xE7, 0x97, 0xF4,
                0x9A)
__CRT_UUID_DECL(IDxcContainerBuilder, 0x334B1F50, 0x2292, 0x4B35, 0x99, 0xA1, 0x25, 0x58, 0x8D,
                0x8C, 0x17, 0xFE)
__CRT_UUID_DECL(IDxcAssembler, 0x091F7A26, 0x1C1F, 0x4948, 0x90, 0x4B, 0xE6, 0xE3, 0xA8, 0xA7, 0x71,
                0xD5)
__CRT_UUID_DECL(IDxcContainerReflection, 0xD2C21B26, 0x8350, 0x4BDC, 0x97, 0x6A, 0x33, 0x1C, 0xE6,
                0xF4, 0xC5, 0x4C)
__CRT_UUID_DECL(IDxcOptimizerPass, 0xAE2CD79F, 0xCC22, 0x453F, 0x9B, 0x6B, 0xB1, 0x24, 0xE7, 0xA5,
                0x20, 0x4C)
__CRT_UUID_DECL(IDxcOptimizer, 0x25740E2E, 0x9CBA, 0x401B, 0x91, 0x19, 0x4F, 0xB4, 0x2F, 0x39, 0xF2,
                0x70)
__CRT_UUID_DECL(IDxcVersionInfo, 0xB04F5B50, 0x2059, 0x4F12, 0xA8, 0xFF, 0xA1, 0xE0, 0xCD, 0xE1,
                0xCC, 0x7E)
__CRT_UUID_DECL(IDxcVersionInfo2, 0xFB6904C4, 0x42F0, 0x4B62, 0x9C, 0x46, 0x98, 0x3A, 0xF7, 0xDA,
                0x7C, 0x83)
#endif

// The classes that DxcCreateInstance makes. Each is the same object in every file of a program.
inline constexpr CLSID CLSID_DxcCompiler = {
    0x73E22D93, 0xE6CE, 0x47F3, {0xB5, 0xBF, 0xF0, 0x66, 0x4F, 0x39, 0xC1, 0xB0}};
inline constexpr CLSID CLSID_DxcLinker = {
    0xEF6A8087, 0xB0EA, 0x4D56, {0x9E, 0x45, 0xD0, 0x7E, 0x1A, 0x8B, 0x78, 0x06}};
inline constexpr CLSID CLSID_DxcDiaDataSource = {
    0xCD1F6B73, 0x2AB0, 0x484D, {0x8E, 0xDC, 0xEB, 0xE7, 0xA4, 0x3C, 0xA0, 0x9F}};
inline constexpr CLSID CLSID_DxcCompilerArgs = {
    0x3E56AE82, 0x224D, 0x470F, {0xA1, 0xA1, 0xFE, 0x30, 0x16, 0xEE, 0x9F, 0x9D}};
inline constexpr CLSID CLSID_DxcLibrary = {
    0x6245D6AF, 0x66E0, 0x48FD, {0x80, 0xB4, 0x4D, 0x27, 0x17, 0x96, 0x74, 0x8C}};
inline constexpr CLSID CLSID_DxcUtils = {
    0x6245D6AF, 0x66E0, 0x48FD, {0x80, 0xB4, 0x4D, 0x27, 0x17, 0x96, 0x74, 0x8C}};
inline constexpr CLSID CLSID_DxcValidator = {
    0x8CA3E215, 0xF728, 0x4CF3, {0x8C, 0xDD, 0x88, 0xAF, 0x91, 0x75, 0x87, 0xA1}};
inline constexpr CLSID CLSID_DxcAssembler = {
    0xD728DB68, 0xF903, 0x4F80, {0x94, 0xCD, 0xDC, 0xCF, 0x76, 0xEC, 0x71, 0x51}};
inline constexpr CLSID CLSID_DxcContainerReflection = {
    0xB9F54489, 0x55B8, 0x400C, {0xBA, 0x3A, 0x16, 0x75, 0xE4, 0x72, 0x8B, 0x91}};
inline constexpr CLSID CLSID_DxcOptimizer = {
    0xAE2CD79F, 0xCC22, 0x453F, {0x9B, 0x6B, 0xB1, 0x24, 0xE7, 0xA5, 0x20, 0x4C}};
inline constexpr CLSID CLSID_DxcContainerBuilder = {
    0x94134294, 0x411F, 0x4574, {0xB4, 0xD0, 0x87, 0x41, 0xE2, 0x52, 0x40, 0xD2}};
inline constexpr CLSID CLSID_DxcPdbUtils = {
    0x54621DFB, 0xF2CE, 0x457E, {0xAE, 0x8C, 0xEC, 0x35, 0x5F, 0xAE, 0xEC, 0x7C}};

typedef HRESULT (*DxcCreateInstanceProc)(REFCLSID rclsid, REFIID riid, LPVOID* ppv);
typedef HRESULT (*DxcCreateInstance2Proc)(IMalloc* pMalloc, REFCLSID rclsid, REFIID riid,
                                          LPVOID* ppv);
STDAPI DxcCreateInstance(REFCLSID rclsid, REFIID riid, LPVOID* ppv);
STDAPI DxcCreateInstance2(IMalloc* pMalloc, REFCLSID rclsid, REFIID riid, LPVOID* ppv);
