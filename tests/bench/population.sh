#!/usr/bin/env bash
# Dresses every body of the external test data in five outfits of drawn garments, in the size that its bust or hip names.
#   tests/bench/population.sh BUILD DATA [further options of population_bench, for example --every 10 or --step -2]
# BUILD: the build's folder (build/release); DATA: the external test data. Prints a line a garment, a table of
# the outfits, one of worn girths against what they have to be and, with --all-sizes, the ease of every size.
# FITROOM_TEST_DATA in the environment stands instead of DATA. Without data it ends with 77, which the test runner takes
# for a skipped test.
set -euo pipefail
build=$1 data=${FITROOM_TEST_DATA:-$2}
shift 2
if [[ ! -d $data/bodies/population && -z ${FITROOM_REQUIRE_TEST_DATA:-} ]]; then
  echo "population: the external test data is absent: $data/bodies/population" >&2
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
make_garment() {
  local kind=$1 length fabric
  "$build/bin/shop_catalog" synthesize --kind "$kind" --size 12 --out "$work/$kind-photos" >/dev/null
  length=$(tr -d ' \n' <"$work/$kind-photos/chart.json" | grep -oE '"name":"12","measures_cm":\{[^}]*"(front_)?length":[0-9.]+' |
    grep -oE '[0-9.]+$')
  fabric=$(grep -oE '"fabric": *"[a-z]+"' "$work/$kind-photos/chart.json" | grep -oE '[a-z]+"$' | tr -d '"')
  "$build/bin/shop_catalog" extract "$work/$kind-photos/front.png" "$work/$kind-photos/back.png" --kind "$kind" \
    --annotation "$work/$kind-photos/truth.json" --chart "$work/$kind-photos/chart.json" --length-cm "$length" --fabric "$fabric" --id "${kind//_/-}" \
    --out "$work/$kind" >/dev/null
}
# Two at a time.
for pair in "tshirt one_piece" "skirt pants"; do
  makers=()
  for kind in $pair; do
    make_garment "$kind" &
    makers+=($!)
  done
  for maker in "${makers[@]}"; do wait "$maker"; done
done
"$build/tests/bench/population_bench" --bodies "$data/bodies/population" --garments "$work" "$@"
