# The shared library of the wheels: everything inside, only KOEBE_API seen, no system library but the C library's.
target_sources(koebe_core PRIVATE bundle/exception_memory.cpp)
target_link_libraries(koebe_core PRIVATE koebe_cholmod)
target_compile_definitions(koebe_core PUBLIC KOEBE_SHARED PRIVATE KOEBE_OWN_KERNELS)
set_target_properties(koebe_core PROPERTIES
  OUTPUT_NAME koebe
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/koebe
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/koebe
  UNITY_BUILD ON UNITY_BUILD_MODE GROUP DISABLE_PRECOMPILE_HEADERS ON)

# The sources in fourteen heaps, which takes a quarter of the time: most of it goes into headers. Which heap, a file's name
# tells, so that a new file moves no other. Two files of one heap may not have a name twice in nameless namespaces: then
# the compiler says so, and one of them is to be compiled by itself, by the property SKIP_UNITY_BUILD_INCLUSION. A name
# there that a header has too would hide that one, silently: tests/python/test_native_rooms.py looks for such names. And
# <windows.h> makes macros of words like "near", so that the sources that include it are by themselves.
get_target_property(all koebe_core SOURCES)
foreach(source IN LISTS all)
  string(MD5 hash ${source})
  string(SUBSTRING ${hash} 6 4 digits)
  math(EXPR heap "0x${digits} % 14")
  set_source_files_properties(${source} PROPERTIES UNITY_GROUP heap${heap})
  file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${source} windows REGEX "#include <windows.h>")
  if(windows)
    set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endforeach()

if(APPLE)  # by hand: CMake knows no such options of zig's
  set_target_properties(koebe_core PROPERTIES NO_SONAME ON)
  target_link_options(koebe_core PRIVATE -Wl,-install_name,@rpath/libkoebe.dylib)
endif()
if(WIN32)
  set_target_properties(koebe_core PROPERTIES PREFIX "")
  target_link_libraries(koebe_core PRIVATE psapi)
  target_compile_definitions(koebe_core PRIVATE WIN32_LEAN_AND_MEAN NOMINMAX)
endif()
