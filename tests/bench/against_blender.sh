#!/usr/bin/env bash
# One T-shirt, flat panels to rest, by this project and by Blender's cloth, in one run on one machine, with the same judge.
#   tests/bench/against_blender.sh PROGRAMS PEERS OUT [PITCH] [BODY]
# PROGRAMS: folder of the built programs; PEERS: the folder with the panels, bodies, Blender's script and the judge; PITCH:
# 0.02, 0.01 (default) or 0.005; BODY: body120k (default) or body13k. Needs Blender (Debian: blender, python3-numpy).
# Both run until 99 % of the particles are slower than 2 cm/s, on two threads. Prints wall and CPU seconds of both, their
# ratios, and what the judge says of both ends. Ours runs before and after; its slower run counts.
set -euo pipefail
programs=$1 peers=$2 out=$3 pitch=${4:-0.01} body=${5:-body120k}
mkdir -p "$out"
zstd -dqf "$peers/$body.obj.zst" -o "$out/$body.obj"
panels="$peers/shirt_$pitch.obj" seams="$peers/shirt_${pitch}_seams.txt"
g++ -O2 "$peers/judge.cc" -o "$out/judge"

timed() {  # timed NAME COMMAND...: leaves "wall cpu" in $out/NAME.time
  local name=$1 TIMEFORMAT='%R %U %S'
  shift
  { time "$@" >"$out/$name.log" 2>&1; } 2>"$out/$name.raw"
  awk '{print $1, $2 + $3}' "$out/$name.raw" >"$out/$name.time"
}
ours() {
  timed "$1" "$programs/fit_client" drape --body "$out/$body.obj" --panels "$panels" --seams "$seams" --out "$out/ours.obj" \
    --report "$out/ours.json" --threads 2 --up z
}

ours ours_before
timed blender "$peers/run_blender.sh" "$out/$body.obj" "$panels" "$seams" "$out/blender.obj" 2
ours ours_after
sort -n -r "$out/ours_before.time" "$out/ours_after.time" | head -n 1 >"$out/ours.time"

printf '%-10s %10s %10s\n' "" "wall s" "CPU s"
for name in ours blender; do printf '%-10s %10s %10s\n' "$name" $(cat "$out/$name.time"); done
paste -d ' ' "$out/blender.time" "$out/ours.time" | awk '{printf "%-10s %9.0fx %9.0fx\n", "ratio", $1 / $3, $2 / $4}'
grep -E '^(REST|RESULT)' "$out/blender.log" || true
for name in ours blender; do
  echo "judge: $name"
  "$out/judge" "$out/$body.obj" "$out/$name.obj" "$seams" "$panels"
done
