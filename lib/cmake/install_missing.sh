# shellcheck shell=bash
# For the run scripts: say(), cores, and install_missing() for all that building taut needs.

say() { printf '\n== %s\n' "$*"; }

# shellcheck disable=SC2034  # used by the scripts that source this one
cores=$(nproc 2>/dev/null || sysctl -n hw.ncpu 2>/dev/null || echo 2)

has_cmake() {
  local version
  version=$(cmake --version 2>/dev/null | sed -n '1s/.*version //p')
  [ -n "$version" ] && [ "$(printf '3.22\n%s\n' "$version" | sort -V | head -n 1)" = 3.22 ]
}

compiler() { command -v "${CXX:-c++}" || command -v g++ || command -v clang++; }

has_header() {
  echo "#include <$1>" | "$(compiler)" -std=c++17 -E -x c++ -I/usr/include/eigen3 -I/usr/local/include \
    -I/usr/local/include/eigen3 -I/opt/homebrew/include -I/opt/homebrew/include/eigen3 - >/dev/null 2>&1
}

# Sets `missing_tools` and `missing_headers` to the Debian packages of what is missing.
find_missing() {
  missing_tools=""
  missing_headers=""
  has_cmake || missing_tools+=" cmake"
  command -v make >/dev/null || command -v ninja >/dev/null || missing_tools+=" make"
  if [ -z "$(compiler)" ]; then
    missing_tools+=" g++"
    missing_headers=" libeigen3-dev nlohmann-json3-dev libcli11-dev doctest-dev" # not to be checked without it
    return
  fi
  has_header Eigen/Core || missing_headers+=" libeigen3-dev"
  has_header nlohmann/json.hpp || missing_headers+=" nlohmann-json3-dev"
  has_header CLI/CLI.hpp || missing_headers+=" libcli11-dev"
  has_header doctest/doctest.h || missing_headers+=" doctest-dev"
}

# Installs Debian packages, as root or with sudo.
apt_install() {
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || return 1
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"
}

# Installs what is missing with apt-get if that is possible. Ends the script if a tool stays missing;
# header libraries that stay missing are downloaded by CMake.
install_missing() {
  local missing_tools missing_headers
  find_missing
  if [ -n "$missing_tools$missing_headers" ]; then
    say "Installing what is missing:$missing_tools$missing_headers"
    # shellcheck disable=SC2086  # words, not one name
    if command -v apt-get >/dev/null && apt_install $missing_tools $missing_headers; then
      find_missing
    fi
  fi
  # CMake itself does not look for ninja.
  command -v make >/dev/null || export CMAKE_GENERATOR=Ninja
  if [ -z "$missing_tools$missing_headers" ]; then
    return
  fi
  cat <<TEXT

Not installed:$missing_tools$missing_headers
The build needs cmake 3.22 or newer, make or ninja, a C++17 compiler, Eigen, nlohmann-json, CLI11 and doctest:
  Debian, Ubuntu   apt-get install cmake make g++ libeigen3-dev nlohmann-json3-dev libcli11-dev doctest-dev
  Fedora           dnf install cmake make gcc-c++ eigen3-devel json-devel cli11-devel doctest-devel
  macOS            xcode-select --install; brew install cmake eigen nlohmann-json cli11 doctest
TEXT
  if [ -n "$missing_tools" ]; then
    exit 1
  fi
  echo "These are header libraries: CMake downloads them now if there is internet."
}
