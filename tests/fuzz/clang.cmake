# Clang, with the OpenMP of GCC: CHOLMOD has that one, and a process should not have two.
set(CMAKE_CXX_COMPILER clang++)

foreach(name include libgomp.so)
  execute_process(COMMAND g++ -print-file-name=${name} OUTPUT_VARIABLE path OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH ${path} path_of_${name})
endforeach()

# The checks that are left out look at every access through a pointer: Eigen's headers take twice as long with them,
# and the address sanitizer sees what they would.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
  -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,function
  -fno-sanitize-recover=all -fno-omit-frame-pointer
  -idirafter ${path_of_include})  # after clang's own headers: next to omp.h lie GCC's intrinsics
set(OpenMP_CXX_FLAGS "-fopenmp=libgomp" CACHE STRING "")
set(OpenMP_CXX_LIB_NAMES gomp CACHE STRING "")
set(OpenMP_gomp_LIBRARY ${path_of_libgomp.so} CACHE FILEPATH "")
