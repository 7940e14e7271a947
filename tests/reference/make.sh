#!/bin/sh
# Makes the reference CSV files anew: builds the programs, runs the methods, compares them
# and writes the files only if they agree. Usage: make.sh [SCRATCH [TARGET]]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=${1:-$(mktemp -d)}
target=${2:-$here}
mkdir -p "$work"
for program in cases taylor fourier collocation sturm fraction merge normal_form width; do
    ${CXX:-g++} -O2 -std=c++20 -I"${EIGEN:-/usr/include/eigen3}" "$here/$program.cpp" -o "$work/$program"
done
"$work/cases" "$work"
# Taylor beside the two others: the waits make a failure of either one stop the script.
"$work/taylor" "$work" &
taylor=$!
"$work/fourier" "$work"
"$work/collocation" "$work"
"$work/sturm" "$work"
"$work/fraction" "$work"
wait $taylor
"$work/merge" "$work" "$target"
"$work/normal_form" "$target"
"$work/width" "$target"
echo "written to $target"
