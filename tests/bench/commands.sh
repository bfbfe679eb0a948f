#!/usr/bin/env bash
# Whole commands, measured: wall time, CPU time and peak memory of the processes that a user starts.
#   tests/bench/commands.sh [--bin FOLDER] [--runs N]
# Uses the project's own synthesized data, and the external test data where FITROOM_TEST_DATA names its folder. Prints
# one table to standard output. The machine should be quiet: the fastest of N runs is reported.
set -euo pipefail
cd "$(dirname "$0")/../.."

bin=build/release/bin
runs=3
while (($# > 0)); do
  case $1 in
    --bin) bin=${2:?--bin needs a folder}; shift 2 ;;
    --runs) runs=${2:?--runs needs a number}; shift 2 ;;
    *) sed -n '2,5s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
  esac
done
bin=$(cd "$bin" && pwd)
external=${FITROOM_TEST_DATA:-}

work=$(mktemp -d)
server=
finish() {
  if [[ -n $server ]]; then
    kill -TERM "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
  fi
  rm -rf "$work"
}
trap finish EXIT

# Runs a command, leaves "wall_s cpu_s peak_mb" in $work/usage. Without GNU time the peak is polled from /proc.
measure() {
  if [[ -x /usr/bin/time ]]; then
    /usr/bin/time -f '%e %U %S %M' -o "$work/time" "$@" >"$work/out" 2>"$work/err" || return 1
    awk '{printf "%.2f %.2f %.0f\n", $1, $2 + $3, $4 / 1024}' "$work/time" >"$work/usage"
    return
  fi
  local begin end before after peak=0 now process status=0
  before=$(children_seconds)
  begin=$(date +%s.%N)
  "$@" >"$work/out" 2>"$work/err" &
  process=$!
  while now=$(awk '/VmHWM/ {print $2}' "/proc/$process/status" 2>/dev/null) && [[ -n $now ]]; do
    peak=$now
    sleep 0.005
  done
  wait "$process" || status=$?
  end=$(date +%s.%N)
  after=$(children_seconds)
  awk -v b="$begin" -v e="$end" -v c="$before" -v d="$after" -v p="$peak" \
    'BEGIN {printf "%.2f %.2f %.0f\n", e - b, d - c, p / 1024}' >"$work/usage"
  return "$status"
}

# CPU seconds of all finished children of this shell.
children_seconds() {
  times | awk 'NR == 2 {split($1, u, /[ms]/); split($2, s, /[ms]/); print u[1] * 60 + u[2] + s[1] * 60 + s[2]}'
}

# Prints the fastest of the runs as a row. `prepare` (a command in one word, or :) goes before every run, unmeasured.
row() {
  local name=$1 prepare=$2 run wall cpu peak best=''
  shift 2
  for ((run = 0; run < runs; ++run)); do
    "$prepare"
    if ! measure "$@"; then
      printf '%-52s failed: %s\n' "$name" "$(tail -n 1 "$work/err")"
      return
    fi
    read -r wall cpu peak <"$work/usage"
    if [[ -z $best ]] || awk -v a="$wall" -v b="${best%% *}" 'BEGIN {exit !(a < b)}'; then best="$wall $cpu $peak"; fi
  done
  read -r wall cpu peak <<<"$best"
  printf '%-52s %8s %8s %8s\n' "$name" "$wall" "$cpu" "$peak"
}

start_body_center() {
  rm -rf "$work/body_data"
  "$bin/body_center" serve --data "$work/body_data" --listen 127.0.0.1:0 >"$work/listens" 2>"$work/server.log" &
  server=$!
  address=
  while [[ -z $address ]] && kill -0 "$server"; do
    address=$(sed -n 's/.* listens on \([^ ]*\).*/\1/p' "$work/listens")
    sleep 0.02
  done
}
# Registers each file once with a fresh server: an equal scan would be recognised.
register_bench() {
  local server_peak
  for file in "$@"; do
    start_body_center
    runs=1 row "register $(basename "$file") ($(($(stat -c %s "$file") / 1000000)) MB), client" : \
      "$bin/body_center" register "$file" --body bench --server "$address"
    server_peak=$(awk '/VmHWM/ {printf "%.0f", $2 / 1024}' "/proc/$server/status")
    printf '%-52s %8s %8s %8s\n' "  its server" - - "$server_peak"
    kill -TERM "$server"
    wait "$server" 2>/dev/null || true
    server=
  done
}

printf '%-52s %8s %8s %8s\n' "command ($(nproc) threads, load $(cut -d' ' -f1 /proc/loadavg))" wall_s cpu_s peak_MB
row "body_center synthesize, scan" : "$bin/body_center" synthesize --out "$work/body.ase"
row "body_center synthesize, clean" : "$bin/body_center" synthesize --out "$work/clean.ply" --clean
row "shop_catalog synthesize" : "$bin/shop_catalog" synthesize --out "$work/drawn"
row "body_center measure, own scan" : "$bin/body_center" measure "$work/body.ase" --json
row "shop_catalog extract, own pair" : "$bin/shop_catalog" extract "$work/drawn/front.png" "$work/drawn/back.png" \
  --kind tshirt --length-cm 68 --out "$work/shirt"
row "fit_client fit, own scan and T-shirt, 1 cm" : "$bin/fit_client" fit --scan "$work/body.ase" \
  --garment "$work/shirt" --out "$work/worn"
row "fit_client fit, the same without pictures" : "$bin/fit_client" fit --scan "$work/body.ase" \
  --garment "$work/shirt" --out "$work/worn" --no-pictures --no-model
register_bench "$work/body.ase"

if [[ -n $external && -d $external/bodies ]]; then
  for packed in "$external"/bodies/scans/p001_scan_60MB.ase.zst "$external"/bodies/scans/p001_scan_100MB.ase.zst; do
    [[ -f $packed ]] || continue
    zstd -dqf "$packed" -o "$work/$(basename "${packed%.zst}")"
    register_bench "$work/$(basename "${packed%.zst}")"
  done
  pair=$external/garments/tshirt/saleor-dash-tee
  if [[ -f $pair-front.png ]]; then
    row "shop_catalog extract, photographed pair" : "$bin/shop_catalog" extract "$pair-front.png" "$pair-back.png" \
      --kind tshirt --length-cm 68 --out "$work/photographed"
    row "fit_client fit, laser scan and photographs, 1 cm" : "$bin/fit_client" fit \
      --scan "$external/bodies/scans/p001_scan.ply" --garment "$work/photographed" --out "$work/worn"
  fi
  peers=$external/../peers
  if [[ -f $peers/shirt_0.01.obj ]]; then
    row "fit_client drape, 8,574 particles, 120k body" : "$bin/fit_client" drape --body "$peers/body120k.obj.zst" \
      --panels "$peers/shirt_0.01.obj" --seams "$peers/shirt_0.01_seams.txt" --out "$work/drape.obj" \
      --report "$work/drape.json" --threads 2 --up z
  fi
fi
