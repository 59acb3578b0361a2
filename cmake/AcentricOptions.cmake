# Warnings, sanitizers and the two helpers by which every folder declares its target.
option(ACENTRIC_TESTS "Build the tests" ON)
set(ACENTRIC_SANITIZE "" CACHE STRING "Sanitizers, comma separated: address,undefined or thread")
option(ACENTRIC_LIBFUZZER "The harnesses of tests/fuzz are driven by libFuzzer, which clang has" OFF)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

find_program(CCACHE ccache)
if(CCACHE)  # told so, it also keeps what precompiled headers went into
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

add_library(acentric_options INTERFACE)
target_compile_options(acentric_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wcast-qual -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # others warn of other things
  # g++ 12 reports these falsely for std::string (GCC bug 105651), the last three with precompiled headers.
  target_compile_options(acentric_options INTERFACE
    -Werror -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  if(ACENTRIC_SANITIZE)  # between whose instructions it loses sight of what is initialised
    target_compile_options(acentric_options INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()
target_include_directories(acentric_options INTERFACE ${CMAKE_SOURCE_DIR})
if(ACENTRIC_SANITIZE)
  target_compile_options(acentric_options INTERFACE
    -fsanitize=${ACENTRIC_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(acentric_options INTERFACE -fsanitize=${ACENTRIC_SANITIZE})
endif()

option(ACENTRIC_JOIN_SOURCES "Compile several sources at once: all takes less time, one change more" ON)
# acentric_join_sources(TARGET [APART source...]): it does so, these and the others apart from each other. Where sources
# that are joined give one name to two things the compiler says so: rename one.
function(acentric_join_sources target)
  cmake_parse_arguments(ARG "" "" "APART" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ACENTRIC_JOIN_SOURCES} UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # it takes joined sources for headers: names of one file in its own classes
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(name ${source} NAME)
    set(kind others)
    if(name IN_LIST ARG_APART)
      set(kind apart)
    endif()
    math(EXPR group "0${${kind}} / 8")
    math(EXPR ${kind} "0${${kind}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${kind}_${group})
  endforeach()
endfunction()

# acentric_library(NAME PUBLIC dep... PRIVATE dep... RUNTIME source... SINGLE source...): a static library from every .cpp
# of this folder. RUNTIME is what the C library takes of it (no more, so that it needs few other libraries), if that is
# not all; SINGLE is what acentric-bench-gl takes besides, source by source.
function(acentric_library name)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;RUNTIME;SINGLE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE acentric_options ${ARG_PUBLIC})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC acentric_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  target_precompile_headers(${name} REUSE_FROM acentric_precompiled_library)
  set_source_files_properties(${ARG_SINGLE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  acentric_join_sources(${name} APART ${ARG_RUNTIME})
endfunction()

# Of tests, the command line and panels, which mostly call libraries: they compile in two thirds to three quarters of the time.
set(ACENTRIC_CALLER_OPTIMIZATION $<$<CONFIG:RelWithDebInfo>:-O1>)

# acentric_test(NAME LABELS label LINK dep... [SERIAL pattern] [SLOW pattern] [TOGETHER suite...]): a GoogleTest binary
# from every *_test.cpp of this folder. Tests that SERIAL (a pattern of --gtest_filter) names run alone: those that measure
# how long something takes. Each test has a process of its own, but for suites that run TOGETHER in one: those that make
# something costly for all of their tests. The labels of these, and of those that SLOW names (more than 2 s each), end on
# _slow.
function(acentric_test name)
  cmake_parse_arguments(ARG "" "LABELS;TIMEOUT;SERIAL;SLOW" "LINK;TOGETHER" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(ACENTRIC_SANITIZE MATCHES "thread")
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")  # its code runs ten times slower
  endif()
  file(GLOB sources CONFIGURE_DEPENDS *_test.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE acentric_options ${ARG_LINK} GTest::gmock GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM acentric_precompiled_test)
  target_compile_options(${name} PRIVATE ${ACENTRIC_CALLER_OPTIMIZATION})
  acentric_join_sources(${name})
  if(ARG_LABELS STREQUAL "unit")
    add_dependencies(unit_tests ${name})
  endif()
  set(discovery DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
  set(environment ENVIRONMENT "TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/tests/tsan.supp")
  set(apart ${ARG_SERIAL} ${ARG_SLOW})  # patterns of those that are not among the others
  if(ARG_SERIAL)
    gtest_discover_tests(${name} TEST_FILTER "${ARG_SERIAL}" TEST_LIST ${name}_serial ${discovery}
      PROPERTIES RUN_SERIAL ON TIMEOUT ${ARG_TIMEOUT} LABELS ${ARG_LABELS} ${environment})
  endif()
  foreach(suite ${ARG_TOGETHER})
    add_test(NAME ${suite} COMMAND ${name} "--gtest_filter=${suite}.*-${ARG_SERIAL}")
    math(EXPR limit "3 * ${ARG_TIMEOUT}")
    set_tests_properties(${suite} PROPERTIES TIMEOUT ${limit} LABELS ${ARG_LABELS}_slow ${environment})
    list(APPEND apart "${suite}.*")
  endforeach()
  if(ARG_SLOW)
    gtest_discover_tests(${name} TEST_FILTER "${ARG_SLOW}" TEST_LIST ${name}_slow ${discovery}
      PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${ARG_LABELS}_slow ${environment})
  endif()
  if(apart)
    list(JOIN apart ":" apart)
    set(others TEST_FILTER "-${apart}")
  endif()
  gtest_discover_tests(${name} ${others} ${discovery}
    PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS ${ARG_LABELS} ${environment})
endfunction()
