#!/usr/bin/env bash
# One T-shirt, flat panels to rest, by this project and by Blender's cloth, in one run on one machine, with the same judge.
#   tests/bench/against_blender.sh PROGRAMS PEERS OUT [PITCH] [BODY]
# PROGRAMS: folder of the built programs; PEERS: the folder with the panels, bodies, Blender's script and the judge; PITCH:
# 0.02, 0.01 (default) or 0.005; BODY: body120k (default) or body13k. Needs Blender (Debian: blender, python3-numpy).
# Both run until 99 % of the particles are slower than 2 cm/s, on two threads. Prints wall and CPU seconds of both, their
# ratios, and what the judge says of both ends. Ours runs before and after; its slower run counts.
set -euo pipefail

fail() {
  echo "against_blender.sh: $*" >&2
  exit 1
}
(($# >= 3)) || fail "usage: tests/bench/against_blender.sh PROGRAMS PEERS OUT [PITCH] [BODY]"
programs=$1 peers=$2 out=$3 pitch=${4:-0.01} body=${5:-body120k}

for tool in "blender blender" "zstd zstd" "g++ g++" "awk mawk"; do
  read -r command package <<<"$tool"
  command -v "$command" >/dev/null || fail "$command is missing: apt-get install $package"
done
# Debian's Blender runs Debian's Python, whichever comes first in the path.
/usr/bin/python3 -c 'import numpy' 2>/dev/null || fail "Debian's python3 has no numpy: apt-get install python3-numpy"
[[ -x $programs/fit_client ]] || fail "$programs/fit_client is not there: PROGRAMS is build/release/bin after cmake --build"
[[ -d $peers ]] || fail "$peers is no folder: PEERS holds the panels, bodies, run_blender.sh and judge.cc"
for file in "$body.obj.zst" "shirt_$pitch.obj" "shirt_${pitch}_seams.txt" judge.cc run_blender.sh; do
  [[ -r $peers/$file ]] || fail "$peers/$file is not there: PEERS must hold it for this PITCH and BODY"
done
[[ -x $peers/run_blender.sh ]] || fail "$peers/run_blender.sh may not be run: chmod +x it"
mkdir -p "$out"
# What an earlier run left must not be taken for this one's.
rm -f "$out"/{ours,blender}.obj "$out"/*.time "$out"/*.log
zstd -dqf "$peers/$body.obj.zst" -o "$out/$body.obj"
panels="$peers/shirt_$pitch.obj" seams="$peers/shirt_${pitch}_seams.txt"
g++ -O2 "$peers/judge.cc" -o "$out/judge"

timed() {  # timed NAME COMMAND...: leaves "wall cpu" in $out/NAME.time
  local name=$1 TIMEFORMAT='%R %U %S'
  shift
  # The shell's own status is that of the command; its last words say why it failed.
  { time "$@" >"$out/$name.log" 2>&1; } 2>"$out/$name.raw" || {
    tail -n 20 "$out/$name.log" >&2
    fail "$name failed; all it said is in $out/$name.log"
  }
  awk '{print $1, $2 + $3}' "$out/$name.raw" >"$out/$name.time"
}
ours() {
  timed "$1" "$programs/fit_client" drape --body "$out/$body.obj" --panels "$panels" --seams "$seams" --out "$out/ours.obj" \
    --report "$out/ours.json" --threads 2 --up z
}

ours ours_before
timed blender "$peers/run_blender.sh" "$out/$body.obj" "$panels" "$seams" "$out/blender.obj" 2
# Blender ends with success even where its script did not.
[[ -s $out/blender.obj ]] || fail "Blender wrote no garment; what it said is in $out/blender.log"
ours ours_after
[[ -s $out/ours.obj ]] || fail "fit_client wrote no garment; what it said is in $out/ours_after.log"
sort -n -r "$out/ours_before.time" "$out/ours_after.time" | head -n 1 >"$out/ours.time"

printf '%-10s %10s %10s\n' "" "wall s" "CPU s"
for name in ours blender; do printf '%-10s %10s %10s\n' "$name" $(cat "$out/$name.time"); done
paste -d ' ' "$out/blender.time" "$out/ours.time" | awk '{printf "%-10s %9.0fx %9.0fx\n", "ratio", $1 / $3, $2 / $4}'
grep -E '^(REST|RESULT)' "$out/blender.log" ||
  fail "Blender did not say how its run ended (REST, RESULT); what it said is in $out/blender.log"
for name in ours blender; do
  echo "judge: $name"
  "$out/judge" "$out/$body.obj" "$out/$name.obj" "$seams" "$panels"
done
