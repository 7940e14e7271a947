#!/bin/sh
# Shows that check.sh accepts a good tree and refuses each kind of bad file.
set -eu
check=$(dirname "$0")/check.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

mkdir -p "$tree/include/strutt/base" "$tree/include/strutt/chart" "$tree/include/strutt/floquet" \
  "$tree/src/base" "$tree/src/floquet" "$tree/src/free_pendulum" "$tree/src/integrate" "$tree/src/io" "$tree/apps/strutt"
good() { printf '%s\n' "$2" > "$tree/$1"; }
good include/strutt/base/error.hpp '#include <string>'
good include/strutt/base/matrix.hpp '#include <Eigen/Core>'
good include/strutt/floquet/verdict.hpp '#include "strutt/base/error.hpp"  // comment'
good include/strutt/chart/axis.hpp '#include "strutt/floquet/verdict.hpp"'
good src/floquet/lapack.cpp '#include <lapacke.h>'
good src/floquet/private.hpp '#include "strutt/base/error.hpp"'
good src/floquet/verdict.cpp '#include "floquet/private.hpp"'
good src/integrate/sundials.cpp '#include <cvodes/cvodes.h>'
good src/io/file.cpp '#include <hdf5.h>'
good apps/strutt/main.cpp '#include <CLI/CLI.hpp>'
good CMakeLists.txt 'project(good)'
sh "$check" "$tree"

failures=0
refuses() {  # FILE LINE...: the tree with LINE added to FILE must be refused
  file=$1; shift
  if [ -f "$tree/$file" ]; then cp "$tree/$file" "$tree/saved"; fi
  printf '%s\n' "$@" >> "$tree/$file"
  if sh "$check" "$tree" > /dev/null 2>&1; then
    echo "accepted: $* in $file"
    failures=1
  fi
  rm "$tree/$file"
  if [ -f "$tree/saved" ]; then mv "$tree/saved" "$tree/$file"; fi
}
refuses include/strutt/base/bad.hpp '#include "strutt/chart/axis.hpp"'
refuses include/strutt/base/bad.hpp '  #  include <strutt/chart/axis.hpp>'
refuses include/strutt/base/bad.hpp '#include "strutt/base/missing.hpp"'
refuses include/strutt/floquet/bad.hpp '#include "floquet/private.hpp"'
refuses include/strutt/base/bad.hpp '#include <boost/math/constants/constants.hpp>'
refuses include/strutt/base/bad.hpp '#include <fmt/core.h>'
refuses include/strutt/base/bad.hpp '#include <tbb/task_arena.h>'
refuses src/base/bad.cpp '#include "floquet/private.hpp"'
refuses src/free_pendulum/bad.cpp '#include "strutt/floquet/verdict.hpp"'
refuses src/floquet/bad.cpp '#include <nvector/nvector_serial.h>'
refuses src/floquet/bad.cpp '#include <lapacke.h>'
refuses src/floquet/bad.cpp '#include <tbb/parallel_for.h>'
refuses src/floquet/bad.cpp '#include <hdf5.h>'
refuses src/floquet/bad.cpp '#include <toml++/toml.h>'
refuses src/io/bad.cpp '#include <CLI/CLI.hpp>'
refuses src/unknown.cpp 'int x;'
refuses CMakeLists.txt 'add_compile_options(-ffast-math)'
refuses CMakeLists.txt 'add_compile_options(-march=native)'
refuses CMakePresets.json '{"CMAKE_CXX_FLAGS_RELEASE": "-Ofast"}'

good include/strutt/base/one.hpp '#include "strutt/base/two.hpp"'
refuses include/strutt/base/two.hpp '#include "strutt/base/one.hpp"'  # a circle
exit $failures
