# WebAssembly for browsers: Debian's emscripten, sources and kernels of the releases, no threads.
set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG")
# Exceptions of the browser itself, which has them since 2022, are as fast as a return. Intervals round one way alone.
add_compile_options(-fwasm-exceptions -msimd128)
add_link_options(-fwasm-exceptions)
add_compile_definitions(CGAL_ALWAYS_ROUND_TO_NEAREST CGAL_DISABLE_GMP)
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${CMAKE_CURRENT_LIST_DIR}/missing_in_libcxx.h>")

set(KOEBE_MAKING OFF)

# Leaves out what no command of the page calls.
function(koebe_web_sources variable)
  set(sources ${${variable}})
  list(FILTER sources EXCLUDE REGEX "^(disk/baselines|domains|labs/(certified|planar_domain|transfer))/")
  list(FILTER sources EXCLUDE REGEX "^apps/report/(capacity|planar|schottky|sphere|tile)_")
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()
