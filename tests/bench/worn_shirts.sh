#!/usr/bin/env bash
# Dresses every photographed T-shirt pair of the external test data on ten closed bodies and on the raw scans, and prints a
# line a fit: how it ended, what is inside the body, strain, crossings, seconds, memory.
#   tests/bench/worn_shirts.sh PROGRAMS DATA OUT [JUDGE]
# PROGRAMS: folder of the built programs; DATA: the external test data; OUT: a folder for the results; JUDGE: a program
# `judge BODY.obj CLOTH.obj SEAMS.txt REST.obj` that measures independently of this project.
set -euo pipefail
programs=$1 data=$2 out=$3 judge=${4:-}
mkdir -p "$out"
length_cm=68
total=0 worn=0

wear() {  # wear SHIRT SCAN NAME
  local folder="$out/$1-$3" line
  "$programs/fit_client" fit --scan "$2" --garment "$out/$1" --out "$folder" --meshes --no-pictures --no-model --json \
    >"$out/report.json" 2>"$out/errors.txt" || { printf '%-18s %-6s FAILED %s\n' "$1" "$3" "$(cat "$out/errors.txt")"; return; }
  line=$(tr -d '\n' <"$out/report.json" | grep -o '"finishing_reason": *"[A-Z_]*"' | head -n 1)
  printf '%-18s %-6s %s' "$1" "$3" "$line"
  if [[ $line == *'"AT_REST"'* ]]; then worn=$((worn + 1)); fi
  if [[ -n $judge && $3 == p* ]]; then
    "$judge" "$folder/body.obj" "$folder/garment.obj" "$folder/seams.txt" "$folder/garment_rest.obj" |
      grep -oE 'inside [0-9]+|crossing body [0-9]+|crossing cloth [0-9]+|max [0-9.]+ mm|max [0-9.]+$' | tr '\n' ';'
  fi
  echo
}

for front in "$data"/garments/tshirt/saleor-*-front.png; do
  shirt=$(basename "$front" -front.png)
  "$programs/shop_catalog" extract "$front" "${front%-front.png}-back.png" --kind tshirt --length-cm "$length_cm" \
    --out "$out/$shirt" >/dev/null
  for number in 001 002 003 004 005 006 007 008 009 010; do
    total=$((total + 1))
    wear "$shirt" "$data/bodies/population/p$number.ply" "p$number"
  done
  for scan in p001_scan p002_scan; do
    total=$((total + 1))
    wear "$shirt" "$data/bodies/scans/$scan.ply" "scan-$scan"
  done
done
echo "worn and at rest: $worn of $total"
