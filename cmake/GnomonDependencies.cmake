# Everything comes from Debian 12; docs/dependencies.md says what each is for.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(GTest REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenSSL 3 REQUIRED)

find_path(GNOMON_GLM_INCLUDE glm/glm.hpp REQUIRED)
find_path(GNOMON_EXPECTED_INCLUDE tl/expected.hpp REQUIRED)
find_path(GNOMON_XXHASH_INCLUDE xxhash.h REQUIRED)
find_library(GNOMON_XXHASH_LIBRARY xxhash REQUIRED)
find_path(GNOMON_BOOST_INCLUDE boost/asio.hpp REQUIRED)
