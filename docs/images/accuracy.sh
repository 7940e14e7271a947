#!/bin/sh
# Usage: accuracy.sh [PROGRAM]. Measures the scenes of docs/examples and the extremes again (some minutes, on an idle
# machine), draws the pictures of docs/accuracy.md and fills in its tables, which stand between `<!-- NAME -->` and
# `<!-- end -->`. Needs pngquant.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
program=${1:-$here/../../build/release/strutt}
page=$here/../accuracy.md
command -v pngquant > /dev/null || { echo "accuracy.sh: pngquant is missing" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# measure SCENE NAME LABEL PICTURE: adds rows "label|method|tolerance|..." to $work/NAME.
measure() {
  set -- "$1" "$2" "$3" "$4" "$work/rows.csv"
  if [ -n "$4" ]; then
    "$program" tradeoff "$1" -o "$5" --figure "$here/$4" --quiet
    pngquant --nofs --strip --force --output "$here/$4" 64 "$here/$4"
  else
    "$program" tradeoff "$1" -o "$5" --quiet
  fi
  awk -F, -v label="$3" '!/^#/ && $1 != "method" { printf "%s", label; for (i = 1; i <= NF; ++i) printf "|%s", $i; print "" }' \
    "$5" >> "$work/$2"
}

# extreme LABEL PICTURE TEXT
extreme() {
  printf '%b' "$3" > "$work/extreme.toml"
  measure "$work/extreme.toml" extremes "$1" "$2"
}

for scene in "$here"/../examples/*.toml; do
  name=$(basename "$scene" .toml)
  measure "$scene" scenes "$name" "accuracy_$name.png"
done
mathieu='[mathieu]\nepsilon = 0.5\n'
extreme 'δ = 10⁴, ε = 1' accuracy_extreme.png '[mathieu]\ndelta = 1e4\nepsilon = 1\n'
extreme 'δ = −50, ε = 10' '' '[mathieu]\ndelta = -50\nepsilon = 10\n'
extreme 'δ = 1, ε = 10³' '' '[mathieu]\ndelta = 1\nepsilon = 1e3\n'
extreme 'c = 10⁻⁹' '' "${mathieu}damping = 1e-9\n"
extreme 'c = 10' '' "${mathieu}damping = 10\n"
extreme 'ω/α = 100' '' \
  '[pendulum]\nlength = 1\nabout = "inverted"\n[support]\namplitude = 0.02\nfrequency = 383.60135557633265\n'

# Columns: 1 label, 2 method, 3 tolerance, 4 used, 5 points, 6 converged, 7 exceeded, 8 error, 9 true error, 11 rate,
# 13 steps, 14 and 15 evaluations.
common='
  function rate(x) { return x >= 1e5 ? sprintf("%.2f million", x / 1e6) : x >= 1e3 ? sprintf("%.1f thousand", x / 1e3) : sprintf("%.0f", x) }
  function short(x) { return sprintf("%.1e", x) }
  function once(x) { if (x == last) return ""; last = x; return x }
  function decade(x) { return sprintf("%.0e", x) }'
auto_table() {
  echo '| scene | tolerance | by | points that reach it | bound reported | true error | points/s |'
  echo '|---|---|---|---|---|---|---|'
  awk -F'|' "$common"'
    function wanted(x) { return x == "1e-03" || x == "1e-06" || x == "1e-09" || x == "1e-12" }
    $2 == "auto" && wanted(decade($3)) {
      printf "| %s | %s | %s | %d of %d | %s | %s | %s |\n", once($1), decade($3), $4, $6, $5, short($8), short($9), rate($11)
    }' "$1"
}
method_table() {
  echo '| scene | method | true error | points/s | evaluations per point, with those for the bound |'
  echo '|---|---|---|---|---|'
  awk -F'|' "$common"'
    $2 != "auto" && decade($3) == "1e-09" {
      printf "| %s | %s | %s | %s | %.0f |\n", once($1), $2, short($9), rate($11), $14 + $15
    }' "$1"
}
counts() {
  cat "$work/scenes" "$work/extremes" |
    awk -F'|' '{ n += $5; bad += $7 } END { printf "Results compared with the reference: %d. Further from it than their bound: %d.\n", n, bad }'
}

auto_table "$work/scenes" > "$work/auto-scenes.md"
method_table "$work/scenes" > "$work/methods-scenes.md"
auto_table "$work/extremes" > "$work/auto-extremes.md"
method_table "$work/extremes" > "$work/methods-extremes.md"
counts > "$work/counts.md"
awk -v work="$work" '
  /^<!-- end -->$/ { inside = 0 }
  !inside { print }
  /^<!-- [a-z-]+ -->$/ && $2 != "end" {
    inside = 1
    print ""
    file = work "/" $2 ".md"
    while ((getline line < file) > 0) print line
    print ""
  }' "$page" > "$work/page.md"
cp "$work/page.md" "$page"
