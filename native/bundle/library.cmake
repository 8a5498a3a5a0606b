# The shared library of the wheels: everything inside, only KOEBE_API seen, no system library but the C library's.
target_sources(koebe_core PRIVATE bundle/exception_memory.cpp)
target_link_libraries(koebe_core PRIVATE koebe_kernels)
target_include_directories(koebe_core PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})  # of bundle/
target_compile_definitions(koebe_base PUBLIC KOEBE_SHARED)
set_target_properties(koebe_core PROPERTIES
  OUTPUT_NAME koebe
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/koebe
  RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/koebe)

if(APPLE)  # by hand: CMake knows no such options of zig's
  set_target_properties(koebe_core PROPERTIES NO_SONAME ON)
  target_link_options(koebe_core PRIVATE -Wl,-install_name,@rpath/libkoebe.dylib)
endif()
if(WIN32)
  set_target_properties(koebe_core PROPERTIES PREFIX "")
  target_link_libraries(koebe_core PRIVATE psapi)
  target_compile_definitions(koebe_base PUBLIC WIN32_LEAN_AND_MEAN NOMINMAX)
endif()
