// SPDX-License-Identifier: MIT
// Interlocked calls, and locks that Win32 has. [Win32: winnt.h, synchapi.h]
#pragma once

#include <minwindef.h>
#include <pthread.h>

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
// Some programs count ULONG references.
inline ULONG InterlockedIncrement(volatile ULONG* p) {
  return __sync_add_and_fetch(p, 1u);
}
inline ULONG InterlockedDecrement(volatile ULONG* p) {
  return __sync_sub_and_fetch(p, 1u);
}
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
