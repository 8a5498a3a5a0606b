// What the library shows where it is a shared one (-DKOEBE_BUNDLE=ON): all else is hidden in it. Marked in every build,
// so that a test sees what a release would miss (tests/python/test_module_symbols.py).
#pragma once

#if !defined(_WIN32)
#define KOEBE_API __attribute__((visibility("default")))
#elif defined(KOEBE_SHARED)
#define KOEBE_API __declspec(dllexport)  // programs that link it need no dllimport: they call through a jump
#else
#define KOEBE_API
#endif
