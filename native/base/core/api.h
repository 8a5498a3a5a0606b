// Marks the functions that the shared library exports (-DKOEBE_BUNDLE=ON). It hides all others. Every build sets the
// marks, so that a test sees a missing one (tests/python/test_module_symbols.py).
#pragma once

#if !defined(_WIN32)
#define KOEBE_API __attribute__((visibility("default")))
#elif defined(KOEBE_SHARED)
#define KOEBE_API __declspec(dllexport)  // a program that links it needs no dllimport: it calls through a jump
#else
#define KOEBE_API
#endif
