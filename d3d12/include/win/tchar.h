// SPDX-License-Identifier: MIT
// TCHAR's names for calls of the C library. [MSVC: tchar.h]
#pragma once

#include <kaamos_crt.h>
#include <minwindef.h>

#ifdef _UNICODE
#define __T(text) L##text
#define _tmain wmain
#define _tWinMain wWinMain
#define _tcslen wcslen
#define _tcscmp wcscmp
#define _tcsicmp _wcsicmp
#define _tcscpy_s wcscpy_s
#define _tcscat_s wcscat_s
#define _tcsrchr wcsrchr
#define _stprintf_s swprintf_s
#define _tfopen_s _wfopen_s
#define _ttoi _wtoi
#else
#define __T(text) text
#define _tmain main
#define _tWinMain WinMain
#define _tcslen strlen
#define _tcscmp strcmp
#define _tcsicmp _stricmp
#define _tcscpy_s strcpy_s
#define _tcscat_s strcat_s
#define _tcsrchr strrchr
#define _stprintf_s sprintf_s
#define _tfopen_s fopen_s
#define _ttoi atoi
#endif
#define _T(text) __T(text)
#define _TEXT(text) __T(text)
