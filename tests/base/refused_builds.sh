#!/bin/sh
# Usage: refused_builds.sh ROOT COMPILER. Fails unless the sources refuse to be compiled with flags that break error bounds.
set -eu
compiles() { "$compiler" -std=c++20 -fsyntax-only -I"$root/include" "$@" "$root/src/base/floating_point.cpp" 2> /dev/null; }
root=$1 compiler=$2

compiles -O2 || { echo 'refused without reason'; exit 1; }
for flag in -ffast-math -Ofast; do
  if compiles $flag; then echo "compiled with $flag"; exit 1; fi
done
