# The headers that most files begin with, read once instead of by each: building takes about half as long. Every file
# still includes what it uses; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without them, and shows if one does not.
set(ACENTRIC_COMMON_HEADERS
  <algorithm> <array> <atomic> <chrono> <cmath> <cstddef> <cstdint> <cstring> <filesystem> <fstream> <functional> <limits>
  <map> <memory> <mutex> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <stop_token> <string>
  <string_view> <thread> <unordered_map> <utility> <variant> <vector>
  <fmt/format.h> <glm/glm.hpp> <tl/expected.hpp>)

# One set for each way of compiling: libraries are position independent, programs are position independent programs,
# and tests begin with GoogleTest too. Targets take theirs by target_precompile_headers(TARGET REUSE_FROM ...).
function(acentric_precompiled name)
  cmake_parse_arguments(ARG "PROGRAM" "" "LINK;HEADERS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "int main() { return 0; }\n")
  if(ARG_PROGRAM)
    add_executable(${name} EXCLUDE_FROM_ALL ${source})
  else()
    add_library(${name} STATIC EXCLUDE_FROM_ALL ${source})
  endif()
  target_link_libraries(${name} PRIVATE acentric_options fmt::fmt glm::glm tl::expected ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE ${ACENTRIC_COMMON_HEADERS} ${ARG_HEADERS})
endfunction()

acentric_precompiled(acentric_precompiled_library)
acentric_precompiled(acentric_precompiled_program PROGRAM)
target_compile_options(acentric_precompiled_program PRIVATE ${ACENTRIC_CALLER_OPTIMIZATION})
if(ACENTRIC_TESTS)
  acentric_precompiled(acentric_precompiled_test PROGRAM
    LINK GTest::gmock GTest::gtest_main HEADERS <gmock/gmock.h> <gtest/gtest.h>)
  target_compile_options(acentric_precompiled_test PRIVATE ${ACENTRIC_CALLER_OPTIMIZATION})
endif()
