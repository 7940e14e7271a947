#!/bin/sh
# Usage: make.sh [PROGRAM]. Draws the pictures of docs/gallery.md again, one for each scene of docs/examples but that
# of docs/portrait.md, which is not in the gallery, and the figure of docs/period.md.
# Needs pngquant (Debian package of that name), which brings a picture to a third of its size.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
program=${1:-$here/../../build/release/strutt}
command -v pngquant > /dev/null || { echo "make.sh: pngquant is missing" >&2; exit 1; }

for scene in "$here"/../examples/*.toml; do
  case $scene in */portrait_*) continue ;; esac
  picture=$here/$(basename "$scene" .toml).png
  code=0  # 1: done, but some cells are unresolved
  "$program" chart "$scene" -o /dev/null --figure "$picture" || code=$?
  [ $code -le 1 ] || exit $code
  pngquant --nofs --strip --force --output "$picture" 128 "$picture"
done

picture=$here/period_formulas.png
awk 'BEGIN { print "amplitude"; for (i = 1; i <= 314; ++i) print i / 100; print "3.141592653589793" }' |
  "$program" period --points - --compare -o /dev/null --quiet --figure "$picture"
pngquant --nofs --strip --force --output "$picture" 128 "$picture"
