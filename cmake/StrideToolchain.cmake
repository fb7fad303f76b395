# Build-wide settings: build type, compiler cache, linker, sanitizers.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug or Release" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

find_program(STRIDE_CCACHE ccache)
if(STRIDE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # The sloppiness is what ccache's manual asks for with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${STRIDE_CCACHE})
endif()

find_program(STRIDE_LLD ld.lld)
if(STRIDE_LLD)
  add_link_options(-fuse-ld=lld)
endif()

# The same numbers on every machine: no contraction to fused multiply-add, no fast-math.
add_compile_options(-ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_COLOR_DIAGNOSTICS)
  add_compile_options(-fdiagnostics-color=always)
endif()

if(STRIDE_SANITIZE)
  # Not optimised: the instrumented code would take g++ three times as long. What looks at every access
  # costs it another half of its time, and is found elsewhere: a null pointer by AddressSanitizer, wrong
  # alignment and types by the fuzzers' build.
  add_compile_options(-O0 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined
                      -fno-sanitize=null,alignment,vptr -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

if(STRIDE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "STRIDE_FUZZ needs clang++: configure with -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-g -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined)
  add_link_options(-fsanitize=address,undefined)
endif()
