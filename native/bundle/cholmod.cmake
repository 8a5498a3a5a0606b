# CHOLMOD as Debian has it: koebe_cholmod. Its analysis is called and nothing else, so that of its archive no BLAS is
# linked, and nobody sees that it is inside. Without archives it is the shared library.
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
set(archives)  # in the order of linking
foreach(name cholmod amd colamd suitesparseconfig)
  find_library(${name}_ARCHIVE lib${name}.a)
  list(APPEND archives ${${name}_ARCHIVE})
endforeach()

add_library(koebe_cholmod INTERFACE)
target_include_directories(koebe_cholmod INTERFACE ${CHOLMOD_INCLUDE_DIR})
if(archives MATCHES "NOTFOUND")
  target_link_libraries(koebe_cholmod INTERFACE ${CHOLMOD_LIBRARY})
else()
  add_library(koebe_cholmod_unused OBJECT native/bundle/cholmod_unused.cpp)
  target_include_directories(koebe_cholmod_unused PRIVATE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(koebe_cholmod INTERFACE $<TARGET_OBJECTS:koebe_cholmod_unused> ${archives})
endif()
