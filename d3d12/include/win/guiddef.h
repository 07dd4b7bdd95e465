// SPDX-License-Identifier: MIT
// GUIDs, and __uuidof for compilers without it.
#pragma once

#include <minwindef.h>
#include <string.h>

typedef struct _GUID {
  uint32_t Data1;
  uint16_t Data2;
  uint16_t Data3;
  uint8_t Data4[8];
} GUID;
typedef GUID IID, UUID, CLSID, FMTID;
typedef GUID* LPGUID;

#ifdef INITGUID
#define DEFINE_GUID(name, l, w1, w2, b1, b2, b3, b4, b5, b6, b7, b8) \
  EXTERN_C const GUID DECLSPEC_SELECTANY name = {l, w1, w2, {b1, b2, b3, b4, b5, b6, b7, b8}}
#else
#define DEFINE_GUID(name, l, w1, w2, b1, b2, b3, b4, b5, b6, b7, b8) EXTERN_C const GUID name
#endif

#ifdef __cplusplus
#define REFGUID const GUID&
#define REFIID const IID&
#define REFCLSID const IID&

inline bool IsEqualGUID(REFGUID a, REFGUID b) {
  return memcmp(&a, &b, sizeof(GUID)) == 0;
}
inline int InlineIsEqualGUID(REFGUID a, REFGUID b) {
  return IsEqualGUID(a, b);
}
#define IsEqualIID(a, b) IsEqualGUID(a, b)
#define IsEqualCLSID(a, b) IsEqualGUID(a, b)
inline bool operator==(REFGUID a, REFGUID b) {
  return IsEqualGUID(a, b);
}
inline bool operator!=(REFGUID a, REFGUID b) {
  return !IsEqualGUID(a, b);
}

#ifndef KAAMOS_MS_MODE
// Outside of clang's MS mode a GUID belongs to an interface by __CRT_UUID_DECL behind it, which
// <dxguids/dxguids.h> does for D3D12's.
extern "C++" {
template <class T>
struct kaamos_uuid;
template <class T>
struct kaamos_uuid<T*> : kaamos_uuid<T> {};
template <class T>
struct kaamos_uuid<const T> : kaamos_uuid<T> {};
template <class T>
struct kaamos_uuid<T&> : kaamos_uuid<T> {};
}
#define __CRT_UUID_DECL(type, l, w1, w2, b1, b2, b3, b4, b5, b6, b7, b8)         \
  extern "C++" {                                                                 \
  template <>                                                                    \
  struct kaamos_uuid<type> {                                                     \
    static constexpr GUID value = {l, w1, w2, {b1, b2, b3, b4, b5, b6, b7, b8}}; \
  };                                                                             \
  }
#define __uuidof(type) (kaamos_uuid<__typeof__(type)>::value)
#endif

#else
#define REFGUID const GUID*
#define REFIID const IID*
#define REFCLSID const IID*
#endif

#define GUID_NULL (GUID{})
#define IID_NULL (GUID{})
#define CLSID_NULL (GUID{})
