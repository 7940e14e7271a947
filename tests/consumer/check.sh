#!/bin/sh
# Usage: check.sh BUILD_DIR. Installs that build into a temporary place, moves it, and there builds and runs main.cpp
# twice: with find_package(strutt) and with pkg-config. CXX and CXXFLAGS apply to both.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --build "$1"
cmake --install "$1" --prefix "$scratch/first" > /dev/null
prefix="$scratch/moved here"
mv "$scratch/first" "$prefix"
[ ! -e "$prefix/bin/strutt" ] || "$prefix/bin/strutt" --version

cmake -G Ninja -S "$here" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$prefix" > /dev/null
cmake --build "$scratch/build"
"$scratch/build/consumer"
echo "find_package(strutt): good"

pc=$(find "$prefix" -name strutt.pc)
export PKG_CONFIG_PATH="${pc%/*}"
static=
[ -n "$(find "$prefix" -name libstrutt.so)" ] || static=--static
# pkg-config quotes blanks in paths for the shell.
eval "${CXX:-c++} -std=c++20 ${CXXFLAGS-} $(pkg-config --cflags strutt) '$here/main.cpp' -o '$scratch/consumer'" \
  "$(pkg-config $static --libs strutt)"
LD_LIBRARY_PATH=${pc%/pkgconfig/*} "$scratch/consumer"
echo "pkg-config strutt: good"
