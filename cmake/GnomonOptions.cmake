# How our own targets are compiled. Presets choose; nothing here touches other people's code.

set(GNOMON_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined or thread")
option(GNOMON_CORE_ONLY "Build only base, math, field, scene and net (what the thread sanitizer looks at)" OFF)

option(GNOMON_FUZZ "Build only what is fuzzed, and its libFuzzer targets; needs clang" OFF)

option(GNOMON_UNITY "Compile sources in batches, which halves the work of headers" ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(GNOMON_CCACHE ccache)
if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${GNOMON_CCACHE})
endif()

add_library(gnomon_options INTERFACE)
target_compile_features(gnomon_options INTERFACE cxx_std_20)
target_compile_options(gnomon_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)

if(GNOMON_UNITY)
  set(CMAKE_UNITY_BUILD ON)
  # What files call by one name, each for itself, shadows in a batch; other builds look for shadows.
  target_compile_options(gnomon_options INTERFACE -Wno-shadow)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 warns wrongly of overlap in std::string's operator+ (GCC bug 105651).
  target_compile_options(gnomon_options INTERFACE -Wno-restrict)
endif()

if(GNOMON_FUZZ)
  # Coverage is what steers libFuzzer; its main() is linked to the targets alone.
  target_compile_options(gnomon_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # Asio 1.18 does not detect clang 14's coroutines.
  target_compile_definitions(gnomon_options INTERFACE
    BOOST_ASIO_HAS_CO_AWAIT BOOST_ASIO_HAS_STD_COROUTINE)
endif()

if(GNOMON_SANITIZE)
  target_compile_options(gnomon_options INTERFACE -fsanitize=${GNOMON_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(gnomon_options INTERFACE -fsanitize=${GNOMON_SANITIZE})
  # Tests that repeat themselves many times do so less often.
  target_compile_definitions(gnomon_options INTERFACE GNOMON_SANITIZED)
  if(GNOMON_SANITIZE MATCHES "thread")
    target_compile_definitions(gnomon_options INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK)
  endif()
  if(GNOMON_SANITIZE MATCHES "address")
    target_compile_definitions(gnomon_options INTERFACE BOOST_ASIO_DISABLE_AWAITABLE_FRAME_RECYCLING)
  endif()
  if(GNOMON_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(gnomon_options INTERFACE -fno-sanitize=function)
  endif()
else()
  find_program(GNOMON_MOLD mold)
  if(GNOMON_MOLD)
    target_link_options(gnomon_options INTERFACE -fuse-ld=mold)
  endif()
endif()
