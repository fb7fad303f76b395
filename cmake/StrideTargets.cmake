# Helpers for the targets of this project. Every CMakeLists.txt below uses them, so that warnings,
# include roots and test registration are the same everywhere.

set(STRIDE_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports these in libstdc++'s own inlined code at -O2 (overread: with precompiled headers).
  list(APPEND STRIDE_WARNINGS -Wno-restrict -Wno-dangling-pointer -Wno-maybe-uninitialized
       -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()

# Code that ends up inside applications has the flags of generated code.
set(STRIDE_APPLICATION_FLAGS
    -fPIC -fwrapv -fno-strict-aliasing -fno-finite-loops -fno-delete-null-pointer-checks
    -ffp-contract=off)
# The same bits on every machine, and neither heap nor streams in applications.
set(STRIDE_EIGEN_DEFINITIONS EIGEN_DONT_VECTORIZE EIGEN_NO_MALLOC EIGEN_NO_IO EIGEN_NO_DEBUG)

# Our own code: warnings are errors, the include root is the top of the repository.
function(_stride_own_code target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE ${STRIDE_WARNINGS})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()

# Code of tests: what it tests is optimised, it itself is not, which halves the time g++ takes. Eight files are compiled
# at once: gtest's header alone takes half a second each time.
function(_stride_test_code target)
  target_compile_options(${target} PRIVATE -O0)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# _stride_precompiled(<target> library|eigen|test|none): its sources use that precompiled header of cmake/pch. There is
# one for the libraries, one for those that applications link and that include Eigen, and one for the tests, which are
# executables and so compiled with other flags. That the sources include what they use is seen where STRIDE_PCH is
# off, in the fuzzers' build.
function(_stride_precompiled target kind)
  if(NOT STRIDE_PCH OR kind STREQUAL "none")
    return()
  endif()
  set(header stride_pch_${kind})
  if(NOT TARGET ${header})
    if(kind STREQUAL "library")
      add_library(${header} OBJECT ${PROJECT_SOURCE_DIR}/cmake/pch/main.cpp)
    elseif(kind STREQUAL "eigen")
      add_library(${header} OBJECT ${PROJECT_SOURCE_DIR}/cmake/pch/main.cpp)
      target_link_libraries(${header} PRIVATE Eigen3::Eigen)
      target_compile_definitions(${header} PRIVATE ${STRIDE_EIGEN_DEFINITIONS})
      target_compile_options(${header} PRIVATE ${STRIDE_APPLICATION_FLAGS})
    else()
      add_executable(${header} ${PROJECT_SOURCE_DIR}/cmake/pch/main.cpp)
      target_link_libraries(${header} PRIVATE GTest::gmock GTest::gtest)
      _stride_test_code(${header})
    endif()
    _stride_own_code(${header})
    target_precompile_headers(${header} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/pch/${kind}.hpp)
  endif()
  target_precompile_headers(${target} REUSE_FROM ${header})
endfunction()

# stride_library(<name> SOURCES <file>... [DEPS <target>...] [SHARED_BY_THREADS <file>...] [PRECOMPILED eigen|none])
# A static library of the project; DEPS are public. Without sources: an interface library. What several
# threads use at once is named, so that a stride_thread_test can compile it.
function(stride_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PRECOMPILED" "SOURCES;DEPS;SHARED_BY_THREADS")
  if(NOT arg_PRECOMPILED)
    set(arg_PRECOMPILED library)
  endif()
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    # Objects of their own, so that those of a test take their place when it is linked.
    set_source_files_properties(${arg_SHARED_BY_THREADS} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    list(TRANSFORM arg_SHARED_BY_THREADS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    set_target_properties(${name} PROPERTIES STRIDE_SHARED_BY_THREADS "${arg_SHARED_BY_THREADS}")
    _stride_own_code(${name})
    _stride_precompiled(${name} ${arg_PRECOMPILED})
    target_link_libraries(${name} PUBLIC ${arg_DEPS})
  else()
    add_library(${name} INTERFACE)
    target_compile_features(${name} INTERFACE cxx_std_20)
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE ${arg_DEPS})
  endif()
endfunction()

# stride_topics(<name> FOLDERS <folder>... [DEPS <target>...])
# A static library whose folders need each other in circles: each names its own sources by target_sources().
function(stride_topics name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;DEPS")
  add_library(${name} STATIC)
  _stride_own_code(${name})
  _stride_precompiled(${name} library)
  target_link_libraries(${name} PUBLIC ${arg_DEPS})
  foreach(folder IN LISTS arg_FOLDERS)
    add_subdirectory(${folder})
  endforeach()
endfunction()

# stride_native_library(<name> SOURCES <file>... [DEPS <target>...] [PRECOMPILED eigen])
# A library that applications link, too: with the flags of generated code, an object for each source, so that an
# application gets only those that it uses. Such sources include next to nothing of the standard library: what g++
# instantiates for a precompiled header of it takes longer (0.16 s) than they do (0.05 s). Eigen takes 1.5 s.
function(stride_native_library name)
  if(NOT "PRECOMPILED" IN_LIST ARGN)
    list(APPEND ARGN PRECOMPILED none)
  endif()
  stride_library(${name} ${ARGN})
  target_compile_options(${name} PRIVATE ${STRIDE_APPLICATION_FLAGS})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
endfunction()

# stride_executable(<name> SOURCES <file>... [DEPS <target>...])
# A program that ends up at the top of the build directory.
function(stride_executable name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPS")
  add_executable(${name} ${arg_SOURCES})
  _stride_own_code(${name})
  target_link_libraries(${name} PRIVATE ${arg_DEPS})
endfunction()

# stride_test(<name> [STARTS_PROGRAMS] SOURCES <file>... [OWN_HELPERS [<file>...]] [DEPS <target>...] [SHARDS <n>] [LABELS <l>...])
# One GoogleTest executable, registered with ctest as one test (or as n shards of it, which run in parallel). Tests find
# the repository and the built `stride` through the macros STRIDE_SOURCE_DIR and STRIDE_BINARY_DIR.
# STARTS_PROGRAMS: it starts what the target stride_programs consists of, which is built with it.
# OWN_HELPERS: these files, or all, have helpers that others name alike, and so are compiled by themselves.
# LABELS turns: it takes long, and CI runs it in turns with others (`./dev test --turn`).
function(stride_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "STARTS_PROGRAMS" "SHARDS" "SOURCES;OWN_HELPERS;DEPS;LABELS")
  find_package(GTest REQUIRED)
  add_executable(${name} ${arg_SOURCES})
  _stride_own_code(${name})
  _stride_test_code(${name})
  if("OWN_HELPERS" IN_LIST arg_KEYWORDS_MISSING_VALUES)
    set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  endif()
  set_source_files_properties(${arg_OWN_HELPERS} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  _stride_precompiled(${name} test)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_compile_definitions(${name} PRIVATE
    STRIDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" STRIDE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  target_link_libraries(${name} PRIVATE ${arg_DEPS} GTest::gmock GTest::gtest GTest::gmock_main)
  if(arg_STARTS_PROGRAMS)
    add_dependencies(${name} stride_programs)
  endif()
  if(NOT arg_SHARDS)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}")
    return()
  endif()
  math(EXPR last "${arg_SHARDS} - 1")
  foreach(shard RANGE ${last})
    add_test(NAME ${name}.${shard} COMMAND ${name})
    set_tests_properties(${name}.${shard} PROPERTIES
      ENVIRONMENT "GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${shard}"
      COST 100 # long ones: started early, so that the cores end together
      LABELS "${arg_LABELS}")
  endforeach()
endfunction()

# stride_thread_test(<name> SOURCES <file>... OF <library>... [DEPS <target>...])
# A stride_test under ThreadSanitizer, with what the libraries share between threads. The sanitizers exclude
# each other, so there is none in other sanitized builds.
function(stride_thread_test name)
  if(STRIDE_SANITIZE OR STRIDE_FUZZ)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;OF;DEPS")
  foreach(library IN LISTS arg_OF)
    get_target_property(shared ${library} STRIDE_SHARED_BY_THREADS)
    list(APPEND arg_SOURCES ${shared})
  endforeach()
  stride_test(${name} SOURCES ${arg_SOURCES} OWN_HELPERS DEPS ${arg_DEPS})
  target_compile_options(${name} PRIVATE -fsanitize=thread)
  target_link_options(${name} PRIVATE -fsanitize=thread)
  set_target_properties(${name} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
endfunction()

# stride_property_test(<name> SOURCES <file>... [OWN_HELPERS <file>...] [DEPS <target>...] [SHARDS <n>])
# A GoogleTest executable whose tests call rc::check; a failure prints the shrunk counterexample and
# the RC_PARAMS string that reproduces it. Sanitizers watch a quarter of the cases: they look for what is wrong with the
# program, not with its numbers.
function(stride_property_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SHARDS" "SOURCES;OWN_HELPERS;DEPS")
  find_package(rapidcheck REQUIRED)
  stride_test(${name} SOURCES ${arg_SOURCES} DEPS ${arg_DEPS} rapidcheck SHARDS ${arg_SHARDS} LABELS property)
  set_source_files_properties(${arg_OWN_HELPERS} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(STRIDE_SANITIZE)
    set(tests ${name})
    if(arg_SHARDS)
      math(EXPR last "${arg_SHARDS} - 1")
      set(tests "")
      foreach(shard RANGE ${last})
        list(APPEND tests ${name}.${shard})
      endforeach()
    endif()
    set_property(TEST ${tests} APPEND PROPERTY ENVIRONMENT RC_PARAMS=max_success=25)
  endif()
endfunction()

# stride_benchmark(<name> SOURCES <file>... [DEPS <target>...])
# A Google Benchmark executable in <build>/bench; `./dev bench` runs all of them. Where STRIDE_BENCHMARKS is off, it is
# built only when it is asked for.
function(stride_benchmark name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPS")
  find_package(benchmark REQUIRED)
  add_executable(${name} ${arg_SOURCES})
  _stride_own_code(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
  target_compile_definitions(${name} PRIVATE
    STRIDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" STRIDE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(STRIDE_BENCHMARKS) # each once: what does not end, or fails, is a defect of what it measures
    add_test(NAME bench.${name} COMMAND ${name} --benchmark_min_time=0)
    set_tests_properties(bench.${name} PROPERTIES FAIL_REGULAR_EXPRESSION "ERROR OCCURRED" TIMEOUT 300)
  else()
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
  target_link_libraries(${name} PRIVATE ${arg_DEPS} benchmark::benchmark benchmark::benchmark_main)
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF) # a file's helpers are its own
endfunction()

# stride_fuzz(<name> SOURCES <file>... [DEPS <target>...])
# A libFuzzer target in <build>/fuzz, built only with -DSTRIDE_FUZZ=ON; `./dev fuzz` runs all of them.
# Its seed corpus is tests/fuzz/corpus/<name>, if there is one.
function(stride_fuzz name)
  if(NOT STRIDE_FUZZ)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPS")
  add_executable(${name} ${arg_SOURCES})
  _stride_own_code(${name})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  if(NOT TARGET stride_fuzzers)
    add_custom_target(stride_fuzzers)
  endif()
  add_dependencies(stride_fuzzers ${name})
  target_link_libraries(${name} PRIVATE ${arg_DEPS})
endfunction()

# The archives that every application links, in this order, and those that make a static executable of it
# (main, stride-host and what it consists of).
set(STRIDE_APPLICATION_ARCHIVES stride_stdlib stride_native stride_runtime_iec)
set(STRIDE_HOST_ARCHIVES stride_static_main stride_host_main stride_runtime_host stride_runtime_monitor
    stride_runtime_script stride_drivers_io stride_runtime_io stride_runtime_system stride_runtime_task
    stride_drivers stride_driver_can stride_driver_can_log stride_can_master stride_driver_can_simulation
    stride_can_socket stride_can_plan stride_driver_sercos stride_sercos_master stride_sercos_plan stride_driver_sercos_simulation stride_sercos_protocol stride_driver_dummy stride_runtime_bus stride_runtime_axis stride_runtime_app stride_common
    stride_fmt)

# stride_stdlib_archive(<generated file>...): the ST bodies of the standard library.
function(stride_stdlib_archive)
  add_library(stride_stdlib STATIC ${ARGN})
  target_compile_features(stride_stdlib PRIVATE cxx_std_20)
  # An object for each library: an application may bring the code of one that it has set parameters of.
  set_target_properties(stride_stdlib PROPERTIES UNITY_BUILD OFF)
  target_link_libraries(stride_stdlib
    PRIVATE stride_generated_headers PUBLIC stride_native stride_runtime_iec)
  target_compile_options(stride_stdlib PRIVATE
    -O2 -fPIC -fwrapv -fno-strict-aliasing -fno-finite-loops -fno-delete-null-pointer-checks
    -ffp-contract=off -fvisibility=hidden -fno-rtti -ffunction-sections -fdata-sections)
endfunction()
