/* What SHA-256 calls of libsodium's utilities, which bring the rest of it with them. */
#include <stddef.h>
#include <string.h>

void sodium_memzero(void* const memory, const size_t size) { memset(memory, 0, size); }
