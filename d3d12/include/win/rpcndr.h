// SPDX-License-Identifier: MIT
// The words of COM declarations as MIDL writes them.
#pragma once

#include <guiddef.h>
#include <winerror.h>

#define __RPCNDR_H_VERSION__ 500

typedef unsigned char byte;
#define interface struct
#ifdef CONST_VTABLE
#define CONST_VTBL const
#else
#define CONST_VTBL
#endif
#define MIDL_INTERFACE(x) struct DECLSPEC_UUID(x) DECLSPEC_NOVTABLE
#define BEGIN_INTERFACE
#define END_INTERFACE

#define STDMETHOD(method) virtual HRESULT STDMETHODCALLTYPE method
#define STDMETHOD_(type, method) virtual type STDMETHODCALLTYPE method
#define STDMETHODIMP HRESULT STDMETHODCALLTYPE
#define STDMETHODIMP_(type) type STDMETHODCALLTYPE
#define IFACEMETHOD(method) STDMETHOD(method)
#define IFACEMETHOD_(type, method) STDMETHOD_(type, method)
#define IFACEMETHODIMP STDMETHODIMP
#define IFACEMETHODIMP_(type) STDMETHODIMP_(type)
#define PURE = 0
#define THIS_
#define THIS void
#define DECLARE_INTERFACE(name) struct DECLSPEC_NOVTABLE name
#define DECLARE_INTERFACE_(name, base) struct DECLSPEC_NOVTABLE name : public base
#define DECLARE_INTERFACE_IID_(name, base, iid) \
  struct DECLSPEC_UUID(iid) DECLSPEC_NOVTABLE name : public base
