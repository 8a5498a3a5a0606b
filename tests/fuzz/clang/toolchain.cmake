# Clang, with the OpenMP of GCC: CHOLMOD has that one, and a process should not have two.
set(CMAKE_CXX_COMPILER clang++)

execute_process(COMMAND g++ -print-file-name=libgomp.so OUTPUT_VARIABLE gomp OUTPUT_STRIP_TRAILING_WHITESPACE)
file(REAL_PATH ${gomp} gomp)
set(OpenMP_CXX_FLAGS "-fopenmp=libgomp" CACHE STRING "")
set(OpenMP_CXX_LIB_NAMES gomp CACHE STRING "")
set(OpenMP_gomp_LIBRARY ${gomp} CACHE FILEPATH "")

# The checks that are left out look at every access through a pointer: Eigen's headers take twice as long with them,
# and the address sanitizer sees what they would.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
  -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,function
  -fno-sanitize-recover=all -fno-omit-frame-pointer
  -isystem ${CMAKE_CURRENT_LIST_DIR})
