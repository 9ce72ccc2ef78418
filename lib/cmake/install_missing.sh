# shellcheck shell=bash
# For the run scripts: say(), cores, and install_missing() for what building taut needs.

say() { printf '\n== %s\n' "$*"; }

# shellcheck disable=SC2034  # used by the scripts that source this one
cores=$(nproc 2>/dev/null || sysctl -n hw.ncpu 2>/dev/null || echo 2)

has_cmake() {
  local version
  version=$(cmake --version 2>/dev/null | sed -n '1s/.*version //p')
  [ -n "$version" ] && [ "$(printf '3.22\n%s\n' "$version" | sort -V | head -n 1)" = 3.22 ]
}

compiler() { command -v "${CXX:-c++}" || command -v g++ || command -v clang++; }

# Whether the header of a Debian package is there, from wherever it is.
has_header_of() {
  local header
  case "$1" in
    libeigen3-dev) header=Eigen/Core ;;
    nlohmann-json3-dev) header=nlohmann/json.hpp ;;
    libcli11-dev) header=CLI/CLI.hpp ;;
    libcpp-httplib-dev) header=httplib.h ;;
    doctest-dev) header=doctest/doctest.h ;;
  esac
  [ -n "$(compiler)" ] && echo "#include <$header>" | "$(compiler)" -std=c++17 -E -x c++ -I/usr/include/eigen3 -I/usr/local/include \
    -I/usr/local/include/eigen3 -I/opt/homebrew/include -I/opt/homebrew/include/eigen3 - >/dev/null 2>&1
}

# Sets `missing_tools` and `missing_headers` to the Debian packages of what is missing of the tools and of these.
find_missing() {
  local package
  missing_tools=""
  missing_headers=""
  has_cmake || missing_tools+=" cmake"
  command -v make >/dev/null || command -v ninja >/dev/null || missing_tools+=" make"
  [ -n "$(compiler)" ] || missing_tools+=" g++"
  for package in "$@"; do
    has_header_of "$package" || missing_headers+=" $package"
  done
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

# install_missing [program] [tests]: installs what is missing for the library, for the program and for the tests, with
# apt-get if that is possible. Ends the script if a tool stays missing; header libraries that stay missing are
# downloaded by CMake.
install_missing() {
  local missing_tools missing_headers packages=(libeigen3-dev)
  [[ " $* " != *" program "* ]] || packages+=(nlohmann-json3-dev libcli11-dev libcpp-httplib-dev)
  [[ " $* " != *" tests "* ]] || packages+=(doctest-dev)
  find_missing "${packages[@]}"
  if [ -n "$missing_tools$missing_headers" ]; then
    say "Installing what is missing:$missing_tools$missing_headers"
    # shellcheck disable=SC2086  # words
    if command -v apt-get >/dev/null && apt_install $missing_tools $missing_headers; then
      find_missing "${packages[@]}"
    fi
  fi
  # CMake itself does not look for ninja.
  command -v make >/dev/null || export CMAKE_GENERATOR=Ninja
  if [ -z "$missing_tools$missing_headers" ]; then
    return
  fi
  cat <<TEXT

Not installed:$missing_tools$missing_headers
The build needs cmake 3.22 or newer, make or ninja, a C++17 compiler, Eigen, nlohmann-json, CLI11, cpp-httplib and doctest:
  Debian, Ubuntu   apt-get install cmake make g++ libeigen3-dev nlohmann-json3-dev libcli11-dev libcpp-httplib-dev doctest-dev
  Fedora           dnf install cmake make gcc-c++ eigen3-devel json-devel cli11-devel cpp-httplib-devel doctest-devel
  macOS            xcode-select --install; brew install cmake eigen nlohmann-json cli11 cpp-httplib doctest
TEXT
  if [ -n "$missing_tools" ]; then
    exit 1
  fi
  echo "These are header libraries: CMake downloads them now if there is internet."
}
