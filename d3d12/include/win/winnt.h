// SPDX-License-Identifier: MIT
// Interlocked calls, and the locks and links that Win32 has. [Win32: winnt.h, synchapi.h]
#pragma once

#include <minwindef.h>
#include <pthread.h>

typedef struct _LIST_ENTRY {
  struct _LIST_ENTRY* Flink;
  struct _LIST_ENTRY* Blink;
} LIST_ENTRY, *PLIST_ENTRY;
#define CONTAINING_RECORD(address, type, field) \
  ((type*)((PCHAR)(address) - (ULONG_PTR)(&((type*)0)->field)))

inline LONG InterlockedIncrement(volatile LONG* p) {
  return __sync_add_and_fetch(p, 1);
}
inline LONG InterlockedDecrement(volatile LONG* p) {
  return __sync_sub_and_fetch(p, 1);
}
inline LONG InterlockedAdd(volatile LONG* p, LONG v) {
  return __sync_add_and_fetch(p, v);
}
inline LONG InterlockedExchangeAdd(volatile LONG* p, LONG v) {
  return __sync_fetch_and_add(p, v);
}
inline LONG InterlockedExchange(volatile LONG* p, LONG v) {
  return __atomic_exchange_n(p, v, __ATOMIC_SEQ_CST);
}
inline LONG InterlockedCompareExchange(volatile LONG* p, LONG v, LONG comparand) {
  return __sync_val_compare_and_swap(p, comparand, v);
}
inline LONGLONG InterlockedIncrement64(volatile LONGLONG* p) {
  return __sync_add_and_fetch(p, 1);
}
inline LONGLONG InterlockedDecrement64(volatile LONGLONG* p) {
  return __sync_sub_and_fetch(p, 1);
}
inline LONGLONG InterlockedExchangeAdd64(volatile LONGLONG* p, LONGLONG v) {
  return __sync_fetch_and_add(p, v);
}
inline LONGLONG InterlockedExchange64(volatile LONGLONG* p, LONGLONG v) {
  return __atomic_exchange_n(p, v, __ATOMIC_SEQ_CST);
}
inline LONGLONG InterlockedCompareExchange64(volatile LONGLONG* p, LONGLONG v, LONGLONG comparand) {
  return __sync_val_compare_and_swap(p, comparand, v);
}
#ifdef __cplusplus
// The same names for unsigned numbers of both sizes, as Windows has them in C++.
#define KAAMOS_INTERLOCKED_UNSIGNED(T)                                   \
  inline T InterlockedIncrement(volatile T* p) {                         \
    return __sync_add_and_fetch(p, (T)1);                                \
  }                                                                      \
  inline T InterlockedDecrement(volatile T* p) {                         \
    return __sync_sub_and_fetch(p, (T)1);                                \
  }                                                                      \
  inline T InterlockedExchangeAdd(volatile T* p, T v) {                  \
    return __sync_fetch_and_add(p, v);                                   \
  }                                                                      \
  inline T InterlockedExchange(volatile T* p, T v) {                     \
    return __atomic_exchange_n(p, v, __ATOMIC_SEQ_CST);                  \
  }                                                                      \
  inline T InterlockedCompareExchange(volatile T* p, T v, T comparand) { \
    return __sync_val_compare_and_swap(p, comparand, v);                 \
  }
KAAMOS_INTERLOCKED_UNSIGNED(ULONG)
KAAMOS_INTERLOCKED_UNSIGNED(UINT64)
#undef KAAMOS_INTERLOCKED_UNSIGNED
#endif
inline void MemoryBarrier() {
  __sync_synchronize();
}

typedef pthread_mutex_t CRITICAL_SECTION, *LPCRITICAL_SECTION;
inline void InitializeCriticalSection(LPCRITICAL_SECTION section) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_init(section, &attributes);
  pthread_mutexattr_destroy(&attributes);
}
inline BOOL InitializeCriticalSectionAndSpinCount(LPCRITICAL_SECTION section, DWORD) {
  InitializeCriticalSection(section);
  return TRUE;
}
inline BOOL InitializeCriticalSectionEx(LPCRITICAL_SECTION section, DWORD, DWORD) {
  InitializeCriticalSection(section);
  return TRUE;
}
inline void EnterCriticalSection(LPCRITICAL_SECTION section) {
  pthread_mutex_lock(section);
}
inline BOOL TryEnterCriticalSection(LPCRITICAL_SECTION section) {
  return pthread_mutex_trylock(section) == 0;
}
inline void LeaveCriticalSection(LPCRITICAL_SECTION section) {
  pthread_mutex_unlock(section);
}
inline void DeleteCriticalSection(LPCRITICAL_SECTION section) {
  pthread_mutex_destroy(section);
}

typedef struct _RTL_SRWLOCK {
  pthread_rwlock_t lock;
} SRWLOCK, *PSRWLOCK;
#define SRWLOCK_INIT \
  { PTHREAD_RWLOCK_INITIALIZER }
inline void InitializeSRWLock(PSRWLOCK lock) {
  pthread_rwlock_init(&lock->lock, nullptr);
}
inline void AcquireSRWLockExclusive(PSRWLOCK lock) {
  pthread_rwlock_wrlock(&lock->lock);
}
inline void ReleaseSRWLockExclusive(PSRWLOCK lock) {
  pthread_rwlock_unlock(&lock->lock);
}
inline void AcquireSRWLockShared(PSRWLOCK lock) {
  pthread_rwlock_rdlock(&lock->lock);
}
inline void ReleaseSRWLockShared(PSRWLOCK lock) {
  pthread_rwlock_unlock(&lock->lock);
}
