set(CMAKE_CXX_COMPILER clang++)

# The checks that are left out look at every access through a pointer: Eigen's headers take twice as long with them,
# and the address sanitizer sees what they would.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
  -fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
  -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,function
  -fno-sanitize-recover=all -fno-omit-frame-pointer)
