// SPDX-License-Identifier: MIT
// Events, mutexes and waits. The library implements these calls. [Win32: synchapi.h]
#pragma once

#include <handleapi.h>

#define INFINITE 0xFFFFFFFFu
#define WAIT_OBJECT_0 0u
#define WAIT_ABANDONED 0x80u
#define WAIT_TIMEOUT 258u
#define WAIT_FAILED 0xFFFFFFFFu
#define MAXIMUM_WAIT_OBJECTS 64
#define EVENT_MODIFY_STATE 0x0002
#define EVENT_ALL_ACCESS 0x1F0003
#define SYNCHRONIZE 0x100000
#define CREATE_EVENT_MANUAL_RESET 0x1
#define CREATE_EVENT_INITIAL_SET 0x2

/// Names are ignored: there is one process.
///@{
EXTERN_C HANDLE WINAPI CreateEventA(LPSECURITY_ATTRIBUTES attributes, BOOL manual_reset,
                                    BOOL initial_state, LPCSTR name);
EXTERN_C HANDLE WINAPI CreateEventW(LPSECURITY_ATTRIBUTES attributes, BOOL manual_reset,
                                    BOOL initial_state, LPCWSTR name);
EXTERN_C HANDLE WINAPI CreateEventExA(LPSECURITY_ATTRIBUTES attributes, LPCSTR name, DWORD flags,
                                      DWORD access);
EXTERN_C HANDLE WINAPI CreateEventExW(LPSECURITY_ATTRIBUTES attributes, LPCWSTR name, DWORD flags,
                                      DWORD access);
///@}
EXTERN_C BOOL WINAPI SetEvent(HANDLE event);
EXTERN_C BOOL WINAPI ResetEvent(HANDLE event);
/// A wait takes a mutex; its thread may wait again, and releases it as often.
///@{
EXTERN_C HANDLE WINAPI CreateMutexA(LPSECURITY_ATTRIBUTES attributes, BOOL owned, LPCSTR name);
EXTERN_C HANDLE WINAPI CreateMutexW(LPSECURITY_ATTRIBUTES attributes, BOOL owned, LPCWSTR name);
///@}
EXTERN_C BOOL WINAPI ReleaseMutex(HANDLE mutex);
EXTERN_C DWORD WINAPI WaitForSingleObject(HANDLE object, DWORD milliseconds);
EXTERN_C DWORD WINAPI WaitForSingleObjectEx(HANDLE object, DWORD milliseconds, BOOL alertable);
EXTERN_C DWORD WINAPI WaitForMultipleObjects(DWORD count, const HANDLE* objects, BOOL wait_all,
                                             DWORD milliseconds);
EXTERN_C DWORD WINAPI WaitForMultipleObjectsEx(DWORD count, const HANDLE* objects, BOOL wait_all,
                                               DWORD milliseconds, BOOL alertable);
EXTERN_C void WINAPI Sleep(DWORD milliseconds);

#ifdef UNICODE
#define CreateEvent CreateEventW
#define CreateMutex CreateMutexW
#define CreateEventEx CreateEventExW
#else
#define CreateEvent CreateEventA
#define CreateMutex CreateMutexA
#define CreateEventEx CreateEventExA
#endif
