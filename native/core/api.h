// What a shared library koebe shows of itself (-DKOEBE_BUNDLE=ON): all else is hidden in it.
#pragma once

#if !defined(KOEBE_SHARED)
#define KOEBE_API
#elif defined(_WIN32)
#define KOEBE_API __declspec(dllexport)  // programs that link it need no dllimport: they call through a jump
#else
#define KOEBE_API __attribute__((visibility("default")))
#endif
