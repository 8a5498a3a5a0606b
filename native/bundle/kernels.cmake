# BLAS and LAPACK made from Eigen, once for each set of instructions: koebe_kernels. With KOEBE_BUNDLE the solver's, else for
# their tests alone.
add_library(koebe_kernels STATIC EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/native/bundle/kernels/blas_symbols.cpp)
target_include_directories(koebe_kernels PRIVATE ${PROJECT_SOURCE_DIR}/native)
function(koebe_kernels_for set)
  add_library(koebe_kernels_${set} OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/native/bundle/kernels/dense_kernels.cpp)
  target_include_directories(koebe_kernels_${set} PRIVATE ${PROJECT_SOURCE_DIR}/native)
  target_compile_definitions(koebe_kernels_${set} PRIVATE KOEBE_INSTRUCTION_SET=${set})
  target_compile_options(koebe_kernels_${set} PRIVATE ${ARGN})
  target_link_libraries(koebe_kernels_${set} PRIVATE Eigen3::Eigen)
  target_sources(koebe_kernels PRIVATE $<TARGET_OBJECTS:koebe_kernels_${set}>)
endfunction()
koebe_kernels_for(baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  koebe_kernels_for(avx2 -mavx2 -mfma)
  # Clang calls itself an old compiler, for which Eigen wraps its vectors, but not those of AVX-512.
  koebe_kernels_for(avx512 -U__GXX_ABI_VERSION -D__GXX_ABI_VERSION=1018 -mavx2 -mfma -mavx512f -mavx512dq -mavx512bw -mavx512vl)
  target_compile_definitions(koebe_kernels PRIVATE KOEBE_SEVERAL_INSTRUCTION_SETS)
endif()
