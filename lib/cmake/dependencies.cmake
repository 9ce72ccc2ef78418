# What taut needs from others: an installed package if there is one, otherwise the headers of a pinned release.
include_guard(GLOBAL)
include(FetchContent)

# Says which package is used and makes its target visible to the whole build, not just to this folder.
macro(taut_use_installed package target)
  message(STATUS "taut: using the installed ${package} ${${package}_VERSION}")
  get_target_property(taut_imported ${target} IMPORTED)
  if(taut_imported)
    set_target_properties(${target} PROPERTIES IMPORTED_GLOBAL TRUE)
  endif()
endmacro()

# Makes `target` from the folder `include` of a release archive. Only headers are taken: no project is added, so
# nothing of it is built, tested or installed, and as an imported target its headers raise no warnings.
function(taut_fetch_headers name target include url sha256)
  message(STATUS "taut: ${target} is not installed, using ${url}")
  FetchContent_Declare(
    ${name}
    URL ${url}
    URL_HASH SHA256=${sha256}
    SOURCE_SUBDIR holds-no-cmakelists)
  FetchContent_MakeAvailable(${name})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} INTERFACE ${${name}_SOURCE_DIR}/${include})
endfunction()

function(taut_need_eigen)
  if(TARGET Eigen3::Eigen) # of the project around us
    return()
  endif()
  # Without a version: Eigen 5 calls itself incompatible with 3.4 and the other way round, but taut takes both,
  # and a second call would no longer know an Eigen3_DIR that was given.
  find_package(Eigen3 CONFIG QUIET)
  if(Eigen3_FOUND)
    if(Eigen3_VERSION VERSION_LESS 3.4)
      message(FATAL_ERROR "taut needs Eigen 3.4 or 5, this is ${Eigen3_VERSION}: ${Eigen3_DIR}\n"
                          "With -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON it is downloaded.")
    endif()
    taut_use_installed(Eigen3 Eigen3::Eigen)
  else()
    taut_fetch_headers(
      taut_eigen Eigen3::Eigen . https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.bz2
      b4c198460eba6f28d34894e3a5710998818515104d6e74e5cc331ce31e46e626)
  endif()
endfunction()

function(taut_need_json)
  find_package(nlohmann_json 3.10 CONFIG QUIET)
  if(nlohmann_json_FOUND)
    taut_use_installed(nlohmann_json nlohmann_json::nlohmann_json)
  else()
    taut_fetch_headers(
      taut_json nlohmann_json::nlohmann_json include
      https://github.com/nlohmann/json/releases/download/v3.11.3/json.tar.xz
      d6c65aca6b1ed68e7a182f4757257b107ae403032760ed6ef121c9d55e81757d)
  endif()
endfunction()

function(taut_need_cli11)
  find_package(CLI11 2.1 CONFIG QUIET)
  if(CLI11_FOUND)
    taut_use_installed(CLI11 CLI11::CLI11)
  else()
    taut_fetch_headers(
      taut_cli11 CLI11::CLI11 include https://github.com/CLIUtils/CLI11/archive/refs/tags/v2.4.2.tar.gz
      f2d893a65c3b1324c50d4e682c0cdc021dd0477ae2c048544f39eed6654b699a)
  endif()
endfunction()

# Debian's package is compiled, with OpenSSL, zlib and Brotli, and so must be what is linked to it. Releases from 0.15 on
# have other classes of streams.
function(taut_need_httplib)
  find_path(TAUT_HTTPLIB_INCLUDE httplib.h)
  find_library(TAUT_HTTPLIB_LIBRARY cpp-httplib)
  set(version 0)
  if(TAUT_HTTPLIB_INCLUDE)
    file(STRINGS ${TAUT_HTTPLIB_INCLUDE}/httplib.h line REGEX "define CPPHTTPLIB_VERSION \"")
    string(REGEX MATCH "[0-9.]+" version "${line}")
  endif()
  if(version VERSION_GREATER_EQUAL 0.11 AND version VERSION_LESS 0.15)
    message(STATUS "taut: using the installed cpp-httplib ${version}")
    add_library(httplib::httplib INTERFACE IMPORTED GLOBAL)
    target_include_directories(httplib::httplib INTERFACE ${TAUT_HTTPLIB_INCLUDE})
    if(TAUT_HTTPLIB_LIBRARY)
      target_link_libraries(httplib::httplib INTERFACE ${TAUT_HTTPLIB_LIBRARY})
      target_compile_definitions(httplib::httplib INTERFACE CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT
                                                            CPPHTTPLIB_BROTLI_SUPPORT)
    endif()
  else()
    taut_fetch_headers(
      taut_httplib httplib::httplib . https://github.com/yhirose/cpp-httplib/archive/refs/tags/v0.11.4.zip
      9d884bee50ded17de3a51d673bb9c2d7d11f101c595b0891830ba9d02e0cc368)
  endif()
endfunction()

function(taut_need_doctest)
  find_package(doctest 2.4 CONFIG QUIET)
  if(doctest_FOUND)
    taut_use_installed(doctest doctest::doctest)
  else()
    taut_fetch_headers(
      taut_doctest doctest::doctest . https://github.com/doctest/doctest/archive/refs/tags/v2.4.11.tar.gz
      632ed2c05a7f53fa961381497bf8069093f0d6628c5f26286161fbd32a560186)
  endif()
endfunction()

# The one dependency that is compiled: it has no header-only form.
function(taut_need_benchmark)
  find_package(benchmark 1.6 CONFIG QUIET)
  if(benchmark_FOUND)
    taut_use_installed(benchmark benchmark::benchmark)
  else()
    message(STATUS "taut: Google Benchmark is not installed, using release 1.8.3")
    set(BENCHMARK_ENABLE_TESTING OFF)
    set(BENCHMARK_ENABLE_INSTALL OFF)
    set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)
    FetchContent_Declare(
      taut_benchmark
      URL https://github.com/google/benchmark/archive/refs/tags/v1.8.3.tar.gz
      URL_HASH SHA256=6bc180a57d23d4d9515519f92b0c83d61b05b5bab188961f36ac7b06b0d9e9ce)
    FetchContent_MakeAvailable(taut_benchmark)
  endif()
endfunction()
