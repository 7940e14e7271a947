#!/bin/sh
# Usage: check.sh ROOT. Fails when a source file of ROOT includes something that its layer must not see (the order
# of the layers and the homes of the foreign libraries are the two tables below), when headers include each other in
# a circle, or when a build file asks for flags that change results.
set -eu
cd "$1"
edges=$(mktemp)
trap 'rm -f "$edges"' EXIT
status=0

# shellcheck disable=SC2016  # $0 is the line in awk
find include src apps \( -name '*.[ch]pp' -o -name '*.inc' \) | sort | xargs awk -v edges="$edges" '
BEGIN {
  # A file includes from its own layer and from layers with a smaller number. Equal numbers do not see each other.
  split("base 1 model 2 integrate 3 floquet 4 free_pendulum 4 chart 5 io 6 apps 7", word, " ")
  for (i = 1; i in word; i += 2) level[word[i]] = word[i + 1]

  # Foreign header, and the only place that may include it.
  home["^(cvodes?|arkode|sundials|nvector|sunmatrix|sunlinsol|sunnonlinsol)/"] = "^src/integrate/"
  home["^(tbb|oneapi)/|^execution$"] = "^src/base/parallel.cpp$"
  home["^(hdf5|toml\\+\\+/|H5|zlib)"] = "^src/io/"
  home["^nlohmann/"] = "^(src/io|apps)/"
  home["^CLI/"] = "^apps/"
  home["^(lapacke|cblas)"] = "^src/"
}
function refuse(why) { printf "%s:%d: %s: %s\n", FILENAME, FNR, header, why; bad = 1 }
function layer_of(path) {
  sub("^(include/strutt|src)/", "", path)
  sub("/.*", "", path)
  return path
}
function exists(path,  line, found) {
  found = (getline line < path) >= 0
  close(path)
  return found
}
function check_own(  target, to) {
  if (header ~ "^strutt/") target = "include/" header
  else {
    target = FILENAME; sub("[^/]*$", "", target); target = target header
    if (!exists(target)) target = "src/" header
  }
  if (!exists(target)) { refuse("no such file"); return }
  if (public && target !~ "^include/") refuse("a public header includes a private one")
  to = layer_of(target)
  if (to != layer && level[to] >= level[layer]) refuse("layer " layer " must not see layer " to)
  print FILENAME, target > edges
}
function check_foreign(  pattern) {
  for (pattern in home) if (header ~ pattern && FILENAME !~ home[pattern]) refuse("belongs in " home[pattern])
  if (header ~ "^(lapacke|cblas)" && lapack != "" && lapack != FILENAME) refuse("is included by " lapack " already")
  if (header ~ "^(lapacke|cblas)") lapack = FILENAME
  if (public && header !~ "^Eigen/" && header ~ "[/.]") refuse("a public header shows only std, Eigen and strutt")
}
FNR == 1 {
  public = FILENAME ~ "^include/"
  layer = layer_of(FILENAME)
  header = ""
  if (!(layer in level)) refuse("not in a known layer")
}
/^[ \t]*#[ \t]*include/ {
  header = $0
  sub(/^[ \t]*#[ \t]*include[ \t]*/, "", header)
  own = header ~ /^"/
  sub(/^["<]/, "", header)
  sub(/[">].*/, "", header)
  if (own || header ~ "^strutt/") check_own(); else check_foreign()
}
END { exit bad }' || status=1

circle=$(tsort "$edges" 2>&1 >/dev/null) || { echo "headers include each other in a circle: $circle"; status=1; }

# Flags that make results depend on the machine or on the compiler.
flags='-march=native|-mtune=native|-ffast-math|-Ofast|-funsafe-math-optimizations'
find . \( -name .git -o -path ./build -o -path ./out \) -prune -o \
  \( -name CMakeLists.txt -o -name '*.cmake' -o -name '*.in' -o -name CMakePresets.json -o -path ./run \
     -o -path ./.ci/run \) -type f -exec grep -EHn -e "$flags" {} + && status=1

exit $status
