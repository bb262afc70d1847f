# gnomon_add_module(<name> SOURCES <...> HEADERS <...> DEPENDS <...> [PRIVATE_DEPENDS <...>])
# Defines library gnomon_<name>, known to others as gnomon::<name>. It publishes only its own
# include folder, so that an include the link graph forbids does not compile. SEPARATE: its files use
# one name for different things (each technique its own `fit`), so they are never batched.
function(gnomon_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "SEPARATE" "" "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS")
  add_library(gnomon_${name} STATIC ${arg_SOURCES})
  add_library(gnomon::${name} ALIAS gnomon_${name})
  target_sources(gnomon_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS include FILES ${arg_HEADERS})
  target_include_directories(gnomon_${name} PRIVATE src)
  target_compile_features(gnomon_${name} PUBLIC cxx_std_20)
  target_link_libraries(gnomon_${name} PUBLIC ${arg_DEPENDS}
    PRIVATE ${arg_PRIVATE_DEPENDS} gnomon_options)
  set_target_properties(gnomon_${name} PROPERTIES
    VERIFY_INTERFACE_HEADER_SETS ON POSITION_INDEPENDENT_CODE ON)
  if(arg_SEPARATE)
    set_target_properties(gnomon_${name} PROPERTIES UNITY_BUILD OFF)
  endif()
endfunction()

# gnomon_add_test(<name> LABELS <...> SOURCES <...> DEPENDS <...> [PREFIX <...>])
# A GoogleTest program; every TEST becomes a ctest of its own, with PREFIX before its name. Its files
# find test data under GNOMON_SOURCE_DIR.
include(GoogleTest)
function(gnomon_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT;PREFIX" "LABELS;SOURCES;DEPENDS")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS} gnomon_options GTest::gtest GTest::gtest_main)
  # Tests run what the modules were built as; their own code need not be fast, but compile fast.
  target_compile_options(${name} PRIVATE $<IF:$<CONFIG:Release>,-O1,-O0>)
  target_compile_definitions(${name} PRIVATE GNOMON_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    GNOMON_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  gtest_discover_tests(${name} NO_PRETTY_VALUES DISCOVERY_TIMEOUT 60
    TEST_PREFIX "${arg_PREFIX}"
    PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()
